/* Building the scene that Embree traverses. */
#include "geometry/geometry.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/geometry_internal.h"

/* With fewer primitives than this, threads take longer to start than to help, and careful building longer than it
 * saves. */
#define LARGE_SCENE 20000

/* The first trouble that Embree told of. */
typedef struct trouble {
    enum RTCError code;
    char text[256];
} trouble;

static void note_trouble(void *user, enum RTCError code, const char *text) {
    trouble *t = user;
    if (t->code != RTC_ERROR_NONE)
        return;
    t->code = code;
    snprintf(t->text, sizeof t->text, "%s", text ? text : "");
}

static graze_status report_trouble(const trouble *t, const graze_report *report) {
    if (t->code == RTC_ERROR_OUT_OF_MEMORY)
        return report_out_of_memory(report);
    report_error(report, NULL, "Embree (error %d): %s", (int)t->code, t->text);
    return GRAZE_SYSTEM_ERROR;
}

static bool find_bounds(geometry *g, size_t count) {
    g->reach = malloc((count + 1) * sizeof *g->reach);
    if (!g->reach)
        return false;
    vec3 lower = {INFINITY, INFINITY, INFINITY}, upper = vec3_negate(lower);
    for (size_t i = 0; i < count; i++) {
        vec3 a, b;
        shape_bounds(&g->shapes[i], &a, &b);
        g->reach[i] = fmax(vec3_max_abs(a), vec3_max_abs(b));
        g->largest_reach = fmax(g->largest_reach, g->reach[i]);
        lower = vec3_make(fmin(lower.x, a.x), fmin(lower.y, a.y), fmin(lower.z, a.z));
        upper = vec3_make(fmax(upper.x, b.x), fmax(upper.y, b.y), fmax(upper.z, b.z));
    }
    vec3 half = vec3_scale(0.5, vec3_subtract(upper, lower));
    g->center = vec3_add(lower, half);
    int exponent;
    frexp(vec3_max_abs(half), &exponent);
    g->scale = ldexp(1, -exponent - 1);
    /* At most sqrt(3) times the half-width that the scale brings below 1/2; a little more takes in roundings. */
    g->radius = (1 + 1e-9) * vec3_length(vec3_scale(g->scale, half)) / g->scale + 1e-15 * vec3_max_abs(g->center);
    return true;
}

vec3 geometry_corner(const geometry *g, const geometry_triangle *triangle, int corner) {
    const shape *s = &g->shapes[triangle->surface];
    return s->polygon.vertices[s->polygon.triangles[triangle->index][corner]];
}

/* The least height of a triangle, in Embree's units. */
static double triangle_height(const geometry *g, const geometry_triangle *triangle, vec3 *normal) {
    vec3 a = geometry_corner(g, triangle, 0);
    vec3 ab = vec3_subtract(geometry_corner(g, triangle, 1), a), ac = vec3_subtract(geometry_corner(g, triangle, 2), a);
    vec3 bc = vec3_subtract(ac, ab);
    double longest2 = fmax(vec3_dot(ab, ab), fmax(vec3_dot(ac, ac), vec3_dot(bc, bc)));
    *normal = vec3_cross(ab, ac);
    return g->scale * vec3_length(*normal) / sqrt(longest2);
}

static double triangle_border(double height) {
    return fmin(fmax(height / 64, GEOMETRY_BORDER_LEAST), GEOMETRY_BORDER);
}

/* The farthest corner's distance from the scene's middle, in Embree's units. */
static double triangle_reach(const geometry *g, const geometry_triangle *triangle) {
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, g->scale * vec3_length(vec3_subtract(geometry_corner(g, triangle, i), g->center)));
    return reach;
}

static void set_tolerances(const geometry *g, geometry_triangle *triangle) {
    vec3 normal;
    double height = triangle_height(g, triangle, &normal), border = triangle_border(height);
    /* Where the polygon is not flat, its normal does not tell how obliquely the triangle is met. */
    bool flat = vec3_length(vec3_cross(normal, triangle->normal)) < 1e-6 * vec3_length(normal);
    triangle->error = (float)(GEOMETRY_UNIT_ERROR * triangle_reach(g, triangle) + border);
    triangle->margin = flat ? (float)((GEOMETRY_FLOAT_ERROR + border) / height) : INFINITY;
}

