/* A light in a mirror, or a pane, is where its image is: it is sampled as the light itself from the vertex's own image.
 */
#include "trace/mirrored_light.h"

#include "base/angle.h"
#include "trace/appearance.h"
#include "trace/direct_light.h"
#include "trace/mist.h"
#include "trace/observer.h"
#include "trace/panes.h"
#include "trace/unmet_light.h"
#include "trace/virtual_lights.h"

/* Light on its way by a mirror. */
typedef struct reflection {
    int surface;      /* the mirror's */
    double to_mirror; /* from the vertex */
    vec3 onward;      /* from the mirror to the light */
    rgb color;        /* what is reflected */
} reflection;

/* What is left of the light on both parts of its way. */
static rgb arriving(const path *p, const vertex *v, const reflection *r, const light_sample *sample) {
    const graze_scene *scene = p->context->scene;
    geometry_ray first = {.origin = v->point, .direction = sample->direction, .far = r->to_mirror, .from = v->surface};
    vec3 at = shape_pull(&scene->shapes[r->surface], vec3_add_scaled(v->point, r->to_mirror, sample->direction));
    double left = sample->distance < GEOMETRY_FAR ? sample->distance - r->to_mirror : GEOMETRY_FAR;
    geometry_ray second = {.origin = at, .direction = r->onward, .far = left, .from = r->surface};
    rgb before = panes_transmittance(p->context, &first, p->length, r->surface, true);
    if (!(left > 0) || rgb_is_black(before))
        return rgb_gray(0);
    if (path_is_in_body(p))
        before = rgb_multiply(before, path_medium_transmittance(p, r->to_mirror + left));
    if (p->in_mist) {
        bool direct = light_role_at(&scene->lights[sample->light], sample->distance) == LIGHT_DIRECT;
        before =
            rgb_multiply(before, mist_transmittance(p->context, v->point, sample->direction, r->to_mirror, direct));
        before = rgb_multiply(before, mist_transmittance(p->context, at, r->onward, left, direct));
    }
    rgb behind = panes_transmittance(p->context, &second, p->length + r->to_mirror,
                                     scene->lights[sample->light].surface, light_is_proper(scene, sample->light));
    return rgb_multiply(before, behind);
}

/* What a pane reflects of what arrives along the direction. */
static rgb pane_color(const graze_scene *scene, int surface, vec3 direction) {
    const vec3 n = shape_plane_of(&scene->shapes[surface]).normal, view = vec3_negate(direction);
    graze_surface s;
    graze_surface_prepare(&s, &scene->materials[scene->surfaces[surface].material].reflector,
                          vec3_dot(n, view) < 0 ? vec3_negate(n) : n, view, NULL);
    return s.specular;
}

/* What the mirror reflects, where it shows the light. */
static rgb color_of(const path *p, const vertex *v, const scene_mirror *m, const reflection *r, vec3 direction) {
    const graze_scene *scene = p->context->scene;
    const scene_material *material = &scene->materials[scene->surfaces[r->surface].material];
    if (m->pane)
        return pane_color(scene, r->surface, direction);
    if (!material->modifiers)
        return material->reflector.color;
    const path_hit hit = {.surface = r->surface,
                          .light = -1,
                          .distance = r->to_mirror,
                          .point = vec3_add_scaled(v->point, r->to_mirror, direction),
                          .normal = shape_plane_of(&scene->shapes[r->surface]).normal,
                          .direction = direction};
    return appearance_reflector(scene, material, &hit, p->length).color;
}

/* Where the mirror reflects light in this direction to the vertex, if it does before its way ends. */
static bool find_reflection(const path *p, const vertex *v, const scene_mirror *m, vec3 direction, double distance,
                            reflection *r) {
    const graze_scene *scene = p->context->scene;
    double slope = vec3_dot(m->plane.normal, direction);
    r->to_mirror = vec3_dot(m->plane.normal, vec3_subtract(m->plane.point, v->point)) / slope;
    if (!(r->to_mirror > 0 && r->to_mirror < distance))
        return false;
    r->surface = scene_mirror_at(scene, m, vec3_add_scaled(v->point, r->to_mirror, direction));
    if (r->surface < 0 || r->surface == v->surface)
        return false;
    r->color = color_of(p, v, m, r, direction);
    return true;
}

