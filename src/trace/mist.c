/* Single scattering towards the eye of lights that a mist names; what is scattered more often is told by the ambient
 * value, and by shadow rays that lose nothing but what is absorbed. */
#include "trace/mist.h"

#include "base/angle.h"
#include "scene/mist.h"
#include "trace/panes.h"

/* Beyond, nothing is scattered: the way has no end. */
#define ENDLESS (0.99 * GEOMETRY_FAR)

static mist_medium everywhere(const path_context *context) {
    const graze_trace_settings *s = context->settings;
    return (mist_medium){s->mist_extinction, s->mist_albedo, s->mist_eccentricity};
}

static rgb left_of(rgb extinction, double length) {
    return (rgb){exp(-extinction.r * length), exp(-extinction.g * length), exp(-extinction.b * length)};
}

/* Per unit of length. */
static rgb absorbed_by(const mist_medium *m) {
    return (rgb){m->extinction.r * (1 - m->albedo.r), m->extinction.g * (1 - m->albedo.g),
                 m->extinction.b * (1 - m->albedo.b)};
}

rgb mist_transmittance(const path_context *context, vec3 origin, vec3 direction, double distance, bool direct) {
    const mist_medium all = everywhere(context);
    mist_walk walk;
    mist_span span;
    rgb left = {1, 1, 1};
    mist_walk_begin(&walk, context->scene, &all, origin, direction, distance);
    while (mist_walk_next(&walk, &span))
        left = rgb_multiply(
            left, left_of(direct ? absorbed_by(&span.medium) : span.medium.extinction, span.end - span.start));
    return left;
}

/* Henyey and Greenstein's phase function, for the cosine of the angle by which the light is turned. */
static double phase(double eccentricity, double cosine) {
    if (!(eccentricity > 0))
        return 1 / (4 * PI);
    double square = 1 + eccentricity * eccentricity - 2 * eccentricity * cosine;
    return (1 - eccentricity * eccentricity) / (4 * PI * square * sqrt(square));
}

/* A point of a way, and how densely such points are drawn. */
typedef struct way_point {
    double at, density;
} way_point;

/* Points at equal angles as a lamp sees them. */
static way_point draw_by_angle(vec3 origin, vec3 direction, const mist_span *span, const shape *lamp, double random) {
    vec3 lower, upper;
    shape_bounds(lamp, &lower, &upper);
    vec3 to_lamp = vec3_subtract(vec3_scale(0.5, vec3_add(lower, upper)), origin);
    double nearest = vec3_dot(to_lamp, direction), length = span->end - span->start;
    double apart = vec3_length(vec3_add_scaled(to_lamp, -nearest, direction));
    apart = fmax(apart, fmax(1e-3 * length, 0.1 * vec3_length(vec3_subtract(upper, lower))));
    double first = atan((span->start - nearest) / apart), last = atan((span->end - nearest) / apart);
    double along = apart * tan(first + random * (last - first));
    double at = fmin(fmax(nearest + along, span->start), span->end);
    along = at - nearest;
    return (way_point){at, apart / ((last - first) * (apart * apart + along * along))};
}

/* Points as what comes from there is thinned out. */
static way_point draw_by_depth(const mist_span *span, double random) {
    double length = span->end - span->start, thin = rgb_min(span->medium.extinction);
    if (thin * length < 1e-6)
        return (way_point){span->start + random * length, 1 / length};
    double all = -expm1(-thin * length), deep = -log1p(-random * all) / thin;
    return (way_point){span->start + fmin(deep, length), thin * exp(-thin * deep) / all};
}

