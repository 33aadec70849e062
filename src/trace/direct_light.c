/* Sampling lights, weighted by the power heuristic against finding them by reflection. */
#include "trace/direct_light.h"

#include "base/angle.h"
#include "base/even_steps.h"
#include "trace/known_light.h"
#include "trace/mist.h"
#include "trace/observer.h"
#include "trace/panes.h"
#include "trace/rare_gloss.h"
#include "trace/vertex.h"

/* Few lights are all sampled at the first point, and up to so many at later ones. */
#define EVERY_LIGHT_LATER 2
/* Of more, so many are chosen. */
#define CHOSEN_FIRST 4
#define CHOSEN_LATER 2

/* The sky is looked for in so many windows, at the first point and at later ones. */
#define WINDOWS_FIRST 4
#define WINDOWS_LATER 1

/* Sets how many of the lights and windows that the receiver asks for are sampled. */
static void set_draws(const path *p, light_receiver *receiver) {
    bool first = p->depth == 0;
    if (light_choice_count(p->context->scene, receiver) <= (first ? PATH_FEW_LIGHTS : EVERY_LIGHT_LATER))
        receiver->draws = LIGHT_EVERY_ONE;
    else
        receiver->draws = first ? CHOSEN_FIRST : CHOSEN_LATER;
    receiver->window_draws = first ? WINDOWS_FIRST : WINDOWS_LATER;
}

