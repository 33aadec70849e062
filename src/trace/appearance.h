/* Surfaces whose material has patterns, textures, or functions, or is a mixture: as they are at a hit. */
#ifndef TRACE_APPEARANCE_H
#define TRACE_APPEARANCE_H

#include "trace/path_state.h"

/* Prepares the vertex's shading, and what depends on it, for a material that is not plain; `v->normal` must be set.
 * Where two materials are mixed that cannot be prepared as one, one of them is drawn. */
void appearance_prepare(const path *, const path_hit *, const scene_material *, vertex *v);

/* The normal that reflection goes by at a hit, on the viewer's side; of a mixture that of the larger share. `length` is
 * that of the path before the ray. */
vec3 appearance_normal(const graze_scene *, const path_hit *, double length);

#endif
