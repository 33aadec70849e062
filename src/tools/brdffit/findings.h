/* What brdffit has found, and how it is written down. */
#ifndef TOOLS_BRDFFIT_FINDINGS_H
#define TOOLS_BRDFFIT_FINDINGS_H

#include "base/records.h"
#include "fit/reflectance.h"

typedef struct findings {
    const fit_measurements *measurements;
    const fit_settings *settings; /* its model aside */
    const char *name;             /* of the material */
    size_t fit_count;
    fit_result fits[GRAZE_BRDF_MODEL_COUNT];
} findings;

const char *findings_loss_name(fit_loss);
const char *findings_state_name(fit_state);
/* The fit of the new model, which is what plastic2 and metal2 are; null if it was not asked for. */
const fit_result *findings_material_fit(const findings *);

/* The models side by side, below comments that say what was taken for granted, and the material behind them. */
void findings_append_table(record_buffer *, const findings *);
/* The material as a Radiance primitive, with comments; there must be a fit of the new model. */
void findings_append_material(record_buffer *, const findings *);
void findings_append_json(record_buffer *, const findings *);
/* What was taken for granted, as lines that begin with "# ". */
void findings_append_conventions(record_buffer *, const findings *);

/* Small things: a number with so many digits, a formatted text (of at most 400 bytes). */
void findings_append_number(record_buffer *, int digits, double value);
void findings_append_format(record_buffer *, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
