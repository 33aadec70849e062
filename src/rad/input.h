/* Whole inputs in memory: files, standard input, the output of commands. */
#ifndef RAD_INPUT_H
#define RAD_INPUT_H

#include <stddef.h>

#include "base/report.h"

/* To be freed with free(bytes). A zero byte stands behind the `length` bytes. */
typedef struct rad_text {
    char *bytes;
    size_t length;
} rad_text;

graze_status rad_input_descriptor(rad_text *, int descriptor, const char *name, const place *where,
                                  const graze_report *);
graze_status rad_input_file(rad_text *, const char *path, const place *where, const graze_report *);
/* The output of `sh -c command`, run in the directory (null: this process's own), with nothing on its standard input. A
 * command that fails is an error. */
graze_status rad_input_command(rad_text *, const char *command, const char *directory, const place *where,
                               const graze_report *);

#endif
