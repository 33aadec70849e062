/* Materials that shine: light, illum, glow, spotlight. */
#ifndef SCENE_EMITTER_H
#define SCENE_EMITTER_H

#include "scene/scene.h"

/* Whether the primitive is a material that shines. */
bool emitter_is(rad_type);

/* Fills in what the material says of a light: radiance, glow, spot. */
graze_status emitter_to_light(scene_light *, const rad_primitive *material, const graze_report *);

#endif
