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

/* A box, from a point. */
typedef struct shaft_box {
    vec3 center, half;
} shaft_box;

static inline shaft_box shaft_box_from(const shaft_node *n, vec3 point) {
    vec3 half = vec3_scale(0.5, vec3_subtract(n->upper, n->lower));
    return (shaft_box){vec3_subtract(vec3_add(n->lower, half), point), half};
}

/* How far a box reaches along a vector. */
static inline shaft_span shaft_box_span(const shaft_box *b, vec3 along) {
    double middle = vec3_dot(along, b->center);
    double reach = fabs(along.x) * b->half.x + fabs(along.y) * b->half.y + fabs(along.z) * b->half.z;
    return (shaft_span){middle - reach, middle + reach};
}

/* Whether a box has nothing in common with these bounds. */
static inline bool shaft_box_is_beside(const shaft_node *n, vec3 lower, vec3 upper) {
    return n->upper.x < lower.x || n->lower.x > upper.x || n->upper.y < lower.y || n->lower.y > upper.y ||
           n->upper.z < lower.z || n->lower.z > upper.z;
}

/* Where a box stands with respect to a convex region. */
typedef enum shaft_place { SHAFT_OUTSIDE, SHAFT_ACROSS, SHAFT_INSIDE } shaft_place;

/* The corners of the polygon around a disk. */
#define SHAFT_ROUND_CORNERS 8
void shaft_surround_disk(vec3 corners[SHAFT_ROUND_CORNERS], vec3 center, vec3 axis, double radius);

/* What is no farther apart than this touches, of points and surfaces with such largest coordinates: their roundings. */
double shaft_tolerance(double point, double surface);

/* So far a polygon must keep off whose corners lie up to `uneven` beside its plane: candidates for a ray come from
 * corners and in single precision, distances from the plane. */
double shaft_slack(const geometry *, double uneven);

/* The reach of the light along a vector: of products with it. */
shaft_span shaft_light_span(const shaft *, vec3 along);

/* What a shape does to the shaft: CLEAR: it leaves all rays pass, BLOCKED: it stops all. Subtracts from `budget` about
 * as many tests as that took. */
geometry_visibility shaft_meets_shape(shaft *, const geometry *, int surface, int *budget);

/* How far a shape reaches along a unit vector, from a point. */
double shaft_reach_of(const shape *, vec3 point, vec3 along);

#endif
