/* Sampling lights, weighted by the power heuristic against finding them by reflection. */
#include "trace/direct_light.h"

#include "base/angle.h"
#include "trace/known_light.h"
#include "trace/observer.h"

/* Up to so many lights are all sampled, at the first point and at later ones; of more, one is chosen. */
#define EVERY_LIGHT_FIRST PATH_FIRST_CONTROLS
#define EVERY_LIGHT_LATER 2

light_receiver direct_light_receiver(const path *p, const vertex *v) {
    const path_context *context = p->context;
    light_receiver receiver = {.point = v->point, .normal = v->shading.n};
    bool glossy = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY;
    receiver.ambient =
        context_samples_glows(context->settings) && (path_bounces_left(p) || (glossy && !v->gloss_is_ambient));
    receiver.every = context->scene->light_count <= (p->depth == 0 ? EVERY_LIGHT_FIRST : EVERY_LIGHT_LATER);
    if (context_samples_lights(context->settings) && (glossy || !rgb_is_black(v->ambient)))
        light_receiver_prepare(context->scene, &receiver);
    return receiver;
}

/* Whether nothing stands between a vertex and a light's sampled point. */
static bool light_is_visible(const path *p, const vertex *v, const light_sample *sample) {
    const graze_scene *scene = p->context->scene;
    geometry_ray ray = {
        .origin = v->point, .direction = sample->direction, .far = sample->distance, .from = v->surface};
    return !geometry_occluded(scene->geometry, &ray, scene->lights[sample->light].surface);
}

/* The reflectance functions for a light sample, by the rules for its role, weighted against finding the light by
 * reflection. */
static rgb reflectance_for_light(const path *p, const vertex *v, const light_sample *sample, double density,
                                 lobe_choice choice) {
    const path_context *context = p->context;
    light_role role = light_role_at(&context->scene->lights[sample->light], sample->distance);
    bool ambient = role == LIGHT_AMBIENT;
    rgb diffuse, glossy;
    if (role == LIGHT_NONE || (ambient && !context_samples_glows(context->settings)))
        return rgb_gray(0);
    graze_surface_value(&v->shading, sample->direction, &diffuse, &glossy);
    if (ambient)
        diffuse = path_bounces_left(p) ? rgb_scale(1 / PI, v->ambient) : rgb_gray(0);
    if (ambient && v->gloss_is_ambient)
        glossy = rgb_gray(0);
    if (context->settings->strategy == GRAZE_STRATEGY_LIGHT)
        return rgb_add(diffuse, glossy);
    if (choice.diffuse > 0) {
        double rival = choice.diffuse * graze_surface_density(&v->shading, GRAZE_LOBE_DIFFUSE, sample->direction);
        diffuse = rgb_scale(power_heuristic(density, rival), diffuse);
    }
    if (choice.specular > 0 && v->shading.specular_lobe == GRAZE_LOBE_GLOSSY) {
        double rival = choice.specular * graze_surface_density(&v->shading, GRAZE_LOBE_GLOSSY, sample->direction);
        glossy = rgb_scale(power_heuristic(density, rival), glossy);
    }
    return rgb_add(diffuse, glossy);
}

/* Direct light, Eq. 18, from a sample of one light that was chosen with the probability. */
static void add_sampled_light(path *p, const vertex *v, const light_receiver *receiver, int light, double probability,
                              const double random[2], lobe_choice choice) {
    light_sample sample = light_draw(p->context->scene, receiver, light, random);
    if (sample.light < 0 || rgb_is_black(sample.radiance))
        return;
    double cosine = vec3_dot(sample.direction, v->shading.n), density = probability * sample.density;
    if (cosine <= 0)
        return;
    rgb reflected = rgb_multiply(reflectance_for_light(p, v, &sample, density, choice), sample.radiance);
    if (rgb_is_black(reflected))
        return;
    bool lit = light_is_visible(p, v, &sample);
    rgb found = rgb_scale(cosine / density, rgb_multiply(p->throughput, reflected));
    if (lit) {
        p->radiance = rgb_add(p->radiance, found);
        observe_shadow_ray(p, v->point, &sample, found);
    }
    if (known_light_is(p, light))
        known_light_subtract(p, light, found, lit);
}

void direct_light_add(path *p, const vertex *v, const light_receiver *receiver, lobe_choice choice) {
    const graze_scene *scene = p->context->scene;
    double random[3], probability = 0;
    if (!receiver->every) {
        sampler_3d(p->sampler, random);
        int light = light_choose(scene, receiver, random[0], &probability);
        add_sampled_light(p, v, receiver, light, probability, random + 1, choice);
        return;
    }
    for (int light = 0; light < (int)scene->light_count; light++)
        if (!known_light_is_settled(p, light) && light_probability(scene, receiver, light) > 0) {
            sampler_2d(p->sampler, random);
            add_sampled_light(p, v, receiver, light, 1, random, choice);
        }
}
