/* Light from emitters that reflections lead to, by Radiance's rules of what counts. */
#include "trace/emission.h"

#include "base/angle.h"
#include "scene/surface.h"
#include "trace/appearance.h"
#include "trace/known_light.h"
#include "trace/mirrored_light.h"

/* The weight of an emitter found by a sampled reflection, against the same found by sampling lights. */
static double found_weight(const path *p, const path_hit *hit, light_role role) {
    const scattering *last = &p->last;
    if (last->refracted || hit->light >= (int)p->context->scene->light_count)
        return 1;
    bool rival = role == LIGHT_DIRECT ? context_samples_lights(p->context->settings)
                                      : context_samples_glows(p->context->settings);
    if (role == LIGHT_DIRECT && hit->passed)
        return 0;
    if (!rival)
        return 1;
    if (last->mirror >= 0)
        return mirrored_light_weight(p, hit);
    if (p->context->settings->strategy == GRAZE_STRATEGY_LIGHT)
        return 0;
    double other = light_expectation(last->lights, hit->light);
    if (other > 0)
        other *= light_density(p->context->scene, last->lights->receiver.point, hit->light, hit->direction, hit->point,
                               hit->normal);
    if (last->lights->windows.count > 0 && scene_light_is_sky(&p->context->scene->lights[hit->light]))
        other = hypot(other, window_density(&last->lights->windows, hit->direction));
    return power_heuristic(last->density, other);
}

static rgb patterned(const path *p, const path_hit *hit, rgb radiance) {
    const scene_light *light = &p->context->scene->lights[hit->light];
    if (light->only_seen)
        return rgb_is_black(radiance) ? radiance : appearance_emission(p->context->scene, hit, p->length, radiance);
    return light_patterned(light, radiance, hit->point, hit->direction, hit->normal, hit->distance, p->length);
}

/* The light of a hit. The cone of a spotlight in a copy goes with this: the light is then put into *turned. */
static const scene_light *light_of(const path *p, const path_hit *hit, scene_light *turned) {
    const graze_scene *scene = p->context->scene;
    const scene_light *light = &scene->lights[hit->light];
    rad_transform t;
    if (!light->only_seen || !light->spot || !scene_material_is_moved(scene, hit->surface, &t))
        return light;
    *turned = *light;
    turned->spot_axis = rad_transform_direction(&t, light->spot_axis);
    turned->spot_focus *= t.scale;
    return turned;
}

rgb emission_radiance(const path *p, const path_hit *hit, bool lights) {
    scene_light turned;
    const scene_light *light = light_of(p, hit, &turned);
    double distance = hit->distance + p->last.travelled;
    return patterned(p, hit,
                     lights ? light_radiance_at(light, hit->direction, hit->normal, distance)
                            : light_radiance(light, hit->direction, hit->normal));
}

/* An illum stands for all that is behind it, glows and other illums: but not for lights, which shine through it. It
 * does so for surfaces that it lights; to the eye, straight on or in mirrors, it is another material. */
static bool is_seen_through(const path *p, const scene_light *light) {
    if (light->secondary && !p->scattered)
        return true;
    return p->last.veiled && (light->secondary || light->glow);
}

void emission_pass_secondary(path *p, const path_hit *hit) {
    if (hit->light < 0 || hit->behind || !p->scattered || !p->context->scene->lights[hit->light].secondary)
        return;
    p->throughput = p->last.indirect = rgb_gray(0);
    p->last.veiled = true;
}

/* A light that is seen in less than this part of all directions, each counted by its cosine, is small. */
#define SMALL 0.005

static bool is_small(const scene_light *light, double distance) {
    if (!light->shape)
        return sin(light->half_angle / 2) * sin(light->half_angle / 2) * 4 < SMALL;
    return shape_area(light->shape) < SMALL * PI * distance * distance;
}

/* By wanted_light. */
static bool is_wanted(const path *p, const scene_light *light, double distance) {
    const scattering *last = &p->last;
    if (p->wanted == WANTED_BENT && last->first)
        return true;
    bool bent = last->refracted && ((p->gathering && last->first) || is_small(light, distance));
    return bent == (p->wanted == WANTED_BENT);
}

rgb emission_found_of(const path *p, const path_hit *hit) {
    scene_light turned;
    const scene_light *light = light_of(p, hit, &turned);
    light_role role = light_role_at(light, hit->distance + p->last.travelled);
    rgb radiance = light_radiance(light, hit->direction, hit->normal), throughput = p->throughput;
    if (rgb_is_black(radiance) || (role == LIGHT_NONE && p->scattered) || is_seen_through(p, light))
        return rgb_gray(0);
    if (p->wanted != WANTED_ALL && !is_wanted(p, light, hit->distance + p->last.travelled))
        return rgb_gray(0);
    if (lobe_scatters(p->last.lobe)) {
        if (known_light_is_settled(p, hit->light))
            return rgb_gray(0);
        if (role == LIGHT_AMBIENT && !p->last.ambient)
            return rgb_gray(0);
        throughput = role == LIGHT_DIRECT ? p->last.direct : p->last.indirect;
        throughput = rgb_scale(found_weight(p, hit, role), throughput);
        radiance = light_radiance_at(light, hit->direction, hit->normal, hit->distance);
    } else if (role != LIGHT_AMBIENT && !p->context->settings->lights_visible) {
        return rgb_gray(0);
    }
    return rgb_multiply(throughput, patterned(p, hit, radiance));
}

rgb emission_found(const path *p, const path_hit *hit) {
    const graze_scene *scene = p->context->scene;
    rgb found = emission_found_of(p, hit);
    if (!scene->suns_overlap || hit->surface >= 0 || !lobe_scatters(p->last.lobe))
        return found;
    for (size_t i = (size_t)hit->light + 1; i < scene->first_copied && !scene->lights[i].glow; i++)
        if (light_source_shines_from(scene, (int)i, hit->direction)) {
            path_hit other = *hit;
            other.light = (int)i;
            found = rgb_add(found, emission_found_of(p, &other));
        }
    return found;
}
