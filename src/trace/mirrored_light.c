/* A light in a mirror is where its image is: it is sampled as the light itself from the vertex's own image. */
#include "trace/mirrored_light.h"

#include "geometry/crossing.h"
#include "trace/appearance.h"
#include "trace/direct_light.h"
#include "trace/mist.h"
#include "trace/observer.h"
#include "trace/panes.h"

/* Of more mirrors that show a vertex, one is chosen. */
#define EVERY_MIRROR 4

static double height_over(const shape_plane *p, vec3 point) {
    return vec3_dot(p->normal, vec3_subtract(point, p->point));
}

static vec3 mirror_direction(const shape_plane *p, vec3 direction) {
    return vec3_add_scaled(direction, -2 * vec3_dot(p->normal, direction), p->normal);
}

static vec3 mirror_point(const shape_plane *p, vec3 point) {
    return vec3_add_scaled(point, -2 * height_over(p, point), p->normal);
}

/* Whether the mirror shows the vertex: it has its front there, and is not all below the horizon as far as its plane
 * tells. What paths see it as without reflecting them, only light samples see lights in: whatever the strategy. */
static bool shows(const path_context *context, int mirror, const vertex *v) {
    const graze_scene *scene = context->scene;
    const shape_plane p = shape_plane_of(&scene->shapes[mirror]);
    if (scene->surfaces[mirror].mirrors && !context_samples_lights(context->settings))
        return false;
    return mirror != v->surface && height_over(&p, v->point) > 0;
}

static int count_shown(const path_context *context, const vertex *v) {
    int count = 0;
    for (size_t i = 0; i < context->scene->mirror_count; i++)
        count += shows(context, context->scene->mirrors[i], v);
    return count;
}

/* How often each of so many is sampled on the average. */
static double share_of(int count) {
    return count <= EVERY_MIRROR ? 1 : 1.0 / count;
}

/* The lights as the vertex's image sees them. */
typedef struct image {
    graze_surface surface;
    light_choice lights;
} image;

static void prepare_image(const path *p, const vertex *v, const shape_plane *mirror, int bounced, image *made) {
    const graze_scene *scene = p->context->scene;
    graze_surface *s = &made->surface;
    bool glossy = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY;
    bool glows = context_samples_glows(p->context->settings);
    *s = v->shading;
    s->x = mirror_direction(mirror, s->x);
    s->y = mirror_direction(mirror, s->y);
    s->n = mirror_direction(mirror, s->n);
    light_receiver receiver = {
        .point = mirror_point(mirror, v->point), .surface = s, .diffuse = v->shading.diffuse, .draws = 1};
    if (v->function)
        receiver.diffuse = rgb_add(receiver.diffuse, v->function_color);
    if (glossy)
        receiver.glossy = v->shading.specular;
    if (glows && !v->no_ambient && bounced < p->context->settings->ambient_bounces)
        receiver.ambient_diffuse = v->ambient;
    if (glows && glossy && !v->gloss_is_ambient)
        receiver.ambient_glossy = v->shading.specular;
    light_choice_prepare(&made->lights, scene, &receiver);
}

/* What is left of the light on both parts of its way. */
static rgb arriving(const path *p, const vertex *v, int mirror, double to_mirror, const light_sample *sample,
                    vec3 onward) {
    const graze_scene *scene = p->context->scene;
    geometry_ray first = {.origin = v->point, .direction = sample->direction, .far = to_mirror, .from = v->surface};
    vec3 at = shape_pull(&scene->shapes[mirror], vec3_add_scaled(v->point, to_mirror, sample->direction));
    double left = sample->distance < GEOMETRY_FAR ? sample->distance - to_mirror : GEOMETRY_FAR;
    geometry_ray second = {.origin = at, .direction = onward, .far = left, .from = mirror};
    rgb before = panes_transmittance(p->context, &first, p->length, mirror, true);
    if (!(left > 0) || rgb_is_black(before))
        return rgb_gray(0);
    if (path_is_in_body(p))
        before = rgb_multiply(before, path_medium_transmittance(p, to_mirror + left));
    if (p->in_mist) {
        bool direct = light_role_at(&scene->lights[sample->light], sample->distance) == LIGHT_DIRECT;
        before = rgb_multiply(before, mist_transmittance(p->context, v->point, sample->direction, to_mirror, direct));
        before = rgb_multiply(before, mist_transmittance(p->context, at, onward, left, direct));
    }
    rgb behind = panes_transmittance(p->context, &second, p->length + to_mirror, scene->lights[sample->light].surface,
                                     light_is_proper(scene, sample->light));
    return rgb_multiply(before, behind);
}

