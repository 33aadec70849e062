/* Choosing and drawing lobes; Russian roulette. */
#include "trace/lobes.h"

#include "base/angle.h"
#include "trace/mirrored_light.h"
#include "trace/vertex.h"

/* Beyond this many reflections every path plays roulette, so that a room of perfect mirrors ends. */
#define ENDLESS_DEPTH    64
#define ENDLESS_SURVIVAL 0.9
/* From this many reflections on, paths that carry less than this survive in proportion to what they carry. With 1 in
 * its place the few that survive carry as much as a first reflection does, and now and then bring a pixel more light
 * than all others: rooms then took 1.3 times as long to the same error. */
#define ROULETTE_DEPTH  4
#define ROULETTE_WEIGHT 0.3

/* Surfaces that reflect more than they receive are warned about, not refused. Between two of them light grows without
 * bound; its path ends here, long before numbers overflow. */
#define LARGEST_THROUGHPUT 1e30

/* How likely a path goes on with a lobe of this reflectance; 0 where -lr or -lw end it. Below the minimum weight, and
 * deep down, survival falls with what the path would carry. */
static double survival(const path *p, rgb reflectance) {
    const graze_trace_settings *s = p->context->settings;
    double weight = rgb_max(rgb_multiply(p->throughput, reflectance));
    int limit = s->reflection_limit < 0 ? -s->reflection_limit : s->reflection_limit;
    if (weight <= 0 || (limit != 0 && p->depth >= limit))
        return 0;
    double chance = 1;
    if (weight < s->minimum_weight) {
        if (s->reflection_limit > 0)
            return 0;
        chance = weight / s->minimum_weight;
    }
    if (p->depth >= ROULETTE_DEPTH)
        chance = fmin(chance, fmax(weight / ROULETTE_WEIGHT, 0.05));
    return p->depth >= ENDLESS_DEPTH ? fmin(chance, ENDLESS_SURVIVAL) : chance;
}

/* How likely a path is let through: as often as one may have to be. One that only looks for lights carries what these
 * would give. */
static double passage_chance(const path *p, rgb transmittance) {
    const graze_trace_settings *s = p->context->settings;
    rgb carried = p->throughput;
    if (rgb_is_black(carried))
        carried = rgb_add(p->last.direct, p->last.indirect);
    double weight = rgb_max(rgb_multiply(carried, transmittance));
    double chance = weight < s->minimum_weight ? weight / s->minimum_weight : 1;
    return p->depth + p->passages >= ENDLESS_DEPTH ? fmin(chance, ENDLESS_SURVIVAL) : chance;
}

/* Whether light is found by a lobe that may not go on, too: where Eq. 16 stands alone, and a gloss where it shares,
 * which light samples might miss, as they mostly do a sky that is seen through windows; and what is refracted on its
 * way no light sample finds. */
static inline bool finds_lights(const path *p, graze_lobe lobe) {
    const graze_trace_settings *s = p->context->settings;
    const graze_scene *scene = p->context->scene;
    bool glossy = lobe == GRAZE_LOBE_GLOSSY || lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY;
    bool shares = scene->has_refraction || (s->strategy == GRAZE_STRATEGY_MIS &&
                                            (glossy || (p->indirect_known && p->depth == 0 && scene->has_sky)));
    return scene->light_count > 0 && (shares || !context_samples_lights(s));
}

/* Where lights are sampled, a second or later reflection that carries less than this is followed less often: it adds
 * little to the variance, and the rest of the path costs what it costs. */
#define WORTH_FOLLOWING 0.1

/* What a path carries that counts for that. One that was drawn about a gleam carries less the more often it would have
 * been, and is worth following for that. */
static inline double worth_following(const path *p, rgb reflectance) {
    double carried = rgb_max(rgb_multiply(p->throughput, reflectance));
    return p->depth == p->gleam_depth ? carried / p->gleam_weight : carried;
}

/* A lobe that matters little still gets a tenth, lest its rare samples carry huge weights. */
#define LEAST_SHARE 0.1

/* A path that only looks for bent light goes on so often, where it goes on at all: there is little of that. */
#define LOOKS_ON 0.25

