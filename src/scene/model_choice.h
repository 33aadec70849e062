/* Which reflectance model a material gets. */
#ifndef SCENE_MODEL_CHOICE_H
#define SCENE_MODEL_CHOICE_H

#include "graze/scene.h"
#include "rad/scene_file.h"

/* Reports unknown models, names that no material has, and names of what has no reflectance model. */
graze_status scene_check_models(const graze_scene_settings *, const rad_primitive *, size_t count,
                                const graze_report *);

/* The model of the material that the primitive describes. */
graze_brdf_model scene_choose_model(const graze_scene_settings *, const rad_primitive *);

#endif
