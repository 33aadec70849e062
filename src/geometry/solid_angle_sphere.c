/* Spheres: the cone around the centre that a sphere fills from outside; all directions from inside a bubble. */
#include "geometry/solid_angle_shapes.h"

/* A direction `lowered` = 1 - cos(theta) away from the axis, at azimuth 2 pi v. With 1 - cos in place of the cosine
 * narrow cones keep all their digits. */
static vec3 turn_from(vec3 axis, double lowered, double v) {
    frame f = frame_around(axis);
    double sine = sqrt(lowered * fmax(2 - lowered, 0)), azimuth = 2 * PI * v;
    return frame_to_world(&f, (vec3){sine * cos(azimuth), sine * sin(azimuth), 1 - lowered});
}

vec3 solid_angle_draw_cone(vec3 axis, double half_angle, double u, double v) {
    double s = sin(0.5 * half_angle);
    return turn_from(axis, u * 2 * s * s, v);
}

double solid_angle_of_cone(double half_angle) {
    double s = sin(0.5 * half_angle);
    return 4 * PI * s * s;
}

typedef struct view_sphere {
    vec3 axis;       /* unit, to the centre */
    double distance; /* of the centre */
    double height;   /* above the surface, negative inside */
} view_sphere;

static view_sphere view(const shape *s, vec3 from) {
    vec3 to_center = vec3_subtract(s->sphere.center, from);
    double distance = vec3_length(to_center);
    vec3 axis = distance > 0 ? vec3_scale(1 / distance, to_center) : (vec3){0, 0, 1};
    return (view_sphere){axis, distance, distance - s->sphere.radius};
}

static bool sees_front(const view_sphere *w, const shape *s, vec3 from) {
    double rounding = solid_angle_rounding(from, s->sphere.center) + 4 * DBL_EPSILON * s->sphere.radius;
    return s->inward ? w->height <= rounding : w->height > rounding;
}

/* 1 - cos of the half-angle that the sphere fills. */
static double lowered_limb(const view_sphere *w, double radius) {
    double sine = radius / w->distance;
    return sine * sine / (1 + sqrt(w->height * (w->distance + radius)) / w->distance);
}

double solid_angle_sphere(const shape *s, vec3 from) {
    view_sphere w = view(s, from);
    if (!sees_front(&w, s, from))
        return 0;
    return 2 * PI * (s->inward ? 2 : lowered_limb(&w, s->sphere.radius));
}

solid_angle_sample solid_angle_sphere_draw(const shape *s, vec3 from, double u, double v) {
    view_sphere w = view(s, from);
    if (!sees_front(&w, s, from))
        return (solid_angle_sample){{0, 0, 0}, 0, 0};
    double radius = s->sphere.radius, limb = s->inward ? 2 : lowered_limb(&w, radius), lowered = u * limb;
    /* The roots b -+ sqrt(chord) of t^2 - 2 b t + product = 0; the one of them that would cancel is got from the other.
     */
    double b = w.distance * (1 - lowered), product = w.height * (w.distance + radius);
    double chord = sqrt(fmax(radius * radius - w.distance * w.distance * lowered * (2 - lowered), 0));
    double far_root = b >= 0 ? b + chord : product / (b - chord);
    double distance = s->inward ? far_root : product / far_root;
    return (solid_angle_sample){turn_from(w.axis, lowered, v), fmax(distance, 0), 1 / (2 * PI * limb)};
}
