/* What lobes after a diffuse reflection are expected to reflect of small lights, and what they do. */
#include "trace/rare_gloss.h"

#include "base/angle.h"
#include "geometry/crossing.h"
#include "trace/context.h"
#include "trace/mirrored_light.h"

/* What is found in so large a part of all cases is not rare. */
#define RARE 0.25

/* Whether it is a clear body's surface. */
static bool is_clear(const vertex *v) {
    return v->shading.transmits && v->refracts;
}

/* Whether what matters about light from a direction is the lobe that the surface transmits. */
static bool is_beyond(const vertex *v, vec3 direction) {
    return vec3_dot(direction, v->shading.n) < 0;
}

/* 4 times the area of the ellipse that half vectors lie in, over pi: directions, turned by twice the angle, spread over
 * so much where they leave the surface steeply. A mirror's do not spread; what is transmitted is not turned so. */
static double spread(const vertex *v, bool beyond) {
    const graze_surface *s = &v->shading;
    if (is_clear(v))
        return 0;
    if (beyond)
        return s->transmitted_u * s->transmitted_v;
    return s->specular_lobe == GRAZE_LOBE_MIRROR ? 0 : 4 * s->lobe.alpha_x * s->lobe.alpha_y;
}

/* The part of all directions, each counted by its cosine, from which a light is seen in the gloss of a flat surface:
 * its image's, of the solid angle 1/density, and the lobe's. */
static double share_of_directions(const vertex *v, bool beyond, double density) {
    return spread(v, beyond) + 1 / (PI * density);
}

static bool is_rare(const vertex *v, bool beyond, double density) {
    return density > 0 && share_of_directions(v, beyond, density) < RARE;
}

/* Notes what comes by one in 1/share of all cases. */
static void expect(path *p, const vertex *v, double expected, double share) {
    p->rare.by_mirrors = p->rare.by_mirrors || v->shading.specular_lobe == GRAZE_LOBE_MIRROR;
    p->rare.times++;
    p->rare.expected += expected;
    p->rare.squares += expected * expected * (1 / share - 1);
}

static double brightness_by_gloss(const path *p, const vertex *v, bool beyond, const light_sample *sample) {
    rgb color = beyond ? v->shading.transmitted_specular : v->shading.specular;
    return rgb_brightness(rgb_multiply(rgb_multiply(p->throughput, color), sample->radiance));
}

/* Half vectors lean no farther, in roughnesses, where a lobe has anything worth the name. */
#define REACH_OF_LOBE 3.5

/* Half its largest extent, or of a source the sine of half its angle. */
static double half_extent(const scene_light *light) {
    vec3 lower, upper;
    if (!light->shape)
        return sin(light->half_angle);
    shape_bounds(light->shape, &lower, &upper);
    return vec3_length(vec3_subtract(upper, lower)) / 2;
}

/* Where a flat surface would have to be to show the light, by its middle, to a point. */
typedef struct image_place {
    vec3 at;
    double way;   /* to there; not positive: nowhere */
    double slope; /* the cosine of the way with the normal */
    double reach; /* so far around that it still might, as the light is wide and the lobe rough */
} image_place;

static image_place place_of_image(const path *p, const vertex *v, vec3 from, const light_sample *sample) {
    const scene_light *light = &p->context->scene->lights[sample->light];
    const vec3 n = v->normal;
    const bool mirror = v->shading.specular_lobe == GRAZE_LOBE_MIRROR;
    vec3 towards = vec3_add_scaled(sample->direction, -2 * vec3_dot(n, sample->direction), n);
    double wide = half_extent(light);
    if (light->shape) {
        towards = vec3_subtract(vec3_add_scaled(v->point, sample->distance, towards), from);
        wide /= vec3_length(towards);
        towards = vec3_normalize(towards);
    }
    double rough = mirror ? 0 : fmax(v->shading.lobe.alpha_x, v->shading.lobe.alpha_y);
    image_place image = {.slope = -vec3_dot(n, towards)};
    image.way = vec3_dot(n, vec3_subtract(from, v->point)) / image.slope;
    image.reach = image.way * (wide + 2 * REACH_OF_LOBE * rough) / image.slope;
    image.at = vec3_add_scaled(from, image.way, towards);
    return image;
}

/* How much likelier than in the mean over all directions the surface shows the light to the point that the path was
 * scattered at, or to its image in the mirror since then. Of flat ones that are no other than they are in space, it is
 * known where they would have to be: 0 if they are not there. If they are, it is seen in a part of them. */
