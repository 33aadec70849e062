/* Reporting: a printf for messages that carry their place in the input. */
#ifndef BASE_REPORT_H
#define BASE_REPORT_H

#include <stdbool.h>
#include <stddef.h>

#include "graze/error.h"

/* A place in some input. `file` is its name as the user knows it, or null where there is none; `line` and `column`
 * count from 1, and 0 stands for unknown. `parent` is the place that brought this input in (the line of the scene that
 * ran the command whose output this is), or null. */
typedef struct place {
    const char *file;
    int line, column;
    const struct place *parent;
    const char *subject; /* what stands there, as "sphere ball", for messages that do not name it; or null */
} place;

/* Each reports one message. `where` may be null. Return the status to hand on, so that
 * `return report_error(...)` reads well. */
graze_status report_error(const graze_report *report, const place *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* As report_error, with ": " and the text of `errno` behind the message. */
graze_status report_system_error(const graze_report *report, const place *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* As report_system_error, of a file that the user named: GRAZE_INPUT_ERROR where `errno` says that the name leads
 * nowhere, to a directory, or to what the user may not open. */
graze_status report_file_error(const graze_report *report, const place *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
graze_status report_out_of_memory(const graze_report *report);
/* The same of what stands at `where`. */
graze_status report_out_of_memory_at(const graze_report *report, const place *where);
void report_warning(const graze_report *report, const place *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Passes nothing on, but makes the flag true where there is something to report. */
graze_report report_to_flag(bool *said_something);

/* clang's static analyzer sees one file at a time, and would follow paths on which these return GRAZE_OK. */
#ifdef __clang_analyzer__
#define report_error(...)            ((report_error)(__VA_ARGS__), GRAZE_INPUT_ERROR)
#define report_system_error(...)     ((report_system_error)(__VA_ARGS__), GRAZE_SYSTEM_ERROR)
#define report_file_error(...)       ((report_file_error)(__VA_ARGS__), GRAZE_SYSTEM_ERROR)
#define report_out_of_memory(report) ((report_out_of_memory)(report), GRAZE_SYSTEM_ERROR)
#define report_out_of_memory_at(...) ((report_out_of_memory_at)(__VA_ARGS__), GRAZE_SYSTEM_ERROR)
#endif

#endif
