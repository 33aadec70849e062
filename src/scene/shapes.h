/* The shapes of many surfaces, made by several threads before surfaces are gone through in their order. */
#ifndef SCENE_SHAPES_H
#define SCENE_SHAPES_H

#include "scene/builder.h"

typedef struct scene_shapes {
    const rad_primitive *all; /* of the description */
    int *primitives;          /* by surface: index into these */
    shape *shapes;
    bool *ready; /* by surface: there is its shape; if not, making it is to say why, or has to warn of something */
    size_t count;
} scene_shapes;

/* Whether the primitive is a surface with a shape of its own: no source, mesh, or instance. */
static inline bool scene_has_shape(const rad_primitive *p) {
    return rad_type_is_surface(p->type) && p->type != RAD_SOURCE && p->type != RAD_MESH && p->type != RAD_INSTANCE;
}

/* Makes the shapes of those primitives from `first` to before `end` that have some, behind one another in `shapes`. */
graze_status scene_shapes_make(scene_shapes *, scene_builder *, size_t first, size_t end, shape *shapes);
void scene_shapes_free(scene_shapes *);

/* Puts the shape of a surface to `s`, which may be its own place or that of one before it, with what its material says
 * of it. Its material; or a negative number where there is no surface (reported). To be asked of one after the other.
 */
int scene_shapes_take(scene_builder *, const scene_shapes *, size_t surface, shape *s);

#endif
