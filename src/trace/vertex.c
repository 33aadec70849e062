/* Surfaces and sensors as a path meets them. */
#include "trace/vertex.h"

#include "base/angle.h"
#include "geometry/placed.h"
#include "scene/surface.h"
#include "trace/appearance.h"

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

void vertex_find_ambient(const path *p, vertex *v, const graze_material *m) {
    v->ambient = v->shading.diffuse;
    v->gloss_is_ambient =
        v->shading.specular_lobe == GRAZE_LOBE_GLOSSY && m->specularity <= p->context->settings->specular_threshold;
    if (v->gloss_is_ambient)
        v->ambient = rgb_add(v->ambient, v->shading.specular);
}

rgb vertex_function_value(const vertex *v, vec3 direction) {
    if (!v->function || !(vec3_dot(direction, v->shading.n) > 0))
        return rgb_gray(0);
    rad_transform t;
    if (v->function_scene && scene_material_is_moved(v->function_scene, v->surface, &t))
        direction = placed_inverse_direction(&t, direction);
    return rgb_scale(material_reflection_value(v->function, &v->function_point, direction), v->function_color);
}

bool vertex_at_hit(const path *p, const path_hit *hit, vertex *v) {
    if (hit->surface < 0 || rgb_is_black(p->throughput))
        return false;
    const graze_scene *scene = p->context->scene;
    const scene_surface surface = scene_surface_at(scene, hit->surface);
    const scene_material *material = &scene->materials[surface.material];
    if (material->emits)
        return false;
    vec3 normal = hit->behind ? vec3_negate(hit->normal) : hit->normal, view = vec3_negate(hit->direction);
    v->point = hit->point;
    v->normal = normal;
    v->surface = hit->surface;
    v->no_ambient = surface.no_ambient;
    v->leans = v->drawn = false;
    v->function = NULL;
    bool irradiance = p->depth == 0 && p->context->settings->quantity == GRAZE_IRRADIANCE_HIT;
    if (!irradiance && !appearance_is_plain(scene, material, hit->surface)) {
        appearance_prepare(p, hit, material, v);
        return true;
    }
    if (irradiance)
        v->shading = probe(normal, view);
    else
        graze_surface_prepare(&v->shading, &material->reflector, normal, view, NULL);
    vertex_find_ambient(p, v, &material->reflector);
    return true;
}

bool vertex_keep_part(vertex *v, graze_part part) {
    bool mirror = v->shading.specular_lobe == GRAZE_LOBE_MIRROR;
    if (part == GRAZE_MIRRORED) {
        v->shading.diffuse = v->ambient = rgb_gray(0);
        v->function = NULL;
    }
    if (part == GRAZE_UNMIRRORED && mirror) {
        v->shading.specular_lobe = GRAZE_LOBE_NONE;
        v->shading.specular = rgb_gray(0);
    }
    return part != GRAZE_MIRRORED || mirror;
}

vertex vertex_of_point(vec3 point, vec3 normal, int64_t surface) {
    vertex v = {.point = point, .normal = normal, .surface = surface, .shading = probe(normal, normal)};
    v.ambient = v.shading.diffuse;
    return v;
}

vertex vertex_of_sensor(vec3 point, vec3 normal) {
    return vertex_of_point(vec3_add_scaled(point, SENSOR_HEIGHT, normal), normal, -1);
}
