/* Path tracing with next-event estimation.
 *
 * At each surface point, light arrives in two ways: from lights that are sampled (Eq. 18), and from wherever a sampled
 * reflection leads (Eq. 16). What both can find is weighted by the power heuristic. Radiance's rules of what counts are
 * kept: `light`s light everything; `glow`s light diffusely only where an ambient bounce is left; a diffuse reflection
 * costs an ambient bounce. */
#include "trace/path.h"

#include "base/angle.h"
#include "scene/surface.h"
#include "trace/appearance.h"
#include "trace/direct_light.h"
#include "trace/emission.h"
#include "trace/irradiance_cache.h"
#include "trace/known_light.h"
#include "trace/lobes.h"
#include "trace/mirrored_light.h"
#include "trace/mist.h"
#include "trace/observer.h"
#include "trace/panes.h"
#include "trace/rare_gloss.h"
#include "trace/unmet_light.h"
#include "trace/vertex.h"

/* The ambient value stands for the diffuse light that is not followed. */
static void add_ambient_value(path *p, const vertex *v) {
    if (p->wanted == WANTED_BENT)
        return;
    rgb ambient = v->shading.transmits ? rgb_add(v->ambient, v->transmitted_ambient) : v->ambient;
    rgb reflected = rgb_multiply(ambient, p->context->settings->ambient_value);
    rgb found = rgb_multiply(p->throughput, reflected);
    p->radiance = rgb_add(p->radiance, found);
    if (!p->scattered)
        p->indirect_light = rgb_add(p->indirect_light, found);
    observe_surface(p, found);
}

/* Whether irradiance tells what is reflected diffusely. */
static bool reflects_plainly(const vertex *v) {
    return !v->no_ambient && !v->gloss_is_ambient && !v->shading.fresnel && !v->leans && !v->function &&
           !v->shading.transmits;
}

/* So many of the paths that end in the cache look for bent light instead. */
#define LOOKS_FOR_BENT 0.25

/* Has the path go on to look for what the cache does not tell, now and then: by diffuse reflection; else, by specular
 * ones. True: that is what it does. */
static bool look_for_bent(path *p, vertex *v) {
    bool looks = sampler_1d(p->sampler) < LOOKS_FOR_BENT;
    p->throughput = rgb_scale(1 / (looks ? LOOKS_FOR_BENT : 1 - LOOKS_FOR_BENT), p->throughput);
    if (!looks)
        return false;
    p->wanted = WANTED_BENT;
    v->shading.specular = rgb_gray(0);
    v->shading.specular_lobe = GRAZE_LOBE_NONE;
    return true;
}

/* Takes what the cache tells of the point that a diffuse reflection has led to, or notes the record that is asked for.
 * What the surface reflects specularly is left of the vertex. True: nothing is, and the path ends. There must be one of
 * both. */
static bool take_from_cache(path *p, const path_hit *hit, vertex *v) {
    const path_context *context = p->context;
    if (p->last.lobe != GRAZE_LOBE_DIFFUSE || p->ambient_depth != 1 || context->settings->ambient_bounces < 2 ||
        p->wanted == WANTED_BENT || !reflects_plainly(v) || path_is_in_body(p))
        return false;
    irradiance_record record = {v->point, v->shading.n, v->surface, hit->distance};
    rgb irradiance[IRRADIANCE_PARTS];
    if (context->record) {
        *context->record = record;
        return true;
    }
    if (!irradiance_cache_find(context->cache, &record, irradiance))
        return false;
    rgb reflected = rgb_scale(1 / PI, rgb_multiply(p->throughput, v->shading.diffuse));
    for (int i = 0; i < IRRADIANCE_PARTS; i++) {
        rgb told = rgb_multiply(reflected, irradiance[i]);
        p->told[i] = p->cached ? rgb_add(p->told[i], told) : told;
        p->radiance = rgb_add_scaled(p->radiance, 1.0 / IRRADIANCE_PARTS, told);
    }
    p->cached = true;
    if (context->scene->has_refraction && p->wanted == WANTED_ALL && look_for_bent(p, v))
        return false;
    v->shading.diffuse = v->ambient = rgb_gray(0);
    return v->shading.specular_lobe == GRAZE_LOBE_NONE;
}