/* How likely the path takes a lobe. One that may not go on is taken only to find lights. */
static inline double lobe_chance(const path *p, graze_lobe lobe, rgb reflectance, bool goes_on, bool *ends) {
    double chance = goes_on ? survival(p, reflectance) : 0;
    *ends = chance == 0;
    if (*ends)
        return finds_lights(p, lobe) && !rgb_is_black(reflectance) ? 1 : 0;
    if (context_samples_lights(p->context->settings) && p->depth > 0)
        chance = fmin(chance, fmax(worth_following(p, reflectance) / WORTH_FOLLOWING, 0.05));
    if (p->wanted == WANTED_BENT)
        chance *= LOOKS_ON;
    return chance;
}

/* The chances of what is reflected, each lobe by itself. */
static inline lobe_choice chances_above(const path *p, const vertex *v) {
    lobe_choice choice = {0};
    rgb matte = v->function ? rgb_add(v->ambient, v->function_color) : v->ambient;
    bool follows = path_bounces_left(p) && (!(p->indirect_known && p->depth == 0) || p->context->scene->has_refraction);
    choice.diffuse = lobe_chance(p, GRAZE_LOBE_DIFFUSE, matte, follows, &choice.diffuse_ends);
    if (v->shading.specular_lobe == GRAZE_LOBE_MIRROR)
        choice.specular =
            rgb_is_black(p->throughput) ? passage_chance(p, v->shading.specular) : survival(p, v->shading.specular);
    else if (v->shading.specular_lobe == GRAZE_LOBE_GLOSSY)
        choice.specular =
            lobe_chance(p, GRAZE_LOBE_GLOSSY, v->shading.specular, !v->gloss_is_ambient, &choice.specular_ends);
    return choice;
}

/* And of what is transmitted. */
static lobe_choice chances_below(const path *p, const vertex *v) {
    const graze_surface *s = &v->shading;
    lobe_choice choice = {0};
    rgb matte = v->function ? rgb_add(v->transmitted_ambient, v->transmitted_function) : v->transmitted_ambient;
    choice.diffuse = lobe_chance(p, GRAZE_LOBE_TRANSMITTED_DIFFUSE, matte, path_bounces_left(p), &choice.diffuse_ends);
    if (s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED)
        choice.specular = passage_chance(p, s->transmitted_specular);
    else if (s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY)
        choice.specular = lobe_chance(p, GRAZE_LOBE_TRANSMITTED_GLOSSY, s->transmitted_specular,
                                      !v->transmitted_gloss_is_ambient, &choice.specular_ends);
    return choice;
}

/* What a mirror shows, and what is behind a pane, are followed both as long as a path has not been scattered, and
 * carries so much there; and not more often than there is room for. Where light is reflected diffusely again and again,
 * that makes most of the noise, and a branch costs a path: then only what mirrors on top of the rest, and so much of
 * it, is worth one. Branches at panes took 1.3 to 2 times as long as lots to the same error there, and at clear bodies
 * 1.1 to 1.3 times. */
#define WORTH_SPLITTING       0.02
#define WORTH_SPLITTING_NOISE 0.3

static bool splits_off(const path *p, const vertex *v, graze_lobe lobe, double chance, rgb reflectance) {
    bool noise = p->context->settings->ambient_bounces > 0;
    return (lobe == GRAZE_LOBE_MIRROR || lobe == GRAZE_LOBE_TRANSMITTED) && chance >= 1 && !p->scattered &&
           !(noise && v->shading.transmits) && p->branches + 2 < PATH_BRANCHES && !p->context->observer &&
           !p->context->record &&
           rgb_max(rgb_multiply(p->throughput, reflectance)) >= (noise ? WORTH_SPLITTING_NOISE : WORTH_SPLITTING);
}

static void split(lobe_choice *choice) {
    choice->specular = 0;
    choice->specular_splits = true;
}