void direct_light_prepare(const path *p, const vertex *v, light_choice *lights) {
    const path_context *context = p->context;
    bool glossy = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY;
    light_receiver receiver = {.point = v->point, .surface = &v->shading, .diffuse = v->shading.diffuse};
    if (v->function)
        receiver.diffuse = rgb_add(receiver.diffuse, v->function_color);
    if (!context_samples_lights(context->settings) || p->wanted == WANTED_BENT ||
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
    set_draws(p, &receiver);
    light_choice_prepare(lights, context->scene, &receiver);
}

/* The surface upside down. Its lobe, which only tells the choice where to look, has its middle in the direction
 * straight on, and there the width of the transmitted one: a reflecting facet turns light by twice its own slope. */
static graze_surface turn_over(const graze_surface *s) {
    graze_surface other = *s;
    frame f = {s->y, s->x, vec3_negate(s->n)};
    vec3 middle = frame_to_local(&f, s->transmitted);
    other.x = f.x;
    other.y = f.y;
    other.n = f.z;
    other.local_view = vec3_make(-middle.x, -middle.y, middle.z);
    other.view = frame_to_world(&f, other.local_view);
    other.lobe = (graze_brdf){GRAZE_BRDF_GMD, s->transmitted_v / 2, s->transmitted_u / 2};
    return other;
}

void direct_light_prepare_below(const path *p, const vertex *v, other_side *beyond) {
    const graze_surface *s = &v->shading;
    bool glossy = s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY;
    light_receiver receiver = {.point = v->point, .surface = &beyond->surface, .diffuse = s->transmitted_diffuse};
    if (v->function)
        receiver.diffuse = rgb_add(receiver.diffuse, v->transmitted_function);
    if (!context_samples_lights(p->context->settings) || p->wanted == WANTED_BENT ||
        (!glossy && rgb_is_black(v->transmitted_ambient) && rgb_is_black(receiver.diffuse))) {
        light_choice_none(&beyond->lights);
        return;
    }
    beyond->surface = turn_over(s);
    if (glossy)
        receiver.glossy = s->transmitted_specular;
    if (context_samples_glows(p->context->settings)) {
        if (path_bounces_left(p))
            receiver.ambient_diffuse = v->transmitted_ambient;
        if (glossy && !v->transmitted_gloss_is_ambient)
            receiver.ambient_glossy = s->transmitted_specular;
    }
    set_draws(p, &receiver);
    light_choice_prepare(&beyond->lights, p->context->scene, &receiver);
}

/* What panes, mist and the body that it is in leave of a light sample's light; black where something else is on its
 * way. */
__attribute__((noinline)) static rgb light_let_through(const path *p, const geometry_ray *ray,
                                                       const light_sample *sample) {
    const graze_scene *scene = p->context->scene;
    const scene_light *light = &scene->lights[sample->light];
    rgb left = panes_transmittance(p->context, ray, p->length, light->surface, light_is_proper(scene, sample->light));
    if (path_is_in_body(p))
        left = rgb_multiply(left, path_medium_transmittance(p, ray->far));
    if (!p->in_mist || rgb_is_black(left))
        return left;
    bool direct = light_role_at(light, sample->distance) == LIGHT_DIRECT;
    return rgb_multiply(mist_transmittance(p->context, ray->origin, ray->direction, ray->far, direct), left);
}

/* Whether nothing stands between a vertex and a light's sampled point, but for what leaves some of its light. */
static bool light_is_visible(const path *p, const vertex *v, const light_sample *sample, rgb *light) {
    const graze_scene *scene = p->context->scene;
    geometry_ray ray = {
        .origin = v->point, .direction = sample->direction, .far = sample->distance, .from = v->surface};
    if (!p->in_mist && known_light_is_clear(p, sample->light))
        return true;
    if (!p->hindered)
        return !geometry_occluded(scene->geometry, &ray, scene->lights[sample->light].surface);
    *light = light_let_through(p, &ray, sample);
    return !rgb_is_black(*light);
}

/* Of what is compiled for each side by itself. */
#define ONE_SIDE inline __attribute__((always_inline))

/* Of a light sample's light. */
typedef struct reflectance {
    bool by_gloss; /* a glossy lobe counts, whether or not it has a value in this direction */
    rgb diffuse, glossy;
} reflectance;

/* The reflectance functions for a light sample, by the rules for its role, weighted against finding the light by
 * reflection. */
static ONE_SIDE reflectance reflectance_for_light(const path *p, const vertex *v, const light_sample *sample,
                                                  double density, const lobe_choice *choice, bool below) {
    const path_context *context = p->context;
    light_role role = light_role_at(&context->scene->lights[sample->light], sample->distance);
    bool ambient = role == LIGHT_AMBIENT;
    reflectance r = {.by_gloss = false};
    if (role == LIGHT_NONE || (ambient && !context_samples_glows(context->settings)))
        return r;
    graze_surface_value(&v->shading, sample->direction, &r.diffuse, &r.glossy);
    if (v->function && !ambient)
        r.diffuse = rgb_add(r.diffuse, vertex_function_value(v, sample->direction));
    if (ambient)
        r.diffuse = path_bounces_left(p) ? rgb_scale(1 / PI, below ? v->transmitted_ambient : v->ambient) : rgb_gray(0);
    r.by_gloss = !(ambient && (below ? v->transmitted_gloss_is_ambient : v->gloss_is_ambient));
    if (!r.by_gloss)
        r.glossy = rgb_gray(0);
    if (context->settings->strategy == GRAZE_STRATEGY_LIGHT)
        return r;
    if (choice->diffuse > 0) {
        graze_lobe lobe = below ? GRAZE_LOBE_TRANSMITTED_DIFFUSE : GRAZE_LOBE_DIFFUSE;
        double rival = choice->diffuse * graze_surface_density(&v->shading, lobe, sample->direction);
        r.diffuse = rgb_scale(power_heuristic(density, rival), r.diffuse);
    }
    graze_lobe lobe = below ? GRAZE_LOBE_TRANSMITTED_GLOSSY : GRAZE_LOBE_GLOSSY;
    if (choice->specular > 0 && (below ? v->shading.transmitted_lobe : v->shading.specular_lobe) == lobe) {
        double rival = choice->specular * graze_surface_density(&v->shading, lobe, sample->direction);
        r.glossy = rgb_scale(power_heuristic(density, rival), r.glossy);
    }
    return r;
}

static ONE_SIDE bool is_above(const vertex *v, vec3 direction, bool below) {
    return (below ? -1 : 1) * vec3_dot(direction, v->shading.n) > 0 &&
           !(v->leans && (vec3_dot(direction, v->normal) <= 0) != below);
}

/* Direct light, Eq. 18, from a sample of one light, which is taken `expectation` times on the average. `other` is the
 * density of the other way to draw it, if it has two: a sky is drawn from as a whole, and in windows. Of both, and of
 * reflection, the squares count (power heuristic): a balance would leave so much to samples of the whole that in a room
 * the few that there are would mostly miss their share, and not tell. Tells the brightness that something hides wholly.
 */
static ONE_SIDE double add_sample(path *p, const vertex *v, const light_sample *drawn, double expectation, double other,
                                  const lobe_choice *choice, bool below) {
    const light_sample sample = *drawn;
    const int light = sample.light;
    double cosine = fabs(vec3_dot(sample.direction, v->shading.n));
    double own = expectation * sample.density, density = own, share = 1;
    if (other > 0) {
        density = hypot(own, other);
        share = power_heuristic(own, other);
    }
    reflectance r = reflectance_for_light(p, v, &sample, density, choice, below);
    rgb reflected = rgb_multiply(rgb_add(r.diffuse, r.glossy), sample.radiance);
    rare_gloss rare = !r.by_gloss || p->gloss == RARE_GLOSS_MIRROR ? RARE_GLOSS_NONE : p->gloss;
    if (rare != RARE_GLOSS_FLAT && rgb_is_black(reflected))
        return 0;
    rgb weight = rgb_scale(cosine / own * share, p->throughput);
    rgb whole = rgb_multiply(weight, reflected);
    rgb passed = rgb_gray(1);
    bool lit = light_is_visible(p, v, &sample, &passed);
    rgb found = rgb_multiply(whole, passed);
    if (lit && rare) {
        light_sample arrived = sample;
        arrived.radiance = rgb_multiply(sample.radiance, passed);
        if (rare == RARE_GLOSS_FLAT)
            rare_gloss_expect(p, v, &arrived, expectation);
        rare_gloss_find(p, v, sample.direction, sample.density,
                        rgb_multiply(weight, rgb_multiply(r.glossy, arrived.radiance)));
    }
    if (lit && !rgb_is_black(reflected)) {
        p->radiance = rgb_add(p->radiance, found);
        observe_shadow_ray(p, v->point, &sample, found);
    }
    if (known_light_is_control(p, light))
        known_light_subtract(p, light, whole, lit ? rgb_brightness(found) : 0);
    return lit ? 0 : rgb_brightness(whole);
}

/* How densely windows are looked through in a direction of a light. */
static inline double density_in_windows(const graze_scene *scene, const light_choice *lights, int light,
                                        vec3 direction) {
    return lights->windows.count > 0 && scene_light_is_sky(&scene->lights[light])
               ? window_density(&lights->windows, direction)
               : 0;
}

static ONE_SIDE double add_sampled_light(path *p, const vertex *v, const light_choice *lights, int light,
                                         double expectation, const double random[2], const lobe_choice *choice,
                                         bool below) {
    const graze_scene *scene = p->context->scene;
    const light_sample sample = light_draw(scene, v->point, p->length, light, random);
    if (sample.light < 0 || rgb_is_black(sample.radiance) || !is_above(v, sample.direction, below))
        return 0;
    const double in_windows = density_in_windows(scene, lights, light, sample.direction);
    const rgb before = p->radiance;
    double hidden = add_sample(p, v, &sample, expectation, in_windows, choice, below);
    if (scene->sky_beside_windows && lights->windows.count > 0 && in_windows == 0 &&
        scene_light_is_sky(&scene->lights[light]) && path_is_at_first(p))
        known_light_watch_sky(p, hidden, rgb_brightness(rgb_add_scaled(p->radiance, -1, before)));
    return hidden;
}

/* Where the sample of this number is looked for in a square, if the first is at two random numbers. */
static void place_in_square(const double random[2], int number, double at[2]) {
    const double x = random[0] + number * EVEN_STEP_X, y = random[1] + number * EVEN_STEP_Y;
    at[0] = x - floor(x);
    at[1] = y - floor(y);
}

static ONE_SIDE void add_every_light(path *p, const vertex *v, const light_choice *lights, const lobe_choice *choice,
                                     bool below) {
    double random[2];
    for (int light = 0; light < lights->every; light++)
        if (!known_light_is_settled(p, light) && light_expectation(lights, light) > 0) {
            sampler_2d(p->sampler, random);
            (void)add_sampled_light(p, v, lights, light, 1, random, choice, below);
        }
}

static ONE_SIDE void add_lights(path *p, const vertex *v, const light_choice *lights, const lobe_choice *choice,
                                bool below) {
    double random[3], hidden = 0;
    if (light_choice_is_every_one(lights)) {
        add_every_light(p, v, lights, choice, below);
        return;
    }
    sampler_3d(p->sampler, random);
    const rgb before = p->radiance;
    int count = lights->receiver.draws;
    for (int i = 0; i < count; i++) {
        double expectation, place_on_light[2];
        int light = light_choose(lights, (random[0] + i) / count, &expectation);
        place_in_square(&random[1], i, place_on_light);
        if (light >= 0)
            hidden += add_sampled_light(p, v, lights, light, expectation, place_on_light, choice, below);
    }
    if (path_is_at_first(p))
        known_light_watch_chosen(p, hidden / count, rgb_brightness(rgb_add_scaled(p->radiance, -1, before)));
}

/* A sky as a window shows it in that direction. */
static ONE_SIDE void add_sky_seen(path *p, const vertex *v, const light_choice *lights, int sky, vec3 direction,
                                  const lobe_choice *choice, bool below) {
    const graze_scene *scene = p->context->scene;
    const scene_light *light = &scene->lights[sky];
    light_sample sample = {.light = sky, .distance = GEOMETRY_FAR, .direction = direction};
    sample.radiance = light_patterned(light, light->radiance, v->point, direction, direction, GEOMETRY_FAR, p->length);
    sample.density = window_density(&lights->windows, direction);
    double other = light_expectation(lights, sky);
    if (other > 0)
        other *= light_density(scene, v->point, sky, direction, v->point, v->normal);
    if (sample.density > 0 && !rgb_is_black(sample.radiance))
        (void)add_sample(p, v, &sample, 1, other, choice, below);
}

/* All skies that a window shows: lights that overlap shine together. */
static ONE_SIDE void add_sky_in_window(path *p, const vertex *v, const light_choice *lights, int which,
                                       const double random[2], const lobe_choice *choice, bool below) {
    const graze_scene *scene = p->context->scene;
    vec3 direction;
    if (!window_draw(&lights->windows, which, random, &direction) || !is_above(v, direction, below))
        return;
    int first = light_source_towards(scene, direction);
    if (first >= 0 && scene_light_is_sky(&scene->lights[first]))
        add_sky_seen(p, v, lights, first, direction, choice, below);
    for (int i = first + 1; scene->suns_overlap && first >= 0 && i < (int)scene->first_copied; i++)
        if (scene_light_is_sky(&scene->lights[i]) && light_source_shines_from(scene, i, direction))
            add_sky_seen(p, v, lights, i, direction, choice, below);
}

static ONE_SIDE void add_windows(path *p, const vertex *v, const light_choice *lights, const lobe_choice *choice,
                                 bool below) {
    const window_choice *windows = &lights->windows;
    const int draws = lights->receiver.window_draws;
    double random[3];
    if (windows->count <= draws) {
        for (int i = 0; i < windows->count; i++) {
            sampler_2d(p->sampler, random);
            add_sky_in_window(p, v, lights, i, random, choice, below);
        }
        return;
    }
    sampler_3d(p->sampler, random);
    for (int i = 0; i < draws; i++) {
        double place_in_window[2];
        place_in_square(&random[1], i, place_in_window);
        add_sky_in_window(p, v, lights, window_choose(windows, (random[0] + i) / draws), place_in_window, choice,
                          below);
    }
}

void direct_light_add(path *p, const vertex *v, const light_choice *lights, const lobe_choice *choice) {
    add_lights(p, v, lights, choice, false);
    if (lights->windows.count > 0)
        add_windows(p, v, lights, choice, false);
}

void direct_light_add_below(path *p, const vertex *v, const light_choice *lights, const lobe_choice *choice) {
    add_lights(p, v, lights, choice, true);
    if (lights->windows.count > 0)
        add_windows(p, v, lights, choice, true);
}

rgb direct_light_reflectance(const path *p, const vertex *v, const light_sample *sample, double density,
                             const lobe_choice *choice, bool matte) {
    reflectance r = reflectance_for_light(p, v, sample, density, choice, false);
    return matte ? rgb_add(r.diffuse, r.glossy) : r.glossy;
}