/* What the mirror reflects, where it shows the light. */
static rgb color_of(const path *p, const vertex *v, int mirror, double to_mirror, vec3 direction) {
    const graze_scene *scene = p->context->scene;
    const scene_material *material = &scene->materials[scene->surfaces[mirror].material];
    if (!material->modifiers)
        return material->reflector.color;
    const path_hit hit = {.surface = mirror,
                          .light = -1,
                          .distance = to_mirror,
                          .point = vec3_add_scaled(v->point, to_mirror, direction),
                          .normal = shape_plane_of(&scene->shapes[mirror]).normal,
                          .direction = direction};
    return appearance_reflector(scene, material, &hit, p->length).color;
}

static void add_from(path *p, const vertex *v, int mirror, double expectation, const double random[3],
                     const lobe_choice *choice) {
    const graze_scene *scene = p->context->scene;
    const shape *s = &scene->shapes[mirror];
    const shape_plane flat = shape_plane_of(s);
    image seen;
    prepare_image(p, v, &flat, p->ambient_depth, &seen);
    if (!light_choice_is_possible(&seen.lights))
        return;
    double chance, to_mirror;
    int light = light_choose(&seen.lights, random[0], &chance);
    if (light < 0)
        return;
    light_sample sample = light_draw(scene, seen.lights.receiver.point, p->length, light, random + 1);
    if (sample.light < 0 || rgb_is_black(sample.radiance))
        return;
    vec3 onward = sample.direction;
    sample.direction = mirror_direction(&flat, onward);
    double cosine = vec3_dot(sample.direction, v->shading.n), density = expectation * chance * sample.density;
    if (cosine <= 0 || (v->leans && vec3_dot(sample.direction, v->normal) <= 0) ||
        !shape_front_crossing(s, v->point, sample.direction, &to_mirror) || to_mirror >= sample.distance)
        return;
    /* Where paths do not see the light in it, only what lights as a light does is seen by others. */
    static const lobe_choice no_rival = {0};
    const lobe_choice *rivals = scene->surfaces[mirror].mirrors ? choice : &no_rival;
    if (rivals == &no_rival && light_role_at(&scene->lights[light], sample.distance) != LIGHT_DIRECT)
        return;
    rgb reflected = rgb_multiply(direct_light_reflectance(p, v, &sample, density, rivals), sample.radiance);
    if (rgb_is_black(reflected))
        return;
    rgb color = color_of(p, v, mirror, to_mirror, sample.direction);
    rgb found = rgb_multiply(rgb_multiply(arriving(p, v, mirror, to_mirror, &sample, onward), color), reflected);
    found = rgb_scale(cosine / density, rgb_multiply(p->throughput, found));
    p->radiance = rgb_add(p->radiance, found);
    if (!rgb_is_black(found))
        observe_shadow_ray(p, v->point, &sample, found);
}

void mirrored_light_add(path *p, const vertex *v, const lobe_choice *choice) {
    const graze_scene *scene = p->context->scene;
    bool dull = v->shading.specular_lobe != GRAZE_LOBE_GLOSSY && rgb_is_black(v->ambient) && !v->function;
    dull = dull || p->wanted == WANTED_BENT;
    int count = dull ? 0 : count_shown(p->context, v);
    double random[3];
    if (count == 0)
        return;
    int chosen = -1;
    if (count > EVERY_MIRROR) {
        sampler_2d(p->sampler, random);
        chosen = (int)(random[0] * count);
    }
    for (size_t i = 0, number = 0; i < scene->mirror_count; i++) {
        if (!shows(p->context, scene->mirrors[i], v) || (chosen >= 0 && (int)number++ != chosen))
            continue;
        sampler_3d(p->sampler, random);
        add_from(p, v, scene->mirrors[i], share_of(count), random, choice);
    }
}

double mirrored_light_density(const path *p, const path_hit *hit) {
    const graze_scene *scene = p->context->scene;
    const scattering *last = &p->last;
    const shape_plane mirror = shape_plane_of(&scene->shapes[last->mirror]);
    int bounced = p->ambient_depth - (last->lobe == GRAZE_LOBE_DIFFUSE);
    image seen;
    if (!shows(p->context, last->mirror, last->vertex))
        return 0;
    prepare_image(p, last->vertex, &mirror, bounced, &seen);
    double expectation = share_of(count_shown(p->context, last->vertex)) * light_expectation(&seen.lights, hit->light);
    if (expectation == 0)
        return 0;
    return expectation *
           light_density(scene, seen.lights.receiver.point, hit->light, hit->direction, hit->point, hit->normal);
}
