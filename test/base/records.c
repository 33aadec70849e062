/* Records in and out: formats, mistakes and slow pipes. */
#include "base/records.h"

#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/captured_report.h"

/* A reader at the end of a pipe. */
typedef struct fixture {
    int input, output;
    record_reader *reader;
    captured c;
    double values[64];
    size_t count;
} fixture;

static void begin(fixture *f, record_format format, int fields) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    f->input = ends[1];
    f->output = ends[0];
    captured_begin(&f->c);
    assert_int_equal(record_reader_open(&f->reader, f->output, "in", format, fields, &f->c.report), GRAZE_OK);
}

static void finish_input(fixture *f) {
    assert_int_equal(close(f->input), 0);
    f->input = -1;
}

static void end(fixture *f) {
    record_reader_close(f->reader);
    close(f->output);
    if (f->input >= 0)
        close(f->input);
}

static void send_bytes(fixture *f, const void *bytes, size_t length) {
    assert_int_equal(write(f->input, bytes, length), length);
}

static void send_text(fixture *f, const char *text) {
    send_bytes(f, text, strlen(text));
}

static graze_status receive(fixture *f, size_t capacity) {
    return record_read(f->reader, f->values, capacity, &f->count);
}

static void expect_values(const fixture *f, size_t count, const double *values) {
    for (size_t i = 0; i < count; i++)
        if (!(f->values[i] == values[i]))
            fail_msg("value %zu is %g, not %g", i, f->values[i], values[i]);
}

static void test_ascii(void **state) {
    (void)state;
    fixture f;
    begin(&f, RECORD_ASCII, 3);
    send_text(&f, "  1 2\t3\n\n-4e0 5.5\r\n+6 7\v8\f.9");
    finish_input(&f);
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 3);
    expect_values(&f, 9, (double[]){1, 2, 3, -4, 5.5, 6, 7, 8, .9});
    for (int i = 0; i < 2; i++) {
        assert_int_equal(receive(&f, 10), GRAZE_OK);
        assert_int_equal(f.count, 0);
    }
    assert_int_equal(f.c.errors, 0);
    end(&f);
}

static void test_capacity(void **state) {
    (void)state;
    fixture f;
    begin(&f, RECORD_ASCII, 1);
    send_text(&f, "1 2 3 4 5\n");
    finish_input(&f);
    static const size_t counts[] = {2, 2, 1, 0};
    double first = 1;
    for (int i = 0; i < 4; i++) {
        assert_int_equal(receive(&f, 2), GRAZE_OK);
        assert_int_equal(f.count, counts[i]);
        if (f.count)
            assert_true(f.values[0] == first);
        first += 2;
    }
    end(&f);
}

static void test_empty_inputs(void **state) {
    (void)state;
    static const char *const texts[] = {"", " ", "\n\n \t\r\n"};
    for (int i = 0; i < 3; i++) {
        fixture f;
        begin(&f, RECORD_ASCII, 2);
        send_text(&f, texts[i]);
        finish_input(&f);
        assert_int_equal(receive(&f, 1), GRAZE_OK);
        assert_int_equal(f.count, 0);
        end(&f);
    }
}

/* Would hang if it waited for more than it was given. */
static void test_interactive(void **state) {
    (void)state;
    fixture f;
    begin(&f, RECORD_ASCII, 3);
    send_text(&f, "1 2 3\n");
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 1);
    send_text(&f, "4 5 6\n7 8 9\n10 1");
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 2);
    send_text(&f, "1 1");
    send_text(&f, "2 ");
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 1);
    expect_values(&f, 3, (double[]){10, 11, 12});
    end(&f);
    /* A number that may go on is waited for, though blanks from before lie behind it in the buffer. */
    begin(&f, RECORD_ASCII, 1);
    send_text(&f, "1 2 3                    \n");
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 3);
    send_text(&f, "7 1045");
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 1);
    send_text(&f, "6\n");
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 1);
    assert_true(f.values[0] == 10456);
    end(&f);
    double pair[] = {1.5, -2.5, 3.5};
    begin(&f, RECORD_DOUBLE, 2);
    send_bytes(&f, pair, 20);
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 1);
    expect_values(&f, 2, pair);
    send_bytes(&f, (char *)pair + 20, 4);
    send_bytes(&f, pair, 8);
    assert_int_equal(receive(&f, 10), GRAZE_OK);
    assert_int_equal(f.count, 1);
    expect_values(&f, 2, (double[]){3.5, 1.5});
    end(&f);
}

/* The good records come first, then the error, once with its text, then without. */
static void expect_trouble(record_format format, const void *bytes, size_t length, size_t good, const char *text) {
    fixture f;
    begin(&f, format, 3);
    send_bytes(&f, bytes, length);
    finish_input(&f);
    if (good > 0) {
        assert_int_equal(receive(&f, 20), GRAZE_OK);
        assert_int_equal(f.count, good);
        assert_int_equal(f.c.errors, 0);
    }
    for (int i = 0; i < 2; i++) {
        assert_int_equal(receive(&f, 20), GRAZE_INPUT_ERROR);
        assert_int_equal(f.count, 0);
        assert_int_equal(f.c.errors, 1);
        assert_string_equal(f.c.text, text);
    }
    end(&f);
}

