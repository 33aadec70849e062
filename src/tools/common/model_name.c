/* The names of the reflectance models on command lines. */
#include "tools/common/model_name.h"

#include <string.h>

/* NAME(model, name) of each. */
#define MODELS(NAME)                                                                                                   \
    NAME(GRAZE_BRDF_GMD, "gmd")                                                                                        \
    NAME(GRAZE_BRDF_WARD, "ward")                                                                                      \
    NAME(GRAZE_BRDF_WARD_DUER, "ward-duer")                                                                            \
    NAME(GRAZE_BRDF_WARD_NEUMANN, "ward-neumann")

#define ENTRY(model, name)      [model] = (name),
#define WITH_BLANK(model, name) " " name

static const char *const names[] = {MODELS(ENTRY)};
_Static_assert(sizeof names == GRAZE_BRDF_MODEL_COUNT * sizeof *names, "each model has a name");

const char *model_name(graze_brdf_model model) {
    return names[model];
}

const char *model_list(void) {
    return &(MODELS(WITH_BLANK))[1];
}

bool model_find(const char *name, graze_brdf_model *model) {
    for (int i = 0; i < GRAZE_BRDF_MODEL_COUNT; i++)
        if (strcmp(name, names[i]) == 0) {
            *model = (graze_brdf_model)i;
            return true;
        }
    return false;
}
