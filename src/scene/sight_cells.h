/* Cells of large flat surfaces, for which it is found out once what stands between them and a light. */
#ifndef SCENE_SIGHT_CELLS_H
#define SCENE_SIGHT_CELLS_H

#include "geometry/patch_sight.h"
#include "scene/scene.h"

/* Of more lights, some are chosen to be sampled at a point: too many cells would be found out for them. */
enum { SIGHT_CELLS_LIGHTS_MOST = 8 };

/* Divides the scene's large surfaces into cells, if it has few lights. */
graze_status sight_cells_make(graze_scene *, const graze_report *);
void sight_cells_destroy(struct sight_cells *);

/* One of them. */
typedef struct sight_cell {
    const struct sight_grid *grid; /* of the surface; null: it has no cells */
    int number;
} sight_cell;

/* The cell that a point of the surface is in, of its number from 1. */
sight_cell sight_cells_find(const graze_scene *, int cells, vec3 point);

static inline sight_cell sight_cells_at(const graze_scene *scene, int64_t surface, vec3 point) {
    const bool own = surface >= 0 && surface < (int64_t)scene->surface_count;
    const int cells = own ? scene->surfaces[surface].cells : 0;
    return cells > 0 ? sight_cells_find(scene, cells, point) : (sight_cell){NULL, 0};
}

/* What all points of the cell see of a light (geometry_sight_of_patch), found out if it is not known yet; of what has
 * no cells, MIXED. */
geometry_visibility sight_cell_sees(const graze_scene *, sight_cell, int light);

#endif
