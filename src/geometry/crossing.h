/* Where straight lines meet spheres, cones and rings, in double precision. */
#ifndef GEOMETRY_CROSSING_H
#define GEOMETRY_CROSSING_H

#include "geometry/shape.h"

typedef struct shape_crossings {
    int count;
    double distance[2]; /* ascending; of either sign */
} shape_crossings;

/* All crossings of a sphere, cone or ring with the line through `origin` along the unit vector `direction`. Where the
 * line `leaves` the shape, whose point the origin is, that crossing is left out: it is not looked for near zero but
 * divided out of the equation, so that a second one is found however close it lies. */
shape_crossings shape_cross(const shape *, vec3 origin, vec3 direction, bool leaves);

/* Whether a ray from a point off the shape meets its front, whatever else may stand in the way, and where first. Of
 * sides of cones, it says false. */
bool shape_front_crossing(const shape *, vec3 origin, vec3 direction, double *distance);

/* Whether a flat shape is at a point in its plane. */
bool shape_flat_contains(const shape *, vec3 point);

/* How far a point in a flat shape's plane is from its outline. */
double shape_outline_distance(const shape *, vec3 point);

#endif
