/* Where a line crosses a curved shape, in double precision. */
#include "geometry/crossing.h"

#include <float.h>

/* Beyond a rim by less than this many roundings is still on the surface: rims of touching shapes must not part. */
#define RIM_ROUNDINGS 8

static void add_crossing(shape_crossings *c, double distance) {
    if (!isfinite(distance))
        return;
    c->distance[c->count++] = distance;
    if (c->count == 2 && c->distance[0] > c->distance[1]) {
        c->distance[1] = c->distance[0];
        c->distance[0] = distance;
    }
}

/* With the discriminant from the line's distance to the centre, after Haines, Gunther and Akenine-Moeller, "Precision
 * Improvements for Ray/Sphere Intersection", Ray Tracing Gems (2019): a difference of squares that do not grow with the
 * distance of the origin. */
static shape_crossings cross_sphere(const shape *s, vec3 origin, vec3 direction, bool leaves) {
    shape_crossings found = {0};
    double radius = s->sphere.radius;
    vec3 f = vec3_subtract(origin, s->sphere.center);
    double b = -vec3_dot(f, direction);
    if (leaves) {
        add_crossing(&found, 2 * b);
        return found;
    }
    double across = vec3_length(vec3_add_scaled(f, b, direction));
    if (across > radius)
        return found;
    double half_chord = sqrt((radius - across) * (radius + across));
    double far = b + copysign(half_chord, b);
    double length = vec3_length(f);
    /* The product of both roots is |f|^2 - r^2; the smaller one follows without cancellation. */
    add_crossing(&found, far);
    if (far != 0)
        add_crossing(&found, (length - radius) * (length + radius) / far);
    return found;
}

/* A line beside a cone, split along and across its axis. */
typedef struct cone_line {
    double growth;      /* of the radius per length */
    vec3 across;        /* the direction's part across the axis */
    double along;       /* and along it */
    vec3 origin_across; /* the same of the origin, seen from p0 */
    double origin_along;
} cone_line;

static cone_line cone_line_make(const shape *s, vec3 origin, vec3 direction) {
    vec3 w = vec3_subtract(origin, s->cone.p0);
    cone_line line = {.growth = (s->cone.r1 - s->cone.r0) / s->cone.length,
                      .along = vec3_dot(direction, s->cone.axis),
                      .origin_along = vec3_dot(w, s->cone.axis)};
    line.across = vec3_add_scaled(direction, -line.along, s->cone.axis);
    line.origin_across = vec3_add_scaled(w, -line.origin_along, s->cone.axis);
    return line;
}

/* The point of the line nearest to the axis, or where that lies above or below the cone, at the cone's end: seen from
 * there the equation's coefficients are no larger than the cone. */
static double cone_middle(const shape *s, const cone_line *line) {
    double across2 = vec3_dot(line->across, line->across);
    double middle = across2 > 0 ? -vec3_dot(line->origin_across, line->across) / across2 : 0;
    if (line->along != 0) {
        double a = -line->origin_along / line->along, b = (s->cone.length - line->origin_along) / line->along;
        middle = fmin(fmax(middle, fmin(a, b)), fmax(a, b));
    }
    return middle;
}

static void add_cone_crossing(shape_crossings *found, const shape *s, const cone_line *line, double t) {
    if (!isfinite(t))
        return;
    double height = line->origin_along + t * line->along;
    double slack = RIM_ROUNDINGS * DBL_EPSILON * (s->cone.length + fabs(line->origin_along));
    if (height >= -slack && height <= s->cone.length + slack)
        add_crossing(found, t);
}

/* |across part of (o + t d)| = r0 + growth * along part of (o + t d), squared: A t^2 + 2 B t + C = 0. Where the radius
 * is positive, as it is between the ends, the squared equation has no further solutions. */
static shape_crossings cross_cone(const shape *s, vec3 origin, vec3 direction, bool leaves) {
    shape_crossings found = {0};
    cone_line line = cone_line_make(s, origin, direction);
    double widening = line.growth * line.along;
    double across = vec3_length(line.across);
    double a = (across - widening) * (across + widening);
    double middle = leaves ? 0 : cone_middle(s, &line);
    vec3 w = vec3_add_scaled(line.origin_across, middle, line.across);
    double radius = s->cone.r0 + line.growth * (line.origin_along + middle * line.along);
    double b = vec3_dot(w, line.across) - widening * radius;
    if (leaves) {
        add_cone_crossing(&found, s, &line, -2 * b / a);
        return found;
    }
    /* B^2 - A C as a difference of two squares */
    double p = vec3_length(vec3_add_scaled(vec3_scale(radius, line.across), -widening, w));
    double q = vec3_length(vec3_cross(w, line.across));
    if (q > p)
        return found;
    double distance = vec3_length(w);
    double c = (distance - radius) * (distance + radius);
    double sum = -(b + copysign(sqrt((p - q) * (p + q)), b));
    add_cone_crossing(&found, s, &line, middle + sum / a);
    if (sum != 0)
        add_cone_crossing(&found, s, &line, middle + c / sum);
    return found;
}

