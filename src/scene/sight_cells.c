/* Pyramids of cells: each level has four times as many as the one above, and what a cell sees, or not, as a whole, its
 * parts do. */
#include "scene/sight_cells.h"

#include <float.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/* So many of a scene's polygons have cells, the largest ones. */
#define MOST_GRIDS 1024
/* The largest polygon has 4 to the power of the levels, the others fewer so that theirs are as large. */
#define LEAST_LEVELS 2
#define MOST_LEVELS  4

/* What is known of one cell: this, or a geometry_visibility and 1. Threads that find it out find the same. */
enum { UNKNOWN = 0 };

typedef struct sight_grid {
    int surface, levels;
    vec3 corner, x, y;   /* of the rectangle around the surface; and its sides, */
    vec3 unit_x, unit_y; /* and these over their squared lengths */
    size_t first, cells; /* of what is known of the first light, all levels; and how many cells that are, */
    size_t above;        /* and how many of them those above the finest level */
} sight_grid;

struct sight_cells {
    sight_grid *grids;
    _Atomic unsigned char *known;
};

static size_t cells_of(int levels) {
    return (((size_t)4 << 2 * levels) - 1) / 3;
}

static int levels_of(double area, double largest) {
    int levels = MOST_LEVELS;
    while (levels > LEAST_LEVELS && 2 * area < largest) {
        area *= 4;
        levels--;
    }
    return levels;
}

/* Along the polygon's longest side, in its plane: the direction of short ones may be nothing but rounding. */
static vec3 direction_of(const shape *s) {
    const vec3 *v = s->polygon.vertices, normal = s->polygon.normal;
    vec3 longest = {0, 0, 0};
    for (uint32_t i = 0, before = s->polygon.vertex_count - 1; i < s->polygon.vertex_count; before = i++) {
        vec3 side = vec3_subtract(v[i], v[before]);
        if (vec3_length(side) > vec3_length(longest))
            longest = side;
    }
    return vec3_safe_normalize(vec3_add_scaled(longest, -vec3_dot(longest, normal), normal));
}

/* The rectangle along that side. */
static sight_grid grid_of(const shape *s, int surface, int levels) {
    const vec3 *v = s->polygon.vertices;
    vec3 x = direction_of(s), y = vec3_cross(s->polygon.normal, x);
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    for (uint32_t i = 0; i < s->polygon.vertex_count; i++) {
        vec3 from_center = vec3_subtract(v[i], s->polygon.center);
        x0 = fmin(x0, vec3_dot(from_center, x));
        x1 = fmax(x1, vec3_dot(from_center, x));
        y0 = fmin(y0, vec3_dot(from_center, y));
        y1 = fmax(y1, vec3_dot(from_center, y));
    }
    return (sight_grid){.surface = surface,
                        .levels = levels,
                        .corner = vec3_add_scaled(vec3_add_scaled(s->polygon.center, x0, x), y0, y),
                        .x = vec3_scale(x1 - x0, x),
                        .y = vec3_scale(y1 - y0, y),
                        .unit_x = vec3_scale(1 / (x1 - x0), x),
                        .unit_y = vec3_scale(1 / (y1 - y0), y),
                        .cells = cells_of(levels),
                        .above = cells_of(levels - 1)};
}

static bool may_have_cells(const shape *s) {
    return s->kind == SHAPE_POLYGON && s->polygon.area > DBL_MIN && !s->shines;
}

/* The largest polygons are found by the binary exponents of their areas. */
#define EXPONENTS (DBL_MAX_EXP - DBL_MIN_EXP + 1)

static int exponent_of(const shape *s) {
    int exponent;
    (void)frexp(s->polygon.area, &exponent);
    return exponent - DBL_MIN_EXP;
}

/* The least exponent that, with all above, no more than MOST_GRIDS polygons have. */
static int least_exponent(const graze_scene *scene, double *largest) {
    size_t counts[EXPONENTS] = {0}, sum = 0;
    *largest = 0;
    for (size_t i = 0; i < scene->surface_count; i++)
        if (may_have_cells(&scene->shapes[i])) {
            counts[exponent_of(&scene->shapes[i])]++;
            *largest = fmax(*largest, scene->shapes[i].polygon.area);
        }
    int exponent = EXPONENTS;
    while (exponent > 0 && sum + counts[exponent - 1] <= MOST_GRIDS)
        sum += counts[--exponent];
    return exponent;
}