lobe_choice lobes_choose(const path *p, const vertex *v) {
    lobe_choice choice = chances_above(p, v);
    double diffuse = choice.diffuse, specular = choice.specular;
    if (diffuse == 0 || specular == 0)
        return choice;
    if (splits_off(p, v, v->shading.specular_lobe, specular, v->shading.specular)) {
        split(&choice);
        return choice;
    }
    double diffuse_share = diffuse * rgb_brightness(v->ambient);
    double specular_share = specular * rgb_brightness(v->shading.specular);
    double share = fmin(fmax(diffuse_share / (diffuse_share + specular_share), LEAST_SHARE), 1 - LEAST_SHARE);
    choice.diffuse = fmax(diffuse, specular) * share;
    choice.specular = fmax(diffuse, specular) * (1 - share);
    return choice;
}

/* The chances of all four lobes, each by itself, are divided in proportion to what they lead to. */
void lobes_choose_both(const path *p, const vertex *v, lobe_choice *above, lobe_choice *below) {
    const graze_surface *s = &v->shading;
    double *const chances[] = {&above->diffuse, &above->specular, &below->diffuse, &below->specular};
    const rgb reflectances[] = {v->ambient, s->specular, v->transmitted_ambient, s->transmitted_specular};
    double shares[4], sum = 0, most = 0;
    *above = chances_above(p, v);
    *below = chances_below(p, v);
    int lobes = (above->diffuse > 0) + (above->specular > 0) + (below->diffuse > 0) + (below->specular > 0);
    if (lobes > 1 && splits_off(p, v, s->specular_lobe, above->specular, s->specular)) {
        split(above);
        lobes--;
    }
    if (lobes > 1 && splits_off(p, v, s->transmitted_lobe, below->specular, s->transmitted_specular))
        split(below);
    for (int i = 0; i < 4; i++)
        sum += *chances[i] * rgb_brightness(reflectances[i]);
    for (int i = 0; i < 4; i++) {
        shares[i] = *chances[i] > 0 ? LEAST_SHARE : 0;
        if (sum > 0)
            shares[i] = fmax(shares[i], *chances[i] * rgb_brightness(reflectances[i]) / sum);
        most = fmax(most, *chances[i]);
    }
    sum = shares[0] + shares[1] + shares[2] + shares[3];
    for (int i = 0; i < 4 && sum > 0; i++)
        *chances[i] = most * (shares[i] / sum);
}

/* Whether a reflection in this direction may meet lights that no light sample finds: all of them, or those seen in a
 * mirror or by refraction. */
static bool is_search(const path *p, graze_lobe lobe) {
    return lobe != GRAZE_LOBE_MIRROR &&
           (!context_samples_lights(p->context->settings) || p->context->scene->has_mirrors);
}

/* Whether it may meet, first of all, what the sun shines on through windows. Paths seldom find such a spot, which is
 * then much brighter than the sky that others find in the windows, evenly enough to be believed too soon. */
static bool is_search_for_sun(const path *p, const light_choice *lights, bool diffuse) {
    return diffuse && p->ambient_depth == 0 && p->context->scene->sun_comes_in && lights->windows.count > 0 &&
           !p->context->cache;
}

/* A rejected direction is drawn again, up to a hundred times. One of two is kept at least for roughnesses up to 1.2 or
 * so, and the end is then never reached; of a roughness of 10, one of a hundred. */
static graze_surface_sample draw_unweighted(path *p, const graze_surface *s, const double random[2]) {
    graze_surface_sample sample = graze_surface_sample_unweighted(s, random[0], random[1]);
    for (int i = 0; i < 100 && rgb_is_black(sample.weight); i++) {
        double again[2];
        sampler_2d(p->sampler, again);
        sample = graze_surface_sample_unweighted(s, again[0], again[1]);
    }
    return sample;
}

static inline graze_surface_sample draw_direction(path *p, const graze_surface *s, graze_lobe lobe,
                                                  const double random[3]) {
    if (lobe == GRAZE_LOBE_GLOSSY && p->context->settings->strategy == GRAZE_STRATEGY_UNWEIGHTED)
        return draw_unweighted(p, s, random);
    return graze_surface_sample_lobe(s, lobe, random[0], random[1], random[2]);
}