/* What a light adds that is scattered once in the span, seen from its start. */
static rgb scattered_of(const path *p, vec3 origin, vec3 direction, const mist_span *span, int index) {
    const path_context *context = p->context;
    const scene_light *light = &context->scene->lights[index];
    double random[3];
    sampler_3d(p->sampler, random);
    way_point at =
        light->shape ? draw_by_angle(origin, direction, span, light->shape, random[0]) : draw_by_depth(span, random[0]);
    vec3 point = vec3_add_scaled(origin, at.at, direction);
    light_sample sample = light_draw(context->scene, point, p->length + at.at, index, random + 1);
    if (sample.light < 0 || rgb_is_black(sample.radiance) || !(at.density > 0) ||
        light_role_at(light, sample.distance) != LIGHT_DIRECT)
        return rgb_gray(0);
    const geometry_ray ray = {.origin = point, .direction = sample.direction, .far = sample.distance, .from = -1};
    rgb arrived =
        panes_transmittance(context, &ray, p->length + at.at, light->surface, light_is_proper(context->scene, index));
    if (rgb_is_black(arrived))
        return rgb_gray(0);
    arrived = rgb_multiply(arrived, mist_transmittance(context, point, sample.direction, sample.distance, true));
    arrived =
        rgb_multiply(arrived, rgb_multiply(sample.radiance, left_of(span->medium.extinction, at.at - span->start)));
    rgb scatters = rgb_multiply(span->medium.extinction, span->medium.albedo);
    double turned = phase(span->medium.eccentricity, vec3_dot(direction, sample.direction));
    return rgb_scale(turned / (at.density * sample.density), rgb_multiply(scatters, arrived));
}

/* Whether one of the span's mists before the one of this number names the light, too. */
static bool is_named_before(const scene_mist *mist, const mist_span *span, int number, int light) {
    for (int i = 0; i < number; i++)
        for (int k = 0; (span->mists & (UINT32_C(1) << i)) && k < mist->of[i].light_count; k++)
            if (mist->of[i].lights[k] == light)
                return true;
    return false;
}

/* All that mists of the span scatter; a light that several of them name, once. */
static rgb scattered_in(const path *p, vec3 origin, vec3 direction, const mist_span *span) {
    const scene_mist *mist = p->context->scene->mist;
    rgb sum = {0, 0, 0};
    if (!mist || span->end >= ENDLESS || rgb_is_black(rgb_multiply(span->medium.extinction, span->medium.albedo)))
        return sum;
    for (int i = 0; i < mist->count; i++) {
        const mist_material *m = &mist->of[i];
        for (int k = 0; (span->mists & (UINT32_C(1) << i)) && k < m->light_count; k++)
            if (!is_named_before(mist, span, i, m->lights[k]))
                sum = rgb_add(sum, scattered_of(p, origin, direction, span, m->lights[k]));
    }
    return sum;
}

void mist_follow(path *p, vec3 origin, vec3 direction, double distance) {
    const mist_medium all = everywhere(p->context);
    mist_walk walk;
    mist_span span;
    rgb whole = {1, 1, 1}, unabsorbed = {1, 1, 1};
    mist_walk_begin(&walk, p->context->scene, &all, origin, direction, distance);
    while (mist_walk_next(&walk, &span)) {
        const mist_medium *m = &span.medium;
        if (rgb_is_black(m->extinction))
            continue;
        double length = span.end - span.start;
        rgb left = left_of(m->extinction, length), carried = rgb_multiply(p->throughput, whole);
        if (!rgb_is_black(carried)) {
            rgb ambient = rgb_multiply(m->albedo, p->context->settings->ambient_value);
            rgb found = rgb_multiply(ambient, rgb_add_scaled(rgb_gray(1), -1, left));
            found = rgb_add(found, scattered_in(p, origin, direction, &span));
            p->radiance = rgb_add(p->radiance, rgb_multiply(carried, found));
        }
        whole = rgb_multiply(whole, left);
        unabsorbed = rgb_multiply(unabsorbed, left_of(absorbed_by(m), length));
    }
    p->throughput = rgb_multiply(p->throughput, whole);
    if (p->last.lobe == GRAZE_LOBE_NONE)
        return;
    p->last.direct = rgb_multiply(p->last.direct, unabsorbed);
    p->last.indirect = rgb_multiply(p->last.indirect, whole);
}
