/* A measurement file of any known format. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/angle.h"
#include "base/whole_file.h"
#include "fit/reader.h"

static graze_status read_whole(whole_file *f, const char *file, const place *where, const graze_report *report) {
    return strcmp(file, "-") == 0 ? whole_file_read(f, STDIN_FILENO, "it", where, report)
                                  : whole_file_read_path(f, file, "it", where, report);
}

/* A comment's first word behind its #. */
static bool comment_begins(const fit_reader *r, const char *word) {
    const char *at = r->line.text + 1, *end = r->line.text + r->line.length;
    while (at < end && *at == ' ')
        at++;
    size_t length = strlen(word);
    return (size_t)(end - at) >= length && memcmp(at, word, length) == 0;
}

static bool line_is_empty(fit_reader *r) {
    fit_word word;
    const char *at = r->at;
    bool empty = !fit_reader_word(r, &word);
    r->at = at;
    return empty;
}

/* The first lines tell: comments of ALTA and pab have words of their own, and Cornell's begins with one number. */
static fit_format recognise(fit_reader *r) {
    static const char *const alta[] = {"DIM ", "PARAM_IN ", "PARAM_OUT ", "ALTA "};
    static const char *const pab[] = {"intheta ", "incident_angle ", "format: theta phi"};
    if (fit_is_merl(r->bytes, (size_t)(r->end - r->bytes)))
        return FIT_FORMAT_MERL;
    fit_reader_rewind(r);
    while (fit_reader_line(r)) {
        if (line_is_empty(r))
            continue;
        if (r->line.text[0] != '#') {
            fit_word word;
            double number;
            bool one = fit_reader_count_words(r) == 1 && fit_reader_word(r, &word) && fit_word_number(&word, &number);
            return one ? FIT_FORMAT_CORNELL : FIT_FORMAT_TABLE;
        }
        for (size_t i = 0; i < sizeof alta / sizeof *alta; i++)
            if (comment_begins(r, alta[i]))
                return FIT_FORMAT_ALTA;
        for (size_t i = 0; i < sizeof pab / sizeof *pab; i++)
            if (comment_begins(r, pab[i]))
                return FIT_FORMAT_PAB;
    }
    return FIT_FORMAT_TABLE;
}

/* Radians read as degrees are all small; degrees read as radians are too large to be read at all. */
static void question_unit(const fit_reader *r) {
    const place where = {.file = r->where.file};
    if (r->source->conventions.unit == FIT_DEGREES && r->largest_polar > 0 && r->largest_polar <= PI / 2 + 1e-3)
        report_warning(r->report, &where,
                       "no polar angle is above %.3g degrees: if they are radians, say --angles radians",
                       r->largest_polar);
}

static graze_status read_format(fit_reader *r) {
    fit_format told = r->options->conventions.format;
    r->source->origins.format = told == FIT_FORMAT_ANY ? FIT_OF_FILE : FIT_TOLD;
    r->source->conventions.format = told == FIT_FORMAT_ANY ? recognise(r) : told;
    if (r->source->conventions.format != FIT_FORMAT_MERL && memchr(r->bytes, 0, (size_t)(r->end - r->bytes)))
        return report_error(r->report, &(place){.file = r->where.file}, "is neither text nor a MERL table");
    fit_reader_rewind(r);
    switch (r->source->conventions.format) {
    case FIT_FORMAT_CORNELL:
        return fit_read_cornell(r);
    case FIT_FORMAT_ALTA:
        return fit_read_alta(r);
    case FIT_FORMAT_PAB:
        return fit_read_pab(r);
    case FIT_FORMAT_MERL:
        return fit_read_merl(r);
    default:
        return fit_read_table(r);
    }
}

static fit_source *new_source(fit_measurements *m, const char *name) {
    fit_source *sources = realloc(m->sources, (m->source_count + 1) * sizeof *sources);
    size_t size = strlen(name) + 1;
    char *copy = malloc(size);
    if (sources)
        m->sources = sources;
    if (!sources || !copy) {
        free(copy);
        return NULL;
    }
    memcpy(copy, name, size);
    sources[m->source_count] = (fit_source){.file = copy};
    return &sources[m->source_count++];
}

/* What some spreadsheets begin their tables with. */
static size_t byte_order_mark(const char *bytes, size_t length) {
    return length >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

graze_status fit_read_bytes(fit_measurements *m, const char *name, const char *bytes, size_t length,
                            const fit_read_options *options, const graze_report *report) {
    const place where = {.file = name};
    size_t mark = byte_order_mark(bytes, length);
    fit_source *source = new_source(m, name);
    if (!source)
        return report_out_of_memory(report);
    fit_reader r = {.bytes = bytes + mark,
                    .end = bytes + length,
                    .separator = ' ',
                    .where = where,
                    .options = options,
                    .measurements = m,
                    .source = source,
                    .report = report};
    graze_status status = read_format(&r);
    if (status != GRAZE_OK)
        return status;
    question_unit(&r);
    if (source->pairs + source->below + source->absent == 0)
        return report_error(report, &where, "there are no lines of data");
    if (source->pairs == 0)
        return report_error(report, &where, "there is no measurement of two directions above the surface");
    return GRAZE_OK;
}

graze_status fit_read(fit_measurements *m, const char *file, const fit_read_options *options,
                      const graze_report *report) {
    const char *name = strcmp(file, "-") == 0 ? "standard input" : file;
    const place where = {.file = name};
    whole_file all = {0};
    graze_status status = read_whole(&all, file, &where, report);
    if (status == GRAZE_OK)
        status = fit_read_bytes(m, name, all.bytes, all.length, options, report);
    free(all.bytes);
    return status;
}
