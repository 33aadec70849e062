/* A hit as the functions of the surface's material know it: in a copy, from where the material is written for. */
#ifndef TRACE_ENCOUNTER_H
#define TRACE_ENCOUNTER_H

#include "trace/path_state.h"

/* What a hit's appearance is found by. */
typedef struct encounter {
    material_ray ray;
    bool moved;              /* the material is written for another place: */
    rad_transform transform; /* from there to the scene */
    material_effect effect;  /* of the surface itself: a mesh's normal */
} encounter;

/* `length` is that of the path before the ray. */
encounter encounter_meet(const graze_scene *, const path_hit *, double length);

/* A unit vector of the scene, as the material's functions know it. */
static inline vec3 encounter_as_written(const encounter *e, vec3 direction) {
    return e->moved ? rad_transform_direction_back(&e->transform, direction) : direction;
}

/* What modifiers (null: none) do, after others. */
material_effect encounter_add_effect(const material_modifier *, const material_ray *, material_effect before);

/* What an effect adds to the hit's normal on the viewer's side: perturbations are for the surface's own. And the normal
 * with it. */
vec3 encounter_perturbation(const path_hit *, const encounter *, const material_effect *);
vec3 encounter_lean(const path_hit *, const encounter *, const material_effect *);

/* A colour under a pattern: negative ones reflect nothing, and what is too large would overflow. */
rgb encounter_colored(rgb color, rgb pattern);

#endif
