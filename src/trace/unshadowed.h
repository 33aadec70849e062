/* What a surface reflects of a light if nothing stands between them, without sampling (graze/brdf_light.h). */
#ifndef TRACE_UNSHADOWED_H
#define TRACE_UNSHADOWED_H

#include "graze/material.h"
#include "scene/scene.h"

/* The integrals over the directions of a light of cosine/pi, and of the glossy lobe for specular reflectance 1 times
 * the cosine. */
typedef struct unshadowed_light {
    double diffuse, glossy;
} unshadowed_light;

/* Whether there are such integrals for the surface at `point`, and that of the lobe where it is wanted. There are none
 * for cylinders and cones, polygons of many corners, spotlights, lights with patterns, sources of half the sky and more
 * or such that overlap, mirrors with Fresnel's estimate, and lobes of other models than the new one. */
bool unshadowed_light_at(const graze_scene *, const graze_surface *, vec3 point, int light, bool glossy,
                         unshadowed_light *);

#endif