/* What may find the same as a light sample does: of what a pane shows, paths find as much less as it reflects. */
static lobe_choice rivals_of(const path *p, const scene_mirror *m, const reflection *r, const lobe_choice *choice) {
    if (!virtual_lights_paths_see(p->context->scene, m))
        return (lobe_choice){0};
    lobe_choice rivals = *choice;
    if (m->pane) {
        rivals.diffuse *= rgb_max(r->color);
        rivals.specular *= rgb_max(r->color);
    }
    return rivals;
}

/* Whether it finds anything. */
static bool add_from(path *p, const virtual_lights *all, const virtual_light *l, double expectation,
                     const double random[3], const lobe_choice *choice) {
    const graze_scene *scene = p->context->scene;
    const vertex *v = all->vertex;
    const scene_mirror *m = l->sight.mirror;
    reflection r;
    double chance;
    int light = virtual_light_draw(all, l, random[2], &chance);
    if (light < 0)
        return false;
    light_sample sample = light_draw(scene, l->sight.image, p->length, light, random);
    if (sample.light < 0 || rgb_is_black(sample.radiance))
        return false;
    r.onward = sample.direction;
    sample.direction = virtual_lights_mirror(m, r.onward);
    double cosine = vec3_dot(sample.direction, v->shading.n), density = expectation * chance * sample.density;
    if (cosine <= 0 || (v->leans && vec3_dot(sample.direction, v->normal) <= 0) ||
        !find_reflection(p, v, m, sample.direction, sample.distance, &r))
        return false;
    /* Where paths do not see the light in it, only what lights as a light does is seen by others. */
    if (!virtual_lights_paths_see(scene, m) && light_role_at(&scene->lights[light], sample.distance) != LIGHT_DIRECT)
        return false;
    const lobe_choice rivals = rivals_of(p, m, &r, choice);
    rgb reflectance = direct_light_reflectance(p, v, &sample, density, &rivals, !m->pane || path_bounces_left(p));
    rgb reflected = rgb_multiply(reflectance, sample.radiance);
    if (rgb_is_black(reflected))
        return false;
    rgb found = rgb_multiply(rgb_multiply(arriving(p, v, &r, &sample), r.color), reflected);
    found = rgb_scale(cosine / density, rgb_multiply(p->throughput, found));
    p->radiance = rgb_add(p->radiance, found);
    if (rgb_is_black(found))
        return false;
    observe_shadow_ray(p, v->point, &sample, found);
    return true;
}

/* The brightness that a light adds, as its middle shows it, where the mirror shows all of it and nothing hides it. */
static double brightness_of_whole(const path *p, const vertex *v, const virtual_light *l) {
    static const lobe_choice no_rivals = {0};
    const graze_scene *scene = p->context->scene;
    const scene_mirror *m = l->sight.mirror;
    light_sample sample = light_draw_middle(scene, l->sight.image, p->length, l->light);
    if (sample.light < 0)
        return 0;
    sample.direction = virtual_lights_mirror(m, sample.direction);
    double slope = vec3_dot(m->plane.normal, sample.direction), cosine = vec3_dot(sample.direction, v->shading.n);
    reflection r = {.surface = scene->mirror_surfaces[m->first],
                    .to_mirror = vec3_dot(m->plane.normal, vec3_subtract(m->plane.point, v->point)) / slope};
    if (!(cosine > 0 && r.to_mirror > 0))
        return 0;
    rgb value = direct_light_reflectance(p, v, &sample, 1, &no_rivals, !m->pane || path_bounces_left(p));
    rgb arriving = rgb_multiply(color_of(p, v, m, &r, sample.direction), sample.radiance);
    return rgb_brightness(rgb_multiply(p->throughput, rgb_multiply(value, arriving))) *
           fmin(cosine / sample.density, PI);
}