graze_status sight_cells_make(graze_scene *scene, const graze_report *report) {
    if (scene->first_copied == 0 || scene->first_copied > SIGHT_CELLS_LIGHTS_MOST || scene->surface_count == 0)
        return GRAZE_OK;
    struct sight_cells *c = calloc(1, sizeof *c);
    scene->sight_cells = c;
    if (c)
        c->grids = malloc(MOST_GRIDS * sizeof *c->grids);
    if (!c || !c->grids)
        return report_out_of_memory(report);
    double largest;
    int least = least_exponent(scene, &largest);
    size_t count = 0, cells = 0;
    for (size_t i = 0; i < scene->surface_count; i++) {
        const shape *s = &scene->shapes[i];
        if (!may_have_cells(s) || exponent_of(s) < least)
            continue;
        sight_grid *g = &c->grids[count++];
        *g = grid_of(s, (int)i, levels_of(s->polygon.area, largest));
        g->first = cells;
        cells += g->cells * scene->first_copied;
        scene->surfaces[i].cells = (unsigned short)count;
    }
    c->known = calloc(cells + 1, sizeof *c->known);
    return c->known ? GRAZE_OK : report_out_of_memory(report);
}

void sight_cells_destroy(struct sight_cells *c) {
    if (!c)
        return;
    free(c->grids);
    free((void *)c->known);
    free(c);
}

/* The cell in column x, row y of so many of either. */
static geometry_visibility look(const graze_scene *scene, const sight_grid *g, int light, int x, int y, int side) {
    const scene_light *l = &scene->lights[light];
    vec3 step_x = vec3_scale(1.0 / side, g->x), step_y = vec3_scale(1.0 / side, g->y);
    vec3 corner = vec3_add_scaled(vec3_add_scaled(g->corner, x, step_x), y, step_y), next = vec3_add(corner, step_x);
    geometry_patch patch = {.corners = {corner, next, vec3_add(next, step_y), vec3_add(corner, step_y)},
                            .surface = g->surface,
                            .light = (int)l->surface,
                            .axis = l->center,
                            .half_angle = l->half_angle};
    return geometry_sight_of_patch(scene->geometry, &patch);
}

/* Down to a cell, from the first one above it that is not known to be seen or hidden as a whole. */
static geometry_visibility descend(const graze_scene *scene, const sight_grid *g, int light, int number) {
    const int x = number & ((1 << g->levels) - 1), y = number >> g->levels;
    _Atomic unsigned char *known = scene->sight_cells->known + g->first + (size_t)light * g->cells;
    geometry_visibility found = GEOMETRY_MIXED;
    for (int level = 0; level <= g->levels; level++) {
        int up = g->levels - level, side = 1 << level;
        _Atomic unsigned char *cell =
            known + (level > 0 ? cells_of(level - 1) : 0) + (size_t)(y >> up) * (size_t)side + (size_t)(x >> up);
        unsigned char state = atomic_load_explicit(cell, memory_order_relaxed);
        if (state != UNKNOWN)
            found = (geometry_visibility)(state - 1);
        else if (found == GEOMETRY_MIXED)
            found = look(scene, g, light, x >> up, y >> up, side);
        if (state == UNKNOWN)
            atomic_store_explicit(cell, (unsigned char)(found + 1), memory_order_relaxed);
    }
    return found;
}

/* A point beside the rectangle, by roundings, is taken for one at its edge. */
static int cell_of(double part, int side) {
    return part > 0 ? part < 1 ? (int)(part * side) : side - 1 : 0;
}

sight_cell sight_cells_find(const graze_scene *scene, int cells, vec3 point) {
    const sight_grid *g = &scene->sight_cells->grids[cells - 1];
    vec3 from_corner = vec3_subtract(point, g->corner);
    int side = 1 << g->levels;
    int x = cell_of(vec3_dot(from_corner, g->unit_x), side), y = cell_of(vec3_dot(from_corner, g->unit_y), side);
    return (sight_cell){g, y * side + x};
}

geometry_visibility sight_cell_sees(const graze_scene *scene, sight_cell cell, int light) {
    const sight_grid *g = cell.grid;
    if (!g || light >= (int)scene->first_copied)
        return GEOMETRY_MIXED;
    size_t finest = g->first + (size_t)light * g->cells + g->above + (size_t)cell.number;
    unsigned char state = atomic_load_explicit(&scene->sight_cells->known[finest], memory_order_relaxed);
    return state != UNKNOWN ? (geometry_visibility)(state - 1) : descend(scene, g, light, cell.number);
}
