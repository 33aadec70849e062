/* Surfaces whose material has patterns, textures, or functions, or is a mixture, and surfaces in copies, which are
 * turned, or have normals of their own at a mesh's points: as they are at a hit. */
#ifndef TRACE_APPEARANCE_H
#define TRACE_APPEARANCE_H

#include "trace/path_state.h"

/* Whether what the material says is all there is to the surface. */
static inline bool appearance_is_plain(const graze_scene *scene, const scene_material *m, int64_t surface) {
    return m->kind == SCENE_REFLECTOR && !m->modifiers && surface < (int64_t)scene->surface_count;
}

/* Whether its normal may lean: what shines has no textures, but may be a mesh. */
static inline bool appearance_has_normal(const graze_scene *scene, const scene_material *m, int64_t surface) {
    return scene_material_emits(m) ? surface >= (int64_t)scene->surface_count : !appearance_is_plain(scene, m, surface);
}

/* Prepares the vertex's shading, and what depends on it, for a surface that is not plain; `v->normal` must be set.
 * Where two materials are mixed that cannot be prepared as one, one of them is drawn. */
void appearance_prepare(const path *, const path_hit *, const scene_material *, vertex *v);

/* The normal that reflection goes by at a hit, on the viewer's side; of a mixture, with the mean of its perturbations.
 * `length` is that of the path before the ray. */
vec3 appearance_normal(const graze_scene *, const path_hit *, double length);

/* The same without textures: the surface's own, or in a mesh what its corners say. */
vec3 appearance_smooth_normal(const graze_scene *, const path_hit *);

/* The reflector of a material that has one (SCENE_REFLECTOR, SCENE_ORIENTED) with its patterns at a hit. */
graze_material appearance_reflector(const graze_scene *, const scene_material *, const path_hit *, double length);

/* The radiance of what shines at a hit, in a copy or a mixture: with patterns and its share. */
rgb appearance_emission(const graze_scene *, const path_hit *, double length, rgb radiance);

/* What a surface with modifiers lets straight through of the ray that meets it, `length` from the eye to its origin. */
rgb appearance_straight_through(const path_context *, const scene_material *, const path_hit *, double length);

#endif