/* Of the error asked for, so much may come from what is known beforehand. */
#define INDIRECT_SHARE 0.7

/* Takes what is known of the first point, if it is good enough: diffuse reflections are not followed from there. */
static void take_indirect(path *p, const vertex *v) {
    const path_indirect *known = p->context->indirect;
    const graze_trace_settings *s = p->context->settings;
    if (!known || !path_is_at_first(p) || rgb_is_black(v->shading.diffuse) || !reflects_plainly(v) ||
        path_is_in_body(p))
        return;
    rgb reflectance = rgb_scale(1 / PI, v->shading.diffuse);
    rgb value = rgb_multiply(reflectance, known->irradiance), error = rgb_multiply(reflectance, known->error);
    if (rgb_max(error) > INDIRECT_SHARE * s->error * fmax(rgb_max(value), s->floor))
        return;
    p->radiance = rgb_add(p->radiance, value);
    p->indirect_light = rgb_add(p->indirect_light, value);
    for (int i = 0; i < IRRADIANCE_PARTS; i++)
        p->told[i] = rgb_multiply(reflectance, known->told[i]);
    p->cached = p->indirect_known = true;
    p->indirect_error = error;
}

/* Of patterns on clear bodies counts what they are where light leaves, as in Radiance. */
static rgb medium_at(const path *p, const path_hit *hit, const scene_material *m) {
    if (!m->modifiers)
        return graze_material_attenuation(&m->reflector, hit->behind, 1);
    const graze_material patterned = appearance_reflector(p->context->scene, m, hit, p->length);
    return graze_material_attenuation(&patterned, hit->behind, 1);
}

/* What the way to a hit through a clear body leaves of the light; and of which body. */
static void attenuate(path *p, const path_hit *hit) {
    const graze_scene *scene = p->context->scene;
    /* What is open is as deep as the world: nothing comes through it from a source. */
    const scene_material *material = hit->surface >= 0 ? scene_material_at(scene, hit->surface) : NULL;
    /* A surface that is met from inside knows what is there, one between two bodies also what is before it. */
    if (material && scene_material_refracts(material) && (hit->behind || rgb_min(material->reflector.outside) < 1))
        p->medium = medium_at(p, hit, material);
    if (rgb_min(p->medium) == 1)
        return;
    rgb left = path_medium_transmittance(p, hit->distance);
    p->throughput = rgb_multiply(p->throughput, left);
    if (p->last.lobe == GRAZE_LOBE_NONE)
        return;
    p->last.direct = rgb_multiply(p->last.direct, left);
    p->last.indirect = rgb_multiply(p->last.indirect, left);
}

/* The eye is outside of all clear bodies, unless what it sees first is the inside of one. What a probe is put on in the
 * ray's place is not seen through it. */
static void begin_in_medium(path *p, const path_hit *first) {
    p->medium = rgb_gray(1);
    if (p->context->settings->quantity != GRAZE_IRRADIANCE_HIT)
        attenuate(p, first);
}

/* Whether light comes weakened to where the path is, however clear its way. */
static inline bool is_veiled(const path *p) {
    return p->in_mist || path_is_in_body(p);
}

/* Whether light from lights is asked for at the vertex that the path has come to. */
static inline bool asks_for_lights(const path *p) {
    return !p->context->record && !(p->gathering && p->depth == 0);
}

/* Decides where the path may go on, and which lights are to be sampled. */
static void decide(const path *p, gathering *here) {
    const vertex *v = &here->vertex;
    const bool nothing_between = !p->context->observer && !is_veiled(p) && (p->scattered || path_is_at_first(p));
    here->lobes = lobes_choose(p, v);
    here->cell = sight_cells_at(p->context->scene, v->surface, v->point);
    here->lit = nothing_between && asks_for_lights(p) && known_light_from_cells(p, v, here->cell, &here->direct);
    if (here->lit)
        light_choice_none(&here->lights);
    else
        direct_light_prepare(p, v, &here->lights);
}

/* The same for both sides of a surface that transmits. */
static void decide_for_both(const path *p, gathering *here, other_side *beyond) {
    here->lit = false;
    here->cell = sight_cells_at(p->context->scene, here->vertex.surface, here->vertex.point);
    lobes_choose_both(p, &here->vertex, &here->lobes, &beyond->lobes);
    direct_light_prepare(p, &here->vertex, &here->lights);
    direct_light_prepare_below(p, &here->vertex, beyond);
}

