/* Participating media: what lies on a way through the scene's mist. */
#ifndef SCENE_MIST_H
#define SCENE_MIST_H

#include "scene/bounds.h"

/* As many materials of mist may a scene have: a bit for each. */
enum { MIST_MOST = 32 };

typedef struct mist_medium {
    rgb extinction;      /* per unit of length */
    rgb albedo;          /* of that, the part that is scattered */
    double eccentricity; /* of the phase function of Henyey and Greenstein, below 1; 0 or less: all directions alike */
} mist_medium;

/* A part of a way in which the medium is the same. */
typedef struct mist_span {
    double start, end;
    mist_medium medium;
    uint32_t mists; /* that it lies in */
} mist_span;

/* One of the materials. */
typedef struct mist_material {
    rgb extinction, albedo;
    double eccentricity;
    bool has_albedo, has_eccentricity;
    int *lights; /* light_count indices of those that it scatters */
    int light_count;
    shape *own; /* the scene's own surfaces of it */
    size_t own_count;
    scene_bounds bounds; /* built of these, and of those in copies */
} mist_material;

typedef struct scene_mist {
    int count;
    mist_material of[MIST_MOST];
} scene_mist;

/* Reads the arguments of a mist. */
graze_status scene_mist_read(mist_material *, const rad_primitive *, const graze_report *);

/* Once lights are known: finds those that mists name, and builds the bounds. */
graze_status scene_mist_make(graze_scene *, int threads, const graze_report *);
void scene_mist_destroy(scene_mist *); /* null is let pass */

/* Walks along a ray from span to span. */
typedef struct mist_walk {
    const scene_mist *mist;
    mist_medium everywhere;
    vec3 direction;
    double at, distance;
    struct {
        geometry_ray ray;
        double next; /* where its boundary is met; INFINITY: not any more */
        int change;  /* to the balance, then */
        int balance; /* how often the ray leaves it ahead more than it enters it */
    } of[MIST_MOST];
} mist_walk;

void mist_walk_begin(mist_walk *, const graze_scene *, const mist_medium *everywhere, vec3 origin, vec3 direction,
                     double distance);
/* False: the way is at its end. */
bool mist_walk_next(mist_walk *, mist_span *);

#endif
