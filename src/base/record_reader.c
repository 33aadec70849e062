/* Input records from ASCII and binary streams. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"
#include "base/records.h"
#include "base/text.h"

/* One read takes what a pipe holds; a word longer than this is refused. */
enum { BUFFER_SIZE = 1 << 16 };

/* Why reading stops at a place. It is found again, and reported, by the call that begins there. */
typedef enum trouble {
    NO_TROUBLE,
    NOTHING_AT_HAND, /* the buffer is used up but for an incomplete word or value */
    NOT_A_NUMBER,
    NOT_FINITE,
} trouble;

struct record_reader {
    int descriptor;
    char *name;
    record_format format;
    size_t fields;
    const graze_report *report;

    size_t begin, end; /* of what is unread in `bytes` */
    bool ended;        /* the descriptor has no more, or failed with `error` */
    int error;
    graze_status status; /* trouble that has been reported */

    uint64_t record; /* the one being read, from 1 */
    double *values;  /* its reals so far */
    size_t filled;
    int line;           /* of bytes[begin], for ASCII */
    size_t line_offset; /* bytes of this line before bytes[begin] */
    char bytes[BUFFER_SIZE];
};

graze_status record_reader_open(record_reader **reader, int descriptor, const char *name, record_format format,
                                int fields, const graze_report *report) {
    *reader = NULL;
    record_reader *r = malloc(sizeof *r);
    if (!r)
        return report_out_of_memory(report);
    r->descriptor = descriptor;
    r->name = strdup(name);
    r->format = format;
    r->fields = (size_t)fields;
    r->report = report;
    r->begin = r->end = 0;
    r->ended = false;
    r->error = 0;
    r->status = GRAZE_OK;
    r->record = 1;
    r->values = malloc((size_t)fields * sizeof *r->values);
    r->filled = 0;
    r->line = 1;
    r->line_offset = 0;
    if (!r->name || !r->values) {
        record_reader_close(r);
        return report_out_of_memory(report);
    }
    *reader = r;
    return GRAZE_OK;
}

void record_reader_close(record_reader *r) {
    if (!r)
        return;
    free(r->name);
    free(r->values);
    free(r);
}

/* Whether a read would return at once. */
static bool is_readable(int descriptor) {
    struct pollfd p = {.fd = descriptor, .events = POLLIN};
    return poll(&p, 1, 0) > 0;
}

static void wait_until_readable(int descriptor) {
    struct pollfd p = {.fd = descriptor, .events = POLLIN};
    poll(&p, 1, -1);
}

/* Reads on behind what is in the buffer, at least a byte, or finds that the input has ended. */
static void fill(record_reader *r) {
    memmove(r->bytes, r->bytes + r->begin, r->end - r->begin);
    r->end -= r->begin;
    r->begin = 0;
    for (;;) {
        ssize_t got = read(r->descriptor, r->bytes + r->end, BUFFER_SIZE - r->end);
        if (got > 0) {
            r->end += (size_t)got;
            return;
        }
        if (got == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) {
            r->ended = true;
            r->error = got == 0 ? 0 : errno;
            return;
        }
        if (errno != EINTR)
            wait_until_readable(r->descriptor);
    }
}

static void skip_blanks(record_reader *r) {
    for (; r->begin < r->end && text_is_blank(r->bytes[r->begin]); r->begin++) {
        r->line_offset++;
        if (r->bytes[r->begin] == '\n') {
            r->line += r->line < INT_MAX;
            r->line_offset = 0;
        }
    }
}

/* The end of the word at `begin`: not past the buffer's. */
static size_t word_end(const record_reader *r) {
    size_t i = r->begin;
    while (i < r->end && !text_is_blank(r->bytes[i]))
        i++;
    return i;
}