static void collect_polygon(const geometry *g, int surface, geometry_triangle *triangle) {
    const shape *s = &g->shapes[surface];
    for (uint32_t k = 0; k < s->polygon.triangle_count; k++, triangle++) {
        *triangle = (geometry_triangle){.normal = s->polygon.normal,
                                        .center = s->polygon.center,
                                        .surface = surface,
                                        .index = k,
                                        .shines = s->shines};
        set_tolerances(g, triangle);
    }
}

static bool collect_surfaces(geometry *g, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (g->shapes[i].kind == SHAPE_POLYGON)
            g->triangle_count += g->shapes[i].polygon.triangle_count;
        else
            g->curved_count++;
    }
    g->triangles = aligned_alloc(64, (g->triangle_count + 1) * sizeof *g->triangles);
    g->curved = malloc((g->curved_count + 1) * sizeof *g->curved);
    if (!g->triangles || !g->curved)
        return false;
    geometry_triangle *triangle = g->triangles;
    int *curved = g->curved;
    for (size_t i = 0; i < count; i++) {
        if (g->shapes[i].kind != SHAPE_POLYGON) {
            *curved++ = (int)i;
            continue;
        }
        collect_polygon(g, (int)i, triangle);
        triangle += g->shapes[i].polygon.triangle_count;
    }
    return true;
}

/* Where a corner of a triangle comes to lie when the border is put around it; a sharp one is cut short. */
static vec3 border_corner(vec3 corner, vec3 next, vec3 previous, double border) {
    vec3 u = vec3_normalize(vec3_subtract(next, corner)), w = vec3_normalize(vec3_subtract(previous, corner));
    vec3 inwards = vec3_normalize(vec3_add(u, w));
    double sine = 0.5 * vec3_length(vec3_subtract(u, w)); /* of half the angle */
    return vec3_add_scaled(corner, -border / fmax(sine, 1.0 / 32), inwards);
}

/* The triangle's corners as Embree gets them. */
static void put_triangle(const geometry *g, const geometry_triangle *triangle, float *out) {
    vec3 v[3], normal;
    double border = triangle_border(triangle_height(g, triangle, &normal));
    for (int i = 0; i < 3; i++)
        v[i] = vec3_scale(g->scale, vec3_subtract(geometry_corner(g, triangle, i), g->center));
    for (int i = 0; i < 3; i++) {
        vec3 corner = border_corner(v[i], v[(i + 1) % 3], v[(i + 2) % 3], border);
        *out++ = (float)corner.x;
        *out++ = (float)corner.y;
        *out++ = (float)corner.z;
    }
}

/* Adds the geometry to the scene, which then owns it. */
static void attach(geometry *g, RTCGeometry part, enum RTCBuildQuality quality) {
    rtcSetGeometryBuildQuality(part, quality);
    rtcCommitGeometry(part);
    rtcAttachGeometry(g->scene, part);
    rtcReleaseGeometry(part);
}

static bool attach_triangles(geometry *g, enum RTCBuildQuality quality) {
    RTCGeometry mesh = rtcNewGeometry(g->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!mesh)
        return false;
    float *vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                              3 * g->triangle_count);
    unsigned *indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                g->triangle_count);
    if (!vertices || !indices) {
        rtcReleaseGeometry(mesh);
        return false;
    }
    for (size_t i = 0; i < g->triangle_count; i++)
        put_triangle(g, &g->triangles[i], vertices + 9 * i);
    for (size_t i = 0; i < 3 * g->triangle_count; i++)
        indices[i] = (unsigned)i;
    rtcSetGeometryIntersectFilterFunction(mesh, geometry_filter_intersect);
    rtcSetGeometryOccludedFilterFunction(mesh, geometry_filter_occluded);
    attach(g, mesh, quality);
    return true;
}

