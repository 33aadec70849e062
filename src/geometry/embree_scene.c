/* A group's surfaces and copies as Embree gets them. */
#include "geometry/embree_scene.h"

#include <stdio.h>

#include "base/parallel.h"

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

static double triangle_border(double height) {
    return double_min(double_max(height / 64, GEOMETRY_BORDER_LEAST), GEOMETRY_BORDER);
}

/* The farthest corner's distance from the scene's middle, in Embree's units. */
static double triangle_reach(const geometry_tree *tree, const vec3 *corners) {
    double reach2 = 0;
    for (int i = 0; i < 3; i++) {
        vec3 v = vec3_subtract(corners[i], tree->center);
        reach2 = double_max(reach2, vec3_dot(v, v));
    }
    return tree->scale * sqrt(reach2);
}

/* Where the corners come to lie when the border is put around the triangle, in Embree's units; a sharp one is cut
 * short. `sides` are the unit vectors from each corner to the next. */
static void put_corners(const geometry_tree *tree, const vec3 *corners, const vec3 *sides, double border, float *out) {
    for (int i = 0; i < 3; i++) {
        vec3 corner = vec3_scale(tree->scale, vec3_subtract(corners[i], tree->center));
        vec3 next = sides[i], previous = vec3_negate(sides[(i + 2) % 3]);
        vec3 inwards = vec3_normalize(vec3_add(next, previous));
        double sine = 0.5 * vec3_length(vec3_subtract(next, previous)); /* of half the angle */
        corner = vec3_add_scaled(corner, -border / double_max(sine, 1.0 / 32), inwards);
        *out++ = (float)corner.x;
        *out++ = (float)corner.y;
        *out++ = (float)corner.z;
    }
}

/* The triangle as Embree gets it, and how far it can then be trusted. */
static void put_triangle(const geometry_tree *tree, geometry_triangle *triangle, float *out) {
    vec3 corners[3], sides[3];
    for (int i = 0; i < 3; i++)
        corners[i] = geometry_corner(tree, triangle, i);
    for (int i = 0; i < 3; i++)
        sides[i] = vec3_subtract(corners[(i + 1) % 3], corners[i]);
    vec3 normal = vec3_cross(sides[0], vec3_negate(sides[2]));
    double lengths[3], longest = 0, area = vec3_length(normal);
    for (int i = 0; i < 3; i++) {
        lengths[i] = vec3_length(sides[i]);
        longest = double_max(longest, lengths[i]);
        sides[i] = vec3_scale(1 / lengths[i], sides[i]);
    }
    double height = tree->scale * area / longest, border = triangle_border(height); /* the least of its heights */
    /* Where the polygon is not flat, its normal does not tell how obliquely the triangle is met. */
    bool flat = vec3_length(vec3_cross(normal, triangle->normal)) < 1e-6 * area;
    triangle->error = (float)(GEOMETRY_UNIT_ERROR * triangle_reach(tree, corners) + border);
    triangle->margin = flat ? (float)((GEOMETRY_FLOAT_ERROR + border) / height) : INFINITY;
    put_corners(tree, corners, sides, border, out);
}

static void collect_block(void *user, size_t index, int worker) {
    (void)worker;
    const geometry_survey *s = user;
    const geometry_tree *tree = s->tree;
    size_t triangle = s->blocks[index].first_triangle, curved = s->blocks[index].first_curved;
    for (size_t i = index * GEOMETRY_BLOCK_SIZE; i < geometry_block_end(s, index); i++) {
        if (tree->shapes[i].kind != SHAPE_POLYGON) {
            tree->curved[curved++] = (int)i;
            continue;
        }
        geometry_collect_polygon(tree, (int)i, &tree->triangles[triangle]);
        triangle += tree->shapes[i].polygon.triangle_count;
    }
    for (size_t i = s->blocks[index].first_triangle; i < triangle; i++) {
        put_triangle(tree, &tree->triangles[i], s->vertices + 9 * i);
        for (size_t k = 3 * i; k < 3 * i + 3; k++)
            s->indices[k] = (unsigned)k;
    }
}

/* Adds the geometry to the scene, which then owns it. */
static unsigned attach(const geometry_tree *tree, RTCGeometry part, enum RTCBuildQuality quality) {
    rtcSetGeometryBuildQuality(part, quality);
    rtcCommitGeometry(part);
    unsigned id = rtcAttachGeometry(tree->scene, part);
    rtcReleaseGeometry(part);
    return id;
}

/* Lays out the surfaces for Embree. */
static bool attach_triangles(geometry_survey *s, RTCDevice device, enum RTCBuildQuality quality, int threads) {
    geometry_tree *tree = s->tree;
    RTCGeometry mesh = NULL;
    if (tree->triangle_count > 0) {
        mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        if (!mesh)
            return false;
        s->vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                              3 * tree->triangle_count);
        s->indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                             tree->triangle_count);
        if (!s->vertices || !s->indices) {
            rtcReleaseGeometry(mesh);
            return false;
        }
    }
    parallel_for(threads, s->count, collect_block, s);
    if (!mesh)
        return true;
    rtcSetGeometryIntersectFilterFunction(mesh, geometry_filter_intersect);
    rtcSetGeometryOccludedFilterFunction(mesh, geometry_filter_occluded);
    tree->triangles_id = attach(tree, mesh, quality);
    return true;
}

