/* The names of the reflectance models on command lines. */
#ifndef TOOLS_COMMON_MODEL_NAME_H
#define TOOLS_COMMON_MODEL_NAME_H

#include <stdbool.h>

#include "graze/brdf.h"

const char *model_name(graze_brdf_model);
const char *model_list(void);                          /* all of them, with blanks between */
bool model_find(const char *name, graze_brdf_model *); /* false: there is none of that name */

#endif
