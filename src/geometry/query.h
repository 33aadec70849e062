/* A ray on its way: what is asked of it, and what has been found. For the files named query_*.c and few_look*
 * alone.
 *
 * Embree finds candidates in single precision; which of them the ray meets, and where, is decided in double precision
 * alone (query_triangle.c, query_curved.c), as is which of them count (query_offer.c). What single precision may
 * mistake is then only which candidates there are, near edges: see query_miss.c. Where surfaces are few, few_look.h
 * finds them in its place.
 *
 * Where copies of groups are placed, Embree is sent through each group in that group's own units, along the ray as it
 * is there (query_cast.c, query_copy.c): single precision then costs no more than if the group were all of the scene.
 * What Embree comes upon is brought into the scene and decided there, as for all others: a surface is the same to every
 * ray, and surfaces that share corners in a group share them in the scene. */
#ifndef GEOMETRY_QUERY_H
#define GEOMETRY_QUERY_H

#include "geometry/geometry_internal.h"

typedef struct candidate {
    double distance;
    vec3 normal;
    double slope; /* cosine between ray and normal */
    int64_t surface;
    bool shines;
    const geometry_triangle *triangle; /* null where the surface is curved, or in a copy of a group */
} candidate;

/* About where Embree took a triangle to be met that is not. */
typedef struct miss {
    double distance;
    double error; /* how far from it the ray really passes */
    double reach; /* how far along the ray that may lead: the more oblique, the farther */
} miss;

/* Places on a ray where Embree has been wrong about a triangle; more of them are very unlikely. */
#define QUERY_MISSES 16

/* The group that Embree is in, on its way along the ray. */
typedef struct visit {
    const geometry_tree *tree;
    const rad_transform *transform;      /* into the scene; null: it is the scene itself */
    const geometry_placement *replacing; /* the outermost copy around it that replaces; or null */
    int64_t first;                       /* the number of its first surface */
    vec3 center;                         /* of all in it, in the scene */
    double radius;
    double unit;  /* the length of Embree's unit, in the scene: a power of two in the scene itself */
    double start; /* distance along the ray of Embree's origin: where it enters the group, a little before */
    double end;   /* and where it leaves the group or comes to its own end, a little behind */
} visit;

/* One to be offered, and those that it may stand back behind. */
enum { QUERY_CANDIDATES = 4 };

typedef struct query {
    embree_context context; /* first, since Embree hands on its address */
    const geometry *geometry;
    visit scene; /* as all visits begin */
    const visit *visit;
    vec3 origin, direction;
    double size;                 /* the origin's largest coordinate */
    double at_once;              /* crossings up to here are at the origin */
    double farthest_coincidence; /* how far apart any surfaces may be found that are meant to coincide */
    double far; /* crossings beyond are none; where `any` is asked, but for what coincides with the target */
    int64_t from, target;
    bool any; /* whether something blocks the ray is all that is asked */
    bool found_any;
    bool passes_panes; /* what light passes does not block, but */
    int panes;         /* they are counted, many as 2; of one, this: */
    candidate pane;
    const candidate *nearest, *nearest_front, *nearest_shining; /* null: none */
    candidate *next;                                            /* where the next one to be offered is put */
    candidate candidates[QUERY_CANDIDATES];                     /* these */
    const miss *around;                                         /* the miss that is being looked after */
    int miss_count;
    miss misses[QUERY_MISSES]; /* that many of them have been set, and no more is ever read */
} query;

/* The bound of single precision's errors, as a length of the scene. */
static inline double query_float_error(const visit *v) {
    return GEOMETRY_FLOAT_ERROR * v->unit;
}

/* How far apart surfaces of such coordinates may be found that are meant to coincide. */
static inline double query_coincidence(const query *q, double coordinates) {
    return geometry_coincidence(coordinates, q->size);
}

/* Embree's own distance in a group, beyond which nothing matters: behind what it takes for the distance of surfaces
 * that coincide with the nearest one. */
static inline float query_embree_limit(const query *q, const visit *v) {
    double limit = v->end;
    if (q->nearest)
        limit = double_min(limit, q->nearest->distance +
                                      (query_float_error(v) + q->farthest_coincidence) / fabs(q->nearest->slope));
    return (float)((limit - v->start) / v->unit);
}

/* Whether what has been met in a copy shines, and would where it is not replaced. */
static inline bool query_shines(const query *q, bool own) {
    return q->visit->replacing ? q->visit->replacing->shines : own;
}

/* Whether two crossings are of surfaces that are meant to coincide. */
bool query_coincide(const query *, const candidate *, const candidate *);

/* Whether a crossing lies before the ray's end, and is not at its origin. */
bool query_in_reach(const query *, const candidate *);

/* Takes the crossing at q->next, which is in reach, into account; true where that shortens the search. */
bool query_offer(query *);

/* Offers a triangle near a miss. One that the ray passes far off has nothing to do with it. */
void query_offer_neighbour(query *, unsigned primitive);

/* Offers a plate of a scene of few surfaces, by its `count` triangles, which stand one after another. The ray is
 * `certain` to meet it, or may: then they tell. */
void query_offer_plate(query *, const geometry_triangle *, unsigned count, bool certain);

/* Offers a surface that is no polygon, by Embree's number of it; true where that shortens the search. */
bool query_offer_curved(query *, unsigned primitive);

/* The place at a distance along the ray, in Embree's units of the group that is visited. */
vec3 query_embree_place(const query *, double distance);

/* The part of the ray that lies in the ball about all that is visited; false where there is none. */
bool query_clip(const query *, visit *);

/* Sends Embree along the ray, through the group that is visited. */
void query_cast(query *);

/* A visit to a copy that is placed in the group visited. Their transforms together go to *both if it is needed. */
visit query_visit_copy(const query *, unsigned primitive, rad_transform *both);

/* Looks after the misses, once Embree has been sent through all. */
void query_look_after_misses(query *);

#endif