/* Wide enough for what single precision does to boxes and rays alike. */
static void put_bounds(const geometry_tree *tree, geometry_box b, struct RTCBounds *out) {
    vec3 lower = vec3_scale(tree->scale, vec3_subtract(b.lower, tree->center));
    vec3 upper = vec3_scale(tree->scale, vec3_subtract(b.upper, tree->center));
    out->lower_x = (float)(lower.x - GEOMETRY_FLOAT_ERROR);
    out->lower_y = (float)(lower.y - GEOMETRY_FLOAT_ERROR);
    out->lower_z = (float)(lower.z - GEOMETRY_FLOAT_ERROR);
    out->upper_x = (float)(upper.x + GEOMETRY_FLOAT_ERROR);
    out->upper_y = (float)(upper.y + GEOMETRY_FLOAT_ERROR);
    out->upper_z = (float)(upper.z + GEOMETRY_FLOAT_ERROR);
}

/* What the callbacks that give bounds are given. */
typedef struct bounded {
    const geometry *geometry;
    const geometry_tree *tree;
} bounded;

static void bound_curved(const struct RTCBoundsFunctionArguments *args) {
    const bounded *of = args->geometryUserPtr;
    geometry_box b;
    shape_bounds(&of->tree->shapes[of->tree->curved[args->primID]], &b.lower, &b.upper);
    put_bounds(of->tree, b, args->bounds_o);
}

static void bound_copy(const struct RTCBoundsFunctionArguments *args) {
    const bounded *of = args->geometryUserPtr;
    geometry_box b;
    geometry_copy_bounds(of->geometry, &of->tree->placements[of->tree->placed[args->primID]], &b.lower, &b.upper);
    put_bounds(of->tree, b, args->bounds_o);
}

/* A geometry of `count` primitives that Embree knows by their bounds alone. */
static RTCGeometry user_geometry(RTCDevice device, size_t count, const bounded *of, RTCBoundsFunction bounds) {
    RTCGeometry part = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    if (!part)
        return NULL;
    rtcSetGeometryUserPrimitiveCount(part, (unsigned)count);
    rtcSetGeometryUserData(part, (void *)of);
    rtcSetGeometryBoundsFunction(part, bounds, NULL);
    return part;
}

static bool attach_curved(const bounded *of, RTCDevice device, enum RTCBuildQuality quality) {
    RTCGeometry part = user_geometry(device, of->tree->curved_count, of, bound_curved);
    if (!part)
        return false;
    rtcSetGeometryIntersectFunction(part, geometry_intersect_curved);
    rtcSetGeometryOccludedFunction(part, geometry_occluded_curved);
    (void)attach(of->tree, part, quality);
    return true;
}

static bool attach_copies(const bounded *of, RTCDevice device, enum RTCBuildQuality quality, unsigned *id) {
    RTCGeometry part = user_geometry(device, of->tree->placed_count, of, bound_copy);
    if (!part)
        return false;
    rtcSetGeometryIntersectFunction(part, geometry_intersect_copy);
    rtcSetGeometryOccludedFunction(part, geometry_occluded_copy);
    *id = attach(of->tree, part, quality);
    return true;
}

/* False where Embree gives nothing, whether it tells of trouble or not. */
static bool fill_scene(const geometry *g, geometry_survey *s, int threads) {
    geometry_tree *tree = s->tree;
    bool large = tree->triangle_count + tree->curved_count + tree->placed_count >= LARGE_SCENE;
    enum RTCBuildQuality quality = large ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    const bounded of = {g, tree}; /* callbacks come while the scene is committed */
    tree->scene = rtcNewScene(g->device);
    if (!tree->scene)
        return false;
    /* A tenth to a quarter slower; without it a ray leaks from a geometry_box of triangles now and then. */
    rtcSetSceneFlags(tree->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(tree->scene, quality);
    if (!attach_triangles(s, g->device, quality, threads))
        return false;
    if (tree->curved_count && !attach_curved(&of, g->device, quality))
        return false;
    if (tree->placed_count && !attach_copies(&of, g->device, quality, &tree->placed_id))
        return false;
    rtcCommitScene(tree->scene);
    return true;
}

static bool is_large(const geometry *g) {
    size_t primitives = 0;
    for (size_t i = 0; i < g->tree_count; i++)
        primitives += g->trees[i].shape_count + g->trees[i].placement_count;
    return primitives >= LARGE_SCENE;
}

static RTCDevice make_device(const geometry *g, int threads) {
    char settings[64];
    bool large = is_large(g);
    snprintf(settings, sizeof settings, "threads=%d,set_affinity=0,hugepages=0", large && threads > 1 ? threads : 1);
    return rtcNewDevice(settings);
}

graze_status geometry_scene_build(geometry *g, geometry_survey *s, int threads, const graze_report *report) {
    trouble t = {.code = RTC_ERROR_NONE};
    if (!g->device)
        g->device = make_device(g, threads);
    if (!g->device) {
        note_trouble(&t, rtcGetDeviceError(NULL), "no device");
        return report_trouble(&t, report);
    }
    rtcSetDeviceErrorFunction(g->device, note_trouble, &t);
    if (!fill_scene(g, s, threads))
        note_trouble(&t, RTC_ERROR_UNKNOWN, "no scene");
    rtcSetDeviceErrorFunction(g->device, NULL, NULL);
    return t.code == RTC_ERROR_NONE ? GRAZE_OK : report_trouble(&t, report);
}
