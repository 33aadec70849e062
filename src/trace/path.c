/* Path tracing with next-event estimation.
 *
 * At each surface point, light arrives in two ways: from lights that are sampled (Eq. 18), and from wherever a sampled
 * reflection leads (Eq. 16). What both can find is weighted by the power heuristic. Radiance's rules of what counts are
 * kept: `light`s light everything; `glow`s light diffusely only where an ambient bounce is left; a diffuse reflection
 * costs an ambient bounce. */
#include "trace/path.h"

#include "trace/direct_light.h"
#include "trace/emission.h"
#include "trace/known_light.h"
#include "trace/lobes.h"
#include "trace/vertex.h"

/* Gathers light at a vertex and goes on from there until the path ends. */
static void follow(path *p, vertex v) {
    const path_context *context = p->context;
    light_choice lights;
    for (;;) {
        if (!path_bounces_left(p))
            p->radiance = rgb_add(
                p->radiance, rgb_multiply(p->throughput, rgb_multiply(v.ambient, context->settings->ambient_value)));
        lobe_choice choice = lobes_choose(p, &v);
        direct_light_prepare(p, &v, &lights);
        p->known.lights = 0;
        if (light_choice_is_possible(&lights)) {
            known_light_add(p, &v, &lights);
            direct_light_add(p, &v, &lights, choice);
        }
        vec3 direction;
        if (!lobes_reflect(p, &v, &lights, choice, &direction))
            return;
        path_hit hit = path_cast(context, v.point, direction, GEOMETRY_FAR, v.surface);
        rgb found = hit.light >= 0 ? emission_found(p, &hit) : rgb_gray(0);
        p->radiance = rgb_add(p->radiance, found);
        if (p->known.lights)
            known_light_subtract_reflected(p, &v, &hit, found);
        if (!vertex_at_hit(p, &hit, &v))
            return;
    }
}

static path path_start(const path_context *context, sampler *points) {
    return (path){.context = context, .sampler = points, .throughput = {1, 1, 1}};
}

static path_sample path_end(const path *p, uint32_t first_group) {
    path_sample sample = {.radiance = p->radiance,
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
