/* What building a geometry and asking it have in common. */
#ifndef GEOMETRY_GEOMETRY_INTERNAL_H
#define GEOMETRY_GEOMETRY_INTERNAL_H

#include <float.h>

#include "geometry/embree.h"
#include "geometry/geometry.h"
#include "geometry/shaft_tree.h"

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

/* A surface goes through a point where it is no farther from it than this times the coordinates of both: the roundings
 * of a point computed on it, and of the distance. */
#define GEOMETRY_ON_SURFACE (16 * DBL_EPSILON)
/* Surfaces that are meant to coincide differ by what writing them down has cost, in proportion to their coordinates:
 * with 12 digits, as Radiance's xform does, by GEOMETRY_DESCRIBED (half a digit in each of three coordinates of two
 * surfaces, and twice that where the larger goes beyond the smaller); in single precision by GEOMETRY_SINGLE, but that
 * counts only up to Radiance's own tolerance, its GEOMETRY_FTINY. */
#define GEOMETRY_DESCRIBED 0x1p-34
#define GEOMETRY_SINGLE    0x1p-22
#define GEOMETRY_FTINY     1e-6

/* How far apart surfaces of such coordinates may be found from an origin of such coordinates, that are meant to
 * coincide. */
static inline double geometry_coincidence(double coordinates, double origin) {
    return double_max(GEOMETRY_DESCRIBED * coordinates, double_min(GEOMETRY_SINGLE * coordinates, GEOMETRY_FTINY)) +
           GEOMETRY_ON_SURFACE * origin;
}

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

struct geometry_few;

/* One group as Embree has it. */
typedef struct geometry_tree {
    const shape *shapes;
    size_t shape_count;
    const geometry_placement *placements;
    size_t placement_count;
    RTCScene scene;           /* null where there is nothing, or: */
    struct geometry_few *few; /* in its place (geometry/few.h); null: not */
    vec3 lower, upper, center;
    double radius;                /* around the center; holds all */
    double scale;                 /* a power of two that makes the radius at most 1 */
    geometry_triangle *triangles; /* by Embree's primitive numbers; aligned to cache lines */
    size_t triangle_count;
    double *reach; /* each own surface's largest coordinate */
    int *curved;   /* the surfaces that are no polygons, by Embree's primitive numbers */
    size_t curved_count;
    uint32_t *placed; /* the copies that are not empty, by Embree's primitive numbers */
    size_t placed_count;
    int64_t *firsts;                  /* by copy: the number of its first surface */
    int64_t surface_count;            /* of its own and of all copies */
    unsigned triangles_id, placed_id; /* Embree's, or RTC_INVALID_GEOMETRY_ID */
} geometry_tree;

struct geometry {
    geometry_tree *trees; /* by group: the scene first */
    size_t tree_count;
    bool empty;           /* no ray meets anything */
    RTCDevice device;     /* null in an empty scene, or one of few surfaces */
    int threads;          /* that may build */
    double largest_reach; /* of all surfaces' coordinates */
    /* Without nodes unless prepared (geometry/shaft.h). */
    shaft_tree sights;        /* over the scene's own shapes */
    shaft_tree copied_sights; /* over boxes around copies */
    shape *copied_boxes;      /* each with a polygon's two corners in place of an outline */
};

/* A corner of the triangle, where its group stands. */
static inline vec3 geometry_corner(const geometry_tree *tree, const geometry_triangle *triangle, int corner) {
    const shape *s = &tree->shapes[triangle->surface];
    return s->polygon.vertices[s->polygon.triangles[triangle->index][corner]];
}

/* The box around a copy in the scene. */
void geometry_copy_bounds(const geometry *, const geometry_placement *, vec3 *lower, vec3 *upper);

/* A surface of a copy, in the scene (shape_placed). */
shape geometry_placed_shape(const geometry *, int64_t surface);
double geometry_placed_reach(const geometry *, int64_t surface);

/* The callbacks: exact tests of what Embree comes upon. */
void geometry_filter_intersect(const struct RTCFilterFunctionNArguments *);
void geometry_filter_occluded(const struct RTCFilterFunctionNArguments *);
void geometry_intersect_curved(const struct RTCIntersectFunctionNArguments *);
void geometry_occluded_curved(const struct RTCOccludedFunctionNArguments *);
void geometry_intersect_copy(const struct RTCIntersectFunctionNArguments *);
void geometry_occluded_copy(const struct RTCOccludedFunctionNArguments *);

#endif
