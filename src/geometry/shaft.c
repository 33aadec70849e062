/* What stands between a point and a light: the way through the hierarchy. */
#include "geometry/shaft.h"

#include "geometry/geometry_internal.h"
#include "geometry/shaft_internal.h"

/* Boxes and surfaces that are looked at before an answer is given up; and once some of the light is known to be hidden,
 * in the hope of one surface that hides all. */
#define TESTS       160
#define TESTS_MIXED 24

graze_status geometry_prepare_sights(geometry *g, const graze_report *report) {
    size_t count = g->triangle_count + g->curved_count ? g->shape_count : 0;
    vec3 reach = {g->radius, g->radius, g->radius};
    if (count == 0 || g->sights.nodes)
        return GRAZE_OK;
    bool built = shaft_tree_build(&g->sights, g->shapes, count, vec3_subtract(g->center, reach),
                                  vec3_add(g->center, reach));
    return built ? GRAZE_OK : report_out_of_memory(report);
}

static bool box_is_beside(const shaft *s, const shaft_node *n) {
    return n->upper.x < s->lower.x || n->lower.x > s->upper.x || n->upper.y < s->lower.y || n->lower.y > s->upper.y ||
           n->upper.z < s->lower.z || n->lower.z > s->upper.z;
}

/* A box, from a point. */
typedef struct box {
    vec3 center, half;
} box;

static box box_from(const shaft_node *n, vec3 point) {
    vec3 half = vec3_scale(0.5, vec3_subtract(n->upper, n->lower));
    return (box){vec3_subtract(vec3_add(n->lower, half), point), half};
}

/* How far a box reaches along a vector. */
static double box_reach(const box *b, vec3 along) {
    return vec3_dot(along, b->center) + fabs(along.x) * b->half.x + fabs(along.y) * b->half.y +
           fabs(along.z) * b->half.z;
}

static bool box_is_outside(const shaft *s, const shaft_node *n) {
    box b = box_from(n, s->sight->point);
    if (box_reach(&b, s->sight->normal) <= 0 || box_reach(&b, s->base) + s->base_height < -2 * s->near)
        return true;
    for (int i = 0; i < s->side_count; i++)
        if (box_reach(&b, s->sides[i]) <= 0)
            return true;
    return false;
}

/* A leaf's shapes. */
static geometry_visibility meet_leaf(const shaft *s, const geometry *g, const shaft_node *leaf, int *budget) {
    geometry_visibility all = GEOMETRY_CLEAR;
    for (uint32_t i = 0; i < leaf->count; i++) {
        if (*budget <= 0)
            return GEOMETRY_MIXED;
        geometry_visibility one = shaft_meets_shape(s, g, g->sights.order[leaf->first + i], budget);
        if (one == GEOMETRY_BLOCKED)
            return one;
        if (one == GEOMETRY_MIXED && all == GEOMETRY_CLEAR) {
            all = one;
            *budget = *budget < TESTS_MIXED ? *budget : TESTS_MIXED;
        }
    }
    return all;
}

geometry_visibility geometry_sight_of(const geometry *g, const geometry_sight *sight) {
    const shaft_node *nodes = g->sights.nodes;
    shaft s;
    if (!nodes)
        return GEOMETRY_MIXED;
    shaft_kind kind = shaft_make(&s, g, sight);
    if (kind != SHAFT_MADE)
        return kind == SHAFT_NOTHING ? GEOMETRY_CLEAR : GEOMETRY_MIXED;
    geometry_visibility all = GEOMETRY_CLEAR;
    uint32_t stack[SHAFT_TREE_DEPTH + 1] = {0};
    int height = 1, budget = TESTS;
    while (height > 0) {
        const shaft_node *n = &nodes[stack[--height]];
        if (box_is_beside(&s, n))
            continue;
        if (--budget < 0)
            return GEOMETRY_MIXED;
        bool single = n->count == 1;
        if (!single && box_is_outside(&s, n))
            continue;
        if (n->count == 0) {
            stack[height++] = n->first;
            stack[height++] = n->first + 1;
            continue;
        }
        geometry_visibility found = meet_leaf(&s, g, n, &budget);
        if (found == GEOMETRY_BLOCKED)
            return found;
        if (found == GEOMETRY_MIXED && all == GEOMETRY_CLEAR) {
            all = found;
            budget = budget < TESTS_MIXED ? budget : TESTS_MIXED;
        }
    }
    return all;
}

/* A surface that the point is on and which curves away below its horizon does not stand above it. */
static bool shape_is_above(const geometry *g, int surface, vec3 point, vec3 normal, int from) {
    const shape *s = &g->shapes[surface];
    bool flat = s->kind == SHAPE_POLYGON || s->kind == SHAPE_RING;
    return !s->shines && !(surface == from && flat) && shaft_reach_of(s, point, normal) > shaft_tolerance(g);
}

bool geometry_reflects_above(const geometry *g, vec3 point, vec3 normal, int from) {
    const shaft_node *nodes = g->sights.nodes;
    uint32_t stack[SHAFT_TREE_DEPTH + 1] = {0};
    int height = 1;
    if (!nodes)
        return g->shape_count > 0;
    for (int budget = TESTS; height > 0; budget--) {
        const shaft_node *n = &nodes[stack[--height]];
        if (!n->reflects)
            continue;
        if (budget <= 0)
            return true;
        box b = box_from(n, point);
        if (box_reach(&b, normal) <= 0)
            continue;
        if (n->count == 0) {
            stack[height++] = n->first;
            stack[height++] = n->first + 1;
        }
        for (uint32_t i = 0; i < n->count; i++)
            if (shape_is_above(g, g->sights.order[n->first + i], point, normal, from))
                return true;
    }
    return false;
}