static shape_crossings cross_ring(const shape *s, vec3 origin, vec3 direction, bool leaves) {
    shape_crossings found = {0};
    if (leaves)
        return found;
    vec3 w = vec3_subtract(s->ring.center, origin);
    double t = vec3_dot(s->ring.normal, w) / vec3_dot(s->ring.normal, direction);
    if (!isfinite(t))
        return found;
    double distance = vec3_length(vec3_subtract(vec3_scale(t, direction), w));
    double slack = RIM_ROUNDINGS * DBL_EPSILON * (s->ring.r1 + vec3_max_abs(w));
    if (distance >= s->ring.r0 - slack && distance <= s->ring.r1 + slack)
        add_crossing(&found, t);
    return found;
}

shape_crossings shape_cross(const shape *s, vec3 origin, vec3 direction, bool leaves) {
    switch (s->kind) {
    case SHAPE_SPHERE:
        return cross_sphere(s, origin, direction, leaves);
    case SHAPE_CONE:
        return cross_cone(s, origin, direction, leaves);
    case SHAPE_RING:
        return cross_ring(s, origin, direction, leaves);
    case SHAPE_POLYGON:
        break;
    }
    return (shape_crossings){0};
}

/* Even-odd, in the plane of the two axes across which the polygon is seen largest. */
static bool polygon_contains(const shape *s, vec3 point) {
    vec3 n = s->polygon.normal;
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    bool drop_x = x >= y && x >= z, drop_y = !drop_x && y >= z, inside = false;
    const vec3 *vertices = s->polygon.vertices;
    uint32_t count = s->polygon.vertex_count;
    for (uint32_t i = 0, before = count - 1; i < count; before = i++) {
        vec3 a = vec3_subtract(vertices[before], point), b = vec3_subtract(vertices[i], point);
        double ax = drop_x ? a.y : a.x, ay = drop_x || drop_y ? a.z : a.y;
        double bx = drop_x ? b.y : b.x, by = drop_x || drop_y ? b.z : b.y;
        if ((ay > 0) != (by > 0) && (bx * ay - ax * by > 0) == (ay > by))
            inside = !inside;
    }
    return inside;
}

bool shape_front_crossing(const shape *s, vec3 origin, vec3 direction, double *distance) {
    if (s->kind == SHAPE_CONE)
        return false;
    if (s->kind == SHAPE_POLYGON) {
        double slope = vec3_dot(s->polygon.normal, direction);
        double height = vec3_dot(s->polygon.normal, vec3_subtract(s->polygon.center, origin));
        *distance = height / slope;
        return slope < 0 && height < 0 && polygon_contains(s, vec3_add_scaled(origin, *distance, direction));
    }
    shape_crossings crossings = shape_cross(s, origin, direction, false);
    for (int i = 0; i < crossings.count; i++) {
        *distance = crossings.distance[i];
        vec3 point = vec3_add_scaled(origin, *distance, direction);
        if (*distance > 0 && vec3_dot(shape_normal(s, point), direction) < 0)
            return true;
    }
    return false;
}

bool shape_flat_contains(const shape *s, vec3 point) {
    if (s->kind == SHAPE_POLYGON)
        return polygon_contains(s, point);
    double radius = vec3_length(vec3_subtract(point, s->ring.center));
    return radius >= s->ring.r0 && radius <= s->ring.r1;
}

static double distance_to_side(vec3 a, vec3 b, vec3 point) {
    vec3 side = vec3_subtract(b, a), from = vec3_subtract(point, a);
    double square = vec3_dot(side, side), along = square > 0 ? vec3_dot(from, side) / square : 0;
    return vec3_length(vec3_add_scaled(from, -fmin(fmax(along, 0), 1), side));
}

double shape_outline_distance(const shape *s, vec3 point) {
    if (s->kind != SHAPE_POLYGON) {
        double radius = vec3_length(vec3_subtract(point, s->ring.center));
        return fmin(fabs(radius - s->ring.r1), s->ring.r0 > 0 ? fabs(radius - s->ring.r0) : INFINITY);
    }
    double least = INFINITY;
    uint32_t count = s->polygon.vertex_count;
    for (uint32_t i = 0, before = count - 1; i < count; before = i++)
        least = fmin(least, distance_to_side(s->polygon.vertices[before], s->polygon.vertices[i], point));
    return least;
}
