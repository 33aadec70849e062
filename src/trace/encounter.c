/* A hit as the functions of the surface's material know it. */
#include "trace/encounter.h"

#include "material/amounts.h"
#include "scene/surface.h"

static material_ray ray_of(const path_hit *hit, double length) {
    return (material_ray){.point = hit->point,
                          .direction = hit->direction,
                          .normal = hit->normal,
                          .distance = length + hit->distance,
                          .last_distance = hit->distance};
}

/* The ray there. */
static void move(encounter *e) {
    const rad_transform *t = &e->transform;
    e->ray.point = rad_transform_point_back(t, e->ray.point);
    e->ray.direction = rad_transform_direction_back(t, e->ray.direction);
    e->ray.normal = rad_transform_direction_back(t, e->ray.normal);
    e->ray.distance /= t->scale;
    e->ray.last_distance /= t->scale;
    e->effect.perturbation = rad_transform_direction_back(t, e->effect.perturbation);
}

encounter encounter_meet(const graze_scene *scene, const path_hit *hit, double length) {
    encounter e = {.ray = ray_of(hit, length), .effect = {.color = {1, 1, 1}}};
    if (hit->surface < (int64_t)scene->surface_count)
        return e;
    scene_mesh_point mesh = scene_mesh_point_at(scene, hit->surface, hit->point);
    if (mesh.has_normal)
        e.effect.perturbation = vec3_subtract(mesh.normal, hit->normal);
    e.ray.u = mesh.uv[0];
    e.ray.v = mesh.uv[1];
    e.moved = scene_material_is_moved(scene, hit->surface, &e.transform);
    if (e.moved)
        move(&e);
    return e;
}

material_effect encounter_add_effect(const material_modifier *modifiers, const material_ray *ray,
                                     material_effect before) {
    if (!modifiers)
        return before;
    material_effect e = material_modify(modifiers, ray);
    return (material_effect){rgb_multiply(before.color, e.color), vec3_add(before.perturbation, e.perturbation)};
}

vec3 encounter_perturbation(const path_hit *hit, const encounter *of, const material_effect *e) {
    vec3 perturbation = hit->behind ? vec3_negate(e->perturbation) : e->perturbation;
    return of->moved ? rad_transform_direction(&of->transform, perturbation) : perturbation;
}

vec3 encounter_lean(const path_hit *hit, const encounter *of, const material_effect *e) {
    vec3 normal = hit->behind ? vec3_negate(hit->normal) : hit->normal;
    return material_perturbed_normal(normal, encounter_perturbation(hit, of, e), hit->direction);
}

rgb encounter_colored(rgb color, rgb pattern) {
    rgb c = rgb_multiply(color, pattern);
    return (rgb){fmin(fmax(c.r, 0), MATERIAL_LARGEST_AMOUNT), fmin(fmax(c.g, 0), MATERIAL_LARGEST_AMOUNT),
                 fmin(fmax(c.b, 0), MATERIAL_LARGEST_AMOUNT)};
}
