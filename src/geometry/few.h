/* A scene of few surfaces: rays look through all of them, which takes less time than a tree does, and needs no Embree.
 *
 * Of each polygon there are plates, the parallelogram or the triangles that it consists of, and of all else a ball
 * around it. Some of a kind are tested at once, in double precision; what a ray surely passes by is not offered. */
#ifndef GEOMETRY_FEW_H
#define GEOMETRY_FEW_H

#include "geometry/geometry_internal.h"

/* Of either no more than this: they would take longer than Embree does. */
enum { GEOMETRY_FEW = 32 };

/* By coordinates, so that those of several lie side by side. */
typedef struct few_vec3 {
    double x[GEOMETRY_FEW], y[GEOMETRY_FEW], z[GEOMETRY_FEW];
} few_vec3;

/* A point of the plane is in the plate where u = u0 + u.point, v = v0 + v.point, 1 - u - cut v and 1 - v - cut u are
 * not negative. */
typedef struct few_plates {
    few_vec3 normal;
    double offset[GEOMETRY_FEW]; /* normal.point in the plane */
    few_vec3 u, v;
    double u0[GEOMETRY_FEW], v0[GEOMETRY_FEW];
    double cut[GEOMETRY_FEW];    /* 0: a parallelogram; 1: a triangle */
    double blur[GEOMETRY_FEW];   /* by how much u and v change with each unit of length */
    double uneven[GEOMETRY_FEW]; /* how far from the plane, or from a parallelogram's, the corners are */
    unsigned first[GEOMETRY_FEW], count[GEOMETRY_FEW]; /* the polygon's triangles that may be met there */
} few_plates;

typedef struct few_balls {
    few_vec3 center;
    double radius[GEOMETRY_FEW];
} few_balls;

struct query;
/* Offers what the ray meets, or may. */
typedef void geometry_look_function(struct query *);

/* Beyond the last ones nothing has a size: no ray meets it. */
typedef struct geometry_few {
    few_plates plates;
    few_balls balls; /* by Embree's numbers of curved surfaces */
    int plate_count, ball_count;
    geometry_look_function *look;
} geometry_few;

/* Whether the tree, which has been surveyed, has so few surfaces, and no copies. */
bool geometry_few_suffice(const geometry_tree *);

/* Lays out the tree's triangles and curved surfaces, and what rays look through in their place. */
graze_status geometry_few_make(geometry_tree *, const graze_report *);

/* The function for this processor is one of these. */
geometry_look_function few_look_baseline;
#if defined(__x86_64__) && defined(__GNUC__)
#define FEW_X86_64
geometry_look_function few_look_avx2;
#endif

#endif
