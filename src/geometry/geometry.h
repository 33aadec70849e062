/* All surfaces of a scene as Embree sees them, and the exact hit points of rays on them. */
#ifndef GEOMETRY_GEOMETRY_H
#define GEOMETRY_GEOMETRY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/report.h"
#include "base/vector.h"
#include "geometry/shape.h"
#include "rad/transform.h"

typedef struct geometry geometry;

/* A copy of a group. */
typedef struct geometry_placement {
    int group; /* index into the groups given to geometry_build */
    rad_transform transform;
    bool replaces;       /* all in it are of one material, whatever it is in the group, so that for each of them, */
    bool shines, passes; /* these are in place of the shape's; of copies in copies the outermost that replaces counts */
} geometry_placement;

/* Surfaces, and copies of other groups among them. What all copies have in common is there once.
 *
 * Surfaces have numbers. In a group come its own shapes first, in their order, then all surfaces of its first copy, in
 * their order within that one's group, then those of the second. */
typedef struct geometry_group {
    const shape *shapes;
    size_t shape_count;
    const geometry_placement *placements;
    size_t placement_count;
} geometry_group;

/* Radiance's "infinitely far" (FHUGE). */
#define GEOMETRY_FAR 1e10

typedef struct geometry_ray {
    vec3 origin;
    vec3 direction; /* unit */
    double far;     /* hits beyond are none; GEOMETRY_FAR for no limit */
    int64_t from;   /* the surface that the ray leaves, or -1: it is not hit again at its origin */
} geometry_ray;

typedef struct geometry_hit {
    int64_t surface; /* its number in the scene; -1: nothing hit */
    double distance;
    vec3 point;  /* on the surface to double precision */
    vec3 normal; /* unit, of the surface's own side (not turned towards the ray) */
} geometry_hit;

/* Builds from groups; what they point to must live as long as the geometry. The first one is the scene; copies are of
 * later groups than the one that they stand in, and no more than RAD_DEPTH deep. `threads` bounds the build's own.
 * An empty scene is allowed and hits nothing; Embree is then not even started, nor where surfaces are few (few.h). */
graze_status geometry_build(geometry **, const geometry_group *groups, size_t count, int threads, const graze_report *);
void geometry_destroy(geometry *);

/* The copy in a group, by its index, that holds the surface of this number in the group; *number becomes that within
 * the copy. -1: it is the group's own, and *number the index of its shape. */
int geometry_descend(const geometry *, int group, int64_t *number);

/* Where a surface comes from: its group and its shape there. */
typedef struct geometry_origin {
    int group;
    const shape *shape;
    bool copied;             /* else it is the scene's own: */
    rad_transform transform; /* to the scene */
} geometry_origin;

geometry_origin geometry_find(const geometry *, int64_t surface);

/* What the surface's shape says of itself, or a copy that replaces. */
bool geometry_shines(const geometry *, int64_t surface);
bool geometry_passes(const geometry *, int64_t surface);

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
 * in place of one that does not.
 *
 * What is in copies is hit where a surface with its corners, centres and radii transformed in double precision would
 * be: as if the copy's surfaces stood in the scene themselves. */
bool geometry_occluded(const geometry *, const geometry_ray *, int64_t target);

/* What light may pass on its way. */
typedef struct geometry_panes {
    int count;         /* 2: more than one, or no one knows */
    geometry_hit only; /* set where there is one */
} geometry_panes;

/* The same where shapes that light passes do not count. What of these is on the ray, if it is not occluded, goes to
 * *panes, which may be null: where they are many geometry_intersect finds them, one after another, up to `far` or the
 * target. */
bool geometry_occluded_but_for_panes(const geometry *, const geometry_ray *, int64_t target, geometry_panes *panes);

#endif
