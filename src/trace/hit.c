/* Casting rays: what is met first, hidden back faces passed. */
#include "trace/hit.h"

#include "scene/light.h"
#include "scene/surface.h"

static bool has_back(const graze_scene *scene, int64_t surface) {
    return scene_material_has_back(scene_material_at(scene, surface));
}

path_hit path_cast(const path_context *context, vec3 origin, vec3 direction, double limit, int64_t from) {
    const graze_scene *scene = context->scene;
    path_hit hit = {.surface = -1, .light = -1, .distance = GEOMETRY_FAR, .point = origin, .direction = direction};
    geometry_ray ray = {.origin = origin, .direction = direction, .far = limit, .from = from};
    geometry_hit found;
    double travelled = 0;
    while (geometry_intersect(scene->geometry, &ray, &found)) {
        bool behind = vec3_dot(found.normal, direction) > 0;
        if (behind && !context->settings->back_faces_visible && !has_back(scene, found.surface)) {
            hit.passed = hit.passed || !scene_surface_passes(scene, found.surface);
            travelled += found.distance;
            ray.origin = found.point;
            ray.far -= found.distance;
            ray.from = found.surface;
            continue;
        }
        hit.surface = found.surface;
        hit.light = scene_surface_at(scene, found.surface).light;
        hit.distance = travelled + found.distance;
        hit.point = found.point;
        hit.normal = found.normal;
        hit.behind = behind;
        return hit;
    }
    if (limit >= GEOMETRY_FAR)
        hit.light = light_source_towards(scene, direction);
    return hit;
}
