/* The names of the reflectance models on command lines. */
#include "tools/common/model_name.h"

#include <string.h>

const char *model_name(graze_brdf_model model) {
    static const char *const names[] = {
        [GRAZE_BRDF_GMD] = "gmd",
        [GRAZE_BRDF_WARD] = "ward",
        [GRAZE_BRDF_WARD_DUER] = "ward-duer",
        [GRAZE_BRDF_WARD_NEUMANN] = "ward-neumann",
    };
    return names[model];
}

bool model_find(const char *name, graze_brdf_model *model) {
    for (int i = GRAZE_BRDF_GMD; i <= GRAZE_BRDF_WARD_NEUMANN; i++)
        if (strcmp(name, model_name((graze_brdf_model)i)) == 0) {
            *model = (graze_brdf_model)i;
            return true;
        }
    return false;
}
