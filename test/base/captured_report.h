/* A report that keeps what it is told. */
#ifndef TEST_BASE_CAPTURED_REPORT_H
#define TEST_BASE_CAPTURED_REPORT_H

#include <stdio.h>

#include "graze/error.h"

typedef struct captured {
    graze_report report;
    int errors, warnings;
    char text[8192]; /* the last one */
} captured;

static void captured_write(void *user, graze_severity severity, const char *text) {
    captured *c = user;
    c->errors += severity == GRAZE_ERROR;
    c->warnings += severity == GRAZE_WARNING;
    snprintf(c->text, sizeof c->text, "%s", text);
}

static inline void captured_begin(captured *c) {
    *c = (captured){.report = {captured_write, c}};
}

#endif
