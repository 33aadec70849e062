/* Sampling shapes as seen from a point: directions distributed by solid angle, and their density. */
#ifndef GEOMETRY_SOLID_ANGLE_H
#define GEOMETRY_SOLID_ANGLE_H

#include <stdbool.h>

#include "base/vector.h"
#include "geometry/shape.h"

typedef struct solid_angle_sample {
    vec3 direction;  /* unit, from the point to the shape */
    double distance; /* to the shape's surface */
    double density;  /* per unit solid angle; 0: nothing of the shape's front is seen from the point, or the sample
                        missed */
} solid_angle_sample;

/* Draws a direction towards the front of the shape (the side its normal points to) with u, v in [0,1). Exactly uniform
 * in solid angle for polygons and spheres; for rings and the sides of cones by a density that is near uniform (to 1e-3
 * or so, more unevenly where the point is very near or the ring very thin) and known exactly. A draw onto a part of an
 * inward cone that hides behind its own outside has density 0. Every direction in which the front is visible has a
 * positive density, so estimates are unbiased. A point as far in front of a surface as coordinates of that size are
 * rounded counts as in it. */
solid_angle_sample solid_angle_draw(const shape *, vec3 from, double u, double v);
/* The density with which solid_angle_draw draws a direction that hits the front at `point` with unit surface normal
 * `normal`. */
double solid_angle_density(const shape *, vec3 from, vec3 direction, vec3 point, vec3 normal);

/* The cone of half-angle `half_angle` (radians, up to pi) around a unit axis: `source`. Density is 1/solid angle. */
vec3 solid_angle_draw_cone(vec3 axis, double half_angle, double u, double v);
double solid_angle_of_cone(double half_angle);

#endif