/* Of no light anything is known at the next vertex, or on its other side. */
static inline void forget_known_lights(path *p) {
    p->known.controls = p->known.settled = p->known.watched = p->known.clear = 0;
}

/* Light that comes from the other side, of which nothing is known without sampling. */
static void gather_below(path *p, const vertex *v, const other_side *beyond) {
    known_lights above = p->known;
    rare_gloss gloss = p->gloss;
    p->gloss = rare_gloss_beyond(p, v);
    forget_known_lights(p);
    if (light_choice_is_possible(&beyond->lights) && !p->context->record)
        direct_light_add_below(p, v, &beyond->lights, &beyond->lobes);
    p->known = above;
    p->gloss = gloss ? gloss : p->gloss;
}

/* What the way to a hit leaves of the light; apart from what all scenes need, which is faster without it. */
__attribute__((noinline)) static void hinder(path *p, vec3 point, const path_hit *hit) {
    if (p->context->scene->has_refraction)
        attenuate(p, hit);
    if (p->in_mist)
        mist_follow(p, point, hit->direction, hit->distance);
}

/* Goes to what the ray from a point meets, after the reflection at the vertex there, or a branch's. False: the path
 * ends there. */
static inline __attribute__((always_inline)) bool arrive(path *p, vec3 point, int64_t surface, const vertex *v,
                                                         vec3 direction, gathering *next) {
    const path_context *context = p->context;
    path_hit hit;
    path_cast_into(&hit, context, point, direction, GEOMETRY_FAR, surface);
    if (p->hindered)
        hinder(p, point, &hit);
    rgb found = hit.light >= 0 ? emission_found(p, &hit) : rgb_gray(0);
    p->radiance = rgb_add(p->radiance, found);
    observe_ray(p, point, &hit, found);
    if (p->hindered && context->scene->has_secondary)
        emission_pass_secondary(p, &hit);
    if (p->last.first && !(p->gathering && p->last.refracted))
        p->direct = p->radiance;
    if (v && p->gloss && !rgb_is_black(found))
        rare_gloss_find_met(p, v, &hit, found);
    if (v && (p->known.controls | p->known.watched))
        known_light_subtract_reflected(p, v, &hit, found);
    next->decided = false;
    if (!vertex_at_hit(p, &hit, &next->vertex))
        return false;
    if ((context->cache || context->record) && take_from_cache(p, &hit, &next->vertex))
        return false;
    p->length += hit.distance;
    return true;
}

__attribute__((noinline)) static bool arrive_by_branch(path *p, const path_branch *b, gathering *next) {
    return arrive(p, b->point, b->surface, NULL, b->direction, next);
}

/* Gathers light at a vertex and goes on from there until the path ends: from where a branch begins, if there is one. */
static void walk(path *p, gathering *here, const path_branch *branch, path_branches *branches) {
    const path_context *context = p->context;
    gathering later[2]; /* one of them has seen the lights that the last scattering refers to */
    other_side others[2], *beyond = others;
    if (branch) {
        here = &later[0];
        if (!arrive_by_branch(p, branch, here))
            return;
    }
    for (;;) {
        vertex *v = &here->vertex;
        const bool transmits = v->shading.transmits;
        if (transmits && p->last.lights == &beyond->lights)
            beyond = beyond == others ? others + 1 : others;
        p->ambient_limit = v->no_ambient ? 0 : context->settings->ambient_bounces;
        bool decided = here->decided;
        if (!path_bounces_left(p))
            add_ambient_value(p, v);
        take_indirect(p, v);
        if (transmits)
            decide_for_both(p, here, beyond);
        else if (!decided)
            decide(p, here);
        forget_known_lights(p);
        p->gloss = rare_gloss_at(p, v);
        if (here->lit) {
            known_light_settle_all(p, here->direct);
        } else if (light_choice_is_possible(&here->lights) && asks_for_lights(p)) {
            if (!context->observer && !is_veiled(p))
                known_light_add(p, v, here->cell, &here->lights);
            if (!p->scattered && !path_is_at_first(p) && !p->unmet && !context->observer)
                unmet_light_expect(p, here);
            direct_light_add(p, v, &here->lights, &here->lobes);
        }
        if (transmits)
            gather_below(p, v, beyond);
        if (context->scene->mirror_count > 0 && !context->record)
            mirrored_light_add(p, v, &here->lobes);
        if (here->lobes.specular_splits || (transmits && beyond->lobes.specular_splits))
            lobes_split(p, v, &here->lobes, transmits ? &beyond->lobes : NULL, branches);
        const bool ends = !transmits && !lobes_may_reflect(&here->lobes);
        /* Where it was not all for an earlier path, it is not for this one. */
        if (!ends && !context->observer && !is_veiled(p) && !decided && known_light_is_all(p, v, &here->lights))
            return;
        here->decided = !v->drawn;
        if (ends)
            return;
        vec3 direction;
        bool goes_on = transmits ? lobes_go_on(p, here, beyond, &direction)
                                 : lobes_reflect(p, v, &here->lights, &here->lobes, &direction);
        if (!goes_on)
            return;
        here = p->last.vertex == &later[0].vertex ? &later[1] : &later[0];
        if (!arrive(p, v->point, v->surface, v, direction, here))
            return;
    }
}

