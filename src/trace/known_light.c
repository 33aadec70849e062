/* Control variates from closed forms of unshadowed light. */
#include "trace/known_light.h"

#include "geometry/crossing.h"
#include "trace/emission.h"
#include "trace/unshadowed.h"

bool known_light_is(const path *p, int light) {
    return light < PATH_FIRST_CONTROLS && p->known.lights >> light & 1;
}

static path_control *control_of(path *p, int light) {
    return &p->controls[p->known.shared ? PATH_FIRST_CONTROLS : light];
}

void known_light_subtract(path *p, int light, rgb found, bool lit) {
    path_control *control = control_of(p, light);
    double brightness = rgb_brightness(found);
    control->difference = rgb_add_scaled(control->difference, -1, found);
    control->whole += brightness;
    control->lit += lit ? brightness : 0;
}

/* Whether a light shines on all points alike: its role does not depend on its distance. */
static bool has_one_role(const scene_light *light) {
    return !light->glow || light->glow_radius == 0;
}

void known_light_add(path *p, const vertex *v, const light_choice *lights) {
    const graze_scene *scene = p->context->scene;
    p->known = (known_lights){0, p->depth > 0};
    if (lights->receiver.draws > 0 || p->scattered)
        return;
    for (int i = 0; i < (int)scene->light_count; i++) {
        const scene_light *light = &scene->lights[i];
        bool ambient = light->glow, glossy = !ambient || !v->gloss_is_ambient;
        unshadowed_light whole;
        if (light_expectation(lights, i) == 0 || !has_one_role(light) ||
            !unshadowed_light_at(scene, &v->shading, v->point, i, glossy, &whole))
            continue;
        rgb diffuse = !ambient ? v->shading.diffuse : path_bounces_left(p) ? v->ambient : rgb_gray(0);
        rgb reflectance = rgb_scale(whole.diffuse, diffuse);
        if (glossy)
            reflectance = rgb_add_scaled(reflectance, whole.glossy, v->shading.specular);
        p->known.lights |= 1u << i;
        path_control *control = control_of(p, i);
        rgb reflected = rgb_multiply(rgb_multiply(p->throughput, reflectance), light->radiance);
        control->difference = rgb_add(control->difference, reflected);
        p->control_count = p->known.shared ? PATH_CONTROLS : i + 1 > p->control_count ? i + 1 : p->control_count;
    }
}

void known_light_subtract_reflected(path *p, const vertex *from, const path_hit *hit, rgb found) {
    const graze_scene *scene = p->context->scene;
    for (int i = 0; i < (int)scene->light_count && i < PATH_FIRST_CONTROLS; i++) {
        if (!known_light_is(p, i))
            continue;
        if (hit->light == i && !hit->passed) {
            known_light_subtract(p, i, found, true);
            continue;
        }
        const scene_light *light = &scene->lights[i];
        path_hit whole = {.surface = light->surface, .light = i, .distance = GEOMETRY_FAR, .direction = hit->direction};
        if (light->shape) {
            if (!shape_front_crossing(light->shape, from->point, hit->direction, &whole.distance))
                continue;
            whole.point = vec3_add_scaled(from->point, whole.distance, hit->direction);
            whole.normal = shape_normal(light->shape, whole.point);
        } else if (light_source_towards(scene, hit->direction) != i) {
            continue;
        }
        known_light_subtract(p, i, emission_found(p, &whole), false);
    }
}
