/* Whole inputs in memory: files, standard input, what a child process says. */
#ifndef BASE_WHOLE_FILE_H
#define BASE_WHOLE_FILE_H

#include <stddef.h>

#include "base/report.h"

/* To be freed with free(bytes). A zero byte stands behind the `length` bytes. */
typedef struct whole_file {
    char *bytes;
    size_t length;
} whole_file;

/* All that can be read from the descriptor, or the file of that path; nothing after an error. Devices with something
 * in them are refused, unless they are terminals: some have no end. Messages call it `name`,
 * and say where it was asked for; `where` may be null. */
graze_status whole_file_read(whole_file *, int descriptor, const char *name, const place *where, const graze_report *);
graze_status whole_file_read_path(whole_file *, const char *path, const char *name, const place *where,
                                  const graze_report *);

#endif
