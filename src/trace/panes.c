/* Rays that pass straight through surfaces: shadow rays, and the eye's where clear bodies are not there for it. */
#include "trace/panes.h"

#include "scene/cuts.h"
#include "scene/surface.h"
#include "trace/appearance.h"

/* What a surface that light passes lets through of the ray that meets it. One that is not there lets all. */
static rgb pane_transmittance(const path_context *context, scene_cuts_walk *walk, const geometry_hit *hit,
                              vec3 direction, double length, double travelled, bool is_proper) {
    const graze_scene *scene = context->scene;
    scene_presence presence =
        scene->cuts ? scene_cuts_at(scene, walk, hit->surface, hit->point, direction) : SCENE_THERE;
    if (presence == SCENE_CUT_AWAY)
        return rgb_gray(1);
    vec3 normal = presence == SCENE_CUT_FACE ? vec3_negate(hit->normal) : hit->normal;
    double slope = vec3_dot(normal, direction);
    const scene_material *material = &scene->materials[scene_surface_at(scene, hit->surface).material];
    if (slope < 0 && (material->keeps_front || (!is_proper && scene_material_emits(material))))
        return rgb_gray(0);
    material = scene_material_seen(scene, material);
    if (slope > 0 && !context->settings->back_faces_visible && !scene_material_has_back(material))
        return rgb_gray(1);
    if (appearance_is_plain(scene, material, hit->surface))
        return graze_material_straight_through(&material->reflector, fabs(slope));
    const path_hit at = {.surface = hit->surface,
                         .light = -1,
                         .distance = travelled + hit->distance,
                         .point = hit->point,
                         .normal = normal,
                         .direction = direction,
                         .behind = slope > 0};
    return appearance_straight_through(context, material, &at, length);
}

rgb panes_transmittance(const path_context *context, const geometry_ray *ray, double length, int64_t target,
                        bool is_proper) {
    const graze_scene *scene = context->scene;
    geometry_ray left = *ray;
    geometry_hit hit;
    geometry_panes panes;
    if (geometry_occluded_but_for_panes(scene->geometry, ray, target, &panes))
        return rgb_gray(0);
    rgb transmittance = {1, 1, 1};
    scene_cuts_walk walk;
    double travelled = 0;
    walk.begun = false;
    if (panes.count == 1)
        return pane_transmittance(context, &walk, &panes.only, ray->direction, length, travelled, is_proper);
    while (panes.count > 0 && !rgb_is_black(transmittance) && geometry_intersect(scene->geometry, &left, &hit) &&
           hit.surface != target && scene_surface_passes(scene, hit.surface)) {
        transmittance = rgb_multiply(
            transmittance, pane_transmittance(context, &walk, &hit, ray->direction, length, travelled, is_proper));
        travelled += hit.distance;
        left.origin = hit.point;
        left.far -= hit.distance;
        left.from = hit.surface;
    }
    return transmittance;
}

/* Of the types that Radiance calls transparent, whatever they let through. */
static bool is_clear(const graze_scene *scene, const path_hit *hit) {
    if (hit->surface < 0)
        return false;
    const scene_material *m = scene_material_at(scene, hit->surface);
    switch (m->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        return m->reflector.kind == GRAZE_TRANS || m->reflector.kind == GRAZE_GLASS ||
               m->reflector.kind == GRAZE_DIELECTRIC;
    case SCENE_FUNCTION:
        return m->reflection->passes;
    case SCENE_WGMD:
        return m->wgmd->has[WGMD_THROUGH];
    case SCENE_NOTHING:
        return true;
    case SCENE_EMITTER:
    case SCENE_PRISM:
    case SCENE_MIXTURE:
        break;
    }
    return false;
}

path_hit panes_look_through(const path_context *context, const path_hit *first) {
    path_hit hit = *first;
    while (is_clear(context->scene, &hit)) {
        path_hit next = path_cast(context, hit.point, hit.direction, GEOMETRY_FAR, hit.surface);
        next.distance = next.distance < GEOMETRY_FAR ? hit.distance + next.distance : GEOMETRY_FAR;
        hit = next;
    }
    return hit;
}
