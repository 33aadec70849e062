/* Materials that shine: light, illum, glow, spotlight. */
#ifndef SCENE_EMITTER_H
#define SCENE_EMITTER_H

#include "scene/scene.h"

/* Whether the primitive is a material that shines. */
bool emitter_is(rad_type);

/* A source's or spotlight's full angle in 0 .. 360 degrees: Radiance knows it by the cosine of its half, so that beyond
 * 360 it becomes smaller again, to 0 at 720, and so on. That is warned of. */
double emitter_full_angle(double degrees, const rad_primitive *, const graze_report *);

/* Fills in what the material says of a light: radiance, glow, spot. */
graze_status emitter_to_light(scene_light *, const rad_primitive *material, const graze_report *);

#endif
