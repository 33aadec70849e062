/* The numbers of records: conversion, and what can be wrong with them. */
#include "base/record_convert.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/record_scan.h"
#include "base/text.h"

/* --- Troubles ---------------------------------------------------------------------------------------------------- */

void record_note(record_trouble *t, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    t->status = GRAZE_INPUT_ERROR;
    t->error = t->line = t->column = 0;
    vsnprintf(t->text, sizeof t->text, format, arguments);
    va_end(arguments);
}

void record_note_place(record_trouble *t, int line, size_t column) {
    t->line = line;
    t->column = column < INT_MAX ? (int)column + 1 : 0;
}

void record_set_trouble(record_portion *p, size_t count, const char *text) {
    unsigned long long number = p->first + count + 1;
    p->count = count;
    record_note(&p->trouble, "record %llu: %s", number, text);
}

void record_advance(int *line, size_t *column, const char *from, const char *to) {
    const char *begin = to;
    while (begin > from && begin[-1] != '\n')
        begin--;
    *column = (size_t)(to - begin) + (begin == from ? *column : 0);
    size_t words = 0, lines = 0;
    record_count_ends(from, (size_t)(begin - from), &words, &lines);
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

void record_set_word_trouble(record_portion *p, size_t count, const char *word, const char *limit) {
    char shown[48], text[96];
    copy_word(word, limit, shown);
    double value;
    const char *end = number_scan(word, limit, &value);
    bool too_large = end && text_is_blank(*end);
    snprintf(text, sizeof text, "'%s' is %s", shown, too_large ? "too large a number" : "not a number");
    record_set_trouble(p, count, text);
    int line = p->line;
    size_t column = p->column;
    record_advance(&line, &column, p->bytes, word);
    record_note_place(&p->trouble, line, column);
}

static void set_number_trouble(record_portion *p, size_t finite) {
    char text[64];
    snprintf(text, sizeof text, "its number %zu is not finite", finite % p->fields + 1);
    record_set_trouble(p, finite / p->fields, text);
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

static const double *convert_words(record_portion *p, double *room) {
    const char *at = p->bytes, *limit = p->bytes + p->length;
    size_t numbers = p->count * p->fields, good = record_scan_words(&at, limit, room, numbers);
    if (good < numbers)
        record_set_word_trouble(p, good / p->fields, at, limit);
    return room;
}

const float *record_floats(record_portion *p) {
    const float *values = (const float *)(const void *)p->bytes;
    size_t numbers = p->count * p->fields, finite = record_finite_floats(values, numbers);
    if (finite < numbers)
        set_number_trouble(p, finite);
    return values;
}

const double *record_doubles(record_portion *p, double *room) {
    if (p->format == RECORD_ASCII)
        return convert_words(p, room);
    if (p->format == RECORD_FLOAT) {
        const float *values = record_floats(p);
        for (size_t i = 0; i < p->count * p->fields; i++)
            room[i] = (double)values[i];
        return room;
    }
    const double *values = (const double *)(const void *)p->bytes;
    size_t numbers = p->count * p->fields, finite = record_finite_doubles(values, numbers);
    if (finite < numbers)
        set_number_trouble(p, finite);
    return values;
}
