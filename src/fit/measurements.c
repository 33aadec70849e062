/* Memory of measurements, and the words for conventions. */
#include "fit/measurements.h"

#include <stdlib.h>

void fit_measurements_free(fit_measurements *m) {
    for (size_t i = 0; i < m->channel_count; i++)
        free(m->channels[i].text);
    for (size_t i = 0; i < m->source_count; i++)
        free(m->sources[i].file);
    free(m->channels);
    free(m->sources);
    free(m->pairs);
    free(m->values);
    *m = (fit_measurements){0};
}

const char *fit_format_text(fit_format format) {
    static const char *const texts[] = {"any", "table", "cornell", "alta", "pab", "merl"};
    return texts[format];
}

const char *fit_unit_text(fit_unit unit) {
    static const char *const texts[] = {"any", "degrees", "radians", "components"};
    return texts[unit];
}

const char *fit_quantity_text(fit_quantity quantity) {
    static const char *const texts[] = {"any", "brdf", "brdf-cosine-out", "brdf-cosine-in"};
    return texts[quantity];
}

const char *fit_light_text(fit_light light) {
    static const char *const texts[] = {"any", "in", "out"};
    return texts[light];
}

const char *fit_mirror_text(fit_mirror mirror) {
    static const char *const texts[] = {"any", "opposite", "same"};
    return texts[mirror];
}

const char *fit_origin_text(fit_origin origin) {
    static const char *const texts[] = {"assumed", "of the format", "of the file", "as told"};
    return texts[origin];
}
