/* Names, and what all forms of a report begin with. */
#include "tools/brdffit/findings.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/angle.h"
#include "base/number.h"

const char *findings_loss_name(fit_loss loss) {
    static const char *const names[] = {"cosine", "plain", "log"};
    return names[loss];
}

const char *findings_state_name(fit_state state) {
    static const char *const names[] = {"determined", "at its lower bound", "at its upper bound", "undetermined"};
    return names[state];
}

const fit_result *findings_material_fit(const findings *r) {
    for (size_t i = 0; i < r->fit_count; i++)
        if (r->fits[i].model == GRAZE_BRDF_GMD)
            return &r->fits[i];
    return NULL;
}

void findings_append_number(record_buffer *out, int digits, double value) {
    char text[NUMBER_TEXT_SIZE];
    number_print(text, digits, value);
    record_append_text(out, text);
}

void findings_append_format(record_buffer *out, const char *format, ...) {
    char text[401];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    record_append_text(out, text);
}

/* A name in a comment must not end it. */
static void append_in_line(record_buffer *out, const char *text) {
    for (; *text; text++)
        record_append_bytes(out, (unsigned char)*text < ' ' ? " " : text, 1);
}

static void append_source(record_buffer *out, const fit_source *s) {
    const fit_conventions *c = &s->conventions;
    record_append_text(out, "# ");
    append_in_line(out, s->file);
    findings_append_format(out, ": %zu pairs", s->pairs);
    if (s->below)
        findings_append_format(out, ", %zu at or below the horizon left out", s->below);
    if (s->absent)
        findings_append_format(out, ", %zu not measured left out", s->absent);
    findings_append_format(out, "\n#   --format %s (%s)\n", fit_format_text(c->format),
                           s->origins.format == FIT_TOLD ? "as told" : "by its content");
    if (c->unit == FIT_COMPONENTS)
        record_append_text(out, "#   directions are not given by angles that have a unit\n");
    else
        findings_append_format(out, "#   --angles %s (%s)\n", fit_unit_text(c->unit), fit_origin_text(s->origins.unit));
    findings_append_format(out, "#   --quantity %s (%s)\n", fit_quantity_text(c->quantity),
                           fit_origin_text(s->origins.quantity));
    findings_append_format(out, "#   --light %s (%s)\n", fit_light_text(c->light), fit_origin_text(s->origins.light));
    findings_append_format(out, "#   --mirror %s (%s)\n", fit_mirror_text(c->mirror),
                           fit_origin_text(s->origins.mirror));
    if (s->azimuths_are_zero)
        record_append_text(out, "#   there are no azimuths: all directions lie in one plane (assumed)\n");
}

void findings_append_conventions(record_buffer *out, const findings *r) {
    const fit_settings *s = r->settings;
    for (size_t i = 0; i < r->measurements->source_count; i++)
        append_source(out, &r->measurements->sources[i]);
    findings_append_format(out, "# fit: --loss %s, %s, ", findings_loss_name(s->loss),
                           s->anisotropic ? "--anisotropic" : "--isotropic");
    if (r->measurements->channel_count > 1)
        findings_append_format(out, "--roughness %s, ", s->shared ? "shared" : "separate");
    record_append_text(out, "directions up to ");
    findings_append_number(out, 6, angle_degrees(s->max_polar));
    record_append_text(out, " degrees from the normal, ");
    if (!s->total)
        record_append_text(out, "rd free\n");
    else {
        record_append_text(out, "rd = total reflectance - rs with total");
        for (size_t k = 0; k < r->measurements->channel_count; k++) {
            record_append_text(out, " ");
            findings_append_number(out, 6, s->total[k]);
        }
        record_append_text(out, "\n");
    }
}
