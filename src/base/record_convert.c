/* The numbers of records: conversion, and what can be wrong with them. */
#include "base/record_convert.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/record_chunk.h"
#include "base/record_file.h"
#include "base/record_scan.h"
#include "base/record_words.h"
#include "base/text.h"

/* --- Errors ------------------------------------------------------------------------------------------------------ */

void record_advance(int *line, size_t *column, const char *from, const char *to, size_t lines) {
    const char *begin = to;
    while (begin > from && begin[-1] != '\n')
        begin--;
    *column = (size_t)(to - begin) + (lines ? 0 : *column);
    *line = lines < (size_t)(INT_MAX - *line) ? *line + (int)lines : INT_MAX;
}

/* A word for a message: cut, and without bytes that would garble it. */
static void copy_word(const char *word, const char *limit, char text[48]) {
    enum { SHOWN = 40 };
    const char *p = word;
    for (; p < limit && !text_is_blank(*p) && p < word + SHOWN; p++)
        *text++ = *p < ' ' || *p == 127 ? '?' : *p;
    bool whole = p == limit || text_is_blank(*p);
    memcpy(text, whole ? "" : "...", whole ? 1 : 4);
}

void record_set_word_error(record_chunk *c, size_t count, const char *word, const char *limit) {
    char shown[48], text[96];
    copy_word(word, limit, shown);
    double value;
    const char *end = number_scan(word, limit, &value);
    bool too_large = end && text_is_blank(*end);
    snprintf(text, sizeof text, "'%s' is %s", shown, too_large ? "too large a number" : "not a number");
    record_set_error(c, count, text);
    int line = c->line;
    size_t column = c->column, words = 0, lines = 0;
    record_count_ends(c->bytes, (size_t)(word - c->bytes), &words, &lines);
    record_advance(&line, &column, c->bytes, word, lines);
    record_note_place(&c->error, line, column);
}

void record_describe_not_finite(char message[RECORD_MESSAGE_SIZE], size_t index) {
    snprintf(message, RECORD_MESSAGE_SIZE, "its number %zu is not finite", index + 1);
}

/* `finite` numbers stand before the first that is not finite. */
static void set_number_error(record_chunk *c, size_t finite) {
    char text[RECORD_MESSAGE_SIZE];
    if (finite == c->count * c->fields)
        return;
    record_describe_not_finite(text, finite % c->fields);
    record_set_error(c, finite / c->fields, text);
}

/* --- Numbers ----------------------------------------------------------------------------------------------------- */

size_t record_scan_words(const char **at, const char *limit, double *values, size_t count) {
    const char *p = *at;
    size_t good = 0;
    for (; good < count; good++) {
        while (text_is_blank(*p))
            p++;
        const char *end = number_scan(p, limit, &values[good]);
        if (!end || !text_is_blank(*end) || !isfinite(values[good]))
            break;
        p = end + 1;
    }
    *at = p;
    return good;
}

static const double *convert_words(record_chunk *c, double *room) {
    const char *at = c->bytes, *limit = c->bytes + c->length;
    size_t numbers = c->count * c->fields;
    size_t good = record_words_available() ? record_words_scan(&at, limit, room, numbers)
                                           : record_scan_words(&at, limit, room, numbers);
    if (good < numbers)
        record_set_word_error(c, good / c->fields, at, limit);
    return room;
}

static const double *convert_floats(record_chunk *c, double *room) {
    const float *values = record_floats(c);
    set_number_error(c, record_finite_floats(values, c->count * c->fields));
    for (size_t i = 0; i < c->count * c->fields; i++)
        room[i] = (double)values[i];
    return room;
}

const float *record_floats(record_chunk *c) {
    record_file_load(c);
    return (const float *)(const void *)c->bytes;
}

const double *record_doubles(record_chunk *c, double *room) {
    if (c->format == RECORD_ASCII)
        return convert_words(c, room);
    if (c->format == RECORD_FLOAT)
        return convert_floats(c, room);
    record_file_load(c);
    const double *values = (const double *)(const void *)c->bytes;
    set_number_error(c, record_finite_doubles(values, c->count * c->fields));
    return values;
}