/* Draws what it takes to choose a lobe, in random[3], and a direction. Where there is no choice no number is drawn for
 * it; a diffuse direction takes two, a mirror's none. */
static void draw_numbers(path *p, graze_lobe specular, lobe_choice choice, double random[4]) {
    if (choice.specular == 0 && choice.diffuse >= 1)
        sampler_2d(p->sampler, random);
    else if (choice.diffuse > 0 || choice.specular < 1)
        sampler_4d(p->sampler, random);
    else if (specular != GRAZE_LOBE_MIRROR)
        sampler_3d(p->sampler, random);
}

/* Whether what the path carries is what numbers hold. */
static bool is_bounded(const path *p) {
    return rgb_max(p->last.direct) <= LARGEST_THROUGHPUT && rgb_max(p->last.indirect) <= LARGEST_THROUGHPUT;
}

/* What is known of light on the viewer's side does not matter on the other. */
static void go_below(path *p, const vertex *v) {
    p->known.controls = p->known.settled = 0;
    if (p->context->scene->has_refraction)
        p->medium = v->beyond;
}

/* Of a mixture it is only known now whether the viewer is in a clear body. */
static inline void stay_above(path *p, const vertex *v) {
    if (p->context->scene->has_refraction)
        p->medium = v->before;
}

/* Lets the path go on in a lobe's one direction as if it had not been stopped. */
static bool carry_on(path *p, const vertex *v, graze_lobe lobe, double chance, vec3 *direction) {
    graze_surface_sample sample = graze_surface_sample_lobe(&v->shading, lobe, 0, 0, 0);
    if (v->leans && vec3_dot(sample.direction, v->normal) >= 0)
        return false;
    rgb weight = rgb_scale(1 / chance, sample.weight);
    p->throughput = rgb_multiply(p->throughput, weight);
    p->last.travelled += v->distance;
    *direction = sample.direction;
    if (p->last.lobe == GRAZE_LOBE_NONE)
        return rgb_max(p->throughput) <= LARGEST_THROUGHPUT;
    p->last.direct = rgb_multiply(p->last.direct, weight);
    p->last.indirect = rgb_multiply(p->last.indirect, weight);
    return is_bounded(p);
}

/* Lets the path through. What a light sample would have found beyond it may still find, unless it is refracted. */
static bool pass(path *p, const vertex *v, double chance, vec3 *direction) {
    p->last.refracted = p->last.refracted || v->refracts;
    p->searching = p->searching || (p->last.refracted && p->last.first && p->scattered);
    p->passages++;
    go_below(p, v);
    return carry_on(p, v, GRAZE_LOBE_TRANSMITTED, chance, direction);
}

/* Whether lights in the mirror that the path has come to are sampled where it was scattered last. */
static bool is_image(const path *p, const vertex *v) {
    return p->context->scene->mirror_count > 0 && mirrored_light_is_in(p->context->scene, v->surface) &&
           lobe_scatters(p->last.lobe);
}

/* Light samples find what one mirror shows to the viewer's side of where the path was scattered. */
static bool reflect_image(path *p, const vertex *v, double chance, vec3 *direction) {
    bool sampled = p->last.mirror < 0 && p->last.lobe < GRAZE_LOBE_MIRROR;
    p->last.refracted = p->last.refracted || !sampled;
    p->last.mirror = (int)v->surface;
    p->depth++;
    return carry_on(p, v, GRAZE_LOBE_MIRROR, chance, direction);
}

/* After so many diffuse reflections gleams are left to luck: little is seen of them by then, and where weights are
 * multiplied again and again, they scatter. */
#define GLEAM_BOUNCES 2

/* The gleams that a diffuse reflection is to look for: at the first point of all paths they are known. */
static gleams *gleams_at(const path *p, const vertex *v, gleams *own) {
    const graze_scene *scene = p->context->scene;
    path_memory *memory = p->context->memory;
    if (!path_is_at_first(p) || !memory || !memory->alike) {
        gleams_expect(own, scene, v->point, v->shading.n);
        return own->count > 0 ? own : NULL;
    }
    if (!memory->gleams_found)
        gleams_look(&memory->gleams, scene, v->point, v->shading.n, v->surface);
    memory->gleams_found = true;
    return memory->gleams.count > 0 ? &memory->gleams : NULL;
}

