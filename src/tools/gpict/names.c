/* Names made from names. */
#include "tools/gpict/names.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/output.h"

/* More digits than any frame's number has are a mistake. */
#define WIDEST 99

/* Reads what stands behind a per cent sign: `d` with a width, or the sign again. Gives its end, or null. */
static const char *read_field(const char *p, bool *is_number, bool *zeros, int *width) {
    *is_number = false;
    *width = 0;
    if (*p == '%')
        return p + 1;
    *zeros = *p == '0';
    while (*p >= '0' && *p <= '9' && *width <= WIDEST)
        *width = 10 * *width + (*p++ - '0');
    *is_number = *p == 'd' || *p == 'i';
    return *is_number && *width <= WIDEST ? p + 1 : NULL;
}

graze_status name_check_frame(const char *spec, const graze_report *report) {
    int numbers = 0;
    for (const char *p = spec; (p = strchr(p, '%'));) {
        bool is_number, zeros;
        int width;
        p = read_field(p + 1, &is_number, &zeros, &width);
        if (!p)
            break;
        numbers += is_number;
        if (!strchr(p, '%') && numbers == 1)
            return GRAZE_OK;
    }
    return report_error(report, NULL, "with -S, the name '%s' must have one %%d, for the frame's number", spec);
}

char *name_of_frame(arena *memory, const char *spec, int number) {
    if (number == 0)
        return arena_copy_text(memory, spec, strlen(spec));
    char *name = arena_allocate(memory, strlen(spec) + WIDEST + 16);
    if (!name)
        return NULL;
    char *out = name;
    while (*spec) {
        bool is_number, zeros;
        int width;
        const char *end = *spec == '%' ? read_field(spec + 1, &is_number, &zeros, &width) : NULL;
        if (!end) {
            *out++ = *spec++;
            continue;
        }
        if (is_number)
            out += sprintf(out, zeros ? "%0*d" : "%*d", width, number);
        else
            *out++ = '%';
        spec = end;
    }
    *out = 0;
    return name;
}

char *name_of_preview(arena *memory, const char *file) {
    const char *suffix = image_suffix(file);
    size_t stem = strlen(file) - strlen(suffix) - (*suffix ? 1 : 0), size = strlen(file) + sizeof ".preview.";
    char *name = arena_allocate(memory, size);
    if (name)
        snprintf(name, size, "%.*s.preview%s%s", (int)stem, file, *suffix ? "." : "", suffix);
    return name;
}

char *name_of_checkpoint(arena *memory, const char *file) {
    size_t size = strlen(file) + sizeof ".checkpoint";
    char *name = arena_allocate(memory, size);
    if (name)
        snprintf(name, size, "%s.checkpoint", file);
    return name;
}
