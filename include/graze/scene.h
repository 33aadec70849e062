/* Scenes: Radiance descriptions read, checked and built for tracing. */
#ifndef GRAZE_SCENE_H
#define GRAZE_SCENE_H

#include <stddef.h>

#include "graze/brdf.h"
#include "graze/error.h"
#include "graze/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All that a ray can meet: surfaces, materials, lights. Never changes once loaded, so any number of threads may trace
 * it. */
typedef struct graze_scene graze_scene;

/* Which reflectance model the rough reflection of materials has, in place of GRAZE_BRDF_GMD. */
typedef struct graze_model_choice {
    const char *material; /* the plastic, metal, plastic2 or metal2 of this name, and its aliases; null: all of them */
    graze_brdf_model model;
} graze_model_choice;

/* Definitions in the language of function files, for all of them to see. */
typedef struct graze_definitions {
    const char *text; /* null: those of a function file */
    const char *file; /* its name, looked for along RAYPATH; with a text, what messages call that, or null */
} graze_definitions;

/* How a scene is to be built; all 0: as it stands in the description. */
typedef struct graze_scene_settings {
    int threads;                      /* that the building itself may use, below 1 for 1; the scene does not depend on
                                         it */
    const graze_model_choice *models; /* a material's own name wins over an alias's original, that over null; else the
                                         last */
    size_t model_count;
    const char *const *ambient_modifiers; /* names of modifiers of surfaces */
    size_t ambient_modifier_count;
    int ambient_modifiers_included;       /* 0: on surfaces with one of these modifiers diffuse interreflection is not
                                             computed: the ambient value stands for it. Else: on all others (with no
                                       modifier: on all) */
    const graze_definitions *definitions; /* read first, in order, and seen by all of the scene's functions: a name's
                                             later definition wins, but that of a function file itself over these */
    size_t definition_count;
} graze_scene_settings;

/* Reads `count` descriptions as one, in order: each a .rad file, an octree, `!command`, or `-` for standard input;
 * graze-scene(5) says what they may hold. Null stands for settings of 0. A model that there is not, or one chosen for a
 * name that no material has, or one of another kind, is an error. Returns GRAZE_OK and the scene in *scene, to be freed
 * with graze_scene_destroy; or GRAZE_INPUT_ERROR or GRAZE_SYSTEM_ERROR, with every mistake reported with its file, line
 * and column, and *scene null.
 */
GRAZE_API graze_status graze_scene_load(graze_scene **scene, const char *const *descriptions, size_t count,
                                        const graze_scene_settings *settings, const graze_report *report);

/* Frees the scene. Null is let pass. */
GRAZE_API void graze_scene_destroy(graze_scene *scene);

#ifdef __cplusplus
}
#endif

#endif
