/* Sampling lights, weighted by the power heuristic against finding them by reflection. */
#include "trace/direct_light.h"

#include "base/angle.h"
#include "trace/known_light.h"
#include "trace/observer.h"
#include "trace/vertex.h"

/* Few lights are all sampled at the first point, and up to so many at later ones. */
#define EVERY_LIGHT_LATER 2
/* Of more, so many are chosen. */
#define CHOSEN_FIRST 4
#define CHOSEN_LATER 2

void direct_light_prepare(const path *p, const vertex *v, light_choice *lights) {
    const path_context *context = p->context;
    bool glossy = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY;
    light_receiver receiver = {.point = v->point, .surface = &v->shading, .diffuse = v->shading.diffuse};
    if (v->function)
        receiver.diffuse = rgb_add(receiver.diffuse, v->function_color);
    if (!context_samples_lights(context->settings) ||
        (!glossy && rgb_is_black(v->ambient) && rgb_is_black(receiver.diffuse))) {
        light_choice_none(lights);
        return;
    }
    if (glossy)
        receiver.glossy = v->shading.specular;
    if (context_samples_glows(context->settings)) {
        if (path_bounces_left(p))
            receiver.ambient_diffuse = v->ambient;
        if (glossy && !v->gloss_is_ambient)
            receiver.ambient_glossy = v->shading.specular;
    }
    bool first = p->depth == 0, every = context->scene->light_count <= (first ? PATH_FEW_LIGHTS : EVERY_LIGHT_LATER);
    receiver.draws = every ? LIGHT_EVERY_ONE : first ? CHOSEN_FIRST : CHOSEN_LATER;
    light_choice_prepare(lights, context->scene, &receiver);
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
    if (v->function && !ambient)
        diffuse = rgb_add(diffuse, vertex_function_value(v, sample->direction));
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

/* Direct light, Eq. 18, from a sample of one light, which is taken `expectation` times on the average. */
static void add_sampled_light(path *p, const vertex *v, int light, double expectation, const double random[2],
                              lobe_choice choice) {
    light_sample sample = light_draw(p->context->scene, v->point, p->length, light, random);
    if (sample.light < 0 || rgb_is_black(sample.radiance))
        return;
    double cosine = vec3_dot(sample.direction, v->shading.n), density = expectation * sample.density;
    if (cosine <= 0 || (v->leans && vec3_dot(sample.direction, v->normal) <= 0))
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
    if (known_light_is_control(p, light))
        known_light_subtract(p, light, found, lit);
}

/* Where a number in [0,1) is after some steps of the given length around the circle of these numbers. Steps of 1/g and
 * 1/g^2 with g^3 = g + 1 cover the square evenly. */
static double step(double random, int steps, double length) {
    double x = random + steps * length;
    return x - floor(x);
}

static void add_every_light(path *p, const vertex *v, const light_choice *lights, lobe_choice choice) {
    double random[2];
    for (int light = 0; light < (int)p->context->scene->light_count; light++)
        if (!known_light_is_settled(p, light) && light_expectation(lights, light) > 0) {
            sampler_2d(p->sampler, random);
            add_sampled_light(p, v, light, 1, random, choice);
        }
}

void direct_light_add(path *p, const vertex *v, const light_choice *lights, lobe_choice choice) {
    double random[3];
    if (light_choice_is_every_one(lights)) {
        add_every_light(p, v, lights, choice);
        return;
    }
    sampler_3d(p->sampler, random);
    int draws = lights->receiver.draws;
    for (int i = 0; i < draws; i++) {
        double expectation, place_on_light[2] = {step(random[1], i, 0.7548776662), step(random[2], i, 0.5698402910)};
        int light = light_choose(lights, (random[0] + i) / draws, &expectation);
        if (light >= 0)
            add_sampled_light(p, v, light, expectation, place_on_light, choice);
    }
}
