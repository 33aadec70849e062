/* Lights as a shading frame sees them: outlines of polygons, spheres, rings and sources. */
#include "trace/unshadowed.h"

#include "base/angle.h"
#include "graze/brdf_light.h"

enum { MOST_CORNERS = 16 };

/* The surface, and what the integral is of. */
typedef struct receiver {
    frame frame;
    vec3 point, view;
    const graze_brdf *lobe; /* null: not wanted */
    unshadowed_light *result;
} receiver;

static vec3 to_local(const receiver *r, vec3 displacement) {
    return frame_to_local(&r->frame, displacement);
}

static void add_ellipse(const receiver *r, double sign, vec3 center, vec3 first, vec3 second) {
    r->result->diffuse += sign * graze_diffuse_ellipse(center, first, second);
    if (r->lobe)
        r->result->glossy += sign * graze_brdf_ellipse(r->lobe, center, first, second, r->view);
}

/* The circle about an axis, all in the shading frame. */
static void add_circle(const receiver *r, double sign, vec3 center, vec3 axis, double radius) {
    vec3 first = vec3_scale(radius, vec3_perpendicular(axis));
    add_ellipse(r, sign, center, first, vec3_cross(axis, first));
}

static bool polygon_light(const receiver *r, const shape *s) {
    vec3 corners[MOST_CORNERS];
    size_t count = s->polygon.vertex_count;
    if (count > MOST_CORNERS)
        return false;
    if (vec3_dot(s->polygon.normal, r->point) <= s->polygon.offset)
        return true;
    for (size_t i = 0; i < count; i++)
        corners[i] = to_local(r, vec3_subtract(s->polygon.vertices[i], r->point));
    r->result->diffuse = graze_diffuse_polygon(corners, count);
    if (r->lobe)
        r->result->glossy = graze_brdf_polygon(r->lobe, corners, count, r->view);
    return true;
}

/* The circle in which the cone that touches the sphere does so. */
static bool sphere_light(const receiver *r, const shape *s) {
    vec3 center = to_local(r, vec3_subtract(s->sphere.center, r->point));
    double distance = vec3_length(center), radius = s->sphere.radius;
    if (s->inward || !(distance > radius))
        return false;
    double sine = radius / distance, cosine = sqrt((1 - sine) * (1 + sine));
    add_circle(r, 1, vec3_scale(cosine * cosine, center), vec3_scale(1 / distance, center), radius * cosine);
    return true;
}

static bool ring_light(const receiver *r, const shape *s) {
    if (vec3_dot(s->ring.normal, vec3_subtract(r->point, s->ring.center)) <= 0)
        return true;
    vec3 center = to_local(r, vec3_subtract(s->ring.center, r->point)), normal = to_local(r, s->ring.normal);
    add_circle(r, 1, center, normal, s->ring.r1);
    if (s->ring.r0 > 0)
        add_circle(r, -1, center, normal, s->ring.r0);
    return true;
}

static bool source_light(const receiver *r, const scene_light *light) {
    vec3 axis = to_local(r, light->center);
    add_circle(r, 1, vec3_scale(cos(light->half_angle), axis), axis, sin(light->half_angle));
    return true;
}

/* A panel on a matte surface: what there is most of. */
static inline bool is_plain_panel(const shape *s, bool lobe) {
    return s && s->kind == SHAPE_POLYGON && s->polygon.vertex_count == 4 && !lobe;
}

bool unshadowed_light_at(const graze_scene *scene, const graze_surface *s, vec3 point, int index, bool glossy,
                         unshadowed_light *result) {
    *result = (unshadowed_light){0, 0};
    const scene_light *light = &scene->lights[index];
    bool lobe = glossy && s->specular_lobe == GRAZE_LOBE_GLOSSY;
    if (light->spot || light->modifiers || s->fresnel || (lobe && s->lobe.model != GRAZE_BRDF_GMD))
        return false;
    if (is_plain_panel(light->shape, lobe)) {
        if (vec3_dot(light->shape->polygon.normal, point) > light->shape->polygon.offset)
            result->diffuse = graze_diffuse_quadrangle(point, s->n, light->shape->polygon.vertices);
        return true;
    }
    receiver r = {{s->x, s->y, s->n}, point, s->local_view, lobe ? &s->lobe : NULL, result};
    if (!light->shape)
        return (light->alone || !light->glow) && light->half_angle < PI / 2 && source_light(&r, light);
    switch (light->shape->kind) {
    case SHAPE_POLYGON:
        return polygon_light(&r, light->shape);
    case SHAPE_SPHERE:
        return sphere_light(&r, light->shape);
    case SHAPE_RING:
        return ring_light(&r, light->shape);
    case SHAPE_CONE:
        break;
    }
    return false;
}