static void test_ascii_trouble(void **state) {
    (void)state;
    static const struct {
        const char *input;
        size_t good;
        const char *text;
    } cases[] = {
        {"1 2 3\n4 5 x6 7", 1, "in:2:5: record 2: 'x6' is not a number"},
        {"nan 1 2", 0, "in:1:1: record 1: 'nan' is not a number"},
        {"1 2 3 4\n\n\n  inf 6", 1, "in:4:3: record 2: 'inf' is not a number"},
        {"1 2 3\n1 0x5 6\n", 1, "in:2:3: record 2: '0x5' is not a number"},
        {"1 2 3\n1e999 5 6\n", 1, "in:2:1: record 2: '1e999' is too large a number"},
        {"1 2 -1e309", 0, "in:1:5: record 1: '-1e309' is too large a number"},
        {"1 2 3\n4 5 6\n7 8", 2, "in:3:4: record 3 is cut short: 2 of 3 numbers"},
        {"1", 0, "in:1:2: record 1 is cut short: 1 of 3 numbers"},
        {"1 2 3e", 0, "in:1:5: record 1: '3e' is not a number"},
        {"1 2 -", 0, "in:1:5: record 1: '-' is not a number"},
        {"1,2,3", 0, "in:1:1: record 1: '1,2,3' is not a number"},
        {"1 2 3.4.5 6", 0, "in:1:5: record 1: '3.4.5' is not a number"},
        {"abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz", 0,
         "in:1:1: record 1: 'abcdefghijklmnopqrstuvwxyzabcdefghijklmn...' is not a number"},
        {"\001\033[2J 1 2", 0, "in:1:1: record 1: '\?\?[2J' is not a number"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_trouble(RECORD_ASCII, cases[i].input, strlen(cases[i].input), cases[i].good, cases[i].text);
    expect_trouble(RECORD_ASCII, "1 2\0 3", 6, 0, "in:1:3: record 1: '2\?' is not a number");
}

static void test_binary_trouble(void **state) {
    (void)state;
    float floats[] = {1, 2, 3, 4, 5, 6, 7};
    double doubles[] = {1, 2, 3, 4, 5, 6, 7};
    expect_trouble(RECORD_FLOAT, floats, 13, 1, "in: record 2 is cut short: 1 of 12 bytes");
    expect_trouble(RECORD_FLOAT, floats, 23, 1, "in: record 2 is cut short: 11 of 12 bytes");
    expect_trouble(RECORD_DOUBLE, doubles, 56, 2, "in: record 3 is cut short: 8 of 24 bytes");
    expect_trouble(RECORD_DOUBLE, doubles, 3, 0, "in: record 1 is cut short: 3 of 24 bytes");
    floats[4] = NAN;
    expect_trouble(RECORD_FLOAT, floats, 24, 1, "in: record 2: its number 2 is not finite");
    doubles[0] = -INFINITY;
    expect_trouble(RECORD_DOUBLE, doubles, 48, 0, "in: record 1: its number 1 is not finite");
}

static void test_failing_read(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    int directory = open("/tmp", O_RDONLY);
    record_reader *reader;
    double value;
    size_t count;
    assert_int_equal(record_reader_open(&reader, directory, "in", RECORD_ASCII, 1, &c.report), GRAZE_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(record_read(reader, &value, 1, &count), GRAZE_SYSTEM_ERROR);
        assert_int_equal(count, 0);
        assert_string_equal(c.text, "in: cannot read: Is a directory");
        assert_int_equal(c.errors, 1);
    }
    record_reader_close(reader);
    record_reader_close(NULL);
    close(directory);
}

/* Numbers lie across the ends of the buffer in every possible way. */
static void test_long_file(void **state) {
    (void)state;
    enum { RECORDS = 60000 };
    FILE *file = tmpfile();
    for (int i = 0; i < RECORDS; i++)
        fprintf(file, "%d\t%d.%d\n", i, -i, i % 10);
    fflush(file);
    lseek(fileno(file), 0, SEEK_SET);
    captured c;
    captured_begin(&c);
    record_reader *reader;
    assert_int_equal(record_reader_open(&reader, fileno(file), "in", RECORD_ASCII, 2, &c.report), GRAZE_OK);
    double values[2 * 777];
    size_t count, total = 0;
    while (record_read(reader, values, 777, &count) == GRAZE_OK && count > 0) {
        for (size_t i = 0; i < count; i++, total++) {
            char text[32];
            snprintf(text, sizeof text, "-%zu.%zu", total, total % 10);
            if (values[2 * i] != (double)total || values[2 * i + 1] != strtod(text, NULL))
                fail_msg("record %zu is %.17g %.17g", total, values[2 * i], values[2 * i + 1]);
        }
        /* A file never makes it wait, so it gives all that is asked for. */
        assert_true(count == 777 || total == RECORDS);
    }
    assert_int_equal(total, RECORDS);
    assert_int_equal(c.errors, 0);
    record_reader_close(reader);
    fclose(file);
}

/* A word without an end is refused, not split in two numbers. */
static void test_endless_word(void **state) {
    (void)state;
    FILE *file = tmpfile();
    for (int i = 0; i < 70000; i++)
        putc('1', file);
    fputs(" 2\n", file);
    fflush(file);
    lseek(fileno(file), 0, SEEK_SET);
    captured c;
    captured_begin(&c);
    record_reader *reader;
    double value;
    size_t count;
    assert_int_equal(record_reader_open(&reader, fileno(file), "in", RECORD_ASCII, 1, &c.report), GRAZE_OK);
    assert_int_equal(record_read(reader, &value, 1, &count), GRAZE_INPUT_ERROR);
    assert_string_equal(c.text, "in:1:1: record 1: '1111111111111111111111111111111111111111...' is not a number");
    record_reader_close(reader);
    fclose(file);
}

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

static void on_alarm(int number) {
    (void)number;
}

enum { TRANSFERRED = 100000 };

typedef struct sender {
    int descriptor;
    record_format format;
    graze_status status;
} sender;

static void *send_records(void *argument) {
    sender *s = argument;
    record_buffer b = {0};
    for (int i = 0; i < TRANSFERRED; i++) {
        record_append_reals(&b, s->format, 17, (double[]){i / 8., -i}, 2);
        record_append_text(&b, s->format == RECORD_ASCII ? "\n" : "");
    }
    s->status = record_buffer_write(&b, s->descriptor, "pipe", NULL);
    record_buffer_free(&b);
    close(s->descriptor);
    return NULL;
}

/* Through a pipe, while signals interrupt the reader or the writer. */
static void transfer(record_format format, int flags, bool interrupt_writer) {
    fixture f;
    begin(&f, format, 2);
    fcntl(f.input, F_SETFL, flags);
    fcntl(f.output, F_SETFL, flags);
    sender s = {f.input, format, GRAZE_INPUT_ERROR};
    f.input = -1;
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, send_records, &s), 0);
    sigset_t alarms;
    sigemptyset(&alarms);
    sigaddset(&alarms, SIGALRM);
    pthread_sigmask(interrupt_writer ? SIG_BLOCK : SIG_UNBLOCK, &alarms, NULL);
    size_t total = 0;
    while (receive(&f, 32) == GRAZE_OK && f.count > 0) {
        for (size_t i = 0; i < f.count; i++, total++)
            if (f.values[2 * i] != (double)total / 8 || f.values[2 * i + 1] != -(double)total)
                fail_msg("record %zu is %g %g", total, f.values[2 * i], f.values[2 * i + 1]);
    }
    pthread_join(thread, NULL);
    pthread_sigmask(SIG_UNBLOCK, &alarms, NULL);
    assert_int_equal(s.status, GRAZE_OK);
    assert_int_equal(f.c.errors, 0);
    assert_int_equal(total, TRANSFERRED);
    end(&f);
}

