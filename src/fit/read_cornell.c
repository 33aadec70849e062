/* Cornell's .brdf text, which pbrt reads too: comments with #, the number of wavelengths, the wavelengths, then a line
 * a pair: theta and phi of the incident and of the scattered direction in radians, and a value a wavelength. The mirror
 * direction is at phi + pi. */
#include <stdlib.h>

#include "fit/reader.h"

enum { CHANNELS_MAX = 4096 };

typedef struct cornell {
    fit_reader *reader;
    size_t count;
    fit_word *names;
    bool *chosen;
    double *values;
} cornell;

/* To the next line that holds something. */
static bool next_line(fit_reader *r) {
    while (fit_reader_line(r))
        if (fit_reader_count_words(r) > 0 && r->line.text[0] != '#')
            return true;
    return false;
}

static graze_status ends_early(const fit_reader *r) {
    return report_error(r->report, &r->where, "the file ends before its data");
}

static graze_status read_count(cornell *c) {
    double number;
    graze_status status = fit_reader_number(c->reader, "number of wavelengths", &number);
    if (status != GRAZE_OK)
        return status;
    if (!(number >= 1 && number <= CHANNELS_MAX) || number != (double)(size_t)number)
        return report_error(c->reader->report, &c->reader->where, "the number of wavelengths must be in 1 .. %d",
                            CHANNELS_MAX);
    c->count = (size_t)number;
    return fit_reader_line_end(c->reader);
}

/* They may fill several lines. */
static graze_status read_wavelengths(cornell *c) {
    fit_reader *r = c->reader;
    c->names = calloc(c->count, sizeof *c->names);
    c->chosen = calloc(c->count, sizeof *c->chosen);
    c->values = calloc(c->count, sizeof *c->values);
    if (!c->names || !c->chosen || !c->values)
        return report_out_of_memory(r->report);
    size_t i = 0;
    while (i < c->count) {
        if (!next_line(r))
            return ends_early(r);
        while (i < c->count && fit_reader_word(r, &c->names[i])) {
            double number;
            if (!fit_word_number(&c->names[i], &number))
                return fit_reader_error(r, &c->names[i], "expected a wavelength");
            i++;
        }
    }
    graze_status status = fit_reader_line_end(r);
    return status == GRAZE_OK ? fit_reader_channels(r, c->names, c->count, c->chosen) : status;
}

static graze_status read_pair(cornell *c) {
    static const char *const names[] = {"incident polar angle", "incident azimuth", "scattered polar angle",
                                        "scattered azimuth"};
    fit_reader *r = c->reader;
    double angles[4];
    for (int i = 0; i < 4; i++) {
        graze_status status = fit_reader_angle(r, names[i], i % 2 ? FIT_AZIMUTH : FIT_POLAR, &angles[i]);
        if (status != GRAZE_OK)
            return status;
    }
    graze_status status = fit_reader_values(r, c->chosen, c->count, c->values);
    if (status == GRAZE_OK)
        status = fit_reader_line_end(r);
    return status == GRAZE_OK ? fit_reader_add(r, fit_reader_direction(r, angles[0], angles[1]),
                                               fit_reader_direction(r, angles[2], angles[3]), 1, c->values)
                              : status;
}

graze_status fit_read_cornell(fit_reader *r) {
    cornell c = {.reader = r};
    fit_reader_set_unit(r, FIT_RADIANS, FIT_OF_FORMAT);
    fit_reader_set_quantity(r, FIT_BRDF, FIT_OF_FORMAT);
    fit_reader_set_light(r, FIT_LIGHT_INCIDENT, FIT_OF_FORMAT);
    fit_reader_set_mirror(r, FIT_MIRROR_OPPOSITE, FIT_OF_FORMAT);
    graze_status status = next_line(r) ? read_count(&c) : ends_early(r);
    if (status == GRAZE_OK)
        status = read_wavelengths(&c);
    while (status == GRAZE_OK && next_line(r))
        status = read_pair(&c);
    free(c.names);
    free(c.chosen);
    free(c.values);
    return status;
}
