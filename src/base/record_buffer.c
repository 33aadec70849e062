/* Output records: a buffer, its growth, and its way to a descriptor. */
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"
#include "base/records.h"

void record_buffer_free(record_buffer *b) {
    free(b->bytes);
    *b = (record_buffer){0};
}

/* Room for `more` bytes; null when out of memory, now or before. */
static char *reserve(record_buffer *b, size_t more) {
    if (b->failed)
        return NULL;
    if (more <= b->capacity - b->length)
        return b->bytes + b->length;
    size_t needed = b->length + more, capacity = b->capacity < 512 ? 1024 : 2 * b->capacity;
    if (capacity < needed)
        capacity = needed;
    char *bytes = needed < more ? NULL : realloc(b->bytes, capacity);
    if (!bytes) {
        b->failed = true;
        return NULL;
    }
    b->bytes = bytes;
    b->capacity = capacity;
    return b->bytes + b->length;
}

void record_append_bytes(record_buffer *b, const void *bytes, size_t length) {
    char *room = length > 0 ? reserve(b, length) : NULL;
    if (!room)
        return;
    memcpy(room, bytes, length);
    b->length += length;
}

void record_append_text(record_buffer *b, const char *text) {
    record_append_bytes(b, text, strlen(text));
}

static char *print_reals(char *to, int digits, const double *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        to += number_print(to, digits, values[i]);
        *to++ = '\t';
    }
    return to;
}

/* Enough for any number and its tab. */
static char *reserve_text(record_buffer *b, size_t count) {
    return reserve(b, count * NUMBER_TEXT_SIZE);
}

static void append_floats(record_buffer *b, const double *values, size_t count) {
    char *room = reserve(b, count * sizeof(float));
    for (size_t i = 0; i < count && room; i++) {
        float single = number_to_float(values[i]);
        memcpy(room + i * sizeof single, &single, sizeof single);
    }
    b->length += room ? count * sizeof(float) : 0;
}

void record_append_reals(record_buffer *b, record_format format, int digits, const double *values, size_t count) {
    if (format == RECORD_DOUBLE) {
        record_append_bytes(b, values, count * sizeof *values);
    } else if (format == RECORD_FLOAT) {
        append_floats(b, values, count);
    } else {
        char *room = reserve_text(b, count);
        if (room)
            b->length += (size_t)(print_reals(room, digits, values, count) - room);
    }
}

void record_append_records(record_buffer *b, record_format format, int digits, const double *values, size_t count,
                           int fields) {
    size_t numbers = (size_t)fields;
    if (format != RECORD_ASCII) {
        record_append_reals(b, format, digits, values, count * numbers);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        char *room = reserve_text(b, numbers + 1);
        if (!room)
            return;
        char *end = print_reals(room, digits, values + i * numbers, numbers);
        *end++ = '\n';
        b->length += (size_t)(end - room);
    }
}

bool record_is_big_endian(void) {
    const union {
        unsigned short number;
        unsigned char first;
    } order = {1};
    return order.first == 0;
}

static void wait_until_writable(int descriptor) {
    struct pollfd p = {.fd = descriptor, .events = POLLOUT};
    poll(&p, 1, -1);
}

static bool write_all(int descriptor, const char *bytes, size_t length) {
    while (length > 0) {
        ssize_t done = write(descriptor, bytes, length);
        if (done > 0) {
            bytes += done;
            length -= (size_t)done;
        } else if (done < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
            wait_until_writable(descriptor);
        } else if (done < 0 && errno != EINTR) {
            return false;
        }
    }
    return true;
}

graze_status record_buffer_write(record_buffer *b, int descriptor, const char *name, const graze_report *report) {
    if (b->failed)
        return report_out_of_memory(report);
    bool written = write_all(descriptor, b->bytes, b->length);
    b->length = 0;
    return written ? GRAZE_OK : report_system_error(report, &(place){.file = name}, "cannot write");
}
