/* Surfaces whose diffuse interreflection is not computed. */
#ifndef SCENE_AMBIENT_CHOICE_H
#define SCENE_AMBIENT_CHOICE_H

#include <stdbool.h>

#include "graze/scene.h"
#include "rad/scene_file.h"

/* Warns of names that no modifier has. */
void scene_check_ambient(const graze_scene_settings *, const rad_primitive *, size_t count, const graze_report *);

/* Whether the settings leave surfaces with this modifier out. */
bool scene_leaves_ambient_out(const graze_scene_settings *, const char *modifier);

#endif
