/* Embree's rays: through a group, in its own units. */
#include <math.h>

#include "geometry/query.h"

/* By so many errors of single precision Embree's rays are longer at both ends. */
#define ENDS 64

vec3 query_embree_place(const query *q, double distance) {
    const visit *v = q->visit;
    const geometry_tree *tree = v->tree;
    if (!v->transform) /* the difference first: it may be exact */
        return vec3_scale(tree->scale, vec3_add_scaled(vec3_subtract(q->origin, tree->center), distance, q->direction));
    vec3 point = rad_transform_point_back(v->transform, vec3_add_scaled(q->origin, distance, q->direction));
    return vec3_scale(tree->scale, vec3_subtract(point, tree->center));
}

void query_cast(query *q) {
    const visit *v = q->visit;
    vec3 o = query_embree_place(q, v->start), d = q->direction;
    if (v->transform)
        d = rad_transform_direction_back(v->transform, d);
    struct RTCRayHit ray = {.ray = {.org_x = (float)o.x,
                                    .org_y = (float)o.y,
                                    .org_z = (float)o.z,
                                    .dir_x = (float)d.x,
                                    .dir_y = (float)d.y,
                                    .dir_z = (float)d.z,
                                    .tfar = query_embree_limit(q, v),
                                    .mask = UINT32_MAX},
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    if (q->any)
        embree_occluded(v->tree->scene, &q->context, &ray.ray);
    else
        embree_intersect(v->tree->scene, &q->context, &ray);
}

bool query_clip(const query *q, visit *v) {
    vec3 to_center = vec3_subtract(v->center, q->origin);
    double middle = vec3_dot(to_center, q->direction);
    vec3 past = vec3_add_scaled(to_center, -middle, q->direction);
    double radius = v->radius + 1e-14 * (fabs(to_center.x) + fabs(to_center.y) + fabs(to_center.z));
    if (vec3_dot(past, past) > radius * radius || middle + radius < 0)
        return false;
    v->start = middle > radius ? middle - radius : 0;
    v->end = q->far < middle + radius ? q->far : middle + radius;
    /* Surfaces close to the ends must not get beyond them, oblique ones neither. */
    v->start -= ENDS * query_float_error(v);
    v->end += ENDS * query_float_error(v);
    return v->start <= v->end;
}
