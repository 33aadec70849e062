/* Messages and the places they name. */
#include "base/report.h"

#include <errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/captured_report.h"

static void test_place_prefix(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    assert_int_equal(report_error(&c.report, NULL, "bad %d", 7), GRAZE_INPUT_ERROR);
    assert_string_equal(c.text, "bad 7");
    report_error(&c.report, &(place){.file = "room.rad", .line = 12, .column = 3}, "bad");
    assert_string_equal(c.text, "room.rad:12:3: bad");
    report_error(&c.report, &(place){.file = "room.rad", .line = 12}, "bad");
    assert_string_equal(c.text, "room.rad:12: bad");
    report_error(&c.report, &(place){.file = "room.rad"}, "bad");
    assert_string_equal(c.text, "room.rad: bad");
    report_error(&c.report, &(place){.line = 4}, "bad");
    assert_string_equal(c.text, "bad");
    assert_int_equal(c.errors, 5);
    assert_int_equal(c.warnings, 0);
}

static void test_nested_commands(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    place file = {.file = "room.rad", .line = 3, .column = 1};
    place outer = {.file = "!gen all", .line = 2, .column = 1, .parent = &file};
    place inner = {.file = "!genbox a b 1 1 1", .line = 5, .column = 9, .parent = &outer};
    report_error(&c.report, &outer, "bad");
    assert_string_equal(c.text, "`!gen all`:2:1: bad (from room.rad:3:1)");
    report_error(&c.report, &inner, "bad");
    assert_string_equal(c.text, "`!genbox a b 1 1 1`:5:9: bad (from `!gen all`:2:1, from room.rad:3:1)");
}

static void test_deep_nesting_is_cut(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    enum { DEEP = 9 };
    place places[DEEP];
    for (int i = 0; i < DEEP; i++)
        places[i] = (place){.file = "f", .line = i + 1, .parent = i > 0 ? &places[i - 1] : NULL};
    report_error(&c.report, &places[7], "bad");
    assert_string_equal(c.text, "f:8: bad (from f:7, from f:6, from f:5, from f:4, from f:3, from f:2, from f:1)");
    report_error(&c.report, &places[8], "bad");
    assert_string_equal(c.text,
                        "f:9: bad (from f:8, from f:7, from f:6, from f:5, ... 2 more ..., from f:2, from f:1)");
}

static void test_subjects(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    place pattern = {.file = "room.rad", .line = 3, .column = 1, .subject = "brightfunc f"};
    report_error(&c.report, &pattern, "bad");
    assert_string_equal(c.text, "room.rad:3:1: brightfunc f: bad");
    report_error(&c.report, &(place){.file = "f.cal", .line = 2, .parent = &pattern}, "bad");
    assert_string_equal(c.text, "f.cal:2: bad (from brightfunc f at room.rad:3:1)");
}

static void test_percent_in_names(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    place parent = {.file = "%n%s.rad", .line = 1};
    report_error(&c.report, &(place){.file = "!printf %d%n", .line = 1, .parent = &parent}, "%s", "100%s");
    assert_string_equal(c.text, "`!printf %d%n`:1: 100%s (from %n%s.rad:1)");
}

static void test_system_error(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    errno = ENOENT;
    assert_int_equal(report_system_error(&c.report, &(place){.file = "a.rad"}, "cannot read"), GRAZE_SYSTEM_ERROR);
    assert_string_equal(c.text, "a.rad: cannot read: No such file or directory");
    errno = 98765;
    report_system_error(&c.report, NULL, "odd");
    assert_non_null(strstr(c.text, "98765"));
}

static void test_file_error(void **state) {
    (void)state;
    static const int users[] = {ENOENT, ENOTDIR, EISDIR, EACCES, ENAMETOOLONG, ELOOP};
    static const int systems[] = {EIO, ENOSPC, ENOMEM, EMFILE, EBADF, EROFS};
    captured c;
    captured_begin(&c);
    for (size_t i = 0; i < 6; i++) {
        errno = users[i];
        assert_int_equal(report_file_error(&c.report, NULL, "x"), GRAZE_INPUT_ERROR);
        errno = systems[i];
        assert_int_equal(report_file_error(&c.report, NULL, "x"), GRAZE_SYSTEM_ERROR);
    }
    errno = EISDIR;
    report_file_error(&c.report, &(place){.file = "a.rad", .line = 2}, "cannot read %s", "b");
    assert_string_equal(c.text, "a.rad:2: cannot read b: Is a directory");
    assert_int_equal(c.errors, 13);
}

