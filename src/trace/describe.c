/* Between rays and hits of the public header and those of paths. */
#include "trace/describe.h"

#include "trace/appearance.h"

graze_hit describe_nothing(vec3 origin) {
    return (graze_hit){.distance = GRAZE_FAR, .point = origin};
}

graze_hit describe_hit(const graze_scene *scene, const path_hit *found) {
    graze_hit hit = {.distance = found->distance, .point = found->point};
    int primitive = -1;
    if (found->surface >= 0) {
        primitive = scene->surfaces[found->surface].primitive;
        hit.normal = found->normal;
        bool turned = found->behind && !scene->materials[scene->surfaces[found->surface].material].emits;
        hit.shading_normal = turned ? vec3_negate(found->normal) : found->normal;
        const scene_material *material = &scene->materials[scene->surfaces[found->surface].material];
        if (!material->emits && !material->plain)
            hit.shading_normal = appearance_normal(scene, found, 0);
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

bool describe_ray(const graze_ray *ray, vec3 *direction, double *limit) {
    *direction = vec3_safe_normalize(ray->direction);
    *limit = ray->limit > 0 ? ray->limit : GEOMETRY_FAR;
    return is_finite(ray->origin) && is_finite(ray->direction) && vec3_max_abs(*direction) > 0 && isfinite(ray->limit);
}
