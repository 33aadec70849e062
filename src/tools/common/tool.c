/* From argc and argv to an exit status. */
#include "tools/common/tool.h"

#include <signal.h>

int tool_main(const option_table *table, int argc, char **argv, const graze_report *report,
              graze_status (*run)(void *user, const tool_arguments *, const graze_report *), void *user) {
    tool_arguments arguments = {.argc = argc, .argv = argv};
    options_arguments *words = NULL;
    options_outcome outcome = OPTIONS_RUN;
    /* A closed pipe is a failed write, which is reported like any other. */
    signal(SIGPIPE, SIG_IGN);
    graze_status status = options_expand(&words, argc, argv, report);
    if (status == GRAZE_OK)
        status = options_parse(table, words, &arguments.operand_count, &arguments.operands, &outcome, report);
    if (status == GRAZE_OK && outcome == OPTIONS_RUN)
        status = run(user, &arguments, report);
    options_arguments_destroy(words);
    return (int)status;
}
