/* Reading Radiance's binary files. */
#include "rad/bytes.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

rad_bytes rad_bytes_of(const whole_file *file, const char *what, const place *where, const graze_report *report) {
    return (rad_bytes){file->bytes, file->bytes, file->bytes + file->length, what, where, report, GRAZE_OK};
}

void rad_bytes_fail(rad_bytes *b, const char *format, ...) {
    if (b->status)
        return;
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    b->status = report_error(b->report, b->where, "%s: %s (byte %zu)", b->what, text, (size_t)(b->next - b->begin));
}

/* The next bytes, or null where there are not that many. */
static const unsigned char *take(rad_bytes *b, size_t count) {
    if (b->status)
        return NULL;
    if ((size_t)(b->end - b->next) < count) {
        b->next = b->end;
        rad_bytes_fail(b, "the file ends too early");
        return NULL;
    }
    const unsigned char *taken = (const unsigned char *)b->next;
    b->next += count;
    return taken;
}

uint64_t rad_bytes_count(rad_bytes *b, int size) {
    const unsigned char *taken = take(b, (size_t)size);
    uint64_t value = 0;
    for (int i = 0; taken && i < size; i++)
        value = value << 8 | taken[i];
    return value;
}

int64_t rad_bytes_integer(rad_bytes *b, int size) {
    uint64_t value = rad_bytes_count(b, size), sign = UINT64_C(1) << (8 * size - 1);
    return value & sign ? -(int64_t)(sign - (value & (sign - 1)) - 1) - 1 : (int64_t)value;
}

/* The fraction was rounded towards zero when it was written. */
double rad_bytes_real(rad_bytes *b) {
    const double most = 0x7fffffff;
    double fraction = (double)rad_bytes_integer(b, 4);
    int exponent = (int)rad_bytes_integer(b, 1);
    if (fraction == 0)
        return 0;
    return ldexp((fraction + (fraction < 0 ? -0.5 : 0.5)) / most, exponent);
}

const char *rad_bytes_text(rad_bytes *b) {
    const char *text = b->next, *end = b->status ? NULL : memchr(text, 0, (size_t)(b->end - text));
    if (!end) {
        take(b, SIZE_MAX);
        return "";
    }
    b->next = end + 1;
    return text;
}

void rad_bytes_skip(rad_bytes *b, size_t count) {
    (void)take(b, count);
}

static const char first_line[] = "#?RADIANCE\n";

/* The header's end: behind its empty line; or null. */
static const char *header_end(const char *text) {
    const char *empty = strncmp(text, first_line, sizeof first_line - 1) ? NULL : strstr(text, "\n\n");
    return empty ? empty + 2 : NULL;
}

bool rad_bytes_have_format(const whole_file *file, const char *format) {
    static const char key[] = "\nFORMAT=";
    const char *end = header_end(file->bytes);
    const char *found = end ? strstr(file->bytes, key) : NULL;
    if (!found || found + 1 >= end)
        return false;
    found += sizeof key - 1;
    found += strspn(found, " ");
    size_t length = strlen(format);
    return strncmp(found, format, length) == 0 && strchr(" \r\n", found[length]);
}

int rad_bytes_begin(rad_bytes *b, int lowest) {
    b->next = header_end(b->begin);
    int64_t size = rad_bytes_integer(b, 2) - lowest;
    if (!b->status && (size < 1 || size > 8))
        rad_bytes_fail(b, "incompatible format");
    return b->status ? 0 : (int)size;
}

/* In depth-first order, each node before its eight children: no need to go into them, only to count. */
void rad_bytes_skip_tree(rad_bytes *b, int object_size) {
    enum { EMPTY, FULL, TREE };
    for (uint64_t nodes = 1; nodes > 0 && !b->status; nodes--) {
        uint64_t kind = rad_bytes_count(b, 1);
        if (kind == FULL) {
            int64_t objects = rad_bytes_integer(b, object_size);
            int64_t left = b->end - b->next;
            if (objects < 0)
                rad_bytes_fail(b, "damaged: a leaf with %lld objects", (long long)objects);
            else
                rad_bytes_skip(b, objects > left ? (size_t)left + 1 : (size_t)objects * (size_t)object_size);
        } else if (kind == TREE) {
            nodes += 8;
        } else if (kind != EMPTY) {
            rad_bytes_fail(b, "damaged: a node of unknown kind %d", (int)kind);
        }
    }
}
