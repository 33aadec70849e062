/* For the pseudo-terminal. */
#define _XOPEN_SOURCE 700
#include "base/progress.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/options.h"

/* A pseudo-terminal as standard error. */
typedef struct fixture {
    int master, saved;
    char text[1024];
} fixture;

static void begin(fixture *f) {
    f->master = posix_openpt(O_RDWR | O_NOCTTY);
    if (f->master < 0)
        skip(); /* a container without terminals */
    assert_int_equal(grantpt(f->master), 0);
    assert_int_equal(unlockpt(f->master), 0);
    int slave = open(ptsname(f->master), O_RDWR | O_NOCTTY);
    assert_true(slave >= 0);
    fflush(stderr);
    f->saved = dup(STDERR_FILENO);
    assert_true(dup2(slave, STDERR_FILENO) >= 0);
    close(slave);
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
}

/* Takes what has been drawn, up to a mark that is written behind it so that reading never waits in vain. */
static void end(fixture *f) {
    fputs("|", stderr);
    fflush(stderr);
    size_t length = 0;
    while (length == 0 || f->text[length - 1] != '|') {
        ssize_t got = read(f->master, f->text + length, sizeof f->text - 1 - length);
        if (got <= 0)
            break;
        length += (size_t)got;
    }
    dup2(f->saved, STDERR_FILENO);
    close(f->saved);
    close(f->master);
    assert_true(length > 0);
    f->text[length - 1] = 0;
}

static void test_drawn_and_erased(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    progress *p = progress_start("rendering", true);
    progress_update(p, .5, "error 0.03");
    progress_finish(p);
    end(&f);
    static const char head[] = "\r\033[Krendering  50% [############............] ";
    static const char tail[] = " left  error 0.03\r\033[K";
    assert_memory_equal(f.text, head, sizeof head - 1);
    assert_string_equal(f.text + strlen(f.text) - (sizeof tail - 1), tail);
}

/* Odd fractions are drawn as the nearest proper one. */
static void test_odd_fractions(void **state) {
    (void)state;
    static const double done[] = {-1, 0, 1, 7, 0. / 0.};
    static const char *const shown[] = {"  0% [...", "  0% [...", "100% [###", "100% [###", "  0% [..."};
    for (int i = 0; i < 5; i++) {
        fixture f;
        begin(&f);
        progress *p = progress_start("x", true);
        progress_update(p, done[i], NULL);
        progress_finish(p);
        end(&f);
        assert_non_null(strstr(f.text, shown[i]));
    }
}

/* Cut to the terminal's width (80 where it does not know), for a broken line cannot be erased. */
static void test_long_detail(void **state) {
    (void)state;
    fixture f;
    char detail[600];
    memset(detail, 'd', sizeof detail - 1);
    detail[sizeof detail - 1] = 0;
    begin(&f);
    progress *p = progress_start("rendering", true);
    progress_update(p, .5, detail);
    progress_finish(p);
    end(&f);
    assert_int_equal(strlen(f.text), strlen("\r\033[K") + 79 + strlen("\r\033[K"));
}

static void test_not_drawn(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    progress *unwanted = progress_start("x", false);
    setenv("NO_COLOR", "1", 1);
    progress *forbidden = progress_start("x", true);
    unsetenv("NO_COLOR");
    setenv("TERM", "dumb", 1);
    progress *dumb = progress_start("x", true);
    progress_update(NULL, .5, NULL);
    progress_finish(NULL);
    end(&f);
    assert_null(unwanted);
    assert_null(forbidden);
    assert_null(dumb);
    assert_string_equal(f.text, "");
}

static void test_no_terminal(void **state) {
    (void)state;
    int saved = dup(STDERR_FILENO), none = open("/dev/null", O_WRONLY);
    setenv("TERM", "xterm", 1);
    dup2(none, STDERR_FILENO);
    progress *p = progress_start("x", true);
    dup2(saved, STDERR_FILENO);
    close(saved);
    close(none);
    assert_null(p);
}

/* On a terminal errors come in colour, on a line of their own. */
static void test_coloured_report(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    graze_report report = options_standard_error_report("gtest");
    report_error(&report, NULL, "bad");
    end(&f);
    assert_string_equal(f.text, "\r\033[Kgtest: \033[1;31merror:\033[0m bad\r\n");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drawn_and_erased), cmocka_unit_test(test_odd_fractions),
        cmocka_unit_test(test_long_detail),      cmocka_unit_test(test_not_drawn),
        cmocka_unit_test(test_no_terminal),      cmocka_unit_test(test_coloured_report),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
