/* Light in closed form: exact where shadows are known, else a control variate. */
#include "trace/known_light.h"

#include "base/angle.h"
#include "geometry/crossing.h"
#include "geometry/shaft.h"
#include "scene/sight_cells.h"
#include "trace/emission.h"
#include "trace/unshadowed.h"

bool known_light_is_control(const path *p, int light) {
    return light < PATH_FEW_LIGHTS && (p->known.controls | p->known.watched) >> light & 1;
}

bool known_light_is_settled(const path *p, int light) {
    return light < PATH_FEW_LIGHTS && p->known.settled >> light & 1;
}

bool known_light_is_clear(const path *p, int light) {
    return light < PATH_FEW_LIGHTS && p->known.clear >> light & 1;
}

static path_control *control_of(path *p, int light) {
    return &p->controls[p->known.shared ? PATH_FEW_LIGHTS : light];
}

void known_light_subtract(path *p, int light, rgb found, double lit) {
    path_control *control = control_of(p, light);
    if (p->known.controls >> light & 1)
        control->difference = rgb_add_scaled(control->difference, -1, found);
    control->whole += rgb_brightness(found);
    control->lit += lit;
}

/* Whether a light shines on all points alike: its role does not depend on its distance. */
static bool has_one_role(const scene_light *light) {
    return !light->glow || light->glow_radius == 0;
}

/* In the same pixel, a light is no longer asked for that so many points saw in part. */
#define MIXED_GIVEN_UP 4

static geometry_visibility visibility(const graze_scene *scene, const vertex *v, int index) {
    const scene_light *light = &scene->lights[index];
    if (light->only_seen)
        return GEOMETRY_MIXED;
    return geometry_sight_of(scene->geometry, &(geometry_sight){.point = v->point,
                                                                .normal = v->normal,
                                                                .from = v->surface,
                                                                .light = (int)light->surface,
                                                                .axis = light->center,
                                                                .half_angle = light->half_angle});
}

/* What is known of a light, and kept for the other paths if this is their first point, too. `seen` is what is known of
 * the surface around. */
static path_memory_light look_at(const path *p, const vertex *v, int index, bool glossy, geometry_visibility seen) {
    const graze_scene *scene = p->context->scene;
    path_memory_light *kept = path_is_at_first(p) ? path_memory_of_light(p->context->memory, index) : NULL;
    if (kept && kept->kept)
        return *kept;
    bool whole = !v->function && (!v->leans || light_choice_is_above(scene, index, v->point, v->normal));
    path_memory_light found = {.seen = seen, .times_mixed = kept ? kept->times_mixed : 0};
    if (seen == GEOMETRY_MIXED && found.times_mixed < MIXED_GIVEN_UP)
        found.seen = visibility(scene, v, index);
    found.integrated = found.seen != GEOMETRY_BLOCKED && whole &&
                       unshadowed_light_at(scene, &v->shading, v->point, index, glossy, &found.whole);
    found.times_mixed += found.seen == GEOMETRY_MIXED;
    if (!kept)
        return found;
    found.kept = p->context->memory->alike && !v->drawn;
    *kept = found;
    return found;
}

/* Makes the path have so many controls, new ones being 0. */
static void begin_controls(path *p, int count) {
    for (; p->control_count < count; p->control_count++)
        p->controls[p->control_count] = (path_control){{0, 0, 0}, 0, 0};
}

/* Of other lights nobody can tell that nothing hides a part of them (geometry/shaft.h): that it is not told says
 * nothing then. */
static bool can_be_told(const scene_light *light) {
    const shape *s = light->shape;
    if (!s)
        return light->half_angle < PI / 2;
    return s->kind == SHAPE_RING || (s->kind == SHAPE_SPHERE && !s->inward) ||
           (s->kind == SHAPE_POLYGON && s->polygon.vertex_count <= 16);
}

/* Nothing is known of the light but that something may stand before a part of it. */
static void watch(path *p, int light) {
    p->known.watched |= 1u << light;
    begin_controls(p, light + 1);
}

void known_light_watch_chosen(path *p, double hidden, double lit) {
    begin_controls(p, 1);
    p->controls[0].whole += hidden;
    p->controls[0].lit += lit;
}

