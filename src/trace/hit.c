/* Casting rays: what is met first, hidden back faces passed. */
#include "trace/hit.h"

#include "scene/cuts.h"
#include "scene/light.h"
#include "scene/surface.h"

static bool has_back(const graze_scene *scene, int64_t surface) {
    return scene_material_has_back(scene_material_at(scene, surface));
}

/* Whether the ray goes on behind what it has met: what is cut away, and back faces that are hidden. A face of a cut has
 * its front in the antimatter, wherever this has its own. Apart from what all rays need, which is faster without it. */
__attribute__((noinline)) static bool goes_on(const path_context *context, scene_cuts_walk *walk,
                                              const geometry_ray *ray, geometry_hit *found, bool *passed) {
    const graze_scene *scene = context->scene;
    if (scene->cuts) {
        scene_presence presence = scene_cuts_at(scene, walk, found->surface, found->point, ray->direction);
        if (presence == SCENE_CUT_AWAY)
            return true;
        if (presence == SCENE_CUT_FACE)
            found->normal = vec3_negate(found->normal);
    }
    bool behind = vec3_dot(found->normal, ray->direction) > 0;
    if (!behind || context->settings->back_faces_visible || has_back(scene, found->surface))
        return false;
    *passed = *passed || !scene_surface_passes(scene, found->surface);
    return true;
}

void path_cast_into(path_hit *hit, const path_context *context, vec3 origin, vec3 direction, double limit,
                    int64_t from) {
    const graze_scene *scene = context->scene;
    const bool may_go_on = scene->cuts || !context->settings->back_faces_visible;
    geometry_ray ray = {.origin = origin, .direction = direction, .far = limit, .from = from};
    geometry_hit found;
    scene_cuts_walk walk;
    double travelled = 0;
    bool passed = false;
    walk.begun = false;
    while (geometry_intersect(scene->geometry, &ray, &found)) {
        if (!may_go_on || !goes_on(context, &walk, &ray, &found, &passed)) {
            *hit = (path_hit){.surface = found.surface,
                              .light = scene_surface_at(scene, found.surface).light,
                              .distance = travelled + found.distance,
                              .point = found.point,
                              .normal = found.normal,
                              .direction = direction,
                              .behind = vec3_dot(found.normal, direction) > 0,
                              .passed = passed};
            return;
        }
        travelled += found.distance;
        ray.origin = found.point;
        ray.far -= found.distance;
        ray.from = found.surface;
    }
    *hit = (path_hit){.surface = -1,
                      .light = limit >= GEOMETRY_FAR ? light_source_towards(scene, direction) : -1,
                      .distance = GEOMETRY_FAR,
                      .point = origin,
                      .direction = direction,
                      .passed = passed};
}
