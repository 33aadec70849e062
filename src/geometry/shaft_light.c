/* The shaft of rays from a point to a light. */
#include <float.h>

#include "base/angle.h"
#include "geometry/geometry_internal.h"
#include "geometry/shaft_internal.h"

/* Below this sine between the rays to two corners, the plane through them is not known well enough. */
#define LEAST_SINE 1e-9

double shaft_tolerance(double point, double surface) {
    return 8 * DBL_EPSILON * (point + surface);
}

shaft_span shaft_light_span(const shaft *s, vec3 along) {
    if (s->round) {
        double middle = vec3_dot(along, s->center), part = vec3_dot(along, s->axis);
        double reach = s->radius * sqrt(double_max(0, vec3_dot(along, along) - part * part));
        return (shaft_span){middle - reach, middle + reach};
    }
    shaft_span span = {INFINITY, -INFINITY};
    for (int i = 0; i < s->corner_count; i++) {
        double part = vec3_dot(along, s->corners[i]);
        span.low = double_min(span.low, part);
        span.high = double_max(span.high, part);
    }
    return span;
}

/* Cuts off what lies below the horizon. */
static void clip(shaft *s) {
    vec3 normal = s->sight->normal, kept[SHAFT_CORNERS];
    int count = 0;
    for (int i = 0, before = s->corner_count - 1; i < s->corner_count; before = i++) {
        vec3 a = s->corners[before], b = s->corners[i];
        double height_a = vec3_dot(normal, a), height_b = vec3_dot(normal, b);
        if ((height_a < 0) != (height_b < 0))
            kept[count++] = vec3_add_scaled(a, height_a / (height_a - height_b), vec3_subtract(b, a));
        if (height_b >= 0)
            kept[count++] = b;
    }
    for (int i = 0; i < count; i++)
        s->corners[i] = kept[i];
    s->corner_count = count;
}

/* Planes through the point and an edge. Edges inside of the hull, such as those of a concave polygon, have none. */
static void add_sides(shaft *s) {
    double longest2 = 0;
    for (int i = 0; i < s->corner_count; i++)
        longest2 = double_max(longest2, vec3_dot(s->corners[i], s->corners[i]));
    double rounding = 16 * DBL_EPSILON * sqrt(longest2);
    for (int i = 0, before = s->corner_count - 1; i < s->corner_count; before = i++) {
        vec3 a = s->corners[before], b = s->corners[i], normal = vec3_cross(a, b);
        double length = vec3_length(normal);
        if (!(length > LEAST_SINE * sqrt(vec3_dot(a, a) * vec3_dot(b, b))))
            continue;
        normal = vec3_scale(1 / length, normal);
        double low = 0, high = 0;
        for (int k = 0; k < s->corner_count; k++) {
            double part = vec3_dot(normal, s->corners[k]);
            low = double_min(low, part);
            high = double_max(high, part);
        }
        if (low >= -rounding)
            s->sides[s->side_count++] = normal;
        else if (high <= rounding)
            s->sides[s->side_count++] = vec3_negate(normal);
    }
}

void shaft_surround_disk(vec3 corners[SHAFT_ROUND_CORNERS], vec3 center, vec3 axis, double radius) {
    vec3 first = vec3_perpendicular(axis), second = vec3_cross(axis, first);
    double far = radius / cos(PI / SHAFT_ROUND_CORNERS);
    const double half = sqrt(0.5);
    const double cosines[SHAFT_ROUND_CORNERS] = {1, half, 0, -half, -1, -half, 0, half};
    for (int i = 0; i < SHAFT_ROUND_CORNERS; i++) {
        double cosine = cosines[i], sine = cosines[(i + SHAFT_ROUND_CORNERS - 2) % SHAFT_ROUND_CORNERS];
        corners[i] = vec3_add_scaled(vec3_add_scaled(center, far * cosine, first), far * sine, second);
    }
}

static void surround_disk(shaft *s) {
    shaft_surround_disk(s->corners, s->center, s->axis, s->radius);
    s->corner_count = SHAFT_ROUND_CORNERS;
    s->round = true;
}

/* With what may coincide with the light. */
static void find_bounds(shaft *s) {
    shaft_span x = shaft_light_span(s, vec3_make(1, 0, 0)), y = shaft_light_span(s, vec3_make(0, 1, 0)),
               z = shaft_light_span(s, vec3_make(0, 0, 1));
    double around = double_max(s->tolerance, 2 * s->near);
    vec3 slack = {around, around, around};
    vec3 lower = {double_min(x.low, 0), double_min(y.low, 0), double_min(z.low, 0)};
    vec3 upper = {double_max(x.high, 0), double_max(y.high, 0), double_max(z.high, 0)};
    s->lower = vec3_subtract(vec3_add(s->sight->point, lower), slack);
    s->upper = vec3_add(vec3_add(s->sight->point, upper), slack);
}

