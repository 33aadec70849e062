/* The surfaces of one material that says what is inside of them, wherever they are in a scene. */
#ifndef SCENE_BOUNDS_H
#define SCENE_BOUNDS_H

#include "scene/scene.h"

typedef struct scene_bounds {
    geometry *geometry;
    shape *shapes; /* those of copied parts */
    geometry_placement *placements;
} scene_bounds;

/* Builds them from the scene's own surfaces of the material, which must live as long as this, and those in copies. */
graze_status scene_bounds_build(scene_bounds *, const graze_scene *, int material, const shape *own, size_t own_count,
                                int threads, const graze_report *);
void scene_bounds_destroy(scene_bounds *);

#endif
