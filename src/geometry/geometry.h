/* All surfaces of a scene as Embree sees them, and the exact hit points of rays on them. */
#ifndef GEOMETRY_GEOMETRY_H
#define GEOMETRY_GEOMETRY_H

#include <stdbool.h>
#include <stddef.h>

#include "base/report.h"
#include "base/vector.h"
#include "geometry/shape.h"

typedef struct geometry geometry;

/* Radiance's "infinitely far" (FHUGE). */
#define GEOMETRY_FAR 1e10

typedef struct geometry_ray {
    vec3 origin;
    vec3 direction; /* unit */
    double far;     /* hits beyond are none; GEOMETRY_FAR for no limit */
    int from;       /* the surface that the ray leaves, or -1: it is not hit again at its origin */
} geometry_ray;

typedef struct geometry_hit {
    int surface; /* index into the shapes given to geometry_build; -1: nothing hit */
    double distance;
    vec3 point;  /* on the surface to double precision */
    vec3 normal; /* unit, of the surface's own side (not turned towards the ray) */
} geometry_hit;

/* Builds from `count` shapes, which must live as long as the geometry. `threads` bounds the build's own. An empty scene
 * is allowed and hits nothing; Embree is then not even started. */
graze_status geometry_build(geometry **, const shape *shapes, size_t count, int threads, const graze_report *);
void geometry_destroy(geometry *);

/* The nearest hit, or false. Safe on any number of threads. A ray that is not finite hits nothing.
 *
 * Nothing here depends on the size of the scene. Surfaces coincide that are parallel, and no farther apart than their
 * own coordinates tell: as single precision rounds them, but no more than Radiance's 1e-6; or as 12 digits round them.
 * Of those that coincide, one whose front the ray meets is hit, and among those one that shines; among equals the later
 * one. What coincides with the surface that the ray leaves is not hit at its origin, but a surface that meets that one
 * at an angle is hit however close it is. A ray that leaves no surface does not hit what is within 1e-6 of its origin,
 * as in Radiance, or within a millionth of the origin's largest coordinate where that is less. */
bool geometry_intersect(const geometry *, const geometry_ray *, geometry_hit *);
/* Whether anything but the surface `target` (-1: none excepted) lies on the ray before `far` and does not coincide with
 * the target there (without one: is not that close to the end); or does and is hit in its place, as one that shines is
 * in place of one that does not. */
bool geometry_occluded(const geometry *, const geometry_ray *, int target);

#endif
