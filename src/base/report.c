/* Messages with their place in the input. */
#include "base/report.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Text that begins in `fixed` and moves to the heap when it outgrows that. Where the heap gives nothing the text is
 * cut: a cut message is better than none. */
typedef struct text {
    char fixed[1024];
    char *bytes;
    size_t length, capacity;
} text;

static void text_begin(text *t) {
    t->bytes = t->fixed;
    t->length = 0;
    t->capacity = sizeof t->fixed;
    t->fixed[0] = 0;
}

static void text_end(text *t) {
    if (t->bytes != t->fixed)
        free(t->bytes);
}

static void text_reserve(text *t, size_t more) {
    if (more < t->capacity - t->length)
        return;
    size_t capacity = 2 * (t->length + more + 1);
    char *bytes = t->bytes == t->fixed ? malloc(capacity) : realloc(t->bytes, capacity);
    if (!bytes)
        return;
    if (t->bytes == t->fixed)
        memcpy(bytes, t->fixed, t->length + 1);
    t->bytes = bytes;
    t->capacity = capacity;
}

__attribute__((format(printf, 2, 0))) static void text_append_list(text *t, const char *format, va_list arguments) {
    va_list again;
    va_copy(again, arguments);
    int needed = vsnprintf(t->bytes + t->length, t->capacity - t->length, format, arguments);
    if (needed > 0 && (size_t)needed >= t->capacity - t->length) {
        text_reserve(t, (size_t)needed);
        vsnprintf(t->bytes + t->length, t->capacity - t->length, format, again);
    }
    t->length += strlen(t->bytes + t->length);
    va_end(again);
}

__attribute__((format(printf, 2, 3))) static void text_append(text *t, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    text_append_list(t, format, arguments);
    va_end(arguments);
}

/* "room.rad:12:3". Commands stand in quotes, for their words would run into the sentence. */
static void append_place(text *t, const place *where) {
    const char *quote = where->file[0] == '!' ? "`" : "";
    text_append(t, "%s%s%s", quote, where->file, quote);
    if (where->line > 0) {
        text_append(t, ":%d", where->line);
        if (where->column > 0)
            text_append(t, ":%d", where->column);
    }
}

/* The next that has a name. */
static const place *next_parent(const place *where) {
    const place *p = where->parent;
    while (p && !p->file)
        p = p->parent;
    return p;
}

/* " (from `!gen a`:2:1, from room.rad:3:1)": from the inmost to the file that the user named. Of many only those at
 * both ends, for what is nested deep mostly is so by mistake. */
static void append_parents(text *t, const place *where) {
    enum { FIRST = 4, LAST = 2 };
    int count = 0, index = 0;
    for (const place *p = next_parent(where); p; p = next_parent(p))
        count++;
    for (const place *p = next_parent(where); p; p = next_parent(p), index++) {
        int left_out = count - FIRST - LAST;
        if (left_out > 1 && index == FIRST)
            text_append(t, ", ... %d more ...", left_out);
        if (left_out > 1 && index >= FIRST && index < count - LAST)
            continue;
        text_append(t, index ? ", from " : " (from ");
        if (p->subject)
            text_append(t, "%s at ", p->subject);
        append_place(t, p);
    }
    if (count)
        text_append(t, ")");
}

__attribute__((format(printf, 5, 0))) static void report_list(const graze_report *report, graze_severity severity,
                                                              const place *where, const char *cause, const char *format,
                                                              va_list arguments) {
    if (!report || !report->write)
        return;
    text t;
    text_begin(&t);
    if (where && where->file) {
        append_place(&t, where);
        text_append(&t, ": ");
    }
    if (where && where->subject)
        text_append(&t, "%s: ", where->subject);
    text_append_list(&t, format, arguments);
    if (cause)
        text_append(&t, ": %s", cause);
    if (where)
        append_parents(&t, where);
    report->write(report->user, severity, t.bytes);
    text_end(&t);
}

graze_status(report_error)(const graze_report *report, const place *where, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    report_list(report, GRAZE_ERROR, where, NULL, format, arguments);
    va_end(arguments);
    return GRAZE_INPUT_ERROR;
}

__attribute__((format(printf, 4, 0))) static void report_cause(const graze_report *report, const place *where,
                                                               int number, const char *format, va_list arguments) {
    char cause[256];
    if (strerror_r(number, cause, sizeof cause) != 0)
        snprintf(cause, sizeof cause, "error %d", number);
    report_list(report, GRAZE_ERROR, where, cause, format, arguments);
}

graze_status(report_system_error)(const graze_report *report, const place *where, const char *format, ...) {
    int number = errno;
    va_list arguments;
    va_start(arguments, format);
    report_cause(report, where, number, format, arguments);
    va_end(arguments);
    return GRAZE_SYSTEM_ERROR;
}

static bool is_users_mistake(int number) {
    return number == ENOENT || number == ENOTDIR || number == EISDIR || number == EACCES || number == ENAMETOOLONG ||
           number == ELOOP;
}

graze_status(report_file_error)(const graze_report *report, const place *where, const char *format, ...) {
    int number = errno;
    va_list arguments;
    va_start(arguments, format);
    report_cause(report, where, number, format, arguments);
    va_end(arguments);
    return is_users_mistake(number) ? GRAZE_INPUT_ERROR : GRAZE_SYSTEM_ERROR;
}

graze_status(report_out_of_memory)(const graze_report *report) {
    if (report && report->write)
        report->write(report->user, GRAZE_ERROR, "out of memory");
    return GRAZE_SYSTEM_ERROR;
}

graze_status(report_out_of_memory_at)(const graze_report *report, const place *where) {
    (void)(report_error)(report, where, "out of memory");
    return GRAZE_SYSTEM_ERROR;
}

void report_warning(const graze_report *report, const place *where, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    report_list(report, GRAZE_WARNING, where, NULL, format, arguments);
    va_end(arguments);
}

static void raise_flag(void *user, graze_severity severity, const char *message) {
    (void)severity;
    (void)message;
    *(bool *)user = true;
}

graze_report report_to_flag(bool *said_something) {
    return (graze_report){raise_flag, said_something};
}
