/* pab's goniometer text, one incident direction a file: comments `#intheta`, `#inphi` or `#incident_angle`, `#format:
 * theta phi DSF` (value x cosine of the outgoing direction) or BSDF, BRDF; then theta, phi and the values of an
 * outgoing direction a line, in degrees. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "fit/reader.h"

enum { VALUES_MAX = 3 };

typedef struct pab {
    fit_reader *reader;
    double theta, phi; /* of the incident direction; NAN: not told yet */
    fit_quantity quantity;
    size_t count; /* of values */
    bool begun;
    bool chosen[VALUES_MAX];
} pab;

static graze_status read_format_line(pab *p) {
    fit_word word;
    fit_reader *r = p->reader;
    for (int i = 0; i < 2; i++)
        if (!fit_reader_word(r, &word) || !fit_word_is(&word, i ? "phi" : "theta"))
            return report_error(r->report, &r->where, "expected 'format: theta phi', then what the values are");
    if (!fit_reader_word(r, &word))
        return report_error(r->report, &r->where, "what the values are is missing");
    if (word.length == 3 && strncasecmp(word.text, "DSF", 3) == 0)
        p->quantity = FIT_TIMES_COSINE_VIEW;
    else if (word.length == 4 && (strncasecmp(word.text, "BSDF", 4) == 0 || strncasecmp(word.text, "BRDF", 4) == 0))
        p->quantity = FIT_BRDF;
    else
        return fit_reader_error(r, &word, "expected values of a kind DSF, BSDF or BRDF");
    return GRAZE_OK;
}

static graze_status read_comment(pab *p) {
    fit_word key, word;
    fit_reader *r = p->reader;
    r->at++;
    if (!fit_reader_word(r, &key))
        return GRAZE_OK;
    if (fit_word_is(&key, "intheta"))
        return fit_reader_angle(r, "incident polar angle", FIT_POLAR, &p->theta);
    if (fit_word_is(&key, "inphi"))
        return fit_reader_angle(r, "incident azimuth", FIT_AZIMUTH, &p->phi);
    if (fit_word_is(&key, "incident_angle")) {
        graze_status status = fit_reader_angle(r, "incident polar angle", FIT_POLAR, &p->theta);
        return status == GRAZE_OK ? fit_reader_angle(r, "incident azimuth", FIT_AZIMUTH, &p->phi) : status;
    }
    if (fit_word_is(&key, "format:"))
        return read_format_line(p);
    if (fit_word_is(&key, "colorimetry:") && fit_reader_word(r, &word))
        p->count = word.length == 7 && strncasecmp(word.text, "CIE-XYZ", 7) == 0 ? 3 : 1;
    return GRAZE_OK;
}

static graze_status begin_data(pab *p) {
    static const char *const names[] = {"X", "Y", "Z"};
    fit_reader *r = p->reader;
    fit_word words[VALUES_MAX];
    if (isnan(p->theta) || isnan(p->phi))
        return report_error(r->report, &r->where, "data before the incident direction: #intheta and #inphi");
    fit_reader_set_quantity(r, p->quantity ? p->quantity : FIT_BRDF, p->quantity ? FIT_OF_FILE : FIT_ASSUMED);
    fit_reader_set_light(r, FIT_LIGHT_INCIDENT, FIT_OF_FORMAT);
    fit_reader_set_mirror(r, FIT_MIRROR_OPPOSITE, FIT_ASSUMED);
    for (size_t i = 0; i < p->count; i++) {
        const char *name = p->count == 1 ? "value" : names[i];
        words[i] = (fit_word){name, strlen(name), 0};
    }
    p->begun = true;
    return fit_reader_channels(r, words, p->count, p->chosen);
}

static graze_status read_line(pab *p) {
    fit_reader *r = p->reader;
    double theta = 0, phi = 0, value, values[VALUES_MAX] = {0};
    graze_status status = fit_reader_angle(r, "polar angle", FIT_POLAR, &theta);
    if (status == GRAZE_OK)
        status = fit_reader_angle(r, "azimuth", FIT_AZIMUTH, &phi);
    for (size_t i = 0, k = 0; i < p->count && status == GRAZE_OK; i++) {
        status = fit_reader_number(r, "value", &value);
        if (p->chosen[i])
            values[k++] = value;
    }
    if (status == GRAZE_OK)
        status = fit_reader_line_end(r);
    return status == GRAZE_OK ? fit_reader_add(r, fit_reader_direction(r, p->theta, p->phi),
                                               fit_reader_direction(r, theta, phi), 1, values)
                              : status;
}

graze_status fit_read_pab(fit_reader *r) {
    pab p = {.reader = r, .theta = NAN, .phi = NAN, .count = 1};
    graze_status status = GRAZE_OK;
    fit_reader_set_unit(r, FIT_DEGREES, FIT_OF_FORMAT);
    while (status == GRAZE_OK && fit_reader_line(r)) {
        if (fit_reader_count_words(r) == 0)
            continue;
        if (r->line.text[0] == '#') {
            status = p.begun ? GRAZE_OK : read_comment(&p);
            continue;
        }
        if (!p.begun)
            status = begin_data(&p);
        if (status == GRAZE_OK)
            status = read_line(&p);
    }
    return status;
}
