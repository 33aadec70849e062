/* Records out: formats, growth, and outputs that fail. */
#include "base/records.h"

#include <fcntl.h>
#include <float.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/captured_report.h"

static void expect_bytes(const record_buffer *b, const void *bytes, size_t length) {
    assert_int_equal(b->length, length);
    assert_memory_equal(b->bytes, bytes, length);
}

static void test_appending(void **state) {
    (void)state;
    record_buffer b = {0};
    record_append_reals(&b, RECORD_ASCII, 0, (double[]){1.5, -1e-300}, 2);
    record_append_text(&b, "\n");
    record_append_reals(&b, RECORD_ASCII, 17, (double[]){.1, -DBL_MAX, 0}, 3);
    record_append_bytes(&b, "x\0y", 3);
    record_append_bytes(&b, NULL, 0);
    static const char expected[] =
        "1.500000e+00\t-1.000000e-300\t\n0.10000000000000001\t-1.7976931348623157e+308\t0\tx\0y";
    expect_bytes(&b, expected, sizeof expected - 1);
    record_buffer_free(&b);
    assert_null(b.bytes);

    double values[] = {1.1, 1e300, -1e300, FLT_MAX, 3.4028235677973366e38, 1e-300};
    float singles[] = {1.1f, FLT_MAX, -FLT_MAX, FLT_MAX, FLT_MAX, 0};
    record_append_reals(&b, RECORD_FLOAT, 0, values, 6);
    expect_bytes(&b, singles, sizeof singles);
    record_buffer_free(&b);
    record_append_reals(&b, RECORD_DOUBLE, 0, values, 6);
    expect_bytes(&b, values, sizeof values);
    record_buffer_free(&b);
}

static void test_appending_records(void **state) {
    (void)state;
    double values[] = {1.1, -2, 1e300, 4, 5e-324, 6};
    record_buffer b = {0};
    record_append_records(&b, RECORD_ASCII, 17, values, 2, 3);
    record_append_records(&b, RECORD_ASCII, 0, values, 0, 3);
    record_append_records(&b, RECORD_ASCII, 0, values, 2, 1);
    static const char expected[] =
        "1.1000000000000001\t-2\t1.0000000000000001e+300\t\n4\t4.9406564584124654e-324\t6\t\n"
        "1.100000e+00\t\n-2.000000e+00\t\n";
    expect_bytes(&b, expected, sizeof expected - 1);
    record_buffer_free(&b);
    record_append_text(&b, "x");
    record_append_records(&b, RECORD_FLOAT, 0, values, 3, 2);
    float singles[] = {1.1f, -2, FLT_MAX, 4, 0, 6};
    assert_int_equal(b.length, 1 + sizeof singles);
    assert_memory_equal(b.bytes + 1, singles, sizeof singles);
    record_buffer_free(&b);
    record_append_records(&b, RECORD_DOUBLE, 0, values, 3, 2);
    expect_bytes(&b, values, sizeof values);
    record_buffer_free(&b);
}

static void test_growing(void **state) {
    (void)state;
    record_buffer b = {0};
    for (int i = 0; i < 30000; i++)
        record_append_reals(&b, RECORD_ASCII, 17, &(double){i}, 1);
    assert_false(b.failed);
    char *p = b.bytes;
    for (int i = 0; i < 30000; i++) {
        if (strtol(p, &p, 10) != i || *p++ != '\t')
            fail_msg("number %d is lost", i);
    }
    assert_ptr_equal(p, b.bytes + b.length);
    record_buffer_free(&b);
}

static void test_failed_buffer(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    record_buffer b = {0};
    record_append_text(&b, "x");
    record_append_bytes(&b, "", SIZE_MAX);
    assert_true(b.failed);
    record_append_text(&b, "y");
    record_append_reals(&b, RECORD_ASCII, 0, &(double){1}, 1);
    assert_int_equal(b.length, 1);
    assert_int_equal(record_buffer_write(&b, STDOUT_FILENO, "out", &c.report), GRAZE_SYSTEM_ERROR);
    assert_string_equal(c.text, "out of memory");
    record_buffer_free(&b);
    assert_false(b.failed);
}

static void test_write_errors(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    signal(SIGPIPE, SIG_IGN);
    record_buffer b = {0};
    int full = open("/dev/full", O_WRONLY);
    record_append_text(&b, "text");
    assert_int_equal(record_buffer_write(&b, full, "out", &c.report), GRAZE_SYSTEM_ERROR);
    assert_string_equal(c.text, "out: cannot write: No space left on device");
    close(full);
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    close(ends[0]);
    record_append_text(&b, "text");
    assert_int_equal(record_buffer_write(&b, ends[1], "out", &c.report), GRAZE_SYSTEM_ERROR);
    assert_string_equal(c.text, "out: cannot write: Broken pipe");
    assert_int_equal(record_buffer_write(&b, ends[1], "out", &c.report), GRAZE_OK);
    close(ends[1]);
    record_buffer_free(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_appending),     cmocka_unit_test(test_appending_records), cmocka_unit_test(test_growing),
        cmocka_unit_test(test_failed_buffer), cmocka_unit_test(test_write_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
