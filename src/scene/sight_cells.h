/* Cells of large flat surfaces, for which it is found out once what stands between them and a light. */
#ifndef SCENE_SIGHT_CELLS_H
#define SCENE_SIGHT_CELLS_H

#include "geometry/patch_sight.h"
#include "scene/scene.h"

/* Divides the scene's large surfaces into cells, if it has few lights. */
graze_status sight_cells_make(graze_scene *, const graze_report *);
void sight_cells_destroy(struct sight_cells *);

/* Finds out what is not known yet. */
geometry_visibility sight_cells_find(const graze_scene *, int cells, vec3 point, int light);

/* What all points of a cell see of a light, in it the point of the surface (geometry_sight_of_patch); of what has no
 * cells, MIXED. */
static inline geometry_visibility sight_cells_at(const graze_scene *scene, int64_t surface, vec3 point, int light) {
    if (!scene->sight_cells || light >= (int)scene->first_copied || surface < 0 ||
        surface >= (int64_t)scene->surface_count || scene->surfaces[surface].cells == 0)
        return GEOMETRY_MIXED;
    return sight_cells_find(scene, scene->surfaces[surface].cells - 1, point, light);
}

#endif
