/* Between rays and hits of the public header and those of paths. */
#include "trace/describe.h"

#include <float.h>

#include "scene/surface.h"
#include "trace/appearance.h"

graze_hit describe_nothing(vec3 origin) {
    return (graze_hit){.distance = GRAZE_FAR, .point = origin};
}

graze_hit describe_hit(const graze_scene *scene, const path_hit *found, graze_quantity quantity) {
    graze_hit hit = {.distance = found->distance, .point = found->point};
    int primitive = -1;
    if (found->surface >= 0) {
        const scene_surface surface = scene_surface_at(scene, found->surface);
        const scene_material *material = scene_material_seen(scene, &scene->materials[surface.material]);
        primitive = surface.primitive;
        hit.normal = found->normal;
        /* As Radiance has it: what shines, clear bodies and mixtures have one normal on both sides. */
        bool turned = found->behind && !scene_material_emits(material) && !scene_material_refracts(material) &&
                      material->kind != SCENE_MIXTURE;
        hit.shading_normal = turned ? vec3_negate(found->normal) : found->normal;
        scene_mesh_point mesh = scene_mesh_point_at(scene, found->surface, found->point);
        hit.uv[0] = mesh.uv[0];
        hit.uv[1] = mesh.uv[1];
        if (appearance_has_normal(scene, material, found->surface)) {
            vec3 normal = quantity == GRAZE_IRRADIANCE_HIT ? appearance_smooth_normal(scene, found)
                                                           : appearance_normal(scene, found, 0);
            hit.shading_normal = found->behind != turned ? vec3_negate(normal) : normal;
        }
    } else if (found->light >= 0) {
        primitive = scene->lights[found->light].primitive;
        hit.normal = hit.shading_normal = vec3_negate(found->direction);
    }
    if (primitive < 0)
        return hit;
    hit.surface = scene_name(scene, primitive);
    hit.modifier = scene_modifier_name(scene, primitive);
    hit.material = scene_material_name(scene, primitive);
    return hit;
}

static bool is_finite(vec3 v) {
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

/* As well as rounded numbers can be. */
static bool is_unit(vec3 v) {
    return fabs(vec3_dot(v, v) - 1) <= 4 * DBL_EPSILON;
}

bool describe_ray(const graze_ray *ray, vec3 *direction, double *limit) {
    bool unit = is_unit(ray->direction);
    *direction = unit ? ray->direction : vec3_safe_normalize(ray->direction);
    *limit = ray->limit > 0 ? ray->limit : GEOMETRY_FAR;
    return is_finite(ray->origin) && isfinite(ray->limit) &&
           (unit || (is_finite(ray->direction) && vec3_max_abs(*direction) > 0));
}
