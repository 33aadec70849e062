/* Copies of groups that Embree comes upon. */
#include <math.h>

#include "geometry/query.h"

visit query_visit_copy(const query *q, unsigned primitive, rad_transform *both) {
    const visit *outer = q->visit;
    const geometry_tree *tree = outer->tree;
    size_t index = tree->placed[primitive];
    const geometry_placement *placement = &tree->placements[index];
    visit v = {.tree = &q->geometry->trees[placement->group],
               .transform = &placement->transform,
               .replacing = outer->replacing || !placement->replaces ? outer->replacing : placement,
               .first = outer->first + tree->firsts[index]};
    if (outer->transform) {
        *both = rad_transform_then(&placement->transform, outer->transform);
        v.transform = both;
    }
    v.center = rad_transform_point(v.transform, v.tree->center);
    v.radius = v.tree->radius * v.transform->scale * (1 + 1e-9) + 1e-14 * vec3_max_abs(v.center);
    v.unit = v.transform->scale / v.tree->scale;
    return v;
}

/* Follows the ray through a copy. */
static void cast_through_copy(query *q, unsigned primitive) {
    const visit *outer = q->visit;
    rad_transform both;
    visit v = query_visit_copy(q, primitive, &both);
    if (!query_clip(q, &v))
        return;
    q->visit = &v;
    query_cast(q);
    q->visit = outer;
}

void geometry_intersect_copy(const struct RTCIntersectFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->rayhit);
    if (!args->valid[0])
        return;
    cast_through_copy(q, args->primID);
    ray->tfar = fminf(ray->tfar, query_embree_limit(q, q->visit));
}

void geometry_occluded_copy(const struct RTCOccludedFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (!args->valid[0] || q->found_any)
        return;
    cast_through_copy(q, args->primID);
    if (q->found_any)
        embree_ray(args->ray)->tfar = -INFINITY;
}
