/* Sampling shapes by solid angle: each kind has a file of its own. */
#include "geometry/solid_angle.h"

#include "geometry/solid_angle_shapes.h"

solid_angle_sample solid_angle_draw(const shape *s, vec3 from, double u, double v) {
    switch (s->kind) {
    case SHAPE_POLYGON:
        return solid_angle_polygon_draw(s, from, u, v);
    case SHAPE_SPHERE:
        return solid_angle_sphere_draw(s, from, u, v);
    case SHAPE_CONE:
        return solid_angle_cone_draw(s, from, u, v);
    case SHAPE_RING:
        return solid_angle_ring_draw(s, from, u, v);
    }
    return (solid_angle_sample){{0, 0, 0}, 0, 0};
}

static double uniform_density(double solid_angle) {
    return solid_angle > 0 ? 1 / solid_angle : 0;
}

double solid_angle_density(const shape *s, vec3 from, vec3 direction, vec3 point, vec3 normal) {
    if (!(vec3_dot(direction, normal) < 0))
        return 0;
    switch (s->kind) {
    case SHAPE_POLYGON:
        return uniform_density(solid_angle_polygon(s, from));
    case SHAPE_SPHERE:
        return uniform_density(solid_angle_sphere(s, from));
    case SHAPE_CONE:
        return solid_angle_cone_density(s, from, point);
    case SHAPE_RING:
        return solid_angle_ring_density(s, from, point);
    }
    return 0;
}
