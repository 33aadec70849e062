/* Spheres, cones and rings that Embree comes upon. */
#include <math.h>

#include "geometry/crossing.h"
#include "geometry/placed.h"
#include "geometry/query.h"

bool query_offer_curved(query *q, unsigned primitive) {
    const visit *v = q->visit;
    int64_t surface = v->first + v->tree->curved[primitive];
    if (surface == q->target)
        return false;
    const shape *s = &v->tree->shapes[v->tree->curved[primitive]];
    shape placed;
    if (v->transform) {
        placed = shape_placed(s, v->transform);
        placed.shines = query_shines(q, s->shines);
        s = &placed;
    }
    shape_crossings crossings = shape_cross(s, q->origin, q->direction, surface == q->from);
    for (int i = 0; i < crossings.count; i++) {
        double distance = crossings.distance[i];
        if (distance <= 0 || (distance > q->far && !q->any))
            continue;
        candidate *c = q->next;
        c->distance = distance;
        c->normal = shape_normal(s, vec3_add_scaled(q->origin, distance, q->direction));
        c->slope = vec3_dot(c->normal, q->direction);
        c->surface = surface;
        c->shines = s->shines;
        c->triangle = NULL;
        /* Of the surface left, only the line's other crossing is here: however near to the tangent plane it is, it is
         * not the origin, and a closed sphere or a tube shuts in what comes from its inside. */
        if (surface == q->from || query_in_reach(q, c))
            return query_offer(q);
    }
    return false;
}

void geometry_intersect_curved(const struct RTCIntersectFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->rayhit);
    if (args->valid[0] && query_offer_curved(q, args->primID))
        ray->tfar = fminf(ray->tfar, query_embree_limit(q, q->visit));
}

void geometry_occluded_curved(const struct RTCOccludedFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (args->valid[0] && query_offer_curved(q, args->primID))
        embree_ray(args->ray)->tfar = -INFINITY;
}
