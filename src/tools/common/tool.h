/* What every tool's main does. */
#ifndef TOOLS_COMMON_TOOL_H
#define TOOLS_COMMON_TOOL_H

#include "base/options.h"

/* What made a file, and room for the command line that did, in the file's header. */
#define TOOL_SOFTWARE "Graze " GRAZE_VERSION
enum { TOOL_COMMAND_SIZE = 2000 };

/* The command line of a run: the words as given, for headers, and what is left of them behind the options. */
typedef struct tool_arguments {
    int argc;
    char **argv;
    int operand_count;
    const char *const *operands;
} tool_arguments;

/* Reads the options and, unless they only asked for information, calls run(user, ...). Returns the exit status. */
int tool_main(const option_table *, int argc, char **argv, const graze_report *,
              graze_status (*run)(void *user, const tool_arguments *, const graze_report *), void *user);

/* The report of a run: without warnings where they are not wanted (-w-). The one given must outlive it. */
graze_report tool_report(const graze_report *, bool warnings);

/* Appends what would go to standard error to a file from now on, behind a line with the process and its command. */
graze_status tool_redirect_messages(const char *file, const tool_arguments *, const graze_report *);

/* Checks that there is a scene, and that standard input, which is `-`, is at most one of them, or none where it is
 * taken already. */
graze_status tool_check_scenes(const tool_arguments *, bool input_taken, const graze_report *);

#endif
