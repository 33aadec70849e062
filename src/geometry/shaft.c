/* What stands between a point and a light: the way through the hierarchy. */
#include "geometry/shaft.h"

#include <stdlib.h>

#include "geometry/geometry_internal.h"
#include "geometry/shaft_internal.h"

/* Tests of boxes that are made before an answer is given up, one of a surface being worth several; and once some of the
 * light is known to be hidden, in the hope of a surface that hides all. */
#define TESTS       120
#define TESTS_MIXED 20

/* A box as the hierarchy takes it. */
static void set_box(shape *box, vec3 corners[2]) {
    vec3 size = vec3_subtract(corners[1], corners[0]);
    *box = (shape){.kind = SHAPE_POLYGON};
    box->polygon.vertices = corners;
    box->polygon.vertex_count = 2;
    box->polygon.center = vec3_add_scaled(corners[0], 0.5, size);
    box->polygon.area = size.x * size.y + size.y * size.z + size.z * size.x;
}

/* A hierarchy over the boxes of copies. */
static bool build_copied(geometry *g, vec3 lower, vec3 upper) {
    const geometry_tree *scene = &g->trees[0];
    size_t count = scene->placed_count;
    g->copied_boxes = malloc(count * (sizeof(shape) + 2 * sizeof(vec3)));
    if (!g->copied_boxes)
        return false;
    vec3 *corners = (vec3 *)(g->copied_boxes + count);
    for (size_t i = 0; i < count; i++, corners += 2) {
        geometry_copy_bounds(g, &scene->placements[scene->placed[i]], &corners[0], &corners[1]);
        set_box(&g->copied_boxes[i], corners);
    }
    return shaft_tree_build(&g->copied_sights, g->copied_boxes, count, lower, upper, g->threads);
}

graze_status geometry_prepare_sights(geometry *g, const graze_report *report) {
    const geometry_tree *scene = &g->trees[0];
    vec3 reach = {scene->radius, scene->radius, scene->radius};
    vec3 lower = vec3_subtract(scene->center, reach), upper = vec3_add(scene->center, reach);
    if (g->empty || g->sights.nodes || g->copied_sights.nodes)
        return GRAZE_OK;
    bool built = scene->shape_count == 0 ||
                 shaft_tree_build(&g->sights, scene->shapes, scene->shape_count, lower, upper, g->threads);
    if (built && scene->placed_count > 0)
        built = build_copied(g, lower, upper);
    return built ? GRAZE_OK : report_out_of_memory(report);
}

/* Where a box stands with respect to the shaft; and how far its middle is inside of the nearest side. */
static shaft_place find_box(const shaft *s, const shaft_node *n, double *depth) {
    shaft_box b = shaft_box_from(n, s->sight->point);
    shaft_span over = shaft_box_span(&b, s->sight->normal), before = shaft_box_span(&b, s->base);
    if (over.high <= 0 || before.high + s->base_height < -2 * s->near)
        return SHAFT_OUTSIDE;
    bool inside = over.low > 0 && before.low + s->base_height > 0;
    for (int i = 0; i < s->side_count; i++) {
        shaft_span span = shaft_box_span(&b, s->sides[i]);
        if (span.high <= 0)
            return SHAFT_OUTSIDE;
        inside = inside && span.low > 0;
        *depth = double_min(*depth, span.low + span.high);
    }
    return inside ? SHAFT_INSIDE : SHAFT_ACROSS;
}

/* The first of a leaf's shapes that is in the way tells for all: where there are several, they are small. */
static geometry_visibility meet_shapes(shaft *s, const geometry *g, const shaft_node *leaf, int *budget) {
    geometry_visibility found = GEOMETRY_CLEAR;
    for (uint32_t i = 0; i < leaf->count && found == GEOMETRY_CLEAR; i++)
        found = *budget > 0 ? shaft_meets_shape(s, g, g->sights.order[leaf->first + i], budget) : GEOMETRY_MIXED;
    return found;
}

/* Of what is in a copy nothing is known but the box around it. */
static geometry_visibility meet_copies(shaft *s, const geometry *g, const shaft_node *leaf, int *budget) {
    for (uint32_t i = 0; i < leaf->count; i++, --*budget) {
        const vec3 *corners = g->copied_boxes[g->copied_sights.order[leaf->first + i]].polygon.vertices;
        shaft_node around = {.lower = corners[0], .upper = corners[1]};
        double depth = 0;
        if (!shaft_box_is_beside(&around, s->lower, s->upper) && find_box(s, &around, &depth) != SHAFT_OUTSIDE)
            return GEOMETRY_MIXED;
    }
    return GEOMETRY_CLEAR;
}