static void test_severities(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    report_warning(&c.report, &(place){.file = "a.rad", .line = 2, .column = 1}, "odd %s", "thing");
    assert_string_equal(c.text, "a.rad:2:1: odd thing");
    assert_int_equal(c.warnings, 1);
    assert_int_equal(c.errors, 0);
    assert_int_equal(report_out_of_memory(&c.report), GRAZE_SYSTEM_ERROR);
    assert_string_equal(c.text, "out of memory");
    assert_int_equal(c.errors, 1);
}

static void test_discarding_report(void **state) {
    (void)state;
    graze_report silent = {0};
    assert_int_equal(report_error(NULL, NULL, "x"), GRAZE_INPUT_ERROR);
    assert_int_equal(report_error(&silent, NULL, "x"), GRAZE_INPUT_ERROR);
    assert_int_equal(report_system_error(NULL, NULL, "x"), GRAZE_SYSTEM_ERROR);
    assert_int_equal(report_out_of_memory(&silent), GRAZE_SYSTEM_ERROR);
    report_warning(&silent, NULL, "x");
    bool said_something = false;
    const graze_report noted = report_to_flag(&said_something);
    assert_false(said_something);
    report_warning(&noted, NULL, "x");
    assert_true(said_something);
}

/* Around the length where the text leaves its first buffer, and far beyond. */
static void test_long_texts(void **state) {
    (void)state;
    static const size_t lengths[] = {1000, 1014, 1015, 1016, 1022, 1023, 1024, 1025, 4000, 7000};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        captured c;
        captured_begin(&c);
        char *word = malloc(lengths[i] + 1);
        memset(word, 'w', lengths[i]);
        word[lengths[i]] = 0;
        place parent = {.file = "p"};
        report_error(&c.report, &(place){.file = "f", .parent = &parent}, "%s", word);
        assert_int_equal(strlen(c.text), lengths[i] + strlen("f:  (from p)"));
        assert_memory_equal(c.text + 3, word, lengths[i]);
        assert_string_equal(c.text + 3 + lengths[i], " (from p)");
        free(word);
    }
}

typedef struct talker {
    pthread_t thread;
    int number;
    const char *expected;
    captured captured;
    int wrong;
} talker;

static void *talk(void *argument) {
    talker *t = argument;
    for (int i = 0; i < 2000; i++) {
        errno = t->number;
        report_system_error(&t->captured.report, NULL, "x");
        t->wrong += strcmp(t->captured.text, t->expected) != 0;
    }
    return NULL;
}

static void test_threads(void **state) {
    (void)state;
    talker talkers[] = {{.number = EACCES, .expected = "x: Permission denied"},
                        {.number = ENOSPC, .expected = "x: No space left on device"},
                        {.number = EPIPE, .expected = "x: Broken pipe"}};
    for (int i = 0; i < 3; i++) {
        captured_begin(&talkers[i].captured);
        assert_int_equal(pthread_create(&talkers[i].thread, NULL, talk, &talkers[i]), 0);
    }
    for (int i = 0; i < 3; i++) {
        pthread_join(talkers[i].thread, NULL);
        assert_int_equal(talkers[i].wrong, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_place_prefix),
        cmocka_unit_test(test_nested_commands),
        cmocka_unit_test(test_deep_nesting_is_cut),
        cmocka_unit_test(test_subjects),
        cmocka_unit_test(test_percent_in_names),
        cmocka_unit_test(test_system_error),
        cmocka_unit_test(test_file_error),
        cmocka_unit_test(test_severities),
        cmocka_unit_test(test_discarding_report),
        cmocka_unit_test(test_long_texts),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
