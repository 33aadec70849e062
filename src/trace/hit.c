/* Casting rays: what is met first, hidden back faces passed. */
#include "trace/hit.h"

#include "scene/cuts.h"
#include "scene/light.h"
#include "scene/surface.h"

static bool has_back(const graze_scene *scene, int64_t surface) {
    return scene_material_has_back(scene_material_at(scene, surface));
}

/* Whether the ray goes on behind what it has met: what is cut away, and back faces that are hidden. A face of a cut has
 * its front in the antimatter, wherever this has its own. */
static bool goes_on(const path_context *context, const geometry_ray *ray, geometry_hit *found, path_hit *hit) {
    const graze_scene *scene = context->scene;
    if (scene->cuts) {
        scene_presence presence = scene_cuts_at(scene, found->surface, found->point, ray->direction);
        if (presence == SCENE_CUT_AWAY)
            return true;
        if (presence == SCENE_CUT_FACE)
            found->normal = vec3_negate(found->normal);
    }
    hit->behind = vec3_dot(found->normal, ray->direction) > 0;
    if (!hit->behind || context->settings->back_faces_visible || has_back(scene, found->surface))
        return false;
    hit->passed = hit->passed || !scene_surface_passes(scene, found->surface);
    hit->behind = false;
    return true;
}

path_hit path_cast(const path_context *context, vec3 origin, vec3 direction, double limit, int64_t from) {
    const graze_scene *scene = context->scene;
    path_hit hit = {.surface = -1, .light = -1, .distance = GEOMETRY_FAR, .point = origin, .direction = direction};
    geometry_ray ray = {.origin = origin, .direction = direction, .far = limit, .from = from};
    geometry_hit found;
    double travelled = 0;
    while (geometry_intersect(scene->geometry, &ray, &found)) {
        if (goes_on(context, &ray, &found, &hit)) {
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
        return hit;
    }
    if (limit >= GEOMETRY_FAR)
        hit.light = light_source_towards(scene, direction);
    return hit;
}