static trouble read_word(record_reader *r, double *value) {
    skip_blanks(r);
    if (r->begin == r->end)
        return NOTHING_AT_HAND;
    const char *word = r->bytes + r->begin, *limit = r->bytes + r->end;
    const char *end = number_scan(word, limit, value);
    /* A word that reaches the end of the buffer may go on behind it. */
    if (!end || end == limit || !text_is_blank(*end)) {
        size_t behind = word_end(r);
        if (behind == r->end && !r->ended)
            return r->end - r->begin < BUFFER_SIZE ? NOTHING_AT_HAND : NOT_A_NUMBER;
        if (end != r->bytes + behind)
            return NOT_A_NUMBER;
    }
    if (!isfinite(*value))
        return NOT_FINITE;
    r->line_offset += (size_t)(end - word);
    r->begin += (size_t)(end - word);
    return NO_TROUBLE;
}

static trouble read_binary(record_reader *r, double *value) {
    size_t size = r->format == RECORD_FLOAT ? sizeof(float) : sizeof(double);
    if (r->end - r->begin < size)
        return NOTHING_AT_HAND;
    if (r->format == RECORD_FLOAT) {
        float single;
        memcpy(&single, r->bytes + r->begin, sizeof single);
        *value = single;
    } else {
        memcpy(value, r->bytes + r->begin, sizeof *value);
    }
    if (!isfinite(*value))
        return NOT_FINITE;
    r->begin += size;
    return NO_TROUBLE;
}

/* Reads the rest of a record from the buffer. */
static trouble read_from_buffer(record_reader *r) {
    while (r->filled < r->fields) {
        double *value = r->values + r->filled;
        trouble t = r->format == RECORD_ASCII ? read_word(r, value) : read_binary(r, value);
        if (t)
            return t;
        r->filled++;
    }
    return NO_TROUBLE;
}

/* The word at `begin` for a message: cut, and without bytes that would garble it. */
static void copy_word(const record_reader *r, char text[48]) {
    size_t length = word_end(r) - r->begin, shown = length > 40 ? 40 : length;
    for (size_t i = 0; i < shown; i++) {
        char c = r->bytes[r->begin + i];
        text[i] = c < ' ' || c == 127 ? '?' : c;
    }
    memcpy(text + shown, length > shown ? "..." : "", length > shown ? 4 : 1);
}

static graze_status report_trouble(const record_reader *r, trouble t) {
    unsigned long long record = r->record;
    place where = {.file = r->name};
    if (r->format != RECORD_ASCII) {
        if (t == NOT_FINITE)
            return report_error(r->report, &where, "record %llu: its number %zu is not finite", record, r->filled + 1);
        size_t size = r->format == RECORD_FLOAT ? sizeof(float) : sizeof(double);
        return report_error(r->report, &where, "record %llu is cut short: %zu of %zu bytes", record,
                            r->filled * size + (r->end - r->begin), r->fields * size);
    }
    where.line = r->line;
    where.column = r->line_offset < INT_MAX ? (int)r->line_offset + 1 : 0;
    if (t == NOTHING_AT_HAND)
        return report_error(r->report, &where, "record %llu is cut short: %zu of %zu numbers", record, r->filled,
                            r->fields);
    char word[48];
    copy_word(r, word);
    return report_error(r->report, &where, "record %llu: '%s' is %s", record, word,
                        t == NOT_FINITE ? "too large a number" : "not a number");
}

/* Reports what is wrong where no record could be read; at the input's proper end nothing is. */
static graze_status stop(record_reader *r, trouble t) {
    if (t == NOTHING_AT_HAND && r->error) {
        errno = r->error;
        r->status = report_system_error(r->report, &(place){.file = r->name}, "cannot read");
    } else if (t != NOTHING_AT_HAND || r->filled > 0 || r->begin < r->end) {
        r->status = report_trouble(r, t);
    }
    return r->status;
}

graze_status record_read(record_reader *r, double *values, size_t capacity, size_t *count) {
    *count = 0;
    while (!r->status && *count < capacity) {
        trouble t = read_from_buffer(r);
        if (t == NO_TROUBLE) {
            memcpy(values + *count * r->fields, r->values, r->fields * sizeof *values);
            r->filled = 0;
            r->record++;
            ++*count;
        } else if (t == NOTHING_AT_HAND && !r->ended) {
            if (*count > 0 && !is_readable(r->descriptor))
                break;
            fill(r);
        } else {
            return *count > 0 ? GRAZE_OK : stop(r, t);
        }
    }
    return r->status;
}
