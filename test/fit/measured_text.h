/* Measurements that a test writes down and reads. */
#ifndef TEST_FIT_MEASURED_TEXT_H
#define TEST_FIT_MEASURED_TEXT_H

#include "fit/measurements.h"
#include "support/written_file.h"

/* The name of the file that was read last. */
static char measured_name[sizeof(written_file)];

/* Adds what a file of these bytes holds. */
static inline graze_status read_written(fit_measurements *m, const void *bytes, size_t length,
                                        const fit_read_options *options) {
    written_file file = written_file_make(bytes, length);
    snprintf(measured_name, sizeof measured_name, "%s", file.name);
    messages[0] = 0;
    graze_status status = fit_read(m, file.name, options, &remembering);
    unlink(file.name);
    return status;
}

static inline graze_status read_text(fit_measurements *m, const char *text, const fit_read_options *options) {
    return read_written(m, text, strlen(text), options);
}

#endif
