/* From argc and argv to an exit status. */
#define _XOPEN_SOURCE 700 /* SIGXFSZ */
#include "tools/common/tool.h"

#include <signal.h>
#include <stdint.h>

int tool_main(const option_table *table, int argc, char **argv, const graze_report *report,
              graze_status (*run)(void *user, const tool_arguments *, const graze_report *), void *user) {
    tool_arguments arguments = {.argc = argc, .argv = argv};
    options_arguments *words = NULL;
    options_outcome outcome = OPTIONS_RUN;
    /* A closed pipe, or a file at its limit, is a failed write, which is reported like any other. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    graze_status status = options_expand(&words, argc, argv, report);
    if (status == GRAZE_OK)
        status = options_parse(table, words, &arguments.operand_count, &arguments.operands, &outcome, report);
    if (status == GRAZE_OK && outcome == OPTIONS_RUN)
        status = run(user, &arguments, report);
    options_arguments_destroy(words);
    return (int)status;
}

static void drop_warnings(void *user, graze_severity severity, const char *text) {
    const graze_report *report = user;
    if (severity != GRAZE_WARNING)
        report->write(report->user, severity, text);
}

graze_report tool_report(const graze_report *report, bool warnings) {
    return warnings ? *report : (graze_report){drop_warnings, (void *)(uintptr_t)report};
}
