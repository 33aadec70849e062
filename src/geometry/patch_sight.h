/* Whether all of a light is seen from every point of a flat patch, or nothing of it: decided once for all of them. */
#ifndef GEOMETRY_PATCH_SIGHT_H
#define GEOMETRY_PATCH_SIGHT_H

#include "geometry/shaft.h"

/* A parallelogram in the plane of one of the scene's own polygons, and a light. */
typedef struct geometry_patch {
    vec3 corners[4];   /* in turn */
    int surface;       /* the polygon; the patch may reach beyond its outline */
    int light;         /* the scene's own surface that shines; or -1: a source, */
    vec3 axis;         /* a cone about this unit vector */
    double half_angle; /* radians */
} geometry_patch;

/* Agrees with what geometry_occluded says of rays from the patch's points on the surface to the light's front, above
 * the horizon: it is false for all where the answer is CLEAR, true for all where it is BLOCKED; up to rays that touch
 * an edge within roundings. What light passes never makes it BLOCKED. MIXED is what is not known. The geometry must be
 * prepared (geometry_prepare_sights). */
geometry_visibility geometry_sight_of_patch(const geometry *, const geometry_patch *);

#endif