/* What has been found since the path scattered, but for what came straight from lights then, is indirect. */
static void end_branch(path *p) {
    if (p->unmet)
        unmet_light_settle(p);
    if (p->scattered)
        p->indirect_light = rgb_add(rgb_add_scaled(p->radiance, -1, p->direct), p->indirect_light);
}

/* Branches draw from groups of their own, so that their points are even however long the others are. */
#define GROUPS_OF_BRANCH 4096u

static void begin_branch(path *p, const path_branch *b, int number) {
    p->noisy = p->noisy || p->sampler->group != p->first_group;
    p->first_group = p->sampler->group = (uint32_t)number * GROUPS_OF_BRANCH;
    p->length = b->length;
    p->throughput = b->throughput;
    p->medium = b->medium;
    p->last = b->last;
    p->depth = b->depth;
    p->passages = b->passages;
    p->known = (known_lights){.shared = true};
    p->wanted = WANTED_ALL;
    p->gloss = RARE_GLOSS_NONE;
    p->ambient_depth = 0;
    p->scattered = false;
}

/* Follows the path from a vertex, and all of its branches. */
static void follow(path *p, gathering *here) {
    path_branches branches;
    branches.count = 0;
    walk(p, here, NULL, &branches);
    end_branch(p);
    for (int number = 1; branches.count > 0; number++) {
        const path_branch next = branches.waiting[--branches.count];
        begin_branch(p, &next, number);
        walk(p, here, &next, &branches);
        end_branch(p);
    }
}

/* Sets all but what is written before it is read: the last reflection, what it found, controls beyond their number, and
 * what the cache told. */
static void path_start(path *p, const path_context *context, sampler *points) {
    p->context = context;
    p->sampler = points;
    p->first_group = points->group;
    const graze_scene *scene = context->scene;
    p->in_mist = mist_is_there(context);
    p->hindered = p->in_mist || scene->has_panes || scene->has_refraction || scene->has_secondary;
    p->branches = 0;
    p->noisy = false;
    p->length = 0;
    p->throughput = (rgb){1, 1, 1};
    p->radiance = p->indirect_light = p->albedo = (rgb){0, 0, 0};
    p->ambient_depth = p->depth = p->passages = p->gleam_depth = 0;
    p->scattered = p->searching = false;
    p->last.lobe = GRAZE_LOBE_NONE;
    p->last.lights = NULL;
    p->last.vertex = NULL;
    p->last.first = true;
    p->last.refracted = p->last.veiled = false;
    p->last.travelled = 0;
    p->known = (known_lights){.shared = false};
    p->wanted = WANTED_ALL;
    p->integrated = p->cached = p->gathering = p->indirect_known = false;
    p->control_count = 0;
    p->unmet = NULL;
    p->rare = (path_rare){.times = 0};
}

