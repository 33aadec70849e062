/* Choosing and drawing lobes; Russian roulette. */
#include "trace/lobes.h"

#include "base/angle.h"
#include "trace/vertex.h"

/* Beyond this many reflections every path plays roulette, so that a room of perfect mirrors ends. */
#define ENDLESS_DEPTH    64
#define ENDLESS_SURVIVAL 0.9
/* From this many reflections on, paths survive in proportion to what they carry. */
#define ROULETTE_DEPTH 4

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
        chance = fmin(chance, fmax(weight, 0.05));
    return p->depth >= ENDLESS_DEPTH ? fmin(chance, ENDLESS_SURVIVAL) : chance;
}

/* Whether light is found by a lobe that may not go on, too: where Eq. 16 stands alone, and a gloss where it shares,
 * which light samples might miss. */
static bool finds_lights(const path *p, graze_lobe lobe) {
    const graze_trace_settings *s = p->context->settings;
    bool shares = s->strategy == GRAZE_STRATEGY_MIS && lobe == GRAZE_LOBE_GLOSSY;
    return p->context->scene->light_count > 0 && (shares || !context_samples_lights(s));
}

/* Where lights are sampled, a second or later reflection that carries less than this is followed less often: it adds
 * little to the variance, and the rest of the path costs what it costs. */
#define WORTH_FOLLOWING 0.1

/* How likely the path takes a lobe. One that may not go on is taken only to find lights. */
static double lobe_chance(const path *p, graze_lobe lobe, rgb reflectance, bool goes_on, bool *ends) {
    double chance = goes_on ? survival(p, reflectance) : 0;
    if (context_samples_lights(p->context->settings) && p->depth > 0)
        chance = fmin(chance, fmax(rgb_max(rgb_multiply(p->throughput, reflectance)) / WORTH_FOLLOWING, 0.05));
    *ends = chance == 0;
    return *ends && finds_lights(p, lobe) && !rgb_is_black(reflectance) ? 1 : chance;
}

lobe_choice lobes_choose(const path *p, const vertex *v) {
    lobe_choice choice = {0};
    rgb matte = v->function ? rgb_add(v->ambient, v->function_color) : v->ambient;
    double diffuse = lobe_chance(p, GRAZE_LOBE_DIFFUSE, matte, path_bounces_left(p), &choice.diffuse_ends);
    double specular = 0;
    if (v->shading.specular_lobe == GRAZE_LOBE_MIRROR)
        specular = survival(p, v->shading.specular);
    else if (v->shading.specular_lobe == GRAZE_LOBE_GLOSSY)
        specular = lobe_chance(p, GRAZE_LOBE_GLOSSY, v->shading.specular, !v->gloss_is_ambient, &choice.specular_ends);
    choice.diffuse = diffuse;
    choice.specular = specular;
    if (diffuse == 0 || specular == 0)
        return choice;
    double diffuse_share = diffuse * rgb_brightness(v->ambient);
    double specular_share = specular * rgb_brightness(v->shading.specular);
    /* A lobe that matters little still gets a tenth, lest its rare samples carry huge weights. */
    double share = fmin(fmax(diffuse_share / (diffuse_share + specular_share), 0.1), 0.9);
    choice.diffuse = fmax(diffuse, specular) * share;
    choice.specular = fmax(diffuse, specular) * (1 - share);
    return choice;
}

/* Whether a reflection in this direction may meet lights that no light sample finds: all of them, or those seen in a
 * mirror. */
static bool is_search(const path *p, graze_lobe lobe) {
    return lobe != GRAZE_LOBE_MIRROR &&
           (!context_samples_lights(p->context->settings) || p->context->scene->has_mirrors);
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

static graze_surface_sample draw_direction(path *p, const graze_surface *s, graze_lobe lobe, const double random[3]) {
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

bool lobes_reflect(path *p, const vertex *v, const light_choice *lights, lobe_choice choice, vec3 *direction) {
    if (choice.diffuse + choice.specular == 0)
        return false;
    double random[4] = {0, 0, 0, 0};
    draw_numbers(p, v->shading.specular_lobe, choice, random);
    bool diffuse = random[3] < choice.diffuse;
    if (!diffuse && random[3] >= choice.diffuse + choice.specular)
        return false;
    graze_lobe lobe = diffuse ? GRAZE_LOBE_DIFFUSE : v->shading.specular_lobe;
    bool ends = diffuse ? choice.diffuse_ends : choice.specular_ends;
    double scale = 1 / (diffuse ? choice.diffuse : choice.specular);
    graze_surface_sample sample = draw_direction(p, &v->shading, lobe, random);
    /* The function is found by diffuse samples. */
    if (v->function && diffuse)
        sample.weight = rgb_add_scaled(sample.weight, PI, vertex_function_value(v, sample.direction));
    /* The weight of a diffuse sample is its reflectance: for `light`s that of the diffuse part alone. */
    rgb onward = ends ? rgb_gray(0) : diffuse ? v->ambient : sample.weight;
    if (rgb_is_black(sample.weight) && rgb_is_black(onward))
        return false;
    if (v->leans && vec3_dot(sample.direction, v->normal) <= 0) {
        /* Into the surface: a mirror reflects by the surface's own normal then, as Radiance's. */
        if (lobe != GRAZE_LOBE_MIRROR)
            return false;
        sample.direction =
            vec3_add_scaled(vec3_negate(v->shading.view), 2 * vec3_dot(v->shading.view, v->normal), v->normal);
    }
    bool ambient = diffuse ? path_bounces_left(p) : !v->gloss_is_ambient;
    p->last = (scattering){
        .lobe = lobe,
        .density = sample.density / scale,
        .direct = rgb_scale(scale, rgb_multiply(p->throughput, sample.weight)),
        .indirect = rgb_scale(scale, rgb_multiply(p->throughput, diffuse ? v->ambient : sample.weight)),
        .ambient = ambient && (!ends || p->context->settings->back_faces_visible),
        .lights = lights,
    };
    p->throughput = rgb_scale(scale, rgb_multiply(p->throughput, onward));
    if (rgb_max(p->last.direct) > LARGEST_THROUGHPUT || rgb_max(p->last.indirect) > LARGEST_THROUGHPUT)
        return false;
    p->depth++;
    p->ambient_depth += diffuse;
    p->scattered = p->scattered || lobe != GRAZE_LOBE_MIRROR;
    p->searching = p->searching || is_search(p, lobe);
    *direction = sample.direction;
    return true;
}