/* Of a light that a mirror's edge may cut, and that is not yet scattered, notes what it might give: where no sample
 * finds any of it, some may yet be seen. Null: nothing is noted. */
static path_unmet_at *note_part(const path *p, const vertex *v, const virtual_light *l, double expectation) {
    const graze_scene *scene = p->context->scene;
    if (p->scattered || l->light < 0 || !p->context->memory || p->context->observer)
        return NULL;
    path_unmet_at *at = unmet_light_at(p, scene->mirror_surfaces[l->sight.mirror->first], l->light);
    if (at && at->expected == UNMET_LIGHT_NEW)
        at->expected = scene_mirror_shows_part(scene, &l->sight, &scene->mirrored_lights[l->light])
                           ? brightness_of_whole(p, v, l) / expectation
                           : 0;
    return at;
}

/* By one number for all: where the sum of what is expected so far passes it, or it and a whole number. */
static void add_chosen(path *p, virtual_lights *all, const virtual_lights_survey *found, const lobe_choice *choice) {
    double random[3] = {0}, sum = 0, next;
    if (virtual_lights_draw_lots(found))
        random[0] = sampler_1d(p->sampler);
    next = random[0];
    for (int i = 0; i < found->count; i++) {
        const virtual_light *l = found->count > VIRTUAL_LIGHTS_KEPT ? virtual_lights_next(all) : &found->kept[i];
        double expectation = virtual_lights_expectation(found, l);
        path_unmet_at *part = note_part(p, all->vertex, l, expectation);
        sum += expectation;
        while (next < sum) {
            next += 1;
            sampler_3d(p->sampler, random);
            bool met = add_from(p, all, l, expectation, random, choice);
            if (part)
                part->met = part->met || met;
        }
    }
}

void mirrored_light_add(path *p, const vertex *v, const lobe_choice *choice) {
    bool dull = v->shading.specular_lobe != GRAZE_LOBE_GLOSSY && rgb_is_black(v->ambient) && !v->function;
    if (dull || p->wanted == WANTED_BENT)
        return;
    virtual_lights all;
    virtual_lights_survey found;
    virtual_lights_begin(&all, p->context, v, p->ambient_depth);
    p->worth = virtual_lights_worth_at(p, v);
    virtual_lights_look(&found, &all, &p->worth);
    if (found.count > 0)
        add_chosen(p, &all, &found, choice);
}

/* How densely that would have found the light that the path has hit after its last scattering and then a mirror. */
static double density_of(const path *p, const path_hit *hit) {
    const graze_scene *scene = p->context->scene;
    const scene_mirror *m = scene_mirror_of(scene, p->last.mirror);
    int bounced = p->ambient_depth - (p->last.lobe == GRAZE_LOBE_DIFFUSE);
    virtual_lights all;
    virtual_lights_begin(&all, p->context, p->last.vertex, bounced);
    const virtual_light *found = virtual_lights_next(&all);
    while (found && (found->sight.mirror != m || (found->light >= 0 && found->light != hit->light)))
        found = virtual_lights_next(&all);
    if (!found)
        return 0;
    const virtual_light l = *found;
    virtual_lights_survey among;
    virtual_lights_look(&among, &all, &p->worth);
    double expectation = virtual_lights_expectation(&among, &l) * virtual_light_chance(&all, &l, hit->light);
    return expectation == 0
               ? 0
               : expectation * light_density(scene, l.sight.image, hit->light, hit->direction, hit->point, hit->normal);
}

double mirrored_light_weight(const path *p, const path_hit *hit) {
    const graze_scene *scene = p->context->scene;
    const scene_material *material = &scene->materials[scene->surfaces[p->last.mirror].material];
    double other = density_of(p, hit), own = p->last.density;
    if (other == 0)
        return 1;
    if (p->context->settings->strategy == GRAZE_STRATEGY_LIGHT)
        return 0;
    if (material->reflector.kind == GRAZE_GLASS)
        own *= rgb_max(pane_color(scene, p->last.mirror, hit->direction));
    return power_heuristic(own, other);
}
