/* Shapes moved by a transform. */
#ifndef GEOMETRY_PLACED_H
#define GEOMETRY_PLACED_H

#include "geometry/shape.h"
#include "rad/transform.h"

/* The shape as the transform places it. Of a polygon only its normal, centre, offset and area: its vertices are still
 * those before the transform. */
shape shape_placed(const shape *, const rad_transform *);

/* Bounds of the shape as the transform places it. */
void shape_placed_bounds(const shape *, const rad_transform *, vec3 *lower, vec3 *upper);

/* A unit vector turned, and mirrored. */
static inline vec3 placed_normal(const rad_transform *t, vec3 normal) {
    return vec3_scale(1 / t->scale, rad_transform_vector(t, normal));
}

/* What a vector comes from, but for a factor: of a similarity, the transposed matrix is the inverse but for that. */
static inline vec3 placed_transposed(const rad_transform *t, vec3 v) {
    return vec3_make(v.x * t->m[0][0] + v.y * t->m[0][1] + v.z * t->m[0][2],
                     v.x * t->m[1][0] + v.y * t->m[1][1] + v.z * t->m[1][2],
                     v.x * t->m[2][0] + v.y * t->m[2][1] + v.z * t->m[2][2]);
}

/* The unit vector that becomes this one. */
static inline vec3 placed_inverse_direction(const rad_transform *t, vec3 direction) {
    return vec3_scale(1 / t->scale, placed_transposed(t, direction));
}

/* The point that becomes this one. */
static inline vec3 placed_inverse_point(const rad_transform *t, vec3 point) {
    vec3 moved = vec3_subtract(point, vec3_make(t->m[3][0], t->m[3][1], t->m[3][2]));
    return vec3_scale(1 / (t->scale * t->scale), placed_transposed(t, moved));
}

#endif
