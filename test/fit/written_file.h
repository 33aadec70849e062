/* Files that a test writes and reads, and the messages that come of it. */
#ifndef TEST_FIT_WRITTEN_FILE_H
#define TEST_FIT_WRITTEN_FILE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fit/measurements.h"

static char messages[4096];

static inline void remember(void *user, graze_severity severity, const char *text) {
    (void)user;
    size_t length = strlen(messages);
    snprintf(messages + length, sizeof messages - length, "%s: %s\n", severity == GRAZE_ERROR ? "error" : "warning",
             text);
}

static const graze_report remembering = {remember, NULL};
static char written_name[] = "/tmp/graze-measured-XXXXXX";

/* Adds what a file of these bytes holds. */
static inline graze_status read_written(fit_measurements *m, const void *bytes, size_t length,
                                        const fit_read_options *options) {
    snprintf(written_name, sizeof written_name, "/tmp/graze-measured-XXXXXX");
    int descriptor = mkstemp(written_name);
    if (descriptor < 0 || write(descriptor, bytes, length) != (ssize_t)length)
        abort();
    close(descriptor);
    messages[0] = 0;
    graze_status status = fit_read(m, written_name, options, &remembering);
    unlink(written_name);
    return status;
}

static inline graze_status read_text(fit_measurements *m, const char *text, const fit_read_options *options) {
    return read_written(m, text, strlen(text), options);
}

#endif
