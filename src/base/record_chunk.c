/* Chunks of records: their memory, and what is wrong with them. */
#include "base/record_chunk.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void record_note(record_error *e, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    e->status = GRAZE_INPUT_ERROR;
    e->error_number = e->line = e->column = 0;
    vsnprintf(e->text, sizeof e->text, format, arguments);
    va_end(arguments);
}

void record_note_place(record_error *e, int line, size_t column) {
    e->line = line;
    e->column = column < INT_MAX ? (int)column + 1 : 0;
}

void record_set_error(record_chunk *c, size_t count, const char *text) {
    unsigned long long number = c->first + count + 1;
    c->count = count;
    record_note(&c->error, "record %llu: %s", number, text);
}

void record_note_end(record_error *e, uint64_t record, int error, size_t bytes, size_t record_size) {
    unsigned long long number = record;
    if (!error) {
        record_note(e, "record %llu is cut short: %zu of %zu bytes", number, bytes, record_size);
        return;
    }
    record_note(e, "record %llu: cannot read", number);
    e->status = GRAZE_SYSTEM_ERROR;
    e->error_number = error;
}

void record_chunk_free(record_chunk *c) {
    free(c->memory);
    *c = (record_chunk){0};
}

char *record_memory(size_t room) {
    char *memory = malloc(RECORD_FRONT + room + 1);
    if (memory)
        memory[RECORD_FRONT - 1] = ' ';
    return memory;
}

static void set_out_of_memory(record_error *e) {
    record_note(e, "out of memory");
    e->status = GRAZE_SYSTEM_ERROR;
    e->error_number = ENOMEM;
}

char *record_chunk_reserve(record_chunk *c, size_t room) {
    if (c->capacity < room) {
        free(c->memory);
        c->memory = record_memory(room);
        c->capacity = c->memory ? room : 0;
    }
    if (c->memory)
        return c->memory + RECORD_FRONT;
    set_out_of_memory(&c->error);
    return NULL;
}

size_t record_number_size(record_format format) {
    return format == RECORD_FLOAT ? sizeof(float) : format == RECORD_DOUBLE ? sizeof(double) : 0;
}