void known_light_watch_sky(path *p, double hidden, double lit) {
    begin_controls(p, PATH_CONTROL_OF_SKY + 1);
    p->controls[PATH_CONTROL_OF_SKY].whole += hidden + lit;
    p->controls[PATH_CONTROL_OF_SKY].lit += lit;
}

/* What the surface reflects of a light that is seen as a whole, for a throughput of 1. */
static rgb reflected_whole(const path *p, const vertex *v, const scene_light *light, const unshadowed_light *whole,
                           bool glossy) {
    rgb diffuse = !light->glow ? v->shading.diffuse : path_bounces_left(p) ? v->ambient : rgb_gray(0);
    rgb reflectance = rgb_scale(whole->diffuse, diffuse);
    if (glossy)
        reflectance = rgb_add_scaled(reflectance, whole->glossy, v->shading.specular);
    return rgb_multiply(reflectance, light->radiance);
}

/* Lights, a bit for each. */
static void settle(path *p, unsigned lights, rgb reflected) {
    p->known.settled |= lights;
    p->radiance = rgb_add(p->radiance, rgb_multiply(p->throughput, reflected));
}

/* Whether cells can tell all of the light at the vertex: none comes weakened, by gloss, or from lights in copies. */
static bool is_plain(const path *p, const vertex *v) {
    const graze_scene *scene = p->context->scene;
    return v->shading.specular_lobe == GRAZE_LOBE_NONE && !v->shading.transmits && !v->function && !v->leans &&
           scene->light_count == scene->first_copied && scene->sight_cells && p->wanted != WANTED_BENT &&
           context_samples_glows(p->context->settings);
}

_Static_assert((int)SIGHT_CELLS_LIGHTS_MOST <= PATH_FEW_LIGHTS, "all lights of scenes with cells can be settled");

bool known_light_from_cells(const path *p, const vertex *v, sight_cell cell, rgb *reflected) {
    const graze_scene *scene = p->context->scene;
    bool seen[SIGHT_CELLS_LIGHTS_MOST];
    int count = (int)scene->light_count;
    if (!cell.grid || !is_plain(p, v))
        return false;
    for (int i = 0; i < count; i++) {
        geometry_visibility found = sight_cell_sees(scene, cell, i);
        if (found == GEOMETRY_MIXED || scene->light_tree.group_of[i] < 0)
            return false;
        seen[i] = found == GEOMETRY_CLEAR;
    }
    *reflected = rgb_gray(0);
    for (int i = 0; i < count; i++) {
        unshadowed_light whole;
        if (!seen[i])
            continue;
        if (!has_one_role(&scene->lights[i]) || !unshadowed_light_at(scene, &v->shading, v->point, i, false, &whole))
            return false;
        *reflected = rgb_add(*reflected, reflected_whole(p, v, &scene->lights[i], &whole, false));
    }
    return true;
}

void known_light_settle_all(path *p, rgb reflected) {
    p->integrated = p->integrated || !rgb_is_black(reflected);
    settle(p, (1u << p->context->scene->light_count) - 1, reflected);
}

/* Adds what the surface reflects of a light that is seen as a whole. For a single sample, or few of many at this
 * point, only what an integral finds for less than a sample costs: the diffuse term. */
static void add_at_once(path *p, const vertex *v, int index, bool glossy) {
    const graze_scene *scene = p->context->scene;
    const scene_light *light = &scene->lights[index];
    unshadowed_light whole;
    if ((glossy && v->shading.specular_lobe == GRAZE_LOBE_GLOSSY) || v->function || v->leans || !has_one_role(light) ||
        !unshadowed_light_at(scene, &v->shading, v->point, index, false, &whole))
        return;
    p->integrated = true;
    settle(p, 1u << index, reflected_whole(p, v, light, &whole, false));
}

/* The same where all that can be known of a light is worth its time: looks for what stands between it and the vertex,
 * if the cell around this does not tell. */
