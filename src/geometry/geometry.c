/* Building the scene that Embree traverses. */
#include "geometry/geometry.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/large_memory.h"
#include "base/parallel.h"
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

typedef struct box {
    vec3 lower, upper;
} box;

static box box_join(box a, box b) {
    return (box){vec3_min(a.lower, b.lower), vec3_max(a.upper, b.upper)};
}

static double box_reach(box b) {
    return double_max(vec3_max_abs(b.lower), vec3_max_abs(b.upper));
}

/* Copies that hold something; their groups are known already. */
static box join_copies(const geometry *g, geometry_tree *tree, box all) {
    for (size_t i = 0; i < tree->placement_count; i++) {
        const geometry_placement *placement = &tree->placements[i];
        box copy;
        if (!g->trees[placement->group].scene)
            continue;
        tree->placed[tree->placed_count++] = (uint32_t)i;
        geometry_copy_bounds(g, placement, &copy.lower, &copy.upper);
        all = box_join(all, copy);
    }
    return all;
}

/* What is found out of some neighbouring surfaces at a time. */
typedef struct block {
    box bounds;
    size_t triangles, curved;            /* how many */
    size_t first_triangle, first_curved; /* where they go among all */
} block;

enum { BLOCK_SIZE = 2048 };

/* The blocks of a tree, and what threads fill in by them. */
typedef struct survey {
    geometry_tree *tree;
    block *blocks;
    size_t count;
    float *vertices; /* Embree's */
    unsigned *indices;
} survey;

static size_t block_end(const survey *s, size_t index) {
    size_t end = (index + 1) * BLOCK_SIZE;
    return end < s->tree->shape_count ? end : s->tree->shape_count;
}

static void survey_block(void *user, size_t index, int worker) {
    (void)worker;
    const survey *s = user;
    geometry_tree *tree = s->tree;
    block found = {.bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    for (size_t i = index * BLOCK_SIZE; i < block_end(s, index); i++) {
        box one;
        shape_bounds(&tree->shapes[i], &one.lower, &one.upper);
        tree->reach[i] = box_reach(one);
        found.bounds = box_join(found.bounds, one);
        if (tree->shapes[i].kind == SHAPE_POLYGON)
            found.triangles += tree->shapes[i].polygon.triangle_count;
        else
            found.curved++;
    }
    s->blocks[index] = found;
}

static void find_extent(const geometry *g, geometry_tree *tree, box all) {
    all = join_copies(g, tree, all);
    tree->lower = all.lower;
    tree->upper = all.upper;
    vec3 half = vec3_scale(0.5, vec3_subtract(all.upper, all.lower));
    tree->center = vec3_add(all.lower, half);
    int exponent;
    frexp(vec3_max_abs(half), &exponent);
    tree->scale = ldexp(1, -exponent - 1);
    /* At most sqrt(3) times the half-width that the scale brings below 1/2; a little more takes in roundings. */
    tree->radius =
        (1 + 1e-9) * vec3_length(vec3_scale(tree->scale, half)) / tree->scale + 1e-15 * vec3_max_abs(tree->center);
}

/* Finds the extent of all, and how many triangles and curved surfaces there are. */
static bool find_bounds(const geometry *g, survey *s, int threads) {
    geometry_tree *tree = s->tree;
    tree->reach = large_memory_unset((tree->shape_count + 1) * sizeof *tree->reach);
    tree->placed = malloc((tree->placement_count + 1) * sizeof *tree->placed);
    s->count = (tree->shape_count + BLOCK_SIZE - 1) / BLOCK_SIZE;
    s->blocks = malloc((s->count + 1) * sizeof *s->blocks);
    if (!tree->reach || !tree->placed || !s->blocks)
        return false;
    parallel_for(threads, s->count, survey_block, s);
    box all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < s->count; i++) {
        block *b = &s->blocks[i];
        all = box_join(all, b->bounds);
        b->first_triangle = tree->triangle_count;
        b->first_curved = tree->curved_count;
        tree->triangle_count += b->triangles;
        tree->curved_count += b->curved;
    }
    find_extent(g, tree, all);
    return true;
}

vec3 geometry_corner(const geometry_tree *tree, const geometry_triangle *triangle, int corner) {
    const shape *s = &tree->shapes[triangle->surface];
    return s->polygon.vertices[s->polygon.triangles[triangle->index][corner]];
}