/* A diffuse direction, and what its weight is to be multiplied by. */
__attribute__((noinline)) static bool draw_by_gleams(path *p, const vertex *v, const double random[2],
                                                     graze_surface_sample *sample, double *weight) {
    gleams own;
    gleams *toward = gleams_at(p, v, &own);
    double turned[3] = {random[0], random[1], 0};
    if (toward && !gleams_turn(toward, &v->shading, turned))
        return false;
    *sample = draw_direction(p, &v->shading, GRAZE_LOBE_DIFFUSE, turned);
    if (!toward)
        return true;
    p->gleam_weight = gleams_weight(toward, sample->direction, v->shading.n);
    p->gleam_depth = p->depth + 1;
    *weight *= p->gleam_weight;
    return p->gleam_weight > 0;
}

/* Draws a direction of a lobe that goes on, or `ends`; its weight is to be multiplied by *scale. False: none. */
static inline __attribute__((always_inline)) bool draw_lobe(path *p, const vertex *v, graze_lobe lobe, bool ends,
                                                            const double random[4], graze_surface_sample *sample,
                                                            double *scale) {
    if (p->context->scene->balls && lobe == GRAZE_LOBE_DIFFUSE && !ends && p->ambient_depth < GLEAM_BOUNCES) {
        if (!draw_by_gleams(p, v, random, sample, scale))
            return false;
    } else {
        *sample = draw_direction(p, &v->shading, lobe, random);
    }
    /* The function is found by diffuse samples. */
    if (v->function && (lobe == GRAZE_LOBE_DIFFUSE || lobe == GRAZE_LOBE_TRANSMITTED_DIFFUSE))
        sample->weight = rgb_add_scaled(sample->weight, PI, vertex_function_value(v, sample->direction));
    return true;
}

/* Of a surface that leans: false where the direction leads into it, or not into it. A mirror reflects by the surface's
 * own normal then, as Radiance's. */
static bool keep_to_side(const vertex *v, graze_lobe lobe, bool below, vec3 *direction) {
    if ((vec3_dot(*direction, v->normal) <= 0) == below)
        return true;
    if (lobe != GRAZE_LOBE_MIRROR)
        return false;
    *direction = vec3_add_scaled(vec3_negate(v->shading.view), 2 * vec3_dot(v->shading.view, v->normal), v->normal);
    return true;
}

/* The path has been reflected, or transmitted, by the lobe. */
static inline void count_scattering(path *p, const light_choice *lights, graze_lobe lobe, bool diffuse) {
    if (diffuse && p->indirect_known && p->depth == 0 && p->context->scene->has_refraction)
        p->wanted = WANTED_BENT;
    p->depth++;
    p->searching = p->searching || is_search(p, lobe) || is_search_for_sun(p, lights, diffuse);
    p->ambient_depth += diffuse;
    p->scattered = p->scattered || lobe != GRAZE_LOBE_MIRROR;
}

/* Goes on with one of the lobes of a side, by random[3], which is below the sum of their chances or means the end.
 * Where there is nothing but one side the other costs nothing. */
