/* Which reflectance model a material gets: the one chosen most specifically, or the new model. */
#include "scene/model_choice.h"

#include <string.h>

#include "material/from_primitive.h"

typedef enum fitness { NO_FIT = 0, FITS_ALL, FITS_ORIGINAL, FITS_NAME } fitness;

static fitness fitness_of(const graze_model_choice *choice, const rad_primitive *p) {
    if (!choice->material)
        return FITS_ALL;
    if (strcmp(choice->material, p->id) == 0)
        return FITS_NAME;
    return strcmp(choice->material, p->original_id) == 0 ? FITS_ORIGINAL : NO_FIT;
}

static graze_status check_name(const char *name, const rad_primitive *primitives, size_t count,
                               const graze_report *report) {
    const rad_primitive *other = NULL;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(name, primitives[i].id) != 0)
            continue;
        if (material_is_reflector(primitives[i].type))
            return GRAZE_OK;
        other = &primitives[i];
    }
    if (other)
        return rad_primitive_error(
            report, other, "has no reflectance model to choose: plastic, metal, trans and their like with a 2 have");
    return report_error(report, NULL, "there is no material '%s' to choose a reflectance model for", name);
}

graze_status scene_check_models(const graze_scene_settings *settings, const rad_primitive *primitives, size_t count,
                                const graze_report *report) {
    graze_status worst = GRAZE_OK;
    for (size_t i = 0; i < settings->model_count; i++) {
        const graze_model_choice *choice = &settings->models[i];
        graze_status status = GRAZE_OK;
        if ((int)choice->model < 0 || (int)choice->model >= GRAZE_BRDF_MODEL_COUNT)
            status = report_error(report, NULL, "unknown reflectance model %d", (int)choice->model);
        else if (choice->material)
            status = check_name(choice->material, primitives, count, report);
        worst = status > worst ? status : worst;
    }
    return worst;
}

graze_brdf_model scene_choose_model(const graze_scene_settings *settings, const rad_primitive *p) {
    graze_brdf_model model = GRAZE_BRDF_GMD;
    fitness best = FITS_ALL;
    for (size_t i = 0; i < settings->model_count; i++) {
        fitness fit = fitness_of(&settings->models[i], p);
        if (fit >= best) {
            best = fit;
            model = settings->models[i].model;
        }
    }
    return model;
}