static void collect_polygon(const geometry_tree *tree, int surface, geometry_triangle *triangle) {
    const shape *s = &tree->shapes[surface];
    for (uint32_t k = 0; k < s->polygon.triangle_count; k++, triangle++) {
        *triangle = (geometry_triangle){.normal = s->polygon.normal,
                                        .center = s->polygon.center,
                                        .surface = surface,
                                        .index = k,
                                        .shines = s->shines};
    }
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
    const survey *s = user;
    const geometry_tree *tree = s->tree;
    size_t triangle = s->blocks[index].first_triangle, curved = s->blocks[index].first_curved;
    for (size_t i = index * BLOCK_SIZE; i < block_end(s, index); i++) {
        if (tree->shapes[i].kind != SHAPE_POLYGON) {
            tree->curved[curved++] = (int)i;
            continue;
        }
        collect_polygon(tree, (int)i, &tree->triangles[triangle]);
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
static bool attach_triangles(survey *s, RTCDevice device, enum RTCBuildQuality quality, int threads) {
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
static void put_bounds(const geometry_tree *tree, box b, struct RTCBounds *out) {
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
    box b;
    shape_bounds(&of->tree->shapes[of->tree->curved[args->primID]], &b.lower, &b.upper);
    put_bounds(of->tree, b, args->bounds_o);
}

static void bound_copy(const struct RTCBoundsFunctionArguments *args) {
    const bounded *of = args->geometryUserPtr;
    box b;
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
static bool fill_scene(const geometry *g, survey *s, int threads) {
    geometry_tree *tree = s->tree;
    bool large = tree->triangle_count + tree->curved_count + tree->placed_count >= LARGE_SCENE;
    enum RTCBuildQuality quality = large ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    const bounded of = {g, tree}; /* callbacks come while the scene is committed */
    tree->scene = rtcNewScene(g->device);
    if (!tree->scene)
        return false;
    /* A tenth to a quarter slower; without it a ray leaks from a box of triangles now and then. */
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
    snprintf(settings, sizeof settings, "threads=%d,set_affinity=0,hugepages=%d", large && threads > 1 ? threads : 1,
             large);
    return rtcNewDevice(settings);
}

/* Embree's part of a group's tree. */
static graze_status build_scene(geometry *g, survey *s, int threads, const graze_report *report) {
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

/* Numbers the surfaces of copies; false where there are more than numbers. */
static bool number_surfaces(const geometry *g, geometry_tree *tree) {
    int64_t next = (int64_t)tree->shape_count;
    for (size_t i = 0; i < tree->placement_count; i++) {
        tree->firsts[i] = next;
        next += g->trees[tree->placements[i].group].surface_count;
        if (next > INT64_MAX / 2)
            return false;
    }
    tree->surface_count = next;
    return true;
}

static bool allocate_surfaces(geometry_tree *tree) {
    tree->triangles = large_memory_unset((tree->triangle_count + 1) * sizeof *tree->triangles);
    tree->curved = malloc((tree->curved_count + 1) * sizeof *tree->curved);
    return tree->triangles && tree->curved;
}

static graze_status build_surveyed(geometry *g, survey *s, int threads, const graze_report *report) {
    geometry_tree *tree = s->tree;
    if (!find_bounds(g, s, threads) || !allocate_surfaces(tree))
        return report_out_of_memory(report);
    if (tree->triangle_count > UINT_MAX / 3)
        return report_error(report, NULL, "too many triangles");
    if (tree->triangle_count + tree->curved_count + tree->placed_count == 0)
        return GRAZE_OK;
    return build_scene(g, s, threads, report);
}

static graze_status build_tree(geometry *g, geometry_tree *tree, const geometry_group *group, int threads,
                               const graze_report *report) {
    tree->shapes = group->shapes;
    tree->shape_count = group->shape_count;
    tree->placements = group->placements;
    tree->placement_count = group->placement_count;
    tree->triangles_id = tree->placed_id = RTC_INVALID_GEOMETRY_ID;
    tree->firsts = malloc((tree->placement_count + 1) * sizeof *tree->firsts);
    if (!tree->firsts)
        return report_out_of_memory(report);
    if (group->shape_count > INT_MAX || group->placement_count > INT_MAX || !number_surfaces(g, tree))
        return report_error(report, NULL, "too many surfaces");
    survey s = {.tree = tree};
    graze_status status = build_surveyed(g, &s, threads, report);
    free(s.blocks);
    return status;
}

graze_status geometry_build(geometry **made, const geometry_group *groups, size_t count, int threads,
                            const graze_report *report) {
    *made = NULL;
    geometry *g = calloc(1, sizeof *g);
    geometry_tree *trees = calloc(count, sizeof *trees);
    if (!g || !trees) {
        free(g);
        free(trees);
        return report_out_of_memory(report);
    }
    g->trees = trees;
    g->tree_count = count;
    g->threads = threads;
    for (size_t i = 0; i < count; i++) {
        trees[i].shape_count = groups[i].shape_count;
        trees[i].placement_count = groups[i].placement_count;
    }
    graze_status status = GRAZE_OK;
    /* What is copied is built before what holds the copies. */
    for (size_t i = count; i-- > 0 && !status;)
        status = build_tree(g, &trees[i], &groups[i], threads, report);
    if (status) {
        geometry_destroy(g);
        return status;
    }
    if (trees[0].scene)
        g->largest_reach = box_reach((box){trees[0].lower, trees[0].upper});
    *made = g;
    return GRAZE_OK;
}

static void free_tree(geometry_tree *tree) {
    if (tree->scene)
        rtcReleaseScene(tree->scene);
    free(tree->triangles);
    free(tree->reach);
    free(tree->curved);
    free(tree->placed);
    free(tree->firsts);
}

void geometry_destroy(geometry *g) {
    if (!g)
        return;
    for (size_t i = 0; i < g->tree_count; i++)
        free_tree(&g->trees[i]);
    if (g->device)
        rtcReleaseDevice(g->device);
    shaft_tree_free(&g->sights);
    shaft_tree_free(&g->copied_sights);
    free(g->copied_boxes);
    free(g->trees);
    free(g);
}