/* What is still to be looked at. */
typedef struct visit {
    const shaft_tree *tree;
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
static double put_down(visit *v, const shaft *s, uint32_t index) {
    const shaft_node *n = &v->tree->nodes[index];
    double depth = INFINITY;
    if (shaft_box_is_beside(n, s->lower, s->upper))
        return depth;
    v->budget--;
    shaft_place where = n->count == 1 ? SHAFT_ACROSS : find_box(s, n, &depth);
    if (where == SHAFT_INSIDE)
        meet_something(v);
    if (where == SHAFT_ACROSS)
        v->node[v->count++] = index;
    return depth;
}

/* Of two children, what stands alone comes first, then what is deeper within the shaft: more often in the way. */
static void put_children(visit *v, const shaft *s, uint32_t first) {
    int before = v->count;
    double a = put_down(v, s, first), b = put_down(v, s, first + 1);
    if (v->count == before + 2 && a > b) {
        v->node[before] = first + 1;
        v->node[before + 1] = first;
    }
}

/* What the shapes of one of the hierarchies do to the shaft. */
static geometry_visibility look_through(shaft *s, const geometry *g, const shaft_tree *tree) {
    visit v = {.tree = tree, .budget = TESTS};
    if (!tree->nodes)
        return GEOMETRY_CLEAR;
    (void)put_down(&v, s, 0);
    while (v.count > 0) {
        const shaft_node *n = &tree->nodes[v.node[--v.count]];
        if (v.budget < 0 || (v.mixed && n->count > 1))
            return GEOMETRY_MIXED;
        if (n->count == 0) {
            put_children(&v, s, n->first);
            continue;
        }
        bool copies = tree == &g->copied_sights;
        geometry_visibility found = copies ? meet_copies(s, g, n, &v.budget) : meet_shapes(s, g, n, &v.budget);
        if (found == GEOMETRY_BLOCKED)
            return found;
        if (found == GEOMETRY_MIXED)
            meet_something(&v);
    }
    return v.mixed ? GEOMETRY_MIXED : GEOMETRY_CLEAR;
}

geometry_visibility geometry_sight_of(const geometry *g, const geometry_sight *sight) {
    shaft s;
    if (g->empty)
        return GEOMETRY_CLEAR;
    if (!g->sights.nodes && !g->copied_sights.nodes)
        return GEOMETRY_MIXED;
    shaft_kind kind = shaft_make(&s, g, sight);
    if (kind != SHAFT_MADE)
        return kind == SHAFT_NOTHING ? GEOMETRY_CLEAR : GEOMETRY_MIXED;
    geometry_visibility own = look_through(&s, g, &g->sights);
    return own == GEOMETRY_CLEAR ? look_through(&s, g, &g->copied_sights) : own;
}

/* A surface that the point is on and which curves away below its horizon does not stand above it. */
static bool shape_is_above(const geometry *g, int surface, vec3 point, vec3 normal, int64_t from) {
    const shape *s = &g->trees[0].shapes[surface];
    return !s->shines && !(surface == from && shape_is_flat(s)) &&
           shaft_reach_of(s, point, normal) > shaft_tolerance(vec3_max_abs(point), g->trees[0].reach[surface]);
}

static bool leaf_is_above(const geometry *g, const shaft_tree *tree, const shaft_node *leaf, vec3 point, vec3 normal,
                          int64_t from) {
    if (tree == &g->copied_sights)
        return leaf->count > 0;
    for (uint32_t i = 0; i < leaf->count; i++)
        if (shape_is_above(g, tree->order[leaf->first + i], point, normal, from))
            return true;
    return false;
}

static bool reflects_above(const geometry *g, const shaft_tree *tree, vec3 point, vec3 normal, int64_t from) {
    const shaft_node *nodes = tree->nodes;
    uint32_t stack[SHAFT_TREE_DEPTH + 1] = {0};
    int height = nodes ? 1 : 0;
    for (int budget = TESTS; height > 0; budget--) {
        const shaft_node *n = &nodes[stack[--height]];
        if (!n->reflects)
            continue;
        if (budget <= 0)
            return true;
        shaft_box b = shaft_box_from(n, point);
        if (shaft_box_span(&b, normal).high <= 0)
            continue;
        if (n->count == 0) {
            stack[height++] = n->first;
            stack[height++] = n->first + 1;
        }
        if (leaf_is_above(g, tree, n, point, normal, from))
            return true;
    }
    return false;
}

bool geometry_reflects_above(const geometry *g, vec3 point, vec3 normal, int64_t from) {
    if (!g->sights.nodes && !g->copied_sights.nodes)
        return !g->empty;
    return reflects_above(g, &g->sights, point, normal, from) ||
           reflects_above(g, &g->copied_sights, point, normal, from);
}
