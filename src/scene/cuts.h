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

/* Finds out what is cut, where there is antimatter or mist in copies: sets scene->cuts. Refuses to cut lights. */
graze_status scene_cuts_make(graze_scene *, int threads, const graze_report *);
void scene_cuts_destroy(scene_cuts *); /* null is let pass */

/* Of a scene with cuts: how a surface is where a ray in this direction meets it. */
scene_presence scene_cuts_at(const graze_scene *, int64_t surface, vec3 point, vec3 direction);

#endif
