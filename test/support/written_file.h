/* Files that a test writes for what reads them, and the messages that come of it. */
#ifndef TEST_SUPPORT_WRITTEN_FILE_H
#define TEST_SUPPORT_WRITTEN_FILE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "graze/error.h"

/* What has been reported since it was last made empty. */
static char messages[4096];

static inline void messages_add(void *user, graze_severity severity, const char *text) {
    (void)user;
    size_t length = strlen(messages);
    snprintf(messages + length, sizeof messages - length, "%s: %s\n", severity == GRAZE_ERROR ? "error" : "warning",
             text);
}

static const graze_report remembering = {messages_add, NULL};

typedef struct written_file {
    char name[32];
} written_file;

/* A file of these bytes; to be removed with unlink. */
static inline written_file written_file_make(const void *bytes, size_t length) {
    written_file file = {"/tmp/graze-test-XXXXXX"};
    int descriptor = mkstemp(file.name);
    if (descriptor < 0 || write(descriptor, bytes, length) != (ssize_t)length || close(descriptor) != 0)
        abort();
    return file;
}

#endif