static double likelihood(const path *p, const vertex *v, const light_sample *sample) {
    const graze_scene *scene = p->context->scene;
    const scattering *last = &p->last;
    if (last->refracted || !last->vertex || v->leans || v->surface < 0 || v->surface >= (int64_t)scene->surface_count ||
        !shape_is_flat(&scene->shapes[v->surface]))
        return 1;
    const scene_material *m = &scene->materials[scene->surfaces[v->surface].material];
    const shape *s = &scene->shapes[v->surface];
    if (m->modifiers || m->kind != SCENE_REFLECTOR)
        return 1;
    vec3 from = last->vertex->point;
    if (last->mirror >= 0) {
        const shape_plane plane = shape_plane_of(&scene->shapes[last->mirror]);
        from = vec3_add_scaled(from, -2 * vec3_dot(plane.normal, vec3_subtract(from, plane.point)), plane.normal);
    }
    const image_place image = place_of_image(p, v, from, sample);
    if (!(image.way > 0))
        return 1;
    if (shape_flat_contains(s, image.at))
        return fmax(PI * image.way * image.way / (image.slope * shape_area(s)), 1);
    return shape_outline_distance(s, image.at) <= image.reach ? 1 : 0;
}

/* Of many lights, one that is hardly ever chosen counts as one chosen at random: it would else be expected to give
 * much, once in a long while. */
void rare_gloss_expect(path *p, const vertex *v, const light_sample *sample, double expectation) {
    bool beyond = is_beyond(v, sample->direction);
    if (!is_rare(v, beyond, sample->density))
        return;
    double likely = beyond ? 1 : likelihood(p, v, sample), share = share_of_directions(v, beyond, sample->density);
    if (likely == 0)
        return;
    likely = fmin(likely, 1 / share);
    double often = fmax(expectation, 1.0 / p->context->scene->light_count);
    double cosine = fabs(vec3_dot(sample->direction, v->shading.n)), times = 1 / (often * sample->density);
    expect(p, v, brightness_by_gloss(p, v, beyond, sample) * times * cosine / PI * likely, share * likely);
}

/* Whether a ray comes to the light: panes on its way let it through. */
static bool is_clear_to(const graze_scene *scene, const geometry_ray *ray, int light) {
    return !geometry_occluded_but_for_panes(scene->geometry, ray, scene->lights[light].surface, NULL);
}

/* Whether light from the direction arrives at the body that a vertex belongs to: there, or else where a ray from there
 * leaves it. */
static bool body_is_lit(const path *p, const vertex *v, const light_sample *sample) {
    const graze_scene *scene = p->context->scene;
    geometry_ray ray = {
        .origin = v->point, .direction = sample->direction, .far = sample->distance, .from = v->surface};
    if (vec3_dot(sample->direction, v->normal) <= 0) {
        geometry_hit end;
        if (!geometry_intersect(scene->geometry, &ray, &end) || end.surface != v->surface)
            return false;
        ray.origin = end.point;
        ray.far -= end.distance;
    }
    return is_clear_to(scene, &ray, sample->light);
}

/* The light as its middle shows it, if it is rare there and may be reflected by gloss. */
static bool look_at_light(const path *p, const vertex *v, int index, light_sample *sample) {
    const scene_light *light = &p->context->scene->lights[index];
    *sample = light_draw_middle(p->context->scene, v->point, p->length, index);
    if (sample->light < 0 || !is_rare(v, false, sample->density) || rgb_is_black(sample->radiance))
        return false;
    light_role role = light_role_at(light, sample->distance);
    return role == LIGHT_DIRECT ||
           (role == LIGHT_AMBIENT && !v->gloss_is_ambient && context_samples_glows(p->context->settings));
}

/* A ball spreads a beam evenly over all directions if it mirrors it, and about so if it has a narrow lobe. So do other
 * curved bodies in the mean over the ways that they may be turned. Of all points that are seen, in the light or not, as
 * many show the light as there are normals near the half vector. */
static void expect_on_body(path *p, const vertex *v, int index) {
    light_sample sample;
    if (!look_at_light(p, v, index, &sample) || !body_is_lit(p, v, &sample))
        return;
    double half = sqrt(fmax((1 + vec3_dot(sample.direction, v->shading.view)) / 2, 0));
    double share = spread(v, false) / 4 * fmax(half, 0.1) + 1 / (4 * PI * sample.density);
    expect(p, v, brightness_by_gloss(p, v, false, &sample) / (4 * PI * sample.density), share);
}

/* A clear body sends light on in all directions, mirrored or bent, in the mean over all ways that it may be turned: as
 * a ball does that mirrors it all. But it gathers much of it in beams, which most places are not in: these get about so
 * much of the mean. */
#define OUTSIDE_BEAMS 0.5

