/* Lines, words and numbers of a measurement file, and pairs of directions out of them. */
#include "fit/reader.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/number.h"
#include "base/text.h"
#include "base/vector.h"

void fit_reader_rewind(fit_reader *r) {
    r->next = r->at = r->bytes;
    r->where.line = 0;
    r->line = (fit_word){r->bytes, 0, 1};
}

bool fit_reader_line(fit_reader *r) {
    if (r->next == r->end)
        return false;
    const char *end = memchr(r->next, '\n', (size_t)(r->end - r->next));
    const char *stop = end ? end : r->end;
    r->line = (fit_word){r->next, (size_t)(stop - r->next), 1};
    r->at = r->next;
    r->next = end ? end + 1 : r->end;
    r->where.line++;
    if (r->line.length > 0 && stop[-1] == '\r')
        r->line.length--;
    return true;
}

static const char *skip_blanks(const char *at, const char *end) {
    while (at < end && text_is_blank(*at))
        at++;
    return at;
}

static void take_off_quotes(fit_word *word) {
    while (word->length > 0 && text_is_blank(word->text[word->length - 1]))
        word->length--;
    if (word->length >= 2 && word->text[0] == '"' && word->text[word->length - 1] == '"') {
        word->text++;
        word->length -= 2;
    }
}

/* `at` stands behind a separator, or one byte behind the line where its last word has been read. */
static bool next_separated(fit_reader *r, fit_word *word) {
    const char *end = r->line.text + r->line.length;
    if (r->at > end || r->line.length == 0)
        return false;
    const char *begin = r->at, *stop = memchr(begin, r->separator, (size_t)(end - begin));
    stop = stop ? stop : end;
    r->at = stop + 1;
    begin = r->separator == '\t' ? begin : skip_blanks(begin, stop);
    *word = (fit_word){begin, (size_t)(stop - begin), (int)(begin - r->line.text) + 1};
    take_off_quotes(word);
    return true;
}

bool fit_reader_word(fit_reader *r, fit_word *word) {
    if (r->separator != ' ')
        return next_separated(r, word);
    const char *end = r->line.text + r->line.length;
    const char *begin = skip_blanks(r->at, end), *stop = begin;
    while (stop < end && !text_is_blank(*stop))
        stop++;
    r->at = stop;
    *word = (fit_word){begin, (size_t)(stop - begin), (int)(begin - r->line.text) + 1};
    take_off_quotes(word);
    return stop > begin;
}

size_t fit_reader_count_words(const fit_reader *r) {
    fit_reader copy = *r;
    fit_word word;
    size_t count = 0;
    while (fit_reader_word(&copy, &word))
        count++;
    return count;
}

graze_status fit_reader_error(const fit_reader *r, const fit_word *word, const char *text) {
    place where = r->where;
    where.column = word->column;
    if (word->length == 0)
        return report_error(r->report, &where, "%s", text);
    return report_error(r->report, &where, "%s, not '%.*s'", text, (int)(word->length < 60 ? word->length : 60),
                        word->text);
}

bool fit_word_is(const fit_word *word, const char *text) {
    return strlen(text) == word->length && memcmp(word->text, text, word->length) == 0;
}

bool fit_word_number(const fit_word *word, double *value) {
    const char *end = word->text + word->length;
    return number_scan(word->text, end, value) == end && word->length > 0 && isfinite(*value);
}

graze_status fit_reader_number(fit_reader *r, const char *what, double *value) {
    fit_word word;
    place where = r->where;
    if (!fit_reader_word(r, &word)) {
        where.column = (int)r->line.length + 1;
        return report_error(r->report, &where, "the line ends where the %s is expected", what);
    }
    if (fit_word_number(&word, value))
        return GRAZE_OK;
    where.column = word.column;
    return report_error(r->report, &where, "expected a finite number, the %s, not '%.*s'", what,
                        (int)(word.length < 60 ? word.length : 60), word.text);
}

graze_status fit_reader_angle(fit_reader *r, const char *what, fit_angle kind, double *value) {
    static const char *const degrees[] = {"expected a polar angle of at most 180 degrees in size",
                                          "expected an azimuth of at most 360 degrees in size"};
    static const char *const radians[] = {
        "expected a polar angle of at most pi radians in size (for degrees, say --angles degrees)",
        "expected an azimuth of at most 2 pi radians in size (for degrees, say --angles degrees)"};
    /* A file's angles are rounded: 3.142. */
    const double limit = (kind == FIT_POLAR ? PI : 2 * PI) * (1 + 2e-4);
    fit_reader before = *r;
    fit_word word;
    graze_status status = fit_reader_number(r, what, value);
    if (status != GRAZE_OK || fabs(fit_reader_radians(r, *value)) <= limit)
        return status;
    fit_reader_word(&before, &word);
    return fit_reader_error(r, &word, (r->source->conventions.unit == FIT_RADIANS ? radians : degrees)[kind]);
}

