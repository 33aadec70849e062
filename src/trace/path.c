/* Path tracing with next-event estimation.
 *
 * At each surface point, light arrives in two ways: from lights that are sampled (Eq. 18), and from wherever a sampled
 * reflection leads (Eq. 16). What both can find is weighted by the power heuristic. Radiance's rules of what counts are
 * kept: `light`s light everything; `glow`s light diffusely only where an ambient bounce is left; a diffuse reflection
 * costs an ambient bounce. */
#include "trace/path.h"

#include "base/angle.h"
#include "trace/direct_light.h"
#include "trace/emission.h"
#include "trace/irradiance_cache.h"
#include "trace/known_light.h"
#include "trace/lobes.h"
#include "trace/vertex.h"

/* Whether what the path comes to by a diffuse reflection is told by the cache. What the surface reflects specularly is
 * left of the vertex. True: nothing is. */
static bool ends_in_cache(path *p, const path_hit *hit, vertex *v) {
    const path_context *context = p->context;
    if ((!context->cache && !context->record) || p->last.lobe != GRAZE_LOBE_DIFFUSE || p->ambient_depth != 1 ||
        !path_bounces_left(p) || v->gloss_is_ambient || v->shading.fresnel)
        return false;
    irradiance_record record = {v->point, v->shading.n, v->surface, hit->distance};
    rgb irradiance[2];
    if (context->record) {
        *context->record = record;
        return true;
    }
    if (!irradiance_cache_find(context->cache, &record, irradiance))
        return false;
    rgb reflected = rgb_scale(0.5 / PI, rgb_multiply(p->throughput, v->shading.diffuse));
    p->radiance = rgb_add(p->radiance, rgb_multiply(reflected, rgb_add(irradiance[0], irradiance[1])));
    p->spread = rgb_add(p->spread, rgb_multiply(reflected, rgb_add_scaled(irradiance[0], -1, irradiance[1])));
    v->shading.diffuse = v->ambient = rgb_gray(0);
    return v->shading.specular_lobe == GRAZE_LOBE_NONE;
}

/* Gathers light at a vertex and goes on from there until the path ends. */
static void follow(path *p, vertex v) {
    const path_context *context = p->context;
    for (;;) {
        if (!path_bounces_left(p))
            p->radiance = rgb_add(
                p->radiance, rgb_multiply(p->throughput, rgb_multiply(v.ambient, context->settings->ambient_value)));
        lobe_choice choice = lobes_choose(p, &v);
        light_receiver receiver = direct_light_receiver(p, &v);
        p->known.lights = 0;
        if (receiver.candidates > 0 && !context->record) {
            known_light_add(p, &v, &receiver);
            direct_light_add(p, &v, &receiver, choice);
        }
        vec3 direction;
        if (!lobes_reflect(p, &v, &receiver, choice, &direction))
            return;
        path_hit hit = path_cast(context, v.point, direction, GEOMETRY_FAR, v.surface);
        rgb found = hit.light >= 0 ? emission_found(p, &hit) : rgb_gray(0);
        p->radiance = rgb_add(p->radiance, found);
        if (p->known.lights)
            known_light_subtract_reflected(p, &v, &hit, found);
        if (!vertex_at_hit(p, &hit, &v) || ends_in_cache(p, &hit, &v))
            return;
    }
}

static path path_start(const path_context *context, sampler *points) {
    return (path){.context = context, .sampler = points, .throughput = {1, 1, 1}};
}

static path_sample path_end(const path *p, uint32_t first_group) {
    path_sample sample = {.radiance = p->radiance,
                          .spread = p->spread,
                          .control_count = p->control_count,
                          .noisy = p->sampler->group != first_group,
                          .searching = p->searching};
    for (int i = 0; i < p->control_count; i++)
        sample.controls[i] = p->controls[i];
    return sample;
}

path_sample path_radiance(const path_context *context, const path_hit *first, sampler *points) {
    path p = path_start(context, points);
    uint32_t first_group = points->group;
    vertex v;
    if (first->light >= 0)
        p.radiance = emission_found(&p, first);
    if (vertex_at_hit(&p, first, &v))
        follow(&p, v);
    return path_end(&p, first_group);
}

path_sample path_irradiance(const path_context *context, vec3 point, vec3 normal, sampler *points) {
    path p = path_start(context, points);
    uint32_t first_group = points->group;
    follow(&p, vertex_of_sensor(point, normal));
    return path_end(&p, first_group);
}

path_sample path_irradiance_at(const path_context *context, const irradiance_record *record, sampler *points) {
    path p = path_start(context, points);
    uint32_t first_group = points->group;
    p.ambient_depth = 1;
    p.depth = 0;
    follow(&p, vertex_of_point(record->point, record->normal, record->surface));
    return path_end(&p, first_group);
}
