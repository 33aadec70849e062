/* What the files of this folder share: the way between the world and the shading frame, and the reflectance in the
 * frame. */
#ifndef MATERIAL_LOBES_H
#define MATERIAL_LOBES_H

#include <float.h>
#include <stdbool.h>

#include "base/vector.h"
#include "graze/material.h"

static inline frame material_frame(const graze_surface *s) {
    return (frame){s->x, s->y, s->n};
}

/* Infinity, where a product has left a double's range, becomes DBL_MAX. */
static inline rgb material_saturate(rgb a) {
    return (rgb){double_min(a.r, DBL_MAX), double_min(a.g, DBL_MAX), double_min(a.b, DBL_MAX)};
}

/* The reflectance of the diffuse part for light at `cosine` > 0. */
rgb material_diffuse_reflectance(const graze_surface *, double cosine);

/* The rough transmitted lobe of a surface that has one, at a direction in the shading frame, for transmitted specular
 * reflectance 1 (the sample's weight is in its colour). */
double material_transmitted_value(const graze_surface *, vec3 l);
double material_transmitted_density(const graze_surface *, vec3 l);
graze_surface_sample material_transmitted_sample(const graze_surface *, double random_radius, double random_angle,
                                                 double choice);

/* The same of the lobe of ashik2. */
double material_ashikhmin_value(const graze_surface *, vec3 l);
double material_ashikhmin_density(const graze_surface *, vec3 l);
graze_surface_sample material_ashikhmin_sample(const graze_surface *, double random_turn, double random_tilt);

static inline bool material_is_ashikhmin(const graze_surface *s) {
    return s->lobe.model == GRAZE_BRDF_MODEL_COUNT;
}

/* graze_surface_value for a direction in the shading frame. */
void material_local_value(const graze_surface *, vec3 l, rgb *diffuse, rgb *glossy);

#endif
