/* The report that writes to standard error. */
#include <string.h>

#include "base/options.h"
#include "base/terminal.h"

/* A message in the making: written at once, unless it is longer than this. */
typedef struct line {
    char bytes[1024];
    size_t length;
} line;

static void flush(line *l) {
    fwrite(l->bytes, 1, l->length, stderr);
    l->length = 0;
}

static void append(line *l, const char *bytes, size_t length) {
    for (size_t i = 0; i < length; i++) {
        if (l->length == sizeof l->bytes)
            flush(l);
        l->bytes[l->length++] = bytes[i];
    }
}

static void append_text(line *l, const char *text) {
    append(l, text, strlen(text));
}

/* How many bytes the character takes that the text begins with, in UTF-8; 0 if it is none, or one that controls a
 * terminal: U+0000 to U+001F, U+007F to U+009F. */
static size_t shown_length(const char *text) {
    const unsigned char *c = (const unsigned char *)text;
    if (c[0] < 0x80)
        return c[0] >= ' ' && c[0] != 0x7f;
    size_t length = c[0] >= 0xf0 ? 4 : c[0] >= 0xe0 ? 3 : 2;
    if (c[0] < 0xc2 || c[0] > 0xf4 || (c[0] == 0xc2 && c[1] < 0xa0) || (c[0] == 0xe0 && c[1] < 0xa0) ||
        (c[0] == 0xf0 && c[1] < 0x90))
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((c[i] & 0xc0) != 0x80)
            return 0;
    return length;
}

/* What a message quotes may be no text, and the terminal would obey it. */
static void append_visibly(line *l, const char *text) {
    while (*text) {
        char code[] = "\\x00";
        size_t length = shown_length(text);
        if (length > 0) {
            append(l, text, length);
            text += length;
        } else {
            snprintf(code, sizeof code, "\\x%02X", (unsigned)(unsigned char)*text++);
            append_text(l, code);
        }
    }
}

/* Together with nothing of another thread's between. */
static void write_message(const char *before, const char *program, const char *severity, const char *text) {
    line l = {.length = 0};
    flockfile(stderr);
    append_text(&l, before);
    append_text(&l, program);
    append_text(&l, severity);
    append_visibly(&l, text);
    append_text(&l, "\n");
    flush(&l);
    funlockfile(stderr);
}

static void write_plain(void *program, graze_severity severity, const char *text) {
    write_message("", program, severity == GRAZE_ERROR ? ": error: " : ": warning: ", text);
}

/* Erases the line first, for a progress bar may stand there. */
static void write_in_colour(void *program, graze_severity severity, const char *text) {
    const char *name = severity == GRAZE_ERROR ? ": \033[1;31merror:\033[0m " : ": \033[1;33mwarning:\033[0m ";
    write_message(TERMINAL_ERASE_LINE, program, name, text);
}

graze_report options_standard_error_report(const char *program) {
    return (graze_report){terminal_is_fancy() ? write_in_colour : write_plain, (void *)program};
}
