/* A file that appears whole or not at all. */
#ifndef IMAGE_OUTPUT_H
#define IMAGE_OUTPUT_H

#include <stdbool.h>

#include "base/report.h"

typedef struct image_output {
    char *path; /* what to open and write */
    /* Within the module: */
    const char *file;
    char *final; /* where `path` moves to in the end; null: `file` is no regular file */
    const graze_report *report;
} image_output;

/* The letters behind the last point of the file's own name; "" without one. */
const char *image_suffix(const char *file);
/* Whether the name stands for something that is no regular file, such as a pipe, a device or /dev/stdout. */
bool image_output_is_special(const char *file);

/* Whether `file` could be written there, as far as that can be told beforehand: its directory lets files be made, it
 * is no directory itself and, if it is there, no file that must not be written. */
graze_status image_output_check(const char *file, const graze_report *);

/* Makes an empty file under another name with the same suffix, beside `file`; for a special file in the directory for
 * temporary files, or, where `direct`, nothing: `path` is then `file` itself. */
graze_status image_output_begin(image_output *, const char *file, bool direct, const graze_report *);
/* Puts what was written in its place if `written` is GRAZE_OK, else takes it away. Returns `written` or what fails
 * here. */
graze_status image_output_finish(image_output *, graze_status written);

#endif
