/* The report that writes to standard error. */
#include "base/options.h"
#include "base/terminal.h"

static void write_plain(void *program, graze_severity severity, const char *text) {
    fprintf(stderr, "%s: %s: %s\n", (const char *)program, severity == GRAZE_ERROR ? "error" : "warning", text);
}

/* Erases the line first, for a progress bar may stand there. */
static void write_in_colour(void *program, graze_severity severity, const char *text) {
    const char *name = severity == GRAZE_ERROR ? "\033[1;31merror" : "\033[1;33mwarning";
    fprintf(stderr, TERMINAL_ERASE_LINE "%s: %s:\033[0m %s\n", (const char *)program, name, text);
}

graze_report options_standard_error_report(const char *program) {
    return (graze_report){terminal_is_fancy() ? write_in_colour : write_plain, (void *)program};
}
