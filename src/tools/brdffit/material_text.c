/* The fit of the new model as text that can be pasted into a scene. */
#include "fit/material.h"
#include "tools/brdffit/findings.h"

static void append_colour(record_buffer *out, graze_rgb c) {
    const double values[] = {c.r, c.g, c.b};
    for (int i = 0; i < 3; i++) {
        record_append_text(out, i ? " " : "");
        findings_append_number(out, 5, values[i]);
    }
}

void findings_append_material(record_buffer *out, const findings *r) {
    fit_material m = fit_material_of(findings_material_fit(r), r->measurements->channels);
    findings_append_format(out, "# colours are %s\n# rs ", fit_colour_text(m.kind));
    append_colour(out, m.rs);
    record_append_text(out, ", in the material ");
    append_colour(out, m.rs_as);
    record_append_text(out, "\n# rd ");
    append_colour(out, m.rd);
    record_append_text(out, ", in the material ");
    append_colour(out, m.rd_as);
    findings_append_format(out, "\nvoid %s %s\n4 1 0 0 .\n0\n6 ", m.metal ? "metal2" : "plastic2", r->name);
    append_colour(out, m.colour);
    const double rest[] = {m.spec, m.alpha_x, m.alpha_y};
    for (int i = 0; i < 3; i++) {
        record_append_text(out, " ");
        findings_append_number(out, 5, rest[i]);
    }
    record_append_text(out, "\n");
}
