/* What is to be known of lights with patterns before they are sampled. */
#ifndef SCENE_LIGHT_PATTERN_H
#define SCENE_LIGHT_PATTERN_H

#include "scene/scene.h"

/* Sets `typical` of all lights, and the tables of sources. */
graze_status light_patterns_prepare(graze_scene *, int threads, const graze_report *);

#endif
