/* Virtual lights: those that a vertex sees in flat mirrors and panes, and how often each is sampled. */
#include "trace/virtual_lights.h"

#include "trace/context.h"

bool virtual_lights_paths_see(const graze_scene *scene, const scene_mirror *m) {
    return scene->surfaces[scene->mirror_surfaces[m->first]].mirrors;
}

/* Whether the mirror may show something to the vertex. What paths see it as without reflecting them, only light samples
 * see lights in: whatever the strategy. */
static bool sees(const virtual_lights *all, const scene_mirror *m, scene_mirror_sight *sight) {
    const path_context *context = all->context;
    const graze_scene *scene = context->scene;
    const vertex *v = all->vertex;
    if ((m->pane && !all->panes) || (virtual_lights_paths_see(scene, m) && !context_samples_lights(context->settings)))
        return false;
    return scene_mirror_see(m, v->point, v->shading.n, sight) &&
           (sight->side > 0 || context->settings->back_faces_visible);
}

/* In panes a sky is left to paths: it is seen in them wherever they are, and mostly it is what they let through that
 * matters. All that counts as ambient is left with it, from which it cannot be told apart. */
static bool is_left_to_paths(const graze_scene *scene, const scene_mirror *m) {
    return m->pane && scene->has_sky;
}

static void rewind_lights(virtual_lights *all) {
    all->next = 0;
    all->light = (int)all->context->scene->light_count;
}

void virtual_lights_begin(virtual_lights *all, const path_context *context, const vertex *v, int bounced) {
    bool glossy = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY && !v->gloss_is_ambient;
    bool matte = !v->no_ambient && bounced < context->settings->ambient_bounces;
    all->context = context;
    all->vertex = v;
    all->bounced = bounced;
    all->ambient = context_samples_glows(context->settings) && (glossy || matte);
    all->panes = glossy || matte;
    rewind_lights(all);
}

/* Goes on to the next mirror that may show something; false: there are no more. */
static bool next_mirror(virtual_lights *all) {
    const graze_scene *scene = all->context->scene;
    while (all->next < scene->mirror_count)
        if (sees(all, &scene->mirrors[all->next++], &all->now.sight)) {
            all->light = 0;
            return true;
        }
    return false;
}

/* Goes on to the next light that the mirror shows; false: there are no more. */
static bool next_in_mirror(virtual_lights *all) {
    const graze_scene *scene = all->context->scene;
    virtual_light *l = &all->now;
    while (all->light < (int)scene->light_count) {
        l->light = all->light++;
        const scene_mirrored_light *light = &scene->mirrored_lights[l->light];
        if (light->ambient && (!all->ambient || is_left_to_paths(scene, l->sight.mirror)))
            continue;
        l->weight = scene_mirror_shows(&l->sight, light);
        if (l->weight > 0)
            return true;
    }
    return false;
}

const virtual_light *virtual_lights_next(virtual_lights *all) {
    virtual_light *l = &all->now;
    if (all->context->scene->mirrored_lights) {
        while (!next_in_mirror(all))
            if (!next_mirror(all))
                return NULL;
        return l;
    }
    if (!next_mirror(all))
        return NULL;
    l->light = -1;
    l->weight = l->sight.share * l->sight.reflects;
    return l;
}

/* What is faint is sampled as often as is worth it: of a pane, at the first point, so many times the share of light
 * that it reflects, lest few samples all miss it; later, where paths differ anyway, so many times. */
#define WORTH_FIRST 4.0
#define WORTH_LATER 0.5

/* But where a later point has not much else, such as a ceiling above a table of glass, few of the paths that lead there
 * would have all of the light that they find, and few of an estimate's samples might be none of these. What counts is
 * what has been found since the path was scattered. */
virtual_lights_worth virtual_lights_worth_at(const path *p, const vertex *v) {
    if (!p->scattered)
        return (virtual_lights_worth){.faint = WORTH_FIRST};
    const rgb reflectance = rgb_add(v->ambient, v->shading.specular);
    const double found = rgb_brightness(rgb_add_scaled(p->radiance, -1, p->direct));
    const double reflected = rgb_brightness(rgb_multiply(p->throughput, reflectance));
    return (virtual_lights_worth){
        .faint = WORTH_LATER, .dim = fmin(rgb_max(p->throughput), 1), .rival = double_share(fmax(found, 0), reflected)};
}

static double worth_of(const virtual_light *l, const virtual_lights_worth *worth) {
    double often = worth->faint * l->sight.reflects;
    if (l->light >= 0 && worth->dim > 0)
        often = fmax(often, worth->dim * l->weight / (l->weight + worth->rival));
    return fmin(often, 1);
}

void virtual_lights_look(virtual_lights_survey *found, virtual_lights *all, const virtual_lights_worth *worth) {
    const virtual_light *l;
    found->count = 0;
    found->sum = found->often = 0;
    found->worth = *worth;
    rewind_lights(all);
    while ((l = virtual_lights_next(all))) {
        if (found->count < VIRTUAL_LIGHTS_KEPT)
            found->kept[found->count] = *l;
        found->count++;
        found->sum += l->weight;
        found->often += worth_of(l, worth);
    }
    rewind_lights(all);
}

/* Where that would be more than so many at one point, so many are chosen of those that matter. */
#define MOST   4
#define CHOSEN 2

bool virtual_lights_draw_lots(const virtual_lights_survey *all) {
    return all->often < all->count || all->often > MOST;
}

double virtual_lights_expectation(const virtual_lights_survey *all, const virtual_light *l) {
    return all->often <= MOST ? worth_of(l, &all->worth) : CHOSEN * l->weight / all->sum;
}

/* Of many lights, as the vertex's image sees them. */
typedef struct image {
    graze_surface surface;
    light_choice lights;
} image;

static void prepare_image(const virtual_lights *all, const scene_mirror_sight *sight, image *made) {
    const path_context *context = all->context;
    const vertex *v = all->vertex;
    const scene_mirror *m = sight->mirror;
    graze_surface *s = &made->surface;
    bool glossy = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY;
    bool glows = context_samples_glows(context->settings) && !is_left_to_paths(context->scene, m);
    *s = v->shading;
    s->x = virtual_lights_mirror(m, s->x);
    s->y = virtual_lights_mirror(m, s->y);
    s->n = virtual_lights_mirror(m, s->n);
    light_receiver receiver = {.point = sight->image, .surface = s, .diffuse = v->shading.diffuse, .draws = 1};
    if (v->function)
        receiver.diffuse = rgb_add(receiver.diffuse, v->function_color);
    if (glossy)
        receiver.glossy = v->shading.specular;
    if (glows && !v->no_ambient && all->bounced < context->settings->ambient_bounces)
        receiver.ambient_diffuse = v->ambient;
    if (glows && glossy && !v->gloss_is_ambient)
        receiver.ambient_glossy = v->shading.specular;
    light_choice_prepare(&made->lights, context->scene, &receiver);
}

int virtual_light_draw(const virtual_lights *all, const virtual_light *l, double random, double *expectation) {
    *expectation = 1;
    if (l->light >= 0)
        return l->light;
    image seen;
    prepare_image(all, &l->sight, &seen);
    return light_choice_is_possible(&seen.lights) ? light_choose(&seen.lights, random, expectation) : -1;
}

double virtual_light_chance(const virtual_lights *all, const virtual_light *l, int light) {
    if (l->light >= 0)
        return l->light == light;
    image seen;
    prepare_image(all, &l->sight, &seen);
    return light_expectation(&seen.lights, light);
}
