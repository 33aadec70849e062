/* Surfaces of copies: which they are, and where. */
#include "geometry/geometry_internal.h"
#include "geometry/placed.h"

int geometry_descend(const geometry *g, int group, int64_t *number) {
    const geometry_tree *tree = &g->trees[group];
    if (*number < (int64_t)tree->shape_count)
        return -1;
    size_t low = 0, high = tree->placement_count; /* the copy is in low .. high - 1 */
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (tree->firsts[middle] <= *number)
            low = middle;
        else
            high = middle;
    }
    *number -= tree->firsts[low];
    return (int)low;
}

/* Transforms are put together as a ray comes by them, from the outermost inwards: to the same bits. */
geometry_origin geometry_find(const geometry *g, int64_t surface) {
    geometry_origin found = {0};
    int copy;
    while ((copy = geometry_descend(g, found.group, &surface)) >= 0) {
        const geometry_placement *placement = &g->trees[found.group].placements[copy];
        found.transform =
            found.copied ? rad_transform_then(&placement->transform, &found.transform) : placement->transform;
        found.group = placement->group;
        found.copied = true;
    }
    found.shape = &g->trees[found.group].shapes[surface];
    return found;
}

shape geometry_placed_shape(const geometry *g, int64_t surface) {
    geometry_origin found = geometry_find(g, surface);
    return found.copied ? shape_placed(found.shape, &found.transform) : *found.shape;
}

double geometry_placed_reach(const geometry *g, int64_t surface) {
    geometry_origin found = geometry_find(g, surface);
    vec3 lower, upper;
    if (found.copied)
        shape_placed_bounds(found.shape, &found.transform, &lower, &upper);
    else
        shape_bounds(found.shape, &lower, &upper);
    return double_max(vec3_max_abs(lower), vec3_max_abs(upper));
}

/* The outermost copy around the surface that replaces; or null, and *s is its shape. */
static const geometry_placement *find_replacing(const geometry *g, int64_t surface, const shape **s) {
    int group = 0, copy;
    while ((copy = geometry_descend(g, group, &surface)) >= 0) {
        const geometry_placement *placement = &g->trees[group].placements[copy];
        if (placement->replaces)
            return placement;
        group = placement->group;
    }
    *s = &g->trees[group].shapes[surface];
    return NULL;
}

bool geometry_shines(const geometry *g, int64_t surface) {
    const shape *s = NULL;
    const geometry_placement *replacing = find_replacing(g, surface, &s);
    return replacing ? replacing->shines : s->shines;
}

bool geometry_passes(const geometry *g, int64_t surface) {
    const shape *s = NULL;
    const geometry_placement *replacing = find_replacing(g, surface, &s);
    return replacing ? replacing->passes : s->passes;
}

/* The box around the box, as turned. */
void geometry_copy_bounds(const geometry *g, const geometry_placement *placement, vec3 *lower, vec3 *upper) {
    const geometry_tree *tree = &g->trees[placement->group];
    const rad_transform *t = &placement->transform;
    vec3 half = vec3_scale(0.5, vec3_subtract(tree->upper, tree->lower));
    vec3 center = rad_transform_point(t, vec3_add(tree->lower, half));
    double rounding = 1e-14 * (vec3_max_abs(center) + t->scale * vec3_max_abs(half));
    vec3 reach = {fabs(t->m[0][0]) * half.x + fabs(t->m[1][0]) * half.y + fabs(t->m[2][0]) * half.z + rounding,
                  fabs(t->m[0][1]) * half.x + fabs(t->m[1][1]) * half.y + fabs(t->m[2][1]) * half.z + rounding,
                  fabs(t->m[0][2]) * half.x + fabs(t->m[1][2]) * half.y + fabs(t->m[2][2]) * half.z + rounding};
    *lower = vec3_subtract(center, reach);
    *upper = vec3_add(center, reach);
}