graze_status fit_reader_values(fit_reader *r, const bool *chosen, size_t count, double *values) {
    graze_status status = GRAZE_OK;
    for (size_t i = 0; i < count && status == GRAZE_OK; i++) {
        double value;
        status = fit_reader_number(r, "value", &value);
        if (status == GRAZE_OK && chosen[i])
            *values++ = value;
    }
    return status;
}

graze_status fit_reader_line_end(fit_reader *r) {
    fit_word word;
    if (fit_reader_word(r, &word) && word.length > 0)
        return fit_reader_error(r, &word, "expected the line's end");
    return GRAZE_OK;
}

void fit_reader_set_unit(fit_reader *r, fit_unit unit, fit_origin origin) {
    bool told = r->options->conventions.unit != FIT_UNIT_ANY && unit != FIT_COMPONENTS;
    r->source->conventions.unit = told ? r->options->conventions.unit : unit;
    r->source->origins.unit = told ? FIT_TOLD : origin;
}

void fit_reader_set_quantity(fit_reader *r, fit_quantity quantity, fit_origin origin) {
    bool told = r->options->conventions.quantity != FIT_QUANTITY_ANY;
    r->source->conventions.quantity = told ? r->options->conventions.quantity : quantity;
    r->source->origins.quantity = told ? FIT_TOLD : origin;
}

void fit_reader_set_light(fit_reader *r, fit_light light, fit_origin origin) {
    bool told = r->options->conventions.light != FIT_LIGHT_ANY;
    r->source->conventions.light = told ? r->options->conventions.light : light;
    r->source->origins.light = told ? FIT_TOLD : origin;
}

void fit_reader_set_mirror(fit_reader *r, fit_mirror mirror, fit_origin origin) {
    bool told = r->options->conventions.mirror != FIT_MIRROR_ANY;
    r->source->conventions.mirror = told ? r->options->conventions.mirror : mirror;
    r->source->origins.mirror = told ? FIT_TOLD : origin;
}

double fit_reader_radians(const fit_reader *r, double angle) {
    return r->source->conventions.unit == FIT_RADIANS ? angle : angle_radians(angle);
}

graze_vec3 fit_reader_direction(fit_reader *r, double polar, double azimuth) {
    r->largest_polar = fmax(r->largest_polar, fabs(polar));
    double t = fit_reader_radians(r, polar), p = fit_reader_radians(r, azimuth);
    return vec3_make(sin(t) * cos(p), sin(t) * sin(p), cos(t));
}

/* "550", "550nm", "550.5 nm" */
static double wavelength_of(const fit_word *name) {
    double value;
    const char *end = name->text + name->length, *next = number_scan(name->text, end, &value);
    if (!next || !isfinite(value) || value < 100 || value > 1e5)
        return 0;
    next = skip_blanks(next, end);
    bool unit = end - next == 2 && memcmp(next, "nm", 2) == 0;
    return next == end || unit ? value : 0;
}

static bool is_wanted(const fit_word *name, const char *wanted) {
    for (const char *at = wanted; at; at = strchr(at, ',')) {
        at += *at == ',';
        if (strcspn(at, ",") == name->length && memcmp(at, name->text, name->length) == 0)
            return true;
    }
    return !wanted;
}

static graze_status check_wanted(const fit_reader *r, const fit_word *names, size_t count) {
    const char *at = r->options->channels;
    while (at) {
        size_t length = strcspn(at, ",");
        bool found = false;
        for (size_t i = 0; i < count; i++)
            found |= names[i].length == length && memcmp(names[i].text, at, length) == 0;
        if (!found)
            return report_error(r->report, &(place){.file = r->where.file}, "there is no channel '%.*s'",
                                (int)(length < 60 ? length : 60), at);
        at = at[length] ? at + length + 1 : NULL;
    }
    return GRAZE_OK;
}

