/* What antimatter cuts out of other surfaces, and the surfaces that it closes them by; and those of mist in copies,
 * which are not there. */
#ifndef SCENE_CUTS_H
#define SCENE_CUTS_H

#include "scene/scene.h"

typedef struct scene_cuts scene_cuts;

/* How a surface is at one of its points. */
typedef enum scene_presence {
    SCENE_THERE,
    SCENE_CUT_AWAY, /* it is not there; as antimatter itself is not */
    SCENE_CUT_FACE  /* antimatter, in a body that it cuts: it closes this, with its front where the antimatter is */
} scene_presence;

/* What was found behind a point of a ray, from the first surface there on: whoever follows the ray back from a point
 * further on need go no farther than to this. */
typedef struct scene_cuts_crossing {
    int antimatter;
    int64_t surface; /* that first one; -1: none is known */
    vec3 point;
    bool entered;    /* by the ray */
    int balance;     /* how often the ray has entered more than left there, this surface counted */
    int most;        /* the most it has, of all places behind the point that one could begin to count at */
    uint64_t others; /* what else cuts the surface at the first such place */
} scene_cuts_crossing;

/* As many are remembered of a ray, by the last bits of the antimatter's number. */
enum { SCENE_CUTS_REMEMBERED = 4 };

/* A ray that meets one surface after another. */
typedef struct scene_cuts_walk {
    bool begun;
    scene_cuts_crossing antimatters[SCENE_CUTS_REMEMBERED]; /* their own surfaces */
    scene_cuts_crossing bodies[SCENE_CUTS_REMEMBERED];      /* those that they cut */
} scene_cuts_walk;

/* Finds out what is cut, where there is antimatter or mist in copies: sets scene->cuts. Refuses to cut lights. */
graze_status scene_cuts_make(graze_scene *, int threads, const graze_report *);
void scene_cuts_destroy(scene_cuts *); /* null is let pass */

/* Of a scene with cuts: how a surface is where a ray in this direction meets it. The walk is the ray's, which is to
 * come to its points in order; a new one has not begun. */
scene_presence scene_cuts_at(const graze_scene *, scene_cuts_walk *, int64_t surface, vec3 point, vec3 direction);

#endif
