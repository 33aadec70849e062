/* Path tracing with next-event estimation.
 *
 * At each surface point, light arrives in two ways: from lights that are sampled (Eq. 18), and from wherever a sampled
 * reflection leads (Eq. 16). What both can find is weighted by the power heuristic. Radiance's rules of what counts are
 * kept: `light`s light everything; `glow`s light diffusely only where an ambient bounce is left; a diffuse reflection
 * costs an ambient bounce. */
#include "trace/path.h"

#include "base/angle.h"
#include "geometry/crossing.h"
#include "graze/material.h"
#include "scene/light.h"
#include "trace/unshadowed.h"

/* Beyond this many reflections every path plays roulette, so that a room of perfect mirrors ends. */
#define ENDLESS_DEPTH    64
#define ENDLESS_SURVIVAL 0.9
/* From this many reflections on, paths survive in proportion to what they carry. */
#define ROULETTE_DEPTH 4

/* Surfaces that reflect more than they receive are warned about, not refused. Between two of them light grows without
 * bound; its path ends here, long before numbers overflow. */
#define LARGEST_THROUGHPUT 1e30

/* Up to so many lights are all sampled, at the first point and at later ones; of more, one is chosen. */
#define EVERY_LIGHT_FIRST PATH_FIRST_CONTROLS
#define EVERY_LIGHT_LATER 2

/* A point that light is gathered at, and how the path got there. */
typedef struct vertex {
    vec3 point;
    int surface; /* -1: a sensor */
    graze_surface shading;
    rgb ambient; /* reflectance of the ambient term: diffuse, and lobes below the specular threshold */
    bool gloss_is_ambient;
} vertex;

/* The last reflection, as an emitter found next needs it. */
typedef struct scattering {
    graze_lobe lobe; /* NONE: the ray comes from the eye */
    double density;  /* of the direction, per unit solid angle, the choice of the lobe included */
    rgb direct;      /* throughput for LIGHT_DIRECT, which differs where a gloss was made ambient */
    rgb indirect;    /* throughput for LIGHT_AMBIENT, also where the path ends with this reflection */
    bool ambient;    /* LIGHT_AMBIENT counts */
    light_receiver receiver;
} scattering;

/* The lights at the last vertex whose unshadowed light is known, a bit each, and where to keep the control of the first
 * of them. */
typedef struct known_lights {
    unsigned lights;
    bool shared; /* one control for all */
} known_lights;

typedef struct path {
    const path_context *context;
    sampler *sampler;
    rgb throughput, radiance;
    int ambient_depth; /* diffuse reflections so far */
    int depth;         /* all reflections so far */
    bool scattered;    /* whether any of them was not a mirror's */
    bool searching;    /* whether one may meet lights that no light sample finds */
    scattering last;
    known_lights known;
    path_control controls[PATH_CONTROLS];
    int control_count;
} path;

path_hit path_cast(const path_context *context, vec3 origin, vec3 direction, double limit, int from) {
    const graze_scene *scene = context->scene;
    path_hit hit = {.surface = -1, .light = -1, .distance = GEOMETRY_FAR, .point = origin, .direction = direction};
    geometry_ray ray = {.origin = origin, .direction = direction, .far = limit, .from = from};
    geometry_hit found;
    double travelled = 0;
    while (geometry_intersect(scene->geometry, &ray, &found)) {
        bool behind = vec3_dot(found.normal, direction) > 0;
        if (!behind || context->settings->back_faces_visible) {
            hit.surface = found.surface;
            hit.light = scene->surfaces[found.surface].light;
            hit.distance = travelled + found.distance;
            hit.point = found.point;
            hit.normal = found.normal;
            hit.behind = behind;
            return hit;
        }
        hit.passed = true;
        travelled += found.distance;
        ray.origin = found.point;
        ray.far -= found.distance;
        ray.from = found.surface;
    }
    if (limit >= GEOMETRY_FAR)
        hit.light = light_source_towards(scene, direction);
    return hit;
}

