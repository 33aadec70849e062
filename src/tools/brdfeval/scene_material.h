/* Reflectance from the materials of scene files. */
#ifndef TOOLS_BRDFEVAL_SCENE_MATERIAL_H
#define TOOLS_BRDFEVAL_SCENE_MATERIAL_H

#include "graze/error.h"
#include "tools/brdfeval/evaluation.h"

/* Fills in all but the lobe's model, which stays, from the last material of this name in the file (or `!command`, or
 * `-`): plastic, metal, plastic2, metal2, and aliases of these. The frame's x is along the material's orientation. All
 * else, mirrors among it, is an error. */
graze_status scene_material_read(reflectance *, const char *file, const char *name, const graze_report *);

#endif
