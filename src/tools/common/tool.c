/* From argc and argv to an exit status. */
#define _XOPEN_SOURCE 700 /* SIGXFSZ */
#include "tools/common/tool.h"

#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

/* Where a standard stream is closed, the next file that is opened would take its place, and messages be written into a
 * picture. Such a stream then is open, but fails to be read or written, as it did. */
static void occupy_closed_streams(void) {
    static const int modes[] = {O_WRONLY, O_RDONLY, O_RDONLY};
    for (int stream = 0; stream < 3; stream++)
        if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", modes[stream]) < 0)
            return;
}

int tool_main(const option_table *table, int argc, char **argv, const graze_report *report,
              graze_status (*run)(void *user, const tool_arguments *, const graze_report *), void *user) {
    tool_arguments arguments = {.argc = argc, .argv = argv};
    options_arguments *words = NULL;
    options_outcome outcome = OPTIONS_RUN;
    occupy_closed_streams();
    /* A closed pipe, or a file at its limit, is a failed write, which is reported like any other. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    graze_status status = options_expand(&words, argc, argv, report);
    if (status == GRAZE_OK)
        status = options_parse(table, words, &arguments.operand_count, &arguments.operands, &outcome, report);
    if (status == GRAZE_OK && outcome == OPTIONS_RUN)
        status = run(user, &arguments, report);
    options_arguments_destroy(words);
    /* A warning that is lost, as on a full disk, leaves only this to tell of it. */
    return (int)(status == GRAZE_OK && ferror(stderr) ? GRAZE_SYSTEM_ERROR : status);
}

static void drop_warnings(void *user, graze_severity severity, const char *text) {
    const graze_report *report = user;
    if (severity != GRAZE_WARNING)
        report->write(report->user, severity, text);
}

graze_report tool_report(const graze_report *report, bool warnings) {
    return warnings ? *report : (graze_report){drop_warnings, (void *)(uintptr_t)report};
}

graze_status tool_redirect_messages(const char *file, const tool_arguments *arguments, const graze_report *report) {
    char command[TOOL_COMMAND_SIZE];
    int descriptor = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor < 0)
        return report_file_error(report, NULL, "cannot append messages to %s", file);
    bool moved = dup2(descriptor, STDERR_FILENO) >= 0;
    close(descriptor);
    if (!moved)
        return report_system_error(report, NULL, "cannot append messages to %s", file);
    options_command_line(command, sizeof command, arguments->argc, arguments->argv);
    fprintf(stderr, "**************\n*** PID %ld: %s\n\n", (long)getpid(), command);
    return GRAZE_OK;
}

graze_status tool_check_scenes(const tool_arguments *arguments, bool input_taken, const graze_report *report) {
    int inputs = 0;
    if (arguments->operand_count == 0)
        return report_error(report, NULL, "no scene given; try --help");
    for (int i = 0; i < arguments->operand_count; i++)
        inputs += strcmp(arguments->operands[i], "-") == 0;
    if (input_taken && inputs > 0)
        return report_error(report, NULL, "the scene cannot be '-': standard input is taken");
    return inputs > 1 ? report_error(report, NULL, "standard input can be only one of the scenes") : GRAZE_OK;
}