/* A Lambertian surface that turns irradiance into radiance of the same number. */
static graze_surface probe(vec3 normal, vec3 view) {
    static const graze_material white = {.kind = GRAZE_PLASTIC, .color = {1, 1, 1}};
    graze_surface surface;
    graze_surface_prepare(&surface, &white, normal, view, NULL);
    surface.diffuse = rgb_gray(PI);
    return surface;
}

/* Makes the vertex where the path has hit a reflecting surface. False: it has not, or carries nothing. */
static bool path_vertex(const path *p, const path_hit *hit, vertex *v) {
    if (hit->surface < 0 || rgb_is_black(p->throughput))
        return false;
    const graze_scene *scene = p->context->scene;
    const scene_material *material = &scene->materials[scene->surfaces[hit->surface].material];
    if (material->emits)
        return false;
    vec3 normal = hit->behind ? vec3_negate(hit->normal) : hit->normal, view = vec3_negate(hit->direction);
    v->point = hit->point;
    v->surface = hit->surface;
    if (p->depth == 0 && p->context->settings->quantity == GRAZE_IRRADIANCE_HIT)
        v->shading = probe(normal, view);
    else
        graze_surface_prepare(&v->shading, &material->reflector, normal, view, NULL);
    v->ambient = v->shading.diffuse;
    v->gloss_is_ambient = v->shading.specular_lobe == GRAZE_LOBE_GLOSSY &&
                          material->reflector.specularity <= p->context->settings->specular_threshold;
    if (v->gloss_is_ambient)
        v->ambient = rgb_add(v->ambient, v->shading.specular);
    return true;
}

static double power_heuristic(double density, double other) {
    double ratio = other / density;
    return 1 / (1 + ratio * ratio);
}

bool path_samples_lights(const graze_trace_settings *settings) {
    return settings->strategy == GRAZE_STRATEGY_MIS || settings->strategy == GRAZE_STRATEGY_LIGHT;
}

static bool samples_lights(const path_context *context) {
    return path_samples_lights(context->settings);
}

/* Whether the other strategies would sample glows here, where a path that ends must not look for more than they do. */
static bool samples_glows_otherwise(const path_context *context) {
    return context->settings->back_faces_visible;
}

/* Glows that shine through hidden back faces would be lost to shadow rays, which those stop as in Radiance: so without
 * back faces, glows are found by reflection alone. */
static bool samples_glows(const path_context *context) {
    return samples_lights(context) && samples_glows_otherwise(context);
}

/* The weight of an emitter found by a sampled reflection, against the same found by sampling lights. */
static double found_weight(const path *p, const path_hit *hit, light_role role) {
    const scattering *last = &p->last;
    bool rival = role == LIGHT_DIRECT ? samples_lights(p->context) : samples_glows(p->context);
    if (role == LIGHT_DIRECT && hit->passed)
        return 0;
    if (!rival)
        return 1;
    if (p->context->settings->strategy == GRAZE_STRATEGY_LIGHT)
        return 0;
    double other =
        light_density(p->context->scene, &last->receiver, hit->light, hit->direction, hit->point, hit->normal);
    return power_heuristic(last->density, other);
}

/* What the path gets of the emitter it has hit. */
static rgb emission(const path *p, const path_hit *hit) {
    const scene_light *light = &p->context->scene->lights[hit->light];
    light_role role = light_role_at(light, hit->distance);
    rgb radiance = light_radiance(light, hit->direction, hit->normal), throughput = p->throughput;
    if (rgb_is_black(radiance) || (role == LIGHT_NONE && p->scattered))
        return rgb_gray(0);
    if (p->last.lobe == GRAZE_LOBE_DIFFUSE || p->last.lobe == GRAZE_LOBE_GLOSSY) {
        if (role == LIGHT_AMBIENT && !p->last.ambient)
            return rgb_gray(0);
        throughput = role == LIGHT_DIRECT ? p->last.direct : p->last.indirect;
        throughput = rgb_scale(found_weight(p, hit, role), throughput);
        radiance = light_radiance_at(light, hit->direction, hit->normal, hit->distance);
    } else if (role != LIGHT_AMBIENT && !p->context->settings->lights_visible) {
        return rgb_gray(0);
    }
    return rgb_multiply(throughput, radiance);
}

