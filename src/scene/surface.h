/* Surfaces by their numbers (geometry/geometry.h): those of copies are told by where they come from. */
#ifndef SCENE_SURFACE_H
#define SCENE_SURFACE_H

#include "scene/scene.h"

/* As scene_surface_at, of a surface that is no own one of the scene. */
scene_surface scene_copied_surface(const graze_scene *, int64_t number);

static inline scene_surface scene_surface_at(const graze_scene *scene, int64_t number) {
    return number < (int64_t)scene->surface_count ? scene->surfaces[number] : scene_copied_surface(scene, number);
}

/* What the surface is seen as. */
static inline const scene_material *scene_material_at(const graze_scene *scene, int64_t number) {
    return scene_material_seen(scene, &scene->materials[scene_surface_at(scene, number).material]);
}

/* Whether light may go straight through the surface (geometry_passes). */
static inline bool scene_surface_passes(const graze_scene *scene, int64_t number) {
    return number < (int64_t)scene->surface_count ? scene->shapes[number].passes
                                                  : geometry_passes(scene->geometry, number);
}

/* Whether the surface's material is written for another place than the scene: that of the transform, which leads into
 * the scene. An instance's own modifier is written for where the instance stands. */
bool scene_material_is_moved(const graze_scene *, int64_t number, rad_transform *);

/* What is interpolated between the points of a mesh. */
typedef struct scene_mesh_point {
    bool has_normal, has_uv;
    vec3 normal; /* unit, in the scene */
    double uv[2];
} scene_mesh_point;

/* At a point of the surface; all false where that is no triangle of a mesh. */
scene_mesh_point scene_mesh_point_at(const graze_scene *, int64_t number, vec3 point);

/* Area of the surface, and whether it is flat. */
double scene_surface_area(const graze_scene *, int64_t number, bool *flat);

#endif