/* What the path carries to the light is what it did before it came there. */
static void expect_in_clear_body(path *p, const vertex *v, int index) {
    light_sample sample;
    if (!look_at_light(p, v, index, &sample) || !body_is_lit(p, v, &sample))
        return;
    bool direct = light_role_at(&p->context->scene->lights[index], sample.distance) == LIGHT_DIRECT;
    double share = 1 / (4 * PI * sample.density);
    rgb carried = direct ? p->last.direct : p->last.indirect;
    expect(p, v, rgb_brightness(rgb_multiply(carried, sample.radiance)) * OUTSIDE_BEAMS * share, share);
    p->rare.by_mirrors = true;
}

/* Where a path comes to such a body. */
static rare_gloss clear_body_at(path *p, const vertex *v) {
    size_t count = p->context->scene->light_count;
    if (count > PATH_FEW_LIGHTS)
        return RARE_GLOSS_NONE;
    if (!p->last.refracted && lobe_scatters(p->last.lobe))
        for (int i = 0; i < (int)count; i++)
            expect_in_clear_body(p, v, i);
    return RARE_GLOSS_CURVED;
}

/* The lights in a flat mirror are not sampled, but looked at: each, or one of many. */
static void expect_in_mirror(path *p, const vertex *v, int index, double expectation) {
    const graze_scene *scene = p->context->scene;
    light_sample sample;
    if (!look_at_light(p, v, index, &sample))
        return;
    geometry_ray ray = {.origin = v->point, .direction = sample.direction, .far = sample.distance, .from = v->surface};
    if (vec3_dot(sample.direction, v->shading.n) > 0 && is_clear_to(scene, &ray, index))
        rare_gloss_expect(p, v, &sample, expectation);
}

/* Whether what the mirror shows is found by light samples from where the path was scattered. */
static bool is_sampled_mirror(const path *p, const vertex *v) {
    return p->last.mirror < 0 && p->last.lobe < GRAZE_LOBE_MIRROR &&
           mirrored_light_is_in(p->context->scene, v->surface);
}

static bool is_body(shape_kind kind) {
    return kind == SHAPE_SPHERE || kind == SHAPE_CONE;
}

/* Whether it reflects lights by a mirror or a narrow lobe. */
static bool has_narrow_gloss(const vertex *v) {
    graze_lobe lobe = v->shading.specular_lobe;
    return (lobe == GRAZE_LOBE_GLOSSY || lobe == GRAZE_LOBE_MIRROR) && spread(v, false) < RARE;
}

static rare_gloss narrow_gloss_at(path *p, const vertex *v) {
    const graze_scene *scene = p->context->scene;
    bool few = scene->light_count <= PATH_FEW_LIGHTS;
    if (few && is_body(geometry_find(scene->geometry, v->surface).shape->kind)) {
        for (int i = 0; i < (int)scene->light_count; i++)
            expect_on_body(p, v, i);
        return RARE_GLOSS_CURVED;
    }
    if (v->shading.specular_lobe != GRAZE_LOBE_MIRROR)
        return RARE_GLOSS_FLAT;
    if (few) {
        for (int i = 0; i < (int)scene->light_count; i++)
            expect_in_mirror(p, v, i, 1);
    } else {
        double count = (double)scene->light_count;
        expect_in_mirror(p, v, (int)(sampler_1d(p->sampler) * count), 1 / count);
    }
    return RARE_GLOSS_MIRROR;
}

rare_gloss rare_gloss_at(path *p, const vertex *v) {
    if (p->ambient_depth == 0 || !context_samples_lights(p->context->settings))
        return RARE_GLOSS_NONE;
    if (is_clear(v) && p->wanted != WANTED_STRAIGHT)
        return clear_body_at(p, v);
    if (p->wanted == WANTED_BENT || !has_narrow_gloss(v) ||
        (v->shading.specular_lobe == GRAZE_LOBE_MIRROR && is_sampled_mirror(p, v)))
        return RARE_GLOSS_NONE;
    return narrow_gloss_at(p, v);
}

rare_gloss rare_gloss_beyond(const path *p, const vertex *v) {
    bool rare = p->ambient_depth > 0 && v->shading.transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY &&
                context_samples_lights(p->context->settings) && spread(v, true) < RARE;
    return rare ? RARE_GLOSS_FLAT : RARE_GLOSS_NONE;
}

void rare_gloss_find(path *p, const vertex *v, vec3 direction, double light_density, rgb found) {
    if (is_rare(v, is_beyond(v, direction), light_density))
        p->rare.found += rgb_brightness(found);
}

void rare_gloss_find_met(path *p, const vertex *v, const path_hit *hit, rgb found) {
    const graze_surface *s = &v->shading;
    if (!is_clear(v) && p->last.lobe != (is_beyond(v, hit->direction) ? s->transmitted_lobe : s->specular_lobe))
        return;
    rare_gloss_find(p, v, hit->direction,
                    light_density(p->context->scene, v->point, hit->light, hit->direction, hit->point, hit->normal),
                    found);
}