/* The light's plane, its normal on its front. */
static shaft_kind set_base(shaft *s, vec3 normal, double height) {
    s->base = normal;
    s->base_height = height;
    return height <= 0 ? SHAFT_NOTHING : height <= s->tolerance ? SHAFT_UNKNOWN : SHAFT_MADE;
}

static shaft_kind polygon_shaft(shaft *s, const shape *light) {
    uint32_t count = light->polygon.vertex_count;
    vec3 point = s->sight->point, normal = light->polygon.normal;
    double height = vec3_dot(normal, vec3_subtract(point, light->polygon.center)), uneven = 0, lowest = 0;
    if (count > SHAFT_LIGHT_CORNERS)
        return SHAFT_UNKNOWN;
    for (uint32_t i = 0; i < count; i++) {
        s->corners[i] = vec3_subtract(light->polygon.vertices[i], point);
        uneven = double_max(uneven, fabs(vec3_dot(normal, s->corners[i]) + height));
        lowest = double_min(lowest, vec3_dot(s->sight->normal, s->corners[i]));
    }
    s->corner_count = (int)count;
    if (lowest < 0)
        clip(s);
    /* Of a polygon that is not plane, neither its corners nor its plane are behind it. */
    shaft_kind kind = set_base(s, normal, uneven > s->tolerance ? height + 2 * uneven : height);
    return uneven > s->tolerance && height < 4 * uneven ? SHAFT_UNKNOWN : kind;
}

static shaft_kind ring_shaft(shaft *s, const shape *light) {
    s->center = vec3_subtract(light->ring.center, s->sight->point);
    s->axis = light->ring.normal;
    s->radius = light->ring.r1;
    surround_disk(s);
    return set_base(s, s->axis, -vec3_dot(s->axis, s->center));
}

static shaft_kind sphere_shaft(shaft *s, const shape *light) {
    vec3 center = vec3_subtract(light->sphere.center, s->sight->point);
    double distance = vec3_length(center), radius = light->sphere.radius;
    if (light->inward || !(distance - radius > 2 * s->near))
        return SHAFT_UNKNOWN;
    double sine = radius / distance, cosine2 = (1 - sine) * (1 + sine);
    s->ball_center = center;
    s->ball_radius = radius;
    s->center = vec3_scale(cosine2, center);
    s->axis = vec3_scale(-1 / distance, center);
    s->radius = radius * sqrt(cosine2);
    surround_disk(s);
    return set_base(s, s->axis, distance * cosine2);
}

/* A disk as far away as nothing else. */
static shaft_kind source_shaft(shaft *s) {
    double angle = s->sight->half_angle;
    if (!(angle < 0.499 * PI))
        return SHAFT_UNKNOWN;
    s->center = vec3_scale(GEOMETRY_FAR, s->sight->axis);
    s->axis = vec3_negate(s->sight->axis);
    s->radius = GEOMETRY_FAR * tan(angle);
    surround_disk(s);
    return set_base(s, s->axis, GEOMETRY_FAR);
}

static shaft_kind light_shaft(shaft *s, const geometry *g) {
    if (s->sight->light < 0)
        return source_shaft(s);
    const shape *light = &g->trees[0].shapes[s->sight->light];
    switch (light->kind) {
    case SHAPE_POLYGON:
        return polygon_shaft(s, light);
    case SHAPE_RING:
        return ring_shaft(s, light);
    case SHAPE_SPHERE:
        return sphere_shaft(s, light);
    case SHAPE_CONE:
        break;
    }
    return SHAFT_UNKNOWN;
}

shaft_kind shaft_make(shaft *s, const geometry *g, const geometry_sight *sight) {
    s->sight = sight;
    double size = vec3_max_abs(sight->point);
    s->tolerance = shaft_tolerance(size, sight->light < 0 ? 0 : g->trees[0].reach[sight->light]);
    s->near = geometry_coincidence(g->largest_reach, size);
    /* Rays that leave no surface do not hit what is that close. */
    if (sight->from < 0)
        s->near += GEOMETRY_FTINY * double_min(1, size);
    s->round = false;
    s->ball_radius = 0;
    s->corner_count = s->side_count = 0;
    shaft_kind kind = light_shaft(s, g);
    if (kind != SHAFT_MADE)
        return kind;
    if (shaft_light_span(s, sight->normal).high <= s->tolerance)
        return SHAFT_NOTHING;
    add_sides(s);
    find_bounds(s);
    return SHAFT_MADE;
}
