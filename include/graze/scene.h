/* Scenes: Radiance descriptions read, checked and built for tracing. */
#ifndef GRAZE_SCENE_H
#define GRAZE_SCENE_H

#include <stddef.h>

#include "graze/error.h"
#include "graze/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All that a ray can meet: surfaces, materials, lights. Never changes once loaded, so any number of threads may trace
 * it. */
typedef struct graze_scene graze_scene;

/* Reads `count` descriptions as one, in order: each a .rad file, `!command`, or `-` for standard input; graze-scene(5)
 * says what they may hold. `threads` (at least 1) bounds the threads that the building itself uses; the scene does not
 * depend on it. Returns GRAZE_OK and the scene in *scene, to be freed with graze_scene_destroy; or GRAZE_INPUT_ERROR or
 * GRAZE_SYSTEM_ERROR, with every mistake reported with its file, line and column, and *scene null. */
GRAZE_API graze_status graze_scene_load(graze_scene **scene, const char *const *descriptions, size_t count, int threads,
                                        const graze_report *report);

/* Frees the scene. Null is let pass. */
GRAZE_API void graze_scene_destroy(graze_scene *scene);

#ifdef __cplusplus
}
#endif

#endif
