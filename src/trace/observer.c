/* Rays as an observer is told of them. */
#include "trace/observer.h"

#include "trace/emission.h"

static void tell(const path *p, const path_event *event) {
    p->context->observer->tell(p->context->observer->user, event);
}

void observe_ray_told(const path *p, vec3 origin, const path_hit *hit, rgb contribution) {
    path_event event = {.kind = PATH_RAY,
                        .depth = p->depth + p->passages,
                        .mirrored = p->last.lobe == GRAZE_LOBE_MIRROR && p->last.travelled == 0,
                        .origin = origin,
                        .hit = *hit,
                        .coefficient = p->throughput,
                        .contribution = contribution};
    if (hit->light >= 0) {
        event.radiance = emission_radiance(p, hit, !event.mirrored);
        event.coefficient = rgb_share(contribution, event.radiance);
    }
    tell(p, &event);
}

void observe_shadow_ray_told(const path *p, vec3 origin, const light_sample *sample, rgb contribution) {
    const scene_light *light = &p->context->scene->lights[sample->light];
    path_event event = {.kind = PATH_SHADOW,
                        .depth = p->depth + p->passages + 1,
                        .origin = origin,
                        .radiance = sample->radiance,
                        .coefficient = rgb_share(contribution, sample->radiance),
                        .contribution = contribution};
    event.hit = (path_hit){.surface = light->surface,
                           .light = sample->light,
                           .distance = sample->distance,
                           .point = origin,
                           .direction = sample->direction};
    if (light->shape) {
        event.hit.point = vec3_add_scaled(origin, sample->distance, sample->direction);
        event.hit.normal = shape_normal(light->shape, event.hit.point);
    }
    tell(p, &event);
}

void observe_surface_told(const path *p, rgb contribution) {
    tell(p, &(path_event){.kind = PATH_SURFACE, .contribution = contribution});
}
