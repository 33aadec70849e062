/* The convex region between a point and a light, as the files that test surfaces against it see it. */
#ifndef GEOMETRY_SHAFT_INTERNAL_H
#define GEOMETRY_SHAFT_INTERNAL_H

#include "geometry/shaft.h"
#include "geometry/shaft_tree.h"

/* Polygons of more corners are not known as lights; cutting a concave one may give half as many more. */
#define SHAFT_LIGHT_CORNERS 16
#define SHAFT_CORNERS       (3 * SHAFT_LIGHT_CORNERS / 2)

/* The convex hull of a point and a light. All is relative to the point. A sphere stands for the disk in which it is
 * touched by the cone of rays to it: what it hides of that cone lies before the disk. */
typedef struct shaft {
    const geometry_sight *sight;
    double tolerance; /* shaft_tolerance() of the light, and then of each surface with it */
    double near;      /* and these may coincide, by geometry.h */
    /* The light: a polygon of `corners`, cut off at the horizon, or a disk, which lies within the polygon. */
    vec3 corners[SHAFT_CORNERS];
    int corner_count;
    bool round;
    vec3 center, axis;
    double radius;
    /* A sphere's own center and radius; 0: it is none. */
    vec3 ball_center;
    double ball_radius;
    /* The plane of the light: its unit normal on the point's side, and the point's height over it. */
    vec3 base;
    double base_height;
    /* Inward unit normals of planes through the point that the hull lies within. */
    vec3 sides[SHAFT_CORNERS];
    int side_count;
    vec3 lower, upper; /* bounds of the hull, in the scene's coordinates */
} shaft;

typedef enum shaft_kind {
    SHAFT_UNKNOWN, /* not such a light, or too close to it */
    SHAFT_NOTHING, /* nothing of the light's front stands above the horizon */
    SHAFT_MADE,
} shaft_kind;

shaft_kind shaft_make(shaft *, const geometry *, const geometry_sight *);

typedef struct shaft_span {
    double low, high;
} shaft_span;

/* What is no farther apart than this touches, of points and surfaces with such largest coordinates: their roundings. */
double shaft_tolerance(double point, double surface);

/* The reach of the light along a vector: of products with it. */
shaft_span shaft_light_span(const shaft *, vec3 along);

/* What a shape does to the shaft: CLEAR: it leaves all rays pass, BLOCKED: it stops all. Subtracts from `budget` about
 * as many tests as that took. */
geometry_visibility shaft_meets_shape(shaft *, const geometry *, int surface, int *budget);

/* How far a shape reaches along a unit vector, from a point. */
double shaft_reach_of(const shape *, vec3 point, vec3 along);

#endif