/* Wide enough for what single precision does to boxes and rays alike. */
static void bound_curved(const struct RTCBoundsFunctionArguments *args) {
    const geometry *g = args->geometryUserPtr;
    vec3 lower, upper;
    shape_bounds(&g->shapes[g->curved[args->primID]], &lower, &upper);
    struct RTCBounds *box = args->bounds_o;
    vec3 a = vec3_scale(g->scale, vec3_subtract(lower, g->center));
    vec3 b = vec3_scale(g->scale, vec3_subtract(upper, g->center));
    box->lower_x = (float)(a.x - GEOMETRY_FLOAT_ERROR);
    box->lower_y = (float)(a.y - GEOMETRY_FLOAT_ERROR);
    box->lower_z = (float)(a.z - GEOMETRY_FLOAT_ERROR);
    box->upper_x = (float)(b.x + GEOMETRY_FLOAT_ERROR);
    box->upper_y = (float)(b.y + GEOMETRY_FLOAT_ERROR);
    box->upper_z = (float)(b.z + GEOMETRY_FLOAT_ERROR);
}

static bool attach_curved(geometry *g, enum RTCBuildQuality quality) {
    RTCGeometry part = rtcNewGeometry(g->device, RTC_GEOMETRY_TYPE_USER);
    if (!part)
        return false;
    rtcSetGeometryUserPrimitiveCount(part, (unsigned)g->curved_count);
    rtcSetGeometryUserData(part, g);
    rtcSetGeometryBoundsFunction(part, bound_curved, NULL);
    rtcSetGeometryIntersectFunction(part, geometry_intersect_curved);
    rtcSetGeometryOccludedFunction(part, geometry_occluded_curved);
    attach(g, part, quality);
    return true;
}

/* False where Embree gives nothing, whether it tells of trouble or not. */
static bool fill_scene(geometry *g, bool large) {
    enum RTCBuildQuality quality = large ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    g->scene = rtcNewScene(g->device);
    if (!g->scene)
        return false;
    /* A tenth to a quarter slower; without it a ray leaks from a box of triangles now and then. */
    rtcSetSceneFlags(g->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(g->scene, quality);
    /* Triangles are attached first: offer_neighbour() tells them by that. */
    if (g->triangle_count && !attach_triangles(g, quality))
        return false;
    if (g->curved_count && !attach_curved(g, quality))
        return false;
    rtcCommitScene(g->scene);
    return true;
}

static graze_status build_scene(geometry *g, int threads, const graze_report *report) {
    bool large = g->triangle_count + g->curved_count >= LARGE_SCENE;
    char settings[64];
    snprintf(settings, sizeof settings, "threads=%d,set_affinity=0", large && threads > 1 ? threads : 1);
    trouble t = {.code = RTC_ERROR_NONE};
    g->device = rtcNewDevice(settings);
    if (!g->device) {
        note_trouble(&t, rtcGetDeviceError(NULL), "no device");
        return report_trouble(&t, report);
    }
    rtcSetDeviceErrorFunction(g->device, note_trouble, &t);
    if (!fill_scene(g, large))
        note_trouble(&t, RTC_ERROR_UNKNOWN, "no scene");
    rtcSetDeviceErrorFunction(g->device, NULL, NULL);
    return t.code == RTC_ERROR_NONE ? GRAZE_OK : report_trouble(&t, report);
}

graze_status geometry_build(geometry **made, const shape *shapes, size_t count, int threads,
                            const graze_report *report) {
    *made = NULL;
    geometry *g = calloc(1, sizeof *g);
    if (!g)
        return report_out_of_memory(report);
    g->shapes = shapes;
    g->shape_count = count;
    graze_status status = GRAZE_OK;
    if (count > INT_MAX)
        status = report_error(report, NULL, "too many surfaces");
    else if (!find_bounds(g, count) || !collect_surfaces(g, count))
        status = report_out_of_memory(report);
    else if (g->triangle_count > UINT_MAX / 3)
        status = report_error(report, NULL, "too many triangles");
    else if (g->triangle_count + g->curved_count)
        status = build_scene(g, threads, report);
    if (status) {
        geometry_destroy(g);
        return status;
    }
    *made = g;
    return GRAZE_OK;
}

void geometry_destroy(geometry *g) {
    if (!g)
        return;
    if (g->scene)
        rtcReleaseScene(g->scene);
    if (g->device)
        rtcReleaseDevice(g->device);
    shaft_tree_free(&g->sights);
    free(g->triangles);
    free(g->reach);
    free(g->curved);
    free(g);
}