static void path_end(const path *p, path_sample *sample) {
    sample->radiance = p->radiance;
    sample->cached = p->cached;
    sample->known_error = p->indirect_known ? p->indirect_error : rgb_gray(0);
    for (int i = 0; i < IRRADIANCE_PARTS && p->cached; i++)
        sample->told[i] = p->told[i];
    sample->control_count = p->control_count;
    sample->rare = p->rare;
    sample->unmet = p->context->memory ? &p->context->memory->unmet : NULL;
    sample->noisy = p->noisy || p->sampler->group != p->first_group;
    sample->searching = p->searching;
    sample->integrated = p->integrated;
    sample->indirect = p->indirect_light;
    sample->albedo = p->albedo;
    for (int i = 0; i < p->control_count; i++)
        sample->controls[i] = p->controls[i];
}

/* Where a path begins: in the memory, if others begin there, too. */
static gathering *begin_at(const path_context *context, gathering *own) {
    bool alike = context->memory && context->memory->alike;
    own->decided = false;
    return alike ? &context->memory->first : own;
}

/* Through mist to the first hit; what is scattered on the way no mirror shows. */
static void follow_first(path *p, const path_hit *first) {
    vec3 origin = first->point;
    if (first->surface >= 0)
        origin = vec3_add_scaled(origin, -first->distance, first->direction);
    mist_follow(p, origin, first->direction, first->distance);
    if (p->context->settings->part == GRAZE_MIRRORED)
        p->radiance = rgb_gray(0);
}

void path_radiance(const path_context *context, const path_hit *first, sampler *points, path_sample *sample) {
    path p;
    path_start(&p, context, points);
    gathering own, *here = begin_at(context, &own);
    vertex *v = &here->vertex;
    path_hit beyond;
    if (context->scene->has_refraction)
        begin_in_medium(&p, first);
    if (context->settings->quantity == GRAZE_IRRADIANCE_HIT) {
        beyond = panes_look_through(context, first);
        first = &beyond;
    }
    if (p.in_mist)
        follow_first(&p, first);
    if (first->light >= 0 && context->settings->part != GRAZE_MIRRORED)
        p.radiance = rgb_add(p.radiance, emission_found(&p, first));
    if (here->decided || (vertex_at_hit(&p, first, v) && vertex_keep_part(v, context->settings->part))) {
        bool probe = context->settings->quantity == GRAZE_IRRADIANCE_HIT;
        p.length = first->distance;
        p.albedo = probe ? rgb_gray(1) : rgb_add(v->shading.diffuse, v->shading.specular);
        if (!probe && v->shading.transmits)
            p.albedo = rgb_add(p.albedo, rgb_add(v->shading.transmitted_diffuse, v->shading.transmitted_specular));
        follow(&p, here);
    }
    path_end(&p, sample);
}

/* A path that begins at a vertex, as if it had been reflected diffusely that often. */
static void path_from(const path_context *context, sampler *points, vertex v, int ambient_depth, wanted_light wanted,
                      path_sample *sample) {
    path p;
    path_start(&p, context, points);
    p.ambient_depth = ambient_depth;
    p.wanted = wanted;
    p.medium = rgb_gray(1);
    gathering own, *here = begin_at(context, &own);
    here->vertex = v;
    follow(&p, here);
    path_end(&p, sample);
}

void path_irradiance(const path_context *context, vec3 point, vec3 normal, sampler *points, path_sample *sample) {
    path_from(context, points, vertex_of_sensor(point, normal), 0, WANTED_ALL, sample);
}

void path_irradiance_at(const path_context *context, const irradiance_record *record, sampler *points,
                        path_sample *sample) {
    path_from(context, points, vertex_of_point(record->point, record->normal, record->surface), 1, WANTED_STRAIGHT,
              sample);
}

bool path_asks_indirect(const path_context *context, const path_hit *first, irradiance_record *record) {
    path p;
    vertex v;
    path_start(&p, context, &(sampler){.key = 0});
    if (!vertex_at_hit(&p, first, &v) || rgb_is_black(v.shading.diffuse) || !reflects_plainly(&v))
        return false;
    *record = (irradiance_record){v.point, v.normal, v.surface, first->distance};
    return true;
}

void path_indirect_at(const path_context *context, const irradiance_record *record, sampler *points,
                      path_sample *sample) {
    path p;
    path_start(&p, context, points);
    p.gathering = true;
    p.medium = rgb_gray(1);
    p.wanted = WANTED_STRAIGHT;
    gathering own, *here = begin_at(context, &own);
    here->vertex = vertex_of_point(record->point, record->normal, record->surface);
    follow(&p, here);
    path_end(&p, sample);
}
