/* Surfaces and sensors as a path meets them. */
#include "trace/vertex.h"

#include "base/angle.h"
#include "scene/surface.h"
#include "trace/appearance.h"
#include "trace/mirrored_light.h"

/* Sensors stand this far above the point given, as Radiance's, so that points read off a surface are not inside it. */
#define SENSOR_HEIGHT 1e-4

/* A Lambertian surface that turns irradiance into radiance of the same number. */
static graze_surface probe(vec3 normal, vec3 view) {
    static const graze_material white = {.kind = GRAZE_PLASTIC, .color = {1, 1, 1}};
    graze_surface surface;
    graze_surface_prepare(&surface, &white, normal, view, NULL);
    surface.diffuse = rgb_gray(PI);
    return surface;
}

/* The path only looks for lights that light samples may find, too: straight on, or in a pane. */
static void keep_straight_on(const path *p, vertex *v) {
    graze_surface *s = &v->shading;
    s->diffuse = s->transmitted_diffuse = v->ambient = v->transmitted_ambient = rgb_gray(0);
    if (!p->last.ambient || !mirrored_light_is_in(p->context->scene, v->surface)) {
        s->specular = rgb_gray(0);
        s->specular_lobe = GRAZE_LOBE_NONE;
    }
    if (s->transmitted_lobe != GRAZE_LOBE_TRANSMITTED)
        s->transmitted_lobe = GRAZE_LOBE_NONE;
    v->function = NULL;
}

void vertex_set_passage(const path *p, vertex *v) {
    v->refracts = false;
    if (p->context->scene->has_refraction)
        v->beyond = p->medium;
    if (rgb_is_black(p->throughput))
        keep_straight_on(p, v);
}

static inline void find_ambient_above(const path *p, vertex *v, double specularity) {
    v->ambient = v->shading.diffuse;
    v->gloss_is_ambient =
        v->shading.specular_lobe == GRAZE_LOBE_GLOSSY && specularity <= p->context->settings->specular_threshold;
    if (v->gloss_is_ambient)
        v->ambient = rgb_add(v->ambient, v->shading.specular);
}

static void find_ambient_below(const path *p, vertex *v, double specularity) {
    const graze_surface *s = &v->shading;
    v->transmitted_ambient = s->transmitted_diffuse;
    v->transmitted_gloss_is_ambient =
        s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY && specularity <= p->context->settings->specular_threshold;
    if (v->transmitted_gloss_is_ambient)
        v->transmitted_ambient = rgb_add(v->transmitted_ambient, s->transmitted_specular);
}

/* What only surfaces have that let light through: apart from what all have, which is faster without it. */
__attribute__((noinline)) static void find_other_side(const path *p, vertex *v, const graze_material *m) {
    find_ambient_below(p, v, (1 - m->specularity) * m->transmission * m->transmitted_specularity);
    vertex_set_passage(p, v);
    v->refracts = m->kind == GRAZE_DIELECTRIC;
    if (v->refracts)
        v->beyond = graze_material_attenuation(m, !v->behind, 1);
}

void vertex_find_ambient(const path *p, vertex *v, const graze_material *m) {
    find_ambient_above(p, v, m->specularity);
    if (v->shading.transmits)
        find_other_side(p, v, m);
}

void vertex_set_ambient(const path *p, vertex *v, double reflected, double transmitted) {
    find_ambient_above(p, v, reflected);
    if (!v->shading.transmits)
        return;
    find_ambient_below(p, v, transmitted);
    vertex_set_passage(p, v);
}

rgb vertex_function_value(const vertex *v, vec3 direction) {
    if (!v->function)
        return rgb_gray(0);
    double cosine = vec3_dot(direction, v->shading.n);
    rgb color = cosine > 0 ? v->function_color : v->transmitted_function;
    rad_transform t;
    if (cosine == 0 || (cosine < 0 && !v->shading.transmits) || rgb_is_black(color))
        return rgb_gray(0);
    if (v->function_scene && scene_material_is_moved(v->function_scene, v->surface, &t))
        direction = rad_transform_direction_back(&t, direction);
    return rgb_multiply(material_reflection_value(v->function, &v->function_point, direction), color);
}

