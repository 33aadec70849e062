/* The report as JSON. */
#include <math.h>
#include <stdio.h>

#include "base/angle.h"
#include "base/number.h"
#include "fit/material.h"
#include "tools/brdffit/findings.h"
#include "tools/common/model_name.h"

/* File names and columns are bytes of any kind: what is no ASCII text is written as if it were Latin-1, so that the
 * result is always JSON, unless it is UTF-8. */
static size_t utf8_length(const unsigned char *s) {
    size_t length = s[0] < 0x80 ? 1 : s[0] >= 0xc2 && s[0] < 0xe0 ? 2 : (s[0] & 0xf0) == 0xe0 ? 3 : 0;
    if (s[0] >= 0xf0 && s[0] <= 0xf4)
        length = 4;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xf0 && s[1] < 0x90);
    bool beyond = (s[0] == 0xed && s[1] >= 0xa0) || (s[0] == 0xf4 && s[1] >= 0x90);
    return overlong || beyond ? 0 : length;
}

static void append_string(record_buffer *out, const char *text) {
    record_append_text(out, "\"");
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        size_t length = utf8_length(s);
        if (*s == '"' || *s == '\\')
            findings_append_format(out, "\\%c", *s);
        else if (*s < ' ' || length == 0)
            findings_append_format(out, "\\u%04x", *s);
        else
            record_append_bytes(out, s, length);
        s += length ? length : 1;
    }
    record_append_text(out, "\"");
}

static void append_key(record_buffer *out, const char *key) {
    append_string(out, key);
    record_append_text(out, ": ");
}

/* JSON knows no other numbers than finite ones. */
static void print_number(record_buffer *out, double value) {
    char text[NUMBER_TEXT_SIZE];
    number_print_exact(text, value);
    record_append_text(out, isfinite(value) ? text : "null");
}

static void append_number(record_buffer *out, const char *key, double value) {
    append_key(out, key);
    print_number(out, value);
}

static void append_convention(record_buffer *out, const char *key, const char *value, fit_origin origin) {
    append_key(out, key);
    findings_append_format(out, "{\"value\": \"%s\", \"known\": \"%s\"}, ", value, fit_origin_text(origin));
}

static void append_source(record_buffer *out, const fit_source *s) {
    const fit_conventions *c = &s->conventions;
    record_append_text(out, "    {");
    append_key(out, "file");
    append_string(out, s->file);
    record_append_text(out, ", ");
    append_convention(out, "format", fit_format_text(c->format), s->origins.format);
    append_convention(out, "angles", fit_unit_text(c->unit), s->origins.unit);
    append_convention(out, "quantity", fit_quantity_text(c->quantity), s->origins.quantity);
    append_convention(out, "light", fit_light_text(c->light), s->origins.light);
    append_convention(out, "mirror", fit_mirror_text(c->mirror), s->origins.mirror);
    findings_append_format(out, "\"pairs\": %zu, \"below_horizon\": %zu, \"not_measured\": %zu}", s->pairs, s->below,
                           s->absent);
}

static void append_settings(record_buffer *out, const findings *r) {
    const fit_settings *s = r->settings;
    findings_append_format(out, "  \"settings\": {\"loss\": \"%s\", \"anisotropic\": %s, \"roughness\": \"%s\", ",
                           findings_loss_name(s->loss), s->anisotropic ? "true" : "false",
                           s->shared ? "shared" : "separate");
    append_number(out, "max_angle", angle_degrees(s->max_polar));
    record_append_text(out, ", \"total_reflectance\": ");
    if (!s->total)
        record_append_text(out, "null");
    for (size_t k = 0; s->total && k < r->measurements->channel_count; k++) {
        record_append_text(out, k ? ", " : "[");
        print_number(out, s->total[k]);
    }
    record_append_text(out, s->total ? "]},\n" : "},\n");
}

