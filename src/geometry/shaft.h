/* Whether all of a light is seen from a point, or nothing of it, decided for the whole light at once. */
#ifndef GEOMETRY_SHAFT_H
#define GEOMETRY_SHAFT_H

#include "geometry/geometry.h"

typedef enum geometry_visibility {
    GEOMETRY_MIXED,   /* some of the light is hidden, or may be: not known */
    GEOMETRY_CLEAR,   /* nothing is */
    GEOMETRY_BLOCKED, /* all of it is */
} geometry_visibility;

/* A lit point and a light. */
typedef struct geometry_sight {
    vec3 point;
    vec3 normal;       /* unit, on the lit side: what lies below the horizon does not matter */
    int64_t from;      /* the surface that the point is on, or -1: a sensor */
    int light;         /* the scene's own surface that shines; or -1: a source, */
    vec3 axis;         /* a cone about this unit vector */
    double half_angle; /* radians */
} geometry_sight;

/* Prepares a geometry for the questions below. Without that all their answers are MIXED and true, but where there are
 * no surfaces at all. */
graze_status geometry_prepare_sights(geometry *, const graze_report *);

/* Agrees with what geometry_occluded says of rays from the point to the light's front, above the horizon: it is false
 * for all where the answer is CLEAR, true for all where it is BLOCKED; up to rays that touch an edge within roundings.
 * What light passes never makes it BLOCKED.
 * Always MIXED for the sides of cones, inward spheres, polygons of more than 16 corners, and sources of half the sky
 * and more. What may meet copies of groups is MIXED: only their boxes are looked at. So is what takes too many steps,
 * which bounds the time: in meshes of 100,000 and of a million triangles such an answer took 1.4 and 2.6 microseconds.
 */
geometry_visibility geometry_sight_of(const geometry *, const geometry_sight *);

/* Whether anything that does not shine stands above the point's horizon, or may. */
bool geometry_reflects_above(const geometry *, vec3 point, vec3 normal, int64_t from);

#endif
