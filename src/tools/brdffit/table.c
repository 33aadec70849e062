/* The report as text: a column a model. */
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "tools/brdffit/findings.h"
#include "tools/common/model_name.h"

enum { LABEL_WIDTH = 16, CELL_WIDTH = 27, CELL_SIZE = 2 * NUMBER_TEXT_SIZE + 16 };

static void append_padded(record_buffer *out, const char *text, size_t width) {
    record_append_text(out, text);
    for (size_t length = strlen(text); length < width; length++)
        record_append_text(out, " ");
}

static void end_row(record_buffer *out) {
    while (out->length > 0 && !out->failed && out->bytes[out->length - 1] == ' ')
        out->length--;
    record_append_text(out, "\n");
}

/* "0.03172 +- 2.6e-05", or why there is no error. */
static void append_estimate(record_buffer *out, const fit_estimate *e) {
    char value[NUMBER_TEXT_SIZE], error[NUMBER_TEXT_SIZE], cell[CELL_SIZE];
    number_print(value, 5, e->value);
    number_print(error, 2, e->error);
    switch (e->state) {
    case FIT_DETERMINED:
        snprintf(cell, sizeof cell, "%s +- %s", value, error);
        break;
    case FIT_AT_LOW:
    case FIT_AT_HIGH:
        snprintf(cell, sizeof cell, "%s (at bound)", value);
        break;
    case FIT_UNDETERMINED:
        snprintf(cell, sizeof cell, "%s (undetermined)", value);
        break;
    }
    append_padded(out, cell, CELL_WIDTH);
}

typedef const fit_estimate *estimate_of(const fit_channel *);
static const fit_estimate *alpha_x_of(const fit_channel *c) {
    return &c->alpha_x;
}
static const fit_estimate *alpha_y_of(const fit_channel *c) {
    return &c->alpha_y;
}
static const fit_estimate *rs_of(const fit_channel *c) {
    return &c->rs;
}
static const fit_estimate *rd_of(const fit_channel *c) {
    return &c->rd;
}

static void append_rows(record_buffer *out, const findings *r, const char *name, estimate_of *of, size_t channels) {
    for (size_t k = 0; k < channels; k++) {
        char label[64];
        snprintf(label, sizeof label, channels > 1 ? "%s[%.40s]" : "%s", name, r->measurements->channels[k].text);
        append_padded(out, label, LABEL_WIDTH);
        for (size_t i = 0; i < r->fit_count; i++)
            append_estimate(out, of(&r->fits[i].channels[k]));
        end_row(out);
    }
}

static void append_numbers(record_buffer *out, const findings *r, const char *name, double (*of)(const fit_result *)) {
    append_padded(out, name, LABEL_WIDTH);
    for (size_t i = 0; i < r->fit_count; i++) {
        char text[NUMBER_TEXT_SIZE];
        number_print(text, 5, of(&r->fits[i]));
        append_padded(out, text, CELL_WIDTH);
    }
    end_row(out);
}

static double residual_of(const fit_result *f) {
    return f->residual;
}
static double root_mean_square_of(const fit_result *f) {
    return f->root_mean_square;
}
static double loss_of(const fit_result *f) {
    double sum = 0;
    for (size_t i = 0; i < f->fit_count; i++)
        sum += f->qualities[i].loss;
    return sum;
}
static double condition_of(const fit_result *f) {
    double worst = 1;
    for (size_t i = 0; i < f->fit_count && worst > 0; i++)
        worst = f->qualities[i].condition == 0 || f->qualities[i].condition > worst ? f->qualities[i].condition : worst;
    return worst;
}

void findings_append_table(record_buffer *out, const findings *r) {
    size_t channels = r->measurements->channel_count;
    findings_append_conventions(out, r);
    findings_append_format(out, "# %zu pairs x %zu channel%s\n", r->fit_count ? r->fits[0].pairs : 0, channels,
                           channels > 1 ? "s" : "");
    append_padded(out, "", LABEL_WIDTH);
    for (size_t i = 0; i < r->fit_count; i++)
        append_padded(out, model_name(r->fits[i].model), CELL_WIDTH);
    end_row(out);
    append_rows(out, r, r->settings->anisotropic ? "alpha_x" : "alpha", alpha_x_of, r->settings->shared ? 1 : channels);
    if (r->settings->anisotropic)
        append_rows(out, r, "alpha_y", alpha_y_of, r->settings->shared ? 1 : channels);
    append_rows(out, r, "rs", rs_of, channels);
    append_rows(out, r, "rd", rd_of, channels);
    append_numbers(out, r, "residual_20", residual_of);
    append_numbers(out, r, "rms_20", root_mean_square_of);
    if (r->settings->loss != FIT_LOSS_COSINE)
        append_numbers(out, r, "loss", loss_of);
    append_numbers(out, r, "condition", condition_of);
    if (findings_material_fit(r)) {
        record_append_text(out, "\n");
        findings_append_material(out, r);
    }
}
