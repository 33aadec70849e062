/* Telling scenes apart. */
#ifndef SCENE_FINGERPRINT_H
#define SCENE_FINGERPRINT_H

#include "scene/scene.h"

/* A number of all that the scene's descriptions say (names, types, modifiers, arguments, in their order), and
 * of what is in the octrees, meshes, function files, data files and pictures that they name, but not of where they say
 * it. */
uint64_t scene_fingerprint(const graze_scene *);

#endif
