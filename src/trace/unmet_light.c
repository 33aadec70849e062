/* What lights might give at vertices that are seen through panes and in mirrors, and whether any of it has been met. */
#include "trace/unmet_light.h"

#include "base/angle.h"
#include "trace/context.h"
#include "trace/known_light.h"
#include "trace/vertex.h"

/* Of many lights, so many stand for all. */
#define CHOSEN 4

/* How much a lobe may reflect of a light's radiance. One that is narrower than the light may show it wholly, which is
 * found by following the lobe, if that happens, or by the light samples that lie in it: the more seldom, the more may
 * be missing. Else each light sample finds what is reflected towards it. */
static rgb gloss_share(const gathering *here, const light_sample *sample, rgb value, double facing) {
    const graze_surface *s = &here->vertex.shading;
    double share = 4 * PI * s->lobe.alpha_x * s->lobe.alpha_y * sample->density;
    return share < 1 ? rgb_scale(1 / fmax(here->lobes.specular, share), s->specular) : rgb_scale(facing, value);
}

/* The brightness that a light, taken so many times, would add if nothing hid it, as its middle shows it. */
static double from_light(const path *p, const gathering *here, int index, double times) {
    const graze_scene *scene = p->context->scene;
    const vertex *v = &here->vertex;
    const light_sample sample = light_draw_middle(scene, v->point, p->length, index);
    light_role role = sample.light < 0 ? LIGHT_NONE : light_role_at(&scene->lights[index], sample.distance);
    bool ambient = role == LIGHT_AMBIENT;
    if (role == LIGHT_NONE || (ambient && !context_samples_glows(p->context->settings)))
        return 0;
    double facing = fmin(fmax(vec3_dot(sample.direction, v->shading.n), 0) / sample.density, PI);
    rgb diffuse, gloss;
    graze_surface_value(&v->shading, sample.direction, &diffuse, &gloss);
    if (ambient)
        diffuse = path_bounces_left(p) ? rgb_scale(1 / PI, v->ambient) : rgb_gray(0);
    rgb reflected = rgb_scale(facing, diffuse);
    if (v->shading.specular_lobe == GRAZE_LOBE_GLOSSY && !(ambient && v->gloss_is_ambient))
        reflected = rgb_add(reflected, gloss_share(here, &sample, gloss, facing));
    return times * rgb_brightness(rgb_multiply(p->throughput, rgb_multiply(reflected, sample.radiance)));
}

static double from_lights(const path *p, const gathering *here) {
    const light_choice *lights = &here->lights;
    double sum = 0;
    if (light_choice_is_every_one(lights)) {
        for (int i = 0; i < lights->every; i++)
            if (!known_light_is_settled(p, i) && light_expectation(lights, i) > 0)
                sum += from_light(p, here, i, 1);
        return sum;
    }
    for (int i = 0; i < CHOSEN; i++) {
        double chance;
        int index = light_choose(lights, (i + 0.5) / CHOSEN, &chance);
        if (index >= 0)
            sum += from_light(p, here, index, lights->receiver.draws / (CHOSEN * chance));
    }
    return sum;
}

path_unmet_at *unmet_light_at(const path *p, int surface, int light) {
    path_unmet *unmet = &p->context->memory->unmet;
    for (int i = 0; i < unmet->count; i++) {
        path_unmet_at *at = &unmet->at[i];
        if (at->depth == p->depth && at->passages == p->passages && at->surface == surface && at->light == light)
            return at;
    }
    if (unmet->count == PATH_UNMET || (surface >= 0 && unmet->count >= PATH_UNMET / 2))
        return NULL;
    unmet->at[unmet->count] = (path_unmet_at){p->depth, p->passages, surface, light, false, UNMET_LIGHT_NEW};
    return &unmet->at[unmet->count++];
}

void unmet_light_expect(path *p, const gathering *here) {
    path_unmet_at *at = unmet_light_at(p, -1, -1);
    if (!at)
        return;
    if (at->expected == UNMET_LIGHT_NEW)
        at->expected = from_lights(p, here);
    p->unmet = at;
    p->before = p->radiance;
}

void unmet_light_settle(path *p) {
    const rgb found = rgb_add_scaled(p->scattered ? p->direct : p->radiance, -1, p->before);
    p->unmet->met = p->unmet->met || rgb_max(found) > 0;
    p->unmet = NULL;
}

double unmet_light_of(const path_unmet *unmet, double taken) {
    double sum = 0;
    for (int i = 0; i < unmet->count; i++)
        sum += unmet->at[i].met ? 0 : unmet->at[i].expected;
    return sum / taken;
}
