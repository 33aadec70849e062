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

#endif
