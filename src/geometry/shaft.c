/* What stands between a point and a light: the way through the hierarchy. */
#include "geometry/shaft.h"

#include "geometry/geometry_internal.h"
#include "geometry/shaft_internal.h"

/* Tests of boxes that are made before an answer is given up, one of a surface being worth several; and once some of the
 * light is known to be hidden, in the hope of a surface that hides all. */
#define TESTS       120
#define TESTS_MIXED 20

graze_status geometry_prepare_sights(geometry *g, const graze_report *report) {
    size_t count = g->triangle_count + g->curved_count ? g->shape_count : 0;
    vec3 reach = {g->radius, g->radius, g->radius};
    if (count == 0 || g->sights.nodes)
        return GRAZE_OK;
    bool built =
        shaft_tree_build(&g->sights, g->shapes, count, vec3_subtract(g->center, reach), vec3_add(g->center, reach));
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

static inline box box_from(const shaft_node *n, vec3 point) {
    vec3 half = vec3_scale(0.5, vec3_subtract(n->upper, n->lower));
    return (box){vec3_subtract(vec3_add(n->lower, half), point), half};
}

/* How far a box reaches along a vector. */
static inline shaft_span box_span(const box *b, vec3 along) {
    double middle = vec3_dot(along, b->center);
    double reach = fabs(along.x) * b->half.x + fabs(along.y) * b->half.y + fabs(along.z) * b->half.z;
    return (shaft_span){middle - reach, middle + reach};
}

typedef enum place_of_box { OUTSIDE, ACROSS, INSIDE } place_of_box;

/* Where a box stands with respect to the shaft; and how far its middle is inside of the nearest side. */
static place_of_box find_box(const shaft *s, const shaft_node *n, double *depth) {
    box b = box_from(n, s->sight->point);
    shaft_span over = box_span(&b, s->sight->normal), before = box_span(&b, s->base);
    if (over.high <= 0 || before.high + s->base_height < -2 * s->near)
        return OUTSIDE;
    bool inside = over.low > 0 && before.low + s->base_height > 0;
    for (int i = 0; i < s->side_count; i++) {
        shaft_span span = box_span(&b, s->sides[i]);
        if (span.high <= 0)
            return OUTSIDE;
        inside = inside && span.low > 0;
        *depth = shaft_lesser(*depth, span.low + span.high);
    }
    return inside ? INSIDE : ACROSS;
}

/* The first of a leaf's shapes that is in the way tells for all: where there are several, they are small. */
static geometry_visibility meet_leaf(shaft *s, const geometry *g, const shaft_node *leaf, int *budget) {
    geometry_visibility found = GEOMETRY_CLEAR;
    for (uint32_t i = 0; i < leaf->count && found == GEOMETRY_CLEAR; i++)
        found = *budget > 0 ? shaft_meets_shape(s, g, g->sights.order[leaf->first + i], budget) : GEOMETRY_MIXED;
    return found;
}

/* What is still to be looked at. */
typedef struct visit {
    uint32_t node[SHAFT_TREE_DEPTH + 1];
    int count, budget;
    bool mixed; /* something is in the way */
} visit;

static void meet_something(visit *v) {
    v->mixed = true;
    v->budget = v->budget < TESTS_MIXED ? v->budget : TESTS_MIXED;
}

/* Looks at a node's box, and puts it down as to be entered unless that tells all. Returns how far its middle is within
 * the shaft. */
static double put_down(visit *v, const shaft *s, const geometry *g, uint32_t index) {
    const shaft_node *n = &g->sights.nodes[index];
    double depth = INFINITY;
    if (box_is_beside(s, n))
        return depth;
    v->budget--;
    place_of_box where = n->count == 1 ? ACROSS : find_box(s, n, &depth);
    if (where == INSIDE)
        meet_something(v);
    if (where == ACROSS)
        v->node[v->count++] = index;
    return depth;
}

/* Of two children, what stands alone comes first, then what is deeper within the shaft: more often in the way. */
static void put_children(visit *v, const shaft *s, const geometry *g, uint32_t first) {
    int before = v->count;
    double a = put_down(v, s, g, first), b = put_down(v, s, g, first + 1);
    if (v->count == before + 2 && a > b) {
        v->node[before] = first + 1;
        v->node[before + 1] = first;
    }
}

geometry_visibility geometry_sight_of(const geometry *g, const geometry_sight *sight) {
    shaft s;
    if (!g->sights.nodes)
        return GEOMETRY_MIXED;
    shaft_kind kind = shaft_make(&s, g, sight);
    if (kind != SHAFT_MADE)
        return kind == SHAFT_NOTHING ? GEOMETRY_CLEAR : GEOMETRY_MIXED;
    visit v = {.budget = TESTS};
    (void)put_down(&v, &s, g, 0);
    while (v.count > 0) {
        const shaft_node *n = &g->sights.nodes[v.node[--v.count]];
        if (v.budget < 0 || (v.mixed && n->count > 1))
            return GEOMETRY_MIXED;
        if (n->count == 0) {
            put_children(&v, &s, g, n->first);
            continue;
        }
        geometry_visibility found = meet_leaf(&s, g, n, &v.budget);
        if (found == GEOMETRY_BLOCKED)
            return found;
        if (found == GEOMETRY_MIXED)
            meet_something(&v);
    }
    return v.mixed ? GEOMETRY_MIXED : GEOMETRY_CLEAR;
}

/* A surface that the point is on and which curves away below its horizon does not stand above it. */
static bool shape_is_above(const geometry *g, int surface, vec3 point, vec3 normal, int from) {
    const shape *s = &g->shapes[surface];
    bool flat = s->kind == SHAPE_POLYGON || s->kind == SHAPE_RING;
    return !s->shines && !(surface == from && flat) &&
           shaft_reach_of(s, point, normal) > shaft_tolerance(vec3_max_abs(point), g->reach[surface]);
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
        if (box_span(&b, normal).high <= 0)
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
