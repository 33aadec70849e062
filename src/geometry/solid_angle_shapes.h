/* What solid_angle.c hands on to one file a kind of shape. Draws and densities have the contracts of solid_angle.h;
 * where draws are uniform, the solid angle of the front tells the density, and is 0 where nothing of it is seen. */
#ifndef GEOMETRY_SOLID_ANGLE_SHAPES_H
#define GEOMETRY_SOLID_ANGLE_SHAPES_H

#include <float.h>

#include "base/angle.h"
#include "geometry/solid_angle.h"

solid_angle_sample solid_angle_polygon_draw(const shape *, vec3 from, double u, double v);
double solid_angle_polygon(const shape *, vec3 from);

solid_angle_sample solid_angle_sphere_draw(const shape *, vec3 from, double u, double v);
double solid_angle_sphere(const shape *, vec3 from);

solid_angle_sample solid_angle_ring_draw(const shape *, vec3 from, double u, double v);
double solid_angle_ring_density(const shape *, vec3 from, vec3 point);

solid_angle_sample solid_angle_cone_draw(const shape *, vec3 from, double u, double v);
double solid_angle_cone_density(const shape *, vec3 from, vec3 point);

/* A point no farther than this in front of a surface is in it: coordinates of that size cannot tell. */
static inline double solid_angle_rounding(vec3 from, vec3 on_shape) {
    return 4 * DBL_EPSILON * (vec3_max_abs(from) + vec3_max_abs(on_shape));
}

/* The part of a vector across a unit axis. Where little is across, what the first projection leaves are roundings along
 * the axis, too. */
static inline vec3 solid_angle_across(vec3 v, vec3 axis) {
    vec3 across = vec3_add_scaled(v, -vec3_dot(v, axis), axis);
    return vec3_add_scaled(across, -vec3_dot(across, axis), axis);
}

/* The sample that ends `to_point` away; a miss where that is the point itself. */
static inline solid_angle_sample solid_angle_sample_at(vec3 to_point, double density) {
    double distance = vec3_length(to_point);
    if (!(distance > 0))
        return (solid_angle_sample){{0, 0, 0}, 0, 0};
    return (solid_angle_sample){vec3_scale(1 / distance, to_point), distance, density};
}

static inline double solid_angle_clamp(double x, double lower, double upper) {
    return x < lower ? lower : x > upper ? upper : x;
}

#endif
