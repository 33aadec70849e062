/* What building a geometry and asking it have in common. */
#ifndef GEOMETRY_GEOMETRY_INTERNAL_H
#define GEOMETRY_GEOMETRY_INTERNAL_H

#include "geometry/embree.h"
#include "geometry/geometry.h"

/* Embree works in single precision, on a scene moved and scaled into the unit ball. Per unit of their coordinates,
 * corners and a ray's origin are wrong by up to sqrt(3) 2^-25 each, and per unit of its length the ray by as much
 * again; the test of a triangle adds twice that. So where a ray of length t meets a triangle at a distance r from the
 * middle, they are displaced against each other by less than (r + t) times this. */
#define GEOMETRY_UNIT_ERROR 0x1p-22
/* And this is a bound for all of them. */
#define GEOMETRY_FLOAT_ERROR 0x1p-20

/* By so much are Embree's triangles larger on all sides than the true ones; less, but no less than the least, where
 * they are small. Hardly any ray then misses one that it should meet, and an exact test sorts out the others. Between
 * neighbours that overlap by too little, and lie above one another by a rounding, oblique rays would slip through. */
#define GEOMETRY_BORDER       0x1p-18
#define GEOMETRY_BORDER_LEAST 0x1p-22

/* What the exact test of a triangle begins with, in one cache line. */
typedef struct geometry_triangle {
    vec3 normal, center; /* of the polygon */
    int surface;
    uint32_t index : 31; /* among the polygon's triangles */
    uint32_t shines : 1;
    /* A hit is certain in spite of single precision where its least barycentric coordinate, times the cosine at which
     * the ray meets the triangle, is above this. */
    float margin;
    float error; /* how far from the true triangle Embree may take it to be met close by, in its units */
} geometry_triangle;
_Static_assert(sizeof(geometry_triangle) == 64, "a triangle fills one cache line");

struct geometry {
    const shape *shapes;
    RTCDevice device; /* null in an empty scene */
    RTCScene scene;
    vec3 center;
    double radius;                /* around the center; holds all */
    double scale;                 /* a power of two that makes the radius at most 1 */
    geometry_triangle *triangles; /* by Embree's primitive numbers; aligned to cache lines */
    size_t triangle_count;
    double *reach;        /* each surface's largest coordinate */
    double largest_reach; /* of all */
    int *curved;          /* the surfaces that are no polygons, by Embree's primitive numbers */
    size_t curved_count;
};

/* A corner of the triangle. */
vec3 geometry_corner(const geometry *, const geometry_triangle *, int corner);

/* The callbacks: exact tests of what Embree comes upon. */
void geometry_filter_intersect(const struct RTCFilterFunctionNArguments *);
void geometry_filter_occluded(const struct RTCFilterFunctionNArguments *);
void geometry_intersect_curved(const struct RTCIntersectFunctionNArguments *);
void geometry_occluded_curved(const struct RTCOccludedFunctionNArguments *);

#endif