static void test_transfer(void **state) {
    (void)state;
    struct sigaction action = {.sa_handler = on_alarm};
    struct sigaction alarm_before;
    sigaction(SIGALRM, &action, &alarm_before);
    struct itimerval often = {{0, 300}, {0, 300}}, never = {{0, 0}, {0, 0}};
    setitimer(ITIMER_REAL, &often, NULL);
    transfer(RECORD_ASCII, 0, false);
    transfer(RECORD_ASCII, 0, true);
    transfer(RECORD_ASCII, O_NONBLOCK, false);
    transfer(RECORD_FLOAT, 0, false);
    transfer(RECORD_FLOAT, 0, true);
    transfer(RECORD_FLOAT, O_NONBLOCK, false);
    transfer(RECORD_DOUBLE, 0, false);
    transfer(RECORD_DOUBLE, 0, true);
    transfer(RECORD_DOUBLE, O_NONBLOCK, false);
    setitimer(ITIMER_REAL, &never, NULL);
    sigaction(SIGALRM, &alarm_before, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ascii),         cmocka_unit_test(test_capacity),
        cmocka_unit_test(test_empty_inputs),  cmocka_unit_test(test_interactive),
        cmocka_unit_test(test_ascii_trouble), cmocka_unit_test(test_binary_trouble),
        cmocka_unit_test(test_failing_read),  cmocka_unit_test(test_long_file),
        cmocka_unit_test(test_endless_word),  cmocka_unit_test(test_appending),
        cmocka_unit_test(test_growing),       cmocka_unit_test(test_failed_buffer),
        cmocka_unit_test(test_write_errors),  cmocka_unit_test(test_transfer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