static void append_estimate(record_buffer *out, const char *key, const fit_estimate *e) {
    record_append_text(out, ", ");
    append_key(out, key);
    record_append_text(out, "{");
    append_number(out, "value", e->value);
    record_append_text(out, ", ");
    if (e->state == FIT_DETERMINED)
        append_number(out, "standard_error", e->error);
    else
        record_append_text(out, "\"standard_error\": null");
    findings_append_format(out, ", \"state\": \"%s\"}", findings_state_name(e->state));
}

static void append_quality(record_buffer *out, const fit_quality *q) {
    findings_append_format(out, "      {\"converged\": %s, \"degrees_of_freedom\": %zu, ",
                           q->converged ? "true" : "false", q->degrees);
    append_number(out, "loss", q->loss);
    record_append_text(out, ", ");
    if (q->condition > 0)
        append_number(out, "condition", q->condition);
    else
        record_append_text(out, "\"condition\": null");
    record_append_text(out, ", \"rival\": ");
    if (q->has_rival) {
        record_append_text(out, "{");
        append_number(out, "alpha_x", q->rival_alpha_x);
        record_append_text(out, ", ");
        append_number(out, "alpha_y", q->rival_alpha_y);
        record_append_text(out, "}}");
    } else
        record_append_text(out, "null}");
}

static void append_fit(record_buffer *out, const findings *r, const fit_result *f) {
    findings_append_format(out, "    {\"model\": \"%s\", \"pairs\": %zu, ", model_name(f->model), f->pairs);
    append_number(out, "residual_20", f->residual);
    record_append_text(out, ", ");
    append_number(out, "rms_20", f->root_mean_square);
    record_append_text(out, ",\n     \"channels\": [\n");
    for (size_t k = 0; k < f->channel_count; k++) {
        const fit_channel *c = &f->channels[k];
        record_append_text(out, k ? ",\n      {" : "      {");
        append_key(out, "channel");
        append_string(out, r->measurements->channels[k].text);
        append_estimate(out, "alpha_x", &c->alpha_x);
        append_estimate(out, "alpha_y", &c->alpha_y);
        append_estimate(out, "rs", &c->rs);
        append_estimate(out, "rd", &c->rd);
        record_append_text(out, "}");
    }
    record_append_text(out, "],\n     \"fits\": [\n");
    for (size_t i = 0; i < f->fit_count; i++) {
        record_append_text(out, i ? ",\n" : "");
        append_quality(out, &f->qualities[i]);
    }
    record_append_text(out, "]}");
}

static void append_material(record_buffer *out, const findings *r) {
    const fit_result *f = findings_material_fit(r);
    record_append_text(out, "  \"material\": ");
    if (!f) {
        record_append_text(out, "null\n");
        return;
    }
    fit_material m = fit_material_of(f, r->measurements->channels);
    const double numbers[] = {m.colour.r, m.colour.g, m.colour.b, m.spec, m.alpha_x, m.alpha_y};
    findings_append_format(out, "{\"type\": \"%s\", \"name\": ", m.metal ? "metal2" : "plastic2");
    append_string(out, r->name);
    record_append_text(out, ", \"arguments\": [");
    for (int i = 0; i < 6; i++) {
        record_append_text(out, i ? ", " : "");
        print_number(out, numbers[i]);
    }
    record_append_text(out, "]}\n");
}

void findings_append_json(record_buffer *out, const findings *r) {
    record_append_text(out, "{\n  \"program\": \"brdffit " GRAZE_VERSION "\",\n  \"sources\": [\n");
    for (size_t i = 0; i < r->measurements->source_count; i++) {
        record_append_text(out, i ? ",\n" : "");
        append_source(out, &r->measurements->sources[i]);
    }
    record_append_text(out, "],\n");
    append_settings(out, r);
    record_append_text(out, "  \"models\": [\n");
    for (size_t i = 0; i < r->fit_count; i++) {
        record_append_text(out, i ? ",\n" : "");
        append_fit(out, r, &r->fits[i]);
    }
    record_append_text(out, "],\n");
    append_material(out, r);
    record_append_text(out, "}\n");
}
