/* How Graze's functions fail: a status for the program, a text with its place in the input for the person. */
#ifndef GRAZE_ERROR_H
#define GRAZE_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

/* What a function returns that can fail. The values are the exit statuses of the command-line tools. */
typedef enum graze_status {
    GRAZE_OK = 0,           /* everything asked for was done */
    GRAZE_INPUT_ERROR = 1,  /* the caller's or user's mistake: a bad scene, option, record, argument or file name */
    GRAZE_SYSTEM_ERROR = 2, /* the system's: out of memory, a full disk, a failing read */
} graze_status;

typedef enum graze_severity {
    GRAZE_WARNING, /* the work goes on, as the text says */
    GRAZE_ERROR,   /* the function that reports this will not return GRAZE_OK */
} graze_severity;

/* Where texts go. `write` gets one message, without a newline at its end, beginning with its place in the input
 * ("room.rad:12:3: ...") where it has one. It is called on the thread that met the trouble, possibly by several threads
 * at once. A null graze_report pointer, or a null `write`, discards all texts; the statuses remain. */
typedef struct graze_report {
    void (*write)(void *user, graze_severity severity, const char *text);
    void *user; /* handed to `write` as it is */
} graze_report;

#ifdef __cplusplus
}
#endif

#endif