static void add_after_a_look(path *p, const vertex *v, int i, bool glossy, geometry_visibility seen) {
    const scene_light *light = &p->context->scene->lights[i];
    const path_memory_light found = look_at(p, v, i, glossy, seen);
    if (found.seen == GEOMETRY_BLOCKED)
        settle(p, 1u << i, rgb_gray(0));
    if (found.seen == GEOMETRY_CLEAR)
        p->known.clear |= 1u << i;
    if (!found.integrated || !has_one_role(light)) {
        if (found.seen == GEOMETRY_MIXED && !p->known.shared && can_be_told(light))
            watch(p, i);
        return;
    }
    const rgb reflected = reflected_whole(p, v, light, &found.whole, glossy);
    p->integrated = true;
    if (found.seen == GEOMETRY_CLEAR) {
        settle(p, 1u << i, reflected);
        return;
    }
    p->known.controls |= 1u << i;
    begin_controls(p, p->known.shared ? PATH_FEW_LIGHTS + 1 : i + 1);
    path_control *control = control_of(p, i);
    control->difference = rgb_add(control->difference, rgb_multiply(p->throughput, reflected));
}

void known_light_add(path *p, const vertex *v, sight_cell cell, const light_choice *lights) {
    const graze_scene *scene = p->context->scene;
    p->known = (known_lights){.shared = !path_is_at_first(p)};
    if (!light_choice_is_every_one(lights))
        return;
    bool at_once = p->scattered || p->context->settings->samples == 1;
    for (int i = 0; i < lights->every; i++) {
        if (light_expectation(lights, i) == 0)
            continue;
        bool glossy = !scene->lights[i].glow || !v->gloss_is_ambient;
        geometry_visibility seen = sight_cell_sees(scene, cell, i);
        if (!at_once) {
            add_after_a_look(p, v, i, glossy, seen);
        } else if (seen == GEOMETRY_BLOCKED) {
            settle(p, 1u << i, rgb_gray(0));
        } else if (seen == GEOMETRY_CLEAR) {
            p->known.clear |= 1u << i;
            add_at_once(p, v, i, glossy);
        }
    }
}

bool known_light_is_all(const path *p, const vertex *v, const light_choice *lights) {
    const graze_scene *scene = p->context->scene;
    /* Glows that are not sampled are found by reflection alone. */
    if (!context_samples_glows(p->context->settings) || v->shading.specular_lobe == GRAZE_LOBE_MIRROR)
        return false;
    if (light_choice_is_possible(lights)) {
        if (!light_choice_is_every_one(lights) || p->known.settled == 0)
            return false;
        for (int i = 0; i < lights->every; i++)
            if (!known_light_is_settled(p, i) && light_expectation(lights, i) > 0)
                return false;
    } else if (p->depth > 0 && p->known.settled == 0) {
        return false; /* not worth the question */
    }
    return !v->shading.transmits && !geometry_reflects_above(scene->geometry, v->point, v->normal, v->surface);
}

void known_light_subtract_reflected(path *p, const vertex *from, const path_hit *hit, rgb found) {
    const graze_scene *scene = p->context->scene;
    for (int i = 0; i < (int)scene->light_count && i < PATH_FEW_LIGHTS; i++) {
        if (!known_light_is_control(p, i))
            continue;
        const scene_light *light = &scene->lights[i];
        const bool several = scene->suns_overlap && !light->shape && hit->surface < 0;
        if (hit->light == i && !hit->passed && !several) {
            known_light_subtract(p, i, found, rgb_brightness(found));
            continue;
        }
        path_hit whole = {.surface = light->surface, .light = i, .distance = GEOMETRY_FAR, .direction = hit->direction};
        if (light->shape) {
            if (!shape_front_crossing(light->shape, from->point, hit->direction, &whole.distance))
                continue;
            whole.point = vec3_add_scaled(from->point, whole.distance, hit->direction);
            whole.normal = shape_normal(light->shape, whole.point);
        } else if (!light_source_shines_from(scene, i, hit->direction)) {
            continue;
        }
        rgb unshadowed = emission_found_of(p, &whole);
        bool lit = several && hit->light >= 0 && !hit->passed;
        known_light_subtract(p, i, unshadowed, lit ? rgb_brightness(unshadowed) : 0);
    }
}
