/* What the tests of src/rad share: a report that remembers, files in a directory of their own, scenes as text. */
#ifndef TEST_RAD_SUPPORT_H
#define TEST_RAD_SUPPORT_H

#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "rad/scene_file.h"
#include "support/dice.h"

/* Everything reported, one message a line: "error: ..." or "warning: ...". */
typedef struct messages {
    char text[16384];
    size_t length;
    int errors, warnings;
} messages;

static inline void messages_write(void *user, graze_severity severity, const char *text) {
    messages *m = user;
    bool is_error = severity == GRAZE_ERROR;
    ++*(is_error ? &m->errors : &m->warnings);
    int added =
        snprintf(m->text + m->length, sizeof m->text - m->length, "%s: %s\n", is_error ? "error" : "warning", text);
    m->length += (size_t)added;
    if (m->length >= sizeof m->text)
        m->length = sizeof m->text - 1;
}

static inline graze_report messages_report(messages *m) {
    *m = (messages){.length = 0};
    return (graze_report){messages_write, m};
}

/* A directory for the test's files, made and entered; removed with all that is in it at the end. */
static inline int enter_directory(void **state) {
    static char name[] = "/tmp/graze-rad-XXXXXX";
    *state = name;
    return mkdtemp(name) ? chdir(name) : -1;
}

static inline int leave_directory(void **state) {
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", (const char *)*state);
    return chdir("/") || system(command);
}

static inline void write_bytes(const char *name, const char *bytes, size_t length) {
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, length, out), length);
    assert_int_equal(fclose(out), 0);
}

static inline void write_file(const char *name, const char *text) {
    write_bytes(name, text, strlen(text));
}

/* Reads one scene, which must be good. */
static inline rad_scene *read_good(const char *name) {
    messages m;
    graze_report report = messages_report(&m);
    rad_scene *scene;
    graze_status status = rad_scene_read(&scene, &name, 1, &report);
    if (status)
        print_error("%s", m.text);
    assert_int_equal(status, GRAZE_OK);
    assert_int_equal(m.errors, 0);
    return scene;
}

/* Reads one scene, which must be bad, and gives what was reported. */
static inline graze_status read_bad(const char *name, messages *m) {
    graze_report report = messages_report(m);
    rad_scene *scene;
    graze_status status = rad_scene_read(&scene, &name, 1, &report);
    assert_int_not_equal(status, GRAZE_OK);
    assert_null(scene);
    assert_true(m->errors > 0);
    return status;
}

static inline const rad_primitive *primitive_at(const rad_scene *scene, size_t index) {
    size_t count;
    const rad_primitive *primitives = rad_scene_primitives(scene, &count);
    assert_true(index < count);
    return &primitives[index];
}

static inline size_t primitive_count(const rad_scene *scene) {
    size_t count;
    rad_scene_primitives(scene, &count);
    return count;
}

static inline void assert_contains(const char *text, const char *wanted) {
    if (!strstr(text, wanted)) {
        print_error("\"%s\" is not in:\n%s", wanted, text);
        fail();
    }
}

#endif
