/* Shapes as transforms place them. */
#include "geometry/placed.h"

static shape placed_polygon(const shape *s, const rad_transform *t) {
    shape placed = *s;
    placed.polygon.normal = rad_transform_direction(t, s->polygon.normal);
    placed.polygon.center = rad_transform_point(t, s->polygon.center);
    placed.polygon.offset = vec3_dot(placed.polygon.normal, placed.polygon.center);
    placed.polygon.area = s->polygon.area * t->scale * t->scale;
    placed.polygon.rectangle = NULL;
    return placed;
}

static shape placed_cone(const shape *s, const rad_transform *t) {
    shape placed = *s;
    placed.cone.p0 = rad_transform_point(t, s->cone.p0);
    placed.cone.p1 = rad_transform_point(t, s->cone.p1);
    placed.cone.r0 = s->cone.r0 * t->scale;
    placed.cone.r1 = s->cone.r1 * t->scale;
    vec3 axis = vec3_subtract(placed.cone.p1, placed.cone.p0);
    placed.cone.length = vec3_length(axis);
    /* Far away, and small, both ends may be rounded to one point. */
    if (placed.cone.length > 0) {
        placed.cone.axis = vec3_normalize(axis);
    } else {
        placed.cone.axis = rad_transform_direction(t, s->cone.axis);
        placed.cone.length = s->cone.length * t->scale;
    }
    return placed;
}

shape shape_placed(const shape *s, const rad_transform *t) {
    shape placed = *s;
    switch (s->kind) {
    case SHAPE_POLYGON:
        return placed_polygon(s, t);
    case SHAPE_CONE:
        return placed_cone(s, t);
    case SHAPE_SPHERE:
        placed.sphere.center = rad_transform_point(t, s->sphere.center);
        placed.sphere.radius = s->sphere.radius * t->scale;
        break;
    case SHAPE_RING:
        placed.ring.center = rad_transform_point(t, s->ring.center);
        placed.ring.normal = rad_transform_direction(t, s->ring.normal);
        placed.ring.r0 = s->ring.r0 * t->scale;
        placed.ring.r1 = s->ring.r1 * t->scale;
        break;
    }
    return placed;
}

static void include(vec3 point, vec3 *lower, vec3 *upper) {
    *lower = vec3_min(*lower, point);
    *upper = vec3_max(*upper, point);
}

void shape_placed_bounds(const shape *s, const rad_transform *t, vec3 *lower, vec3 *upper) {
    if (s->kind != SHAPE_POLYGON) {
        shape placed = shape_placed(s, t);
        shape_bounds(&placed, lower, upper);
        return;
    }
    *lower = vec3_make(INFINITY, INFINITY, INFINITY);
    *upper = vec3_negate(*lower);
    for (uint32_t i = 0; i < s->polygon.vertex_count; i++)
        include(rad_transform_point(t, s->polygon.vertices[i]), lower, upper);
}