/* Whether a path that carries nothing may still find lights behind a surface. */
static bool looks_through(const path *p, const scene_material *material, int64_t surface) {
    const graze_scene *scene = p->context->scene;
    bool clear =
        scene_surface_passes(scene, surface) || scene_material_bends(material) || mirrored_light_is_in(scene, surface);
    return clear && lobe_scatters(p->last.lobe) && !(rgb_is_black(p->last.direct) && rgb_is_black(p->last.indirect));
}

/* What the path meets. */
static const scene_material *material_met(const path *p, const path_hit *hit, int index) {
    const scene_material *material = &p->context->scene->materials[index];
    if (material->alternate < 0 || (material->keeps_front && p->scattered && !hit->behind))
        return material;
    return scene_material_seen(p->context->scene, material);
}

/* For the irradiance where a ray hits first: textures do not count, as in Radiance, but the normals of a mesh do. */
static void prepare_probe(const path *p, const path_hit *hit, vertex *v) {
    const graze_scene *scene = p->context->scene;
    vec3 normal = v->normal;
    if (hit->surface >= (int64_t)scene->surface_count) {
        normal = appearance_smooth_normal(scene, hit);
        v->leans = !vec3_is_same(normal, v->normal);
    }
    v->shading = probe(normal, vec3_negate(hit->direction));
}

bool vertex_at_hit(const path *p, const path_hit *hit, vertex *v) {
    if (hit->surface < 0)
        return false;
    const graze_scene *scene = p->context->scene;
    const scene_surface surface = scene_surface_at(scene, hit->surface);
    const scene_material *material = material_met(p, hit, surface.material);
    if (scene_material_emits(material) || (rgb_is_black(p->throughput) && !looks_through(p, material, hit->surface)))
        return false;
    vec3 normal = hit->behind ? vec3_negate(hit->normal) : hit->normal, view = vec3_negate(hit->direction);
    v->point = hit->point;
    v->normal = normal;
    v->surface = hit->surface;
    v->no_ambient = surface.no_ambient;
    v->leans = v->drawn = false;
    v->function = NULL;
    v->behind = hit->behind;
    v->distance = hit->distance;
    if (scene->has_refraction)
        v->before = p->medium;
    bool irradiance = p->context->settings->quantity == GRAZE_IRRADIANCE_HIT && path_is_at_first(p);
    if (irradiance) {
        prepare_probe(p, hit, v);
        v->ambient = v->shading.diffuse;
        v->gloss_is_ambient = false;
        return true;
    }
    if (!appearance_is_plain(scene, material, hit->surface)) {
        appearance_prepare(p, hit, material, v);
        return true;
    }
    graze_surface_prepare(&v->shading, &material->reflector,
                          material->reflector.kind >= GRAZE_DIELECTRIC ? hit->normal : normal, view, NULL);
    vertex_find_ambient(p, v, &material->reflector);
    return true;
}

bool vertex_keep_part(vertex *v, graze_part part) {
    bool mirror = v->shading.specular_lobe == GRAZE_LOBE_MIRROR;
    if (part == GRAZE_MIRRORED) {
        v->shading.diffuse = v->ambient = rgb_gray(0);
        v->function = NULL;
        v->shading.transmits = 0;
    }
    if (part == GRAZE_UNMIRRORED && mirror) {
        v->shading.specular_lobe = GRAZE_LOBE_NONE;
        v->shading.specular = rgb_gray(0);
    }
    return part != GRAZE_MIRRORED || mirror;
}

vertex vertex_of_point(vec3 point, vec3 normal, int64_t surface) {
    vertex v = {
        .point = point, .normal = normal, .surface = surface, .before = {1, 1, 1}, .shading = probe(normal, normal)};
    v.ambient = v.shading.diffuse;
    return v;
}

vertex vertex_of_sensor(vec3 point, vec3 normal) {
    return vertex_of_point(vec3_add_scaled(point, SENSOR_HEIGHT, normal), normal, -1);
}