static graze_status new_channels(fit_reader *r, const fit_word *names, size_t count, const bool *chosen,
                                 size_t wanted) {
    fit_measurements *m = r->measurements;
    m->channels = calloc(wanted, sizeof *m->channels);
    if (!m->channels)
        return report_out_of_memory(r->report);
    for (size_t i = 0; i < count; i++) {
        if (!chosen[i])
            continue;
        char *text = malloc(names[i].length + 1);
        if (!text)
            return report_out_of_memory(r->report);
        memcpy(text, names[i].text, names[i].length);
        text[names[i].length] = 0;
        m->channels[m->channel_count++] = (fit_channel_name){text, wavelength_of(&names[i])};
    }
    return GRAZE_OK;
}

graze_status fit_reader_channels(fit_reader *r, const fit_word *names, size_t count, bool *chosen) {
    fit_measurements *m = r->measurements;
    size_t wanted = 0;
    graze_status status = check_wanted(r, names, count);
    if (status != GRAZE_OK)
        return status;
    for (size_t i = 0; i < count; i++)
        wanted += chosen[i] = is_wanted(&names[i], r->options->channels);
    if (wanted == 0)
        return report_error(r->report, &(place){.file = r->where.file}, "there are no values");
    if (m->channel_count == 0)
        return new_channels(r, names, count, chosen, wanted);
    bool same = wanted == m->channel_count;
    for (size_t i = 0, k = 0; i < count && same; i++)
        if (chosen[i])
            same = fit_word_is(&names[i], m->channels[k++].text);
    return same ? GRAZE_OK
                : report_error(r->report, &(place){.file = r->where.file}, "its channels are not those of '%s'",
                               m->sources[0].file);
}

static graze_status reserve(fit_measurements *m, const graze_report *report) {
    if (m->count < m->capacity)
        return GRAZE_OK;
    size_t capacity = m->capacity ? 2 * m->capacity : 256;
    if (capacity > SIZE_MAX / sizeof(fit_pair) || capacity > SIZE_MAX / sizeof(double) / m->channel_count)
        return report_out_of_memory(report);
    fit_pair *pairs = realloc(m->pairs, capacity * sizeof *pairs);
    if (!pairs)
        return report_out_of_memory(report);
    m->pairs = pairs;
    double *values = realloc(m->values, capacity * m->channel_count * sizeof *values);
    if (!values)
        return report_out_of_memory(report);
    m->values = values;
    m->capacity = capacity;
    return GRAZE_OK;
}

/* What the file's values must be divided by to be the BRDF. */
static double cosine_in_values(const fit_source *source, graze_vec3 incident, graze_vec3 outgoing) {
    switch (source->conventions.quantity) {
    case FIT_TIMES_COSINE_VIEW:
        return outgoing.z;
    case FIT_TIMES_COSINE_LIGHT:
        return incident.z;
    default:
        return 1;
    }
}

graze_status fit_reader_add(fit_reader *r, graze_vec3 incident, graze_vec3 outgoing, double weight,
                            const double *values) {
    fit_measurements *m = r->measurements;
    fit_source *source = r->source;
    incident = vec3_safe_normalize(incident);
    outgoing = vec3_safe_normalize(outgoing);
    if (!(incident.z > FIT_COSINE_MIN) || !(outgoing.z > FIT_COSINE_MIN)) {
        source->below++;
        return GRAZE_OK;
    }
    graze_status status = reserve(m, r->report);
    if (status != GRAZE_OK)
        return status;
    if (!(weight >= 1 / FIT_NUMBER_MAX && weight <= FIT_NUMBER_MAX))
        return report_error(r->report, &r->where, "a weight of %g is out of range: expected %g to %g", weight,
                            1 / FIT_NUMBER_MAX, FIT_NUMBER_MAX);
    double cosine = cosine_in_values(source, incident, outgoing);
    for (size_t k = 0; k < m->channel_count; k++) {
        double value = values[k] / cosine;
        if (!(fabs(value) <= FIT_NUMBER_MAX))
            return report_error(r->report, &r->where, "a value of %g is out of range: a BRDF is at most %g in size",
                                values[k], FIT_NUMBER_MAX);
        m->values[m->count * m->channel_count + k] = value;
    }
    if (source->conventions.mirror == FIT_MIRROR_SAME)
        outgoing = vec3_make(-outgoing.x, -outgoing.y, outgoing.z);
    bool exchange = source->conventions.light == FIT_LIGHT_OUTGOING;
    m->pairs[m->count++] =
        (fit_pair){.l = exchange ? outgoing : incident, .v = exchange ? incident : outgoing, .weight = weight};
    source->pairs++;
    return GRAZE_OK;
}
