/* Glass and dielectrics as seen from one direction. */
#ifndef MATERIAL_REFRACTION_H
#define MATERIAL_REFRACTION_H

#include "base/vector.h"
#include "graze/material.h"

/* Set the colours, lobes and directions of a surface whose frame and view stand. */
void material_prepare_glass(graze_surface *, const graze_material *);
void material_prepare_dielectric(graze_surface *, const graze_material *, int inside);

void material_prepare_mirror(graze_surface *, const graze_material *, int behind);

/* What a pane lets straight through at this cosine. */
rgb material_glass_transmittance(const graze_material *, double cosine);

#endif