static inline __attribute__((always_inline)) bool go_on(path *p, const vertex *v, const light_choice *lights,
                                                        const lobe_choice *choice, bool below, const double random[4],
                                                        vec3 *direction) {
    bool diffuse = random[3] < choice->diffuse;
    if (!diffuse && random[3] >= choice->diffuse + choice->specular)
        return false;
    graze_lobe diffuse_lobe = below ? GRAZE_LOBE_TRANSMITTED_DIFFUSE : GRAZE_LOBE_DIFFUSE;
    graze_lobe specular_lobe = below ? v->shading.transmitted_lobe : v->shading.specular_lobe;
    graze_lobe lobe = diffuse ? diffuse_lobe : specular_lobe;
    if (below && lobe == GRAZE_LOBE_TRANSMITTED)
        return pass(p, v, choice->specular, direction);
    if (!below && lobe == GRAZE_LOBE_MIRROR && is_image(p, v))
        return reflect_image(p, v, choice->specular, direction);
    bool ends = diffuse ? choice->diffuse_ends : choice->specular_ends;
    double chance = diffuse ? choice->diffuse : choice->specular, scale = 1 / chance;
    graze_surface_sample sample;
    if (!draw_lobe(p, v, lobe, ends, random, &sample, &scale))
        return false;
    /* The weight of a diffuse sample is its reflectance: for `light`s that of the diffuse part alone. */
    rgb indirect = !diffuse ? sample.weight : below ? v->transmitted_ambient : v->ambient;
    rgb onward = ends ? rgb_gray(0) : indirect;
    if (rgb_is_black(sample.weight) && rgb_is_black(onward))
        return false;
    if (v->leans && !keep_to_side(v, lobe, below, &sample.direction))
        return false;
    bool gloss_is_ambient = below ? v->transmitted_gloss_is_ambient : v->gloss_is_ambient;
    bool ambient = diffuse ? path_bounces_left(p) : !gloss_is_ambient;
    p->last = (scattering){
        .lobe = lobe,
        .density = sample.density * chance,
        .direct = rgb_scale(scale, rgb_multiply(p->throughput, sample.weight)),
        .indirect = rgb_scale(scale, rgb_multiply(p->throughput, indirect)),
        .ambient = ambient && (!ends || p->context->settings->back_faces_visible),
        .lights = lights,
        .vertex = v,
        .mirror = -1,
        .first = !p->scattered,
    };
    p->throughput = rgb_scale(scale, rgb_multiply(p->throughput, onward));
    if (!is_bounded(p))
        return false;
    if (below)
        go_below(p, v);
    count_scattering(p, lights, lobe, diffuse);
    *direction = sample.direction;
    return true;
}

bool lobes_reflect(path *p, const vertex *v, const light_choice *lights, const lobe_choice *choice, vec3 *direction) {
    double random[4] = {0, 0, 0, 0};
    draw_numbers(p, v->shading.specular_lobe, *choice, random);
    stay_above(p, v);
    return go_on(p, v, lights, choice, false, random, direction);
}

bool lobes_go_on(path *p, const gathering *here, const other_side *beyond, vec3 *direction) {
    const vertex *v = &here->vertex;
    const lobe_choice *above = &here->lobes, *below = &beyond->lobes;
    double reflected = above->diffuse + above->specular, transmitted = below->diffuse + below->specular;
    if (reflected + transmitted == 0)
        return false;
    double random[4] = {0, 0, 0, 0};
    bool only_through = v->shading.transmitted_lobe == GRAZE_LOBE_TRANSMITTED && below->specular >= 1;
    if (!only_through)
        sampler_4d(p->sampler, random);
    if (random[3] < reflected) {
        stay_above(p, v);
        return go_on(p, v, &here->lights, above, false, random, direction);
    }
    random[3] -= reflected;
    return go_on(p, v, &beyond->lights, below, true, random, direction);
}

/* What the path would be if it went on there is put by, and the path left as it is. */
static void put_by(path *p, const vertex *v, bool below, path_branches *branches) {
    static const lobe_choice alone = {.specular = 1};
    static const double random[4] = {0, 0, 0, 0};
    path there = *p;
    if (!below)
        stay_above(&there, v);
    path_branch *b = &branches->waiting[branches->count];
    if (!go_on(&there, v, NULL, &alone, below, random, &b->direction))
        return;
    b->point = v->point;
    b->surface = v->surface;
    b->length = there.length;
    b->throughput = there.throughput;
    b->medium = there.medium;
    b->last = there.last;
    b->last.vertex = NULL;
    b->depth = there.depth;
    b->passages = there.passages;
    branches->count++;
    p->branches++;
}

void lobes_split(path *p, const vertex *v, const lobe_choice *above, const lobe_choice *below,
                 path_branches *branches) {
    if (above->specular_splits)
        put_by(p, v, false, branches);
    if (below && below->specular_splits)
        put_by(p, v, true, branches);
}
