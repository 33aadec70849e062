/* Centroids, extents, areas and directions of lights, and of groups of them. */
#include "scene/light_summary.h"

#include "base/angle.h"

static double length_squared(vec3 a) {
    return vec3_dot(a, a);
}

/* The centroid, and the mean square of the distance from it. */
static void polygon_moments(const shape *s, vec3 *centroid, double *spread) {
    vec3 sum = {0, 0, 0};
    double weight = 0, squares = 0;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t t = 0; t < s->polygon.triangle_count; t++) {
            const uint32_t *corner = s->polygon.triangles[t];
            vec3 origin = pass == 0 ? s->polygon.center : *centroid;
            vec3 a = vec3_subtract(s->polygon.vertices[corner[0]], origin),
                 b = vec3_subtract(s->polygon.vertices[corner[1]], origin),
                 c = vec3_subtract(s->polygon.vertices[corner[2]], origin), all = vec3_add(a, vec3_add(b, c));
            double area = vec3_length(vec3_cross(vec3_subtract(b, a), vec3_subtract(c, a)));
            if (pass == 0) {
                sum = vec3_add_scaled(sum, area / 3, all);
                weight += area;
                *centroid = vec3_add(s->polygon.center, vec3_scale(weight > 0 ? 1 / weight : 0, sum));
            } else {
                squares +=
                    area * (length_squared(a) + length_squared(b) + length_squared(c) + length_squared(all)) / 12;
            }
        }
    *spread = weight > 0 ? squares / weight : 0;
}

static void summarize_polygon(light_summary *m, const shape *s) {
    polygon_moments(s, &m->middle, &m->spread);
    m->axis = s->polygon.normal;
    m->area = s->polygon.area;
    for (uint32_t i = 0; i < s->polygon.vertex_count; i++)
        m->radius = fmax(m->radius, vec3_length(vec3_subtract(s->polygon.vertices[i], m->middle)));
}

static void summarize_ring(light_summary *m, const shape *s) {
    m->middle = s->ring.center;
    m->axis = s->ring.normal;
    m->radius = s->ring.r1;
    m->spread = (s->ring.r0 * s->ring.r0 + s->ring.r1 * s->ring.r1) / 2;
    m->area = shape_area(s);
}

static void summarize_sphere(light_summary *m, const shape *s) {
    m->middle = s->sphere.center;
    m->radius = s->sphere.radius;
    m->spread = m->radius * m->radius / 2;
    m->area = PI * m->radius * m->radius;
}

static void summarize_cone(light_summary *m, const shape *s) {
    vec3 lower, upper;
    shape_bounds(s, &lower, &upper);
    m->middle = vec3_scale(0.5, vec3_add(lower, upper));
    m->radius = vec3_length(vec3_subtract(upper, lower)) / 2;
    double most = fmax(s->cone.r0, s->cone.r1);
    m->spread = s->cone.length * s->cone.length / 12 + most * most / 2;
    m->area = shape_area(s) / PI;
}

static void scale_lengths(light_summary *m, const light_tree *t) {
    double per_unit = t->per_unit;
    m->middle = vec3_scale(per_unit, vec3_subtract(m->middle, t->middle));
    m->radius *= per_unit;
    m->spread *= per_unit * per_unit;
    m->area *= per_unit * per_unit;
}

/* At LIGHT_FAR. The radius makes the part above the horizon of half the sky, and of all of it, about right. */
static void summarize_source(light_summary *m, const scene_light *light) {
    double half_sine = sin(light->half_angle / 2);
    m->middle = vec3_scale(LIGHT_FAR, light->center);
    m->radius = LIGHT_FAR * 2 * half_sine;
    m->spread = m->radius * m->radius / 2;
    m->area = LIGHT_FAR * LIGHT_FAR * 4 * PI * half_sine * half_sine;
}

light_summary light_summarize(const light_tree *t, const scene_light *light) {
    light_summary m = {.cosine = 1};
    if (!light->shape) {
        summarize_source(&m, light);
    } else {
        switch (light->shape->kind) {
        case SHAPE_POLYGON:
            summarize_polygon(&m, light->shape);
            break;
        case SHAPE_RING:
            summarize_ring(&m, light->shape);
            break;
        case SHAPE_SPHERE:
            summarize_sphere(&m, light->shape);
            break;
        case SHAPE_CONE:
            summarize_cone(&m, light->shape);
            break;
        }
        scale_lengths(&m, t);
    }
    if (vec3_max_abs(m.axis) == 0)
        m.cosine = -1;
    m.core = m.area / PI;
    if (!light_is_ambient(light))
        m.radiance = light->typical;
    if (light->glow)
        m.ambient = light->typical;
    return m;
}

static double share_of(const light_summary *m) {
    return m->area * fmax(rgb_brightness(m->radiance), rgb_brightness(m->ambient));
}

/* The smallest cosine of the angle between the axis and a normal of the lights. */
static double least_cosine(const light_summary *summaries, const light_place *places, size_t count, vec3 axis) {
    double least = 1;
    for (size_t i = 0; i < count; i++) {
        const light_summary *m = &summaries[places[i].light];
        least = fmin(least, m->cosine < 0 ? -1 : vec3_dot(m->axis, axis));
    }
    return fmax(least - 1e-6, -1);
}

light_summary light_summarize_all(const light_summary *summaries, const light_place *places, size_t count) {
    light_summary all = {.cosine = 1};
    double shares = 0;
    for (size_t i = 0; i < count; i++) {
        const light_summary *m = &summaries[places[i].light];
        double share = share_of(m);
        shares += share;
        all.middle = vec3_add_scaled(all.middle, share, m->middle);
        all.axis = vec3_add_scaled(all.axis, share, m->axis);
        all.area += m->area;
        all.radiance = rgb_add_scaled(all.radiance, m->area, m->radiance);
        all.ambient = rgb_add_scaled(all.ambient, m->area, m->ambient);
    }
    all.middle = shares > 0 ? vec3_scale(1 / shares, all.middle) : summaries[places[0].light].middle;
    all.radiance = rgb_scale(all.area > 0 ? 1 / all.area : 0, all.radiance);
    all.ambient = rgb_scale(all.area > 0 ? 1 / all.area : 0, all.ambient);
    all.axis = vec3_safe_normalize(all.axis);
    all.cosine = least_cosine(summaries, places, count, all.axis);
    for (size_t i = 0; i < count; i++) {
        const light_summary *m = &summaries[places[i].light];
        vec3 apart = vec3_subtract(m->middle, all.middle);
        all.radius = fmax(all.radius, vec3_length(apart) + m->radius);
        if (shares > 0)
            all.spread += share_of(m) / shares * (m->spread + length_squared(apart));
    }
    all.core = 2 * all.spread;
    return all;
}