static bool ambient_bounces_left(const path *p) {
    return p->ambient_depth < p->context->settings->ambient_bounces;
}

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

/* Probabilities of going on with each lobe; they sum to at most 1. Where a lobe `ends`, the ray only looks for lights
 * that shine on the vertex: what sampling the lights would find. */
typedef struct lobe_choice {
    double diffuse, specular;
    bool diffuse_ends, specular_ends;
} lobe_choice;

/* How likely the path takes a lobe. One that may not go on is taken only where Eq. 16 stands alone. */
static double lobe_chance(const path *p, rgb reflectance, bool goes_on, bool *ends) {
    double chance = goes_on ? survival(p, reflectance) : 0;
    bool needed = !samples_lights(p->context) && p->context->scene->light_count > 0 && !rgb_is_black(reflectance);
    *ends = chance == 0;
    return *ends && needed ? 1 : chance;
}

static lobe_choice choose_lobes(const path *p, const vertex *v) {
    lobe_choice choice = {0};
    double diffuse = lobe_chance(p, v->ambient, ambient_bounces_left(p), &choice.diffuse_ends), specular = 0;
    if (v->shading.specular_lobe == GRAZE_LOBE_MIRROR)
        specular = survival(p, v->shading.specular);
    else if (v->shading.specular_lobe == GRAZE_LOBE_GLOSSY)
        specular = lobe_chance(p, v->shading.specular, !v->gloss_is_ambient, &choice.specular_ends);
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

static bool is_known(const path *p, int light) {
    return light < PATH_FIRST_CONTROLS && p->known.lights >> light & 1;
}

static path_control *control_of(path *p, int light) {
    return &p->controls[p->known.shared ? PATH_FIRST_CONTROLS : light];
}

/* Takes what a sample finds, or would find without shadows, of a light that is known. */
static void subtract_found(path *p, int light, rgb found, bool lit) {
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

/* Adds what is known of the lights' unshadowed light at a vertex, and remembers of which. */
static void add_known_light(path *p, const vertex *v, const light_receiver *receiver) {
    const graze_scene *scene = p->context->scene;
    p->known = (known_lights){0, p->depth > 0};
    if (!receiver->every || p->scattered)
        return;
    for (int i = 0; i < (int)scene->light_count; i++) {
        const scene_light *light = &scene->lights[i];
        bool ambient = light->glow, glossy = !ambient || !v->gloss_is_ambient;
        unshadowed_light whole;
        if (light_probability(scene, receiver, i) == 0 || !has_one_role(light) ||
            !unshadowed_light_at(scene, &v->shading, v->point, i, glossy, &whole))
            continue;
        rgb diffuse = !ambient ? v->shading.diffuse : ambient_bounces_left(p) ? v->ambient : rgb_gray(0);
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

/* Takes away what the last reflection finds, or would find without shadows, of the known lights. */
static void subtract_reflected(path *p, const vertex *from, const path_hit *hit, rgb found) {
    const graze_scene *scene = p->context->scene;
    for (int i = 0; i < (int)scene->light_count && i < PATH_FIRST_CONTROLS; i++) {
        if (!is_known(p, i))
            continue;
        if (hit->light == i && !hit->passed) {
            subtract_found(p, i, found, true);
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
        subtract_found(p, i, emission(p, &whole), false);
    }
}

/* Whether nothing stands between a vertex and a light's sampled point. */
static bool light_is_visible(const path *p, const vertex *v, const light_sample *sample) {
    const graze_scene *scene = p->context->scene;
    geometry_ray ray = {
        .origin = v->point, .direction = sample->direction, .far = sample->distance, .from = v->surface};
    return !geometry_occluded(scene->geometry, &ray, scene->lights[sample->light].surface);
}

/* The reflectance functions for a light sample, by the rules for its role, weighted against finding the light by
 * reflection. */
static rgb reflectance_for_light(const path *p, const vertex *v, const light_sample *sample, double density,
                                 lobe_choice choice) {
    const path_context *context = p->context;
    light_role role = light_role_at(&context->scene->lights[sample->light], sample->distance);
    bool ambient = role == LIGHT_AMBIENT;
    rgb diffuse, glossy;
    if (role == LIGHT_NONE || (ambient && !samples_glows(context)))
        return rgb_gray(0);
    graze_surface_value(&v->shading, sample->direction, &diffuse, &glossy);
    if (ambient)
        diffuse = ambient_bounces_left(p) ? rgb_scale(1 / PI, v->ambient) : rgb_gray(0);
    if (ambient && v->gloss_is_ambient)
        glossy = rgb_gray(0);
    if (context->settings->strategy == GRAZE_STRATEGY_LIGHT)
        return rgb_add(diffuse, glossy);
    if (choice.diffuse > 0) {
        double rival = choice.diffuse * graze_surface_density(&v->shading, GRAZE_LOBE_DIFFUSE, sample->direction);
        diffuse = rgb_scale(power_heuristic(density, rival), diffuse);
    }
    if (choice.specular > 0 && v->shading.specular_lobe == GRAZE_LOBE_GLOSSY) {
        double rival = choice.specular * graze_surface_density(&v->shading, GRAZE_LOBE_GLOSSY, sample->direction);
        glossy = rgb_scale(power_heuristic(density, rival), glossy);
    }
    return rgb_add(diffuse, glossy);
}

/* Direct light, Eq. 18, from a sample of one light that was chosen with the probability. */
static void add_sampled_light(path *p, const vertex *v, const light_receiver *receiver, int light, double probability,
                              const double random[2], lobe_choice choice) {
    light_sample sample = light_draw(p->context->scene, receiver, light, random);
    if (sample.light < 0 || rgb_is_black(sample.radiance))
        return;
    double cosine = vec3_dot(sample.direction, v->shading.n), density = probability * sample.density;
    if (cosine <= 0)
        return;
    rgb reflected = rgb_multiply(reflectance_for_light(p, v, &sample, density, choice), sample.radiance);
    if (rgb_is_black(reflected))
        return;
    bool lit = light_is_visible(p, v, &sample);
    rgb found = rgb_scale(cosine / density, rgb_multiply(p->throughput, reflected));
    if (lit)
        p->radiance = rgb_add(p->radiance, found);
    if (is_known(p, light))
        subtract_found(p, light, found, lit);
}

/* Samples every light, or one that is chosen. */
static void add_direct_light(path *p, const vertex *v, const light_receiver *receiver, lobe_choice choice) {
    const graze_scene *scene = p->context->scene;
    double random[3], probability = 0;
    if (receiver->candidates == 0)
        return;
    if (!receiver->every) {
        sampler_3d(p->sampler, random);
        int light = light_choose(scene, receiver, random[0], &probability);
        add_sampled_light(p, v, receiver, light, probability, random + 1, choice);
        return;
    }
    for (int light = 0; light < (int)scene->light_count; light++)
        if (light_probability(scene, receiver, light) > 0) {
            sampler_2d(p->sampler, random);
            add_sampled_light(p, v, receiver, light, 1, random, choice);
        }
}

/* Whether a reflection in this direction may meet lights that no light sample finds: all of them, or those seen in a
 * mirror. */
static bool is_search(const path *p, graze_lobe lobe) {
    return lobe != GRAZE_LOBE_MIRROR && (!samples_lights(p->context) || p->context->scene->has_mirrors);
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

/* Draws the lobe to go on with and turns the path into it. False: the path ends here. */
static bool reflect(path *p, const vertex *v, const light_receiver *receiver, lobe_choice choice, vec3 *direction) {
    if (choice.diffuse + choice.specular == 0)
        return false;
    double random[4];
    sampler_4d(p->sampler, random);
    bool diffuse = random[3] < choice.diffuse;
    if (!diffuse && random[3] >= choice.diffuse + choice.specular)
        return false;
    graze_lobe lobe = diffuse ? GRAZE_LOBE_DIFFUSE : v->shading.specular_lobe;
    bool ends = diffuse ? choice.diffuse_ends : choice.specular_ends;
    double scale = 1 / (diffuse ? choice.diffuse : choice.specular);
    graze_surface_sample sample = draw_direction(p, &v->shading, lobe, random);
    /* The weight of a diffuse sample is its reflectance: for `light`s that of the diffuse part alone. */
    rgb onward = ends ? rgb_gray(0) : diffuse ? v->ambient : sample.weight;
    if (rgb_is_black(sample.weight) && rgb_is_black(onward))
        return false;
    bool ambient = diffuse ? ambient_bounces_left(p) : !v->gloss_is_ambient;
    p->last = (scattering){
        .lobe = lobe,
        .density = sample.density / scale,
        .direct = rgb_scale(scale, rgb_multiply(p->throughput, sample.weight)),
        .indirect = rgb_scale(scale, rgb_multiply(p->throughput, diffuse ? v->ambient : sample.weight)),
        .ambient = ambient && (!ends || samples_glows_otherwise(p->context)),
        .receiver = *receiver,
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

/* Gathers light at a vertex and goes on from there until the path ends. */
static void follow(path *p, vertex v) {
    const path_context *context = p->context;
    for (;;) {
        if (!ambient_bounces_left(p))
            p->radiance = rgb_add(
                p->radiance, rgb_multiply(p->throughput, rgb_multiply(v.ambient, context->settings->ambient_value)));
        lobe_choice choice = choose_lobes(p, &v);
        p->known.lights = 0;
        bool glossy = v.shading.specular_lobe == GRAZE_LOBE_GLOSSY;
        light_receiver receiver = {.point = v.point, .normal = v.shading.n};
        receiver.ambient = samples_glows(context) && (ambient_bounces_left(p) || (glossy && !v.gloss_is_ambient));
        receiver.every = context->scene->light_count <= (p->depth == 0 ? EVERY_LIGHT_FIRST : EVERY_LIGHT_LATER);
        if (samples_lights(context) && (glossy || !rgb_is_black(v.ambient))) {
            light_receiver_prepare(context->scene, &receiver);
            add_known_light(p, &v, &receiver);
            add_direct_light(p, &v, &receiver, choice);
        }
        vec3 direction;
        if (!reflect(p, &v, &receiver, choice, &direction))
            return;
        path_hit hit = path_cast(context, v.point, direction, GEOMETRY_FAR, v.surface);
        rgb found = hit.light >= 0 ? emission(p, &hit) : rgb_gray(0);
        p->radiance = rgb_add(p->radiance, found);
        if (p->known.lights)
            subtract_reflected(p, &v, &hit, found);
        if (!path_vertex(p, &hit, &v))
            return;
    }
}

static path path_start(const path_context *context, sampler *points) {
    return (path){.context = context, .sampler = points, .throughput = {1, 1, 1}};
}

static path_sample path_end(const path *p, uint32_t first_group) {
    path_sample sample = {.radiance = p->radiance,
                          .control_count = p->control_count,
                          .noisy = p->sampler->group != first_group,
                          .searching = p->searching};
    for (int i = 0; i < p->control_count; i++)
        sample.controls[i] = p->controls[i];
    return sample;
}

path_sample path_radiance(const path_context *context, const path_hit *first, sampler *points) {
    path p = path_start(context, points);
    uint32_t first_group = points->group;
    vertex v;
    if (first->light >= 0)
        p.radiance = emission(&p, first);
    if (path_vertex(&p, first, &v))
        follow(&p, v);
    return path_end(&p, first_group);
}

/* Sensors stand this far above the point given, as Radiance's, so that points read off a surface are not inside it. */
#define SENSOR_HEIGHT 1e-4

path_sample path_irradiance(const path_context *context, vec3 point, vec3 normal, sampler *points) {
    path p = path_start(context, points);
    uint32_t first_group = points->group;
    vertex v = {
        .point = vec3_add_scaled(point, SENSOR_HEIGHT, normal), .surface = -1, .shading = probe(normal, normal)};
    v.ambient = v.shading.diffuse;
    follow(&p, v);
    return path_end(&p, first_group);
}
