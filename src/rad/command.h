/* The output of commands. */
#ifndef RAD_COMMAND_H
#define RAD_COMMAND_H

#include "base/report.h"
#include "base/whole_file.h"

/* The output of `sh -c command`, run in the directory (null: this process's own), with nothing on its standard input. A
 * command that fails is an error. */
graze_status rad_command_output(whole_file *, const char *command, const char *directory, const place *where,
                                const graze_report *);

#endif
