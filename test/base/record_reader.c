/* Records in: formats, mistakes and slow pipes. */
#include "base/records.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/captured_report.h"
#include "base/text.h"

/* A reader at the end of a pipe. */
typedef struct fixture {
    int input, output;
    record_reader *reader;
    record_chunk chunk;
    captured c;
    double room[64];
    const double *values;
    size_t count;
} fixture;

static void begin(fixture *f, record_format format, int fields) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    f->input = ends[1];
    f->output = ends[0];
    f->chunk = (record_chunk){0};
    captured_begin(&f->c);
    assert_int_equal(record_reader_open(&f->reader, f->output, "in", format, fields, &f->c.report), GRAZE_OK);
}

static void finish_input(fixture *f) {
    assert_int_equal(close(f->input), 0);
    f->input = -1;
}

static void end(fixture *f) {
    record_chunk_free(&f->chunk);
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

/* Records, then the status of what is wrong with the one behind them. */
static graze_status receive(fixture *f, size_t capacity) {
    f->count = 0;
    if (!record_read(f->reader, &f->chunk, capacity))
        return GRAZE_OK;
    f->values = record_doubles(&f->chunk, f->room);
    f->count = f->chunk.count;
    return record_report_error(f->reader, &f->chunk);
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

/* The good records come first, then the error, once. */
static void expect_error(record_format format, const void *bytes, size_t length, size_t good, const char *text) {
    fixture f;
    begin(&f, format, 3);
    send_bytes(&f, bytes, length);
    finish_input(&f);
    size_t count = 0;
    graze_status status = GRAZE_OK;
    while (status == GRAZE_OK) {
        assert_int_equal(f.c.errors, 0);
        status = receive(&f, 20);
        count += f.count;
        if (status == GRAZE_OK && f.count == 0)
            fail_msg("nothing is wrong with '%.*s'", (int)length, (const char *)bytes);
    }
    assert_int_equal(status, GRAZE_INPUT_ERROR);
    assert_int_equal(count, good);
    assert_int_equal(f.c.errors, 1);
    assert_string_equal(f.c.text, text);
    end(&f);
}

static void test_ascii_errors(void **state) {
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
        {"1 2 3\n 4\nx", 1, "in:3:1: record 2: 'x' is not a number"},
        {"1 2 3\n x 4", 1, "in:2:2: record 2: 'x' is not a number"},
        {"1\n2\n\n ", 0, "in:4:2: record 1 is cut short: 2 of 3 numbers"},
        {"1 2 3 4 5 6 7 8 9\n1 2 y\nz", 3, "in:2:5: record 4: 'y' is not a number"},
        {"1,2,3", 0, "in:1:1: record 1: '1,2,3' is not a number"},
        {"1 2 3.4.5 6", 0, "in:1:5: record 1: '3.4.5' is not a number"},
        {"abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz", 0,
         "in:1:1: record 1: 'abcdefghijklmnopqrstuvwxyzabcdefghijklmn...' is not a number"},
        {"\001\033[2J 1 2", 0, "in:1:1: record 1: '\?\?[2J' is not a number"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_error(RECORD_ASCII, cases[i].input, strlen(cases[i].input), cases[i].good, cases[i].text);
    expect_error(RECORD_ASCII, "1 2\0 3", 6, 0, "in:1:3: record 1: '2\?' is not a number");
}

static void test_binary_errors(void **state) {
    (void)state;
    float floats[] = {1, 2, 3, 4, 5, 6, 7};
    double doubles[] = {1, 2, 3, 4, 5, 6, 7};
    expect_error(RECORD_FLOAT, floats, 13, 1, "in: record 2 is cut short: 1 of 12 bytes");
    expect_error(RECORD_FLOAT, floats, 23, 1, "in: record 2 is cut short: 11 of 12 bytes");
    expect_error(RECORD_DOUBLE, doubles, 56, 2, "in: record 3 is cut short: 8 of 24 bytes");
    expect_error(RECORD_DOUBLE, doubles, 3, 0, "in: record 1 is cut short: 3 of 24 bytes");
    floats[4] = NAN;
    expect_error(RECORD_FLOAT, floats, 24, 1, "in: record 2: its number 2 is not finite");
    doubles[0] = -INFINITY;
    expect_error(RECORD_DOUBLE, doubles, 48, 0, "in: record 1: its number 1 is not finite");
}

static void open_descriptor(fixture *f, int descriptor, record_format format, int fields) {
    f->input = -1;
    f->output = descriptor;
    f->chunk = (record_chunk){0};
    captured_begin(&f->c);
    assert_int_equal(record_reader_open(&f->reader, f->output, "in", format, fields, &f->c.report), GRAZE_OK);
}

static void test_failing_read(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        fixture f;
        open_descriptor(&f, i ? open("/dev/null", O_WRONLY) : open("/tmp", O_RDONLY), RECORD_ASCII, 1);
        assert_int_equal(receive(&f, 1), i ? GRAZE_SYSTEM_ERROR : GRAZE_INPUT_ERROR);
        assert_int_equal(f.count, 0);
        assert_string_equal(f.c.text, i ? "in: record 1: cannot read: Bad file descriptor"
                                        : "in: record 1: cannot read: Is a directory");
        assert_int_equal(receive(&f, 1), GRAZE_OK);
        assert_int_equal(f.count, 0);
        assert_int_equal(f.c.errors, 1);
        end(&f);
    }
    record_reader_close(NULL);
}

/* --- Every way that bytes can come ------------------------------------------------------------------------------- */

typedef struct outcome {
    double values[64];
    size_t count;
    char text[256];
} outcome;

static bool collect(fixture *f, outcome *o, size_t capacity) {
    graze_status status = receive(f, capacity);
    if (o->count + f->count > 20)
        fail_msg("too many records");
    for (size_t i = 0; i < 3 * f->count; i++)
        o->values[3 * o->count + i] = f->values[i];
    o->count += f->count;
    if (status)
        snprintf(o->text, sizeof o->text, "%.255s", f->c.text);
    return f->count > 0 && status == GRAZE_OK;
}

static size_t whole_records(record_format format, const char *bytes, size_t length) {
    if (format != RECORD_ASCII)
        return length / (format == RECORD_FLOAT ? 12 : 24);
    size_t words = 0;
    for (size_t i = 1; i < length; i++)
        words += text_is_blank(bytes[i]) && !text_is_blank(bytes[i - 1]);
    return words / 3;
}

/* In two pieces. What is whole of the first has to come before the second is sent. */
static outcome deliver_in_two(record_format format, const char *bytes, size_t length, size_t split, size_t capacity) {
    fixture f;
    outcome o = {.count = 0};
    begin(&f, format, 3);
    send_bytes(&f, bytes, split);
    bool good = true;
    for (size_t whole = whole_records(format, bytes, split); good && o.count < whole;)
        good = collect(&f, &o, capacity);
    send_bytes(&f, bytes + split, length - split);
    finish_input(&f);
    while (good)
        good = collect(&f, &o, capacity);
    end(&f);
    return o;
}

typedef struct dribble {
    int descriptor;
    const char *bytes;
    size_t length;
} dribble;

static void *send_byte_by_byte(void *argument) {
    dribble *d = argument;
    for (size_t i = 0; i < d->length; i++) {
        if (write(d->descriptor, d->bytes + i, 1) != 1)
            break;
        sched_yield();
    }
    close(d->descriptor);
    return NULL;
}

static outcome deliver_byte_by_byte(record_format format, const char *bytes, size_t length, size_t capacity) {
    fixture f;
    outcome o = {.count = 0};
    begin(&f, format, 3);
    dribble d = {f.input, bytes, length};
    f.input = -1;
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, send_byte_by_byte, &d), 0);
    while (collect(&f, &o, capacity))
        ;
    pthread_join(thread, NULL);
    end(&f);
    return o;
}

static void expect_same(const outcome *a, const outcome *b, size_t split) {
    if (a->count != b->count || strcmp(a->text, b->text) != 0)
        fail_msg("split at %zu: %zu records and '%s', not %zu and '%s'", split, a->count, a->text, b->count, b->text);
    assert_memory_equal(a->values, b->values, 3 * a->count * sizeof *a->values);
}

static void expect_same_however_sent(record_format format, const void *bytes, size_t length, size_t count,
                                     const char *text) {
    outcome whole = deliver_in_two(format, bytes, length, 0, 20);
    assert_int_equal(whole.count, count);
    assert_string_equal(whole.text, text);
    for (size_t capacity = 1; capacity < 5; capacity++) {
        for (size_t split = 0; split <= length; split++) {
            outcome o = deliver_in_two(format, bytes, length, split, capacity);
            expect_same(&o, &whole, split);
        }
        outcome o = deliver_byte_by_byte(format, bytes, length, capacity);
        expect_same(&o, &whole, length);
    }
}

static void test_every_split(void **state) {
    (void)state;
    static const struct {
        const char *input;
        size_t count;
        const char *text;
    } cases[] = {
        {" 1 2 3\r\n4.5\t-6e-1 7\n\n8 9\n10 \n \n", 3, ""},
        {"1 2 3 4 5 6 7 8 9 10 11 12", 4, ""},
        {"1 2 3\n4 5 6\n7 8 nine\n1 2 3", 2, "in:3:5: record 3: 'nine' is not a number"},
        {"1 2 3\n4 5 6\n7 1e400\n1 1 2 3", 2, "in:3:3: record 3: '1e400' is too large a number"},
        {"1 2 3\n4 5 6 7\n 8", 2, "in:3:3: record 3 is cut short: 2 of 3 numbers"},
        {"\n\n\n  \n\n", 0, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_same_however_sent(RECORD_ASCII, cases[i].input, strlen(cases[i].input), cases[i].count, cases[i].text);
    float floats[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    double doubles[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    expect_same_however_sent(RECORD_FLOAT, floats, sizeof floats, 4, "");
    expect_same_however_sent(RECORD_DOUBLE, doubles, sizeof doubles, 4, "");
    floats[7] = INFINITY;
    doubles[11] = NAN;
    expect_same_however_sent(RECORD_FLOAT, floats, sizeof floats, 2, "in: record 3: its number 2 is not finite");
    expect_same_however_sent(RECORD_DOUBLE, doubles, sizeof doubles, 3, "in: record 4: its number 3 is not finite");
}

/* Where a chunk's floats are, as they came, for the reader of floats alone. */
static void test_floats_in_place(void **state) {
    (void)state;
    fixture f;
    begin(&f, RECORD_FLOAT, 3);
    float sent[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    send_bytes(&f, sent, 30);
    for (size_t from = 0; from < 6; from += 3) {
        assert_true(record_read(f.reader, &f.chunk, 1));
        const float *floats = record_floats(&f.chunk);
        assert_int_equal((uintptr_t)floats % sizeof(float), 0);
        assert_memory_equal(floats, sent + from, 12);
    }
    sent[8] = NAN;
    send_bytes(&f, (char *)sent + 30, 6);
    assert_true(record_read(f.reader, &f.chunk, 5));
    assert_true(isnan(record_floats(&f.chunk)[2]));
    assert_int_equal(f.chunk.count, 1);
    record_doubles(&f.chunk, f.room);
    assert_int_equal(f.chunk.count, 0);
    assert_int_equal(f.chunk.error.status, GRAZE_INPUT_ERROR);
    assert_string_equal(f.chunk.error.text, "record 3: its number 3 is not finite");
    end(&f);
}

static void test_set_error(void **state) {
    (void)state;
    fixture f;
    begin(&f, RECORD_ASCII, 3);
    send_text(&f, "1 2 3\n4 5 6\n7 8 9\n");
    assert_int_equal(receive(&f, 1), GRAZE_OK);
    assert_int_equal(receive(&f, 9), GRAZE_OK);
    assert_int_equal(f.chunk.first, 1);
    assert_int_equal(f.chunk.count, 2);
    record_set_error(&f.chunk, 1, "100% wrong");
    assert_int_equal(f.chunk.count, 1);
    assert_int_equal(record_report_error(f.reader, &f.chunk), GRAZE_INPUT_ERROR);
    assert_string_equal(f.c.text, "in: record 3: 100% wrong");
    end(&f);
}

static void *cancel(void *reader) {
    sched_yield();
    record_reader_cancel(reader);
    return NULL;
}

/* Would hang if it went on waiting. */
static void test_cancel(void **state) {
    (void)state;
    for (int k = 0; k < 20; k++) {
        fixture f;
        begin(&f, RECORD_ASCII, 3);
        send_text(&f, "1 2 ");
        pthread_t thread;
        assert_int_equal(pthread_create(&thread, NULL, cancel, f.reader), 0);
        for (int i = 0; i < 2; i++)
            assert_false(record_read(f.reader, &f.chunk, 1));
        assert_int_equal(f.chunk.count, 0);
        assert_int_equal(f.chunk.error.status, GRAZE_OK);
        assert_int_equal(f.c.errors, 0);
        pthread_join(thread, NULL);
        end(&f);
    }
}

/* --- More than a buffer ------------------------------------------------------------------------------------------ */

/* Numbers lie across the ends of the buffer in every possible way. */
static void test_long_file(void **state) {
    (void)state;
    enum { RECORDS = 60000 };
    static const size_t capacities[] = {777, 20000};
    for (int k = 0; k < 2; k++) {
        FILE *file = tmpfile();
        for (int i = 0; i < RECORDS; i++)
            fprintf(file, "%d\t%d.%d\n", i, -i, i % 10);
        fputs("1 x", file);
        fflush(file);
        lseek(fileno(file), 0, SEEK_SET);
        fixture f;
        open_descriptor(&f, dup(fileno(file)), RECORD_ASCII, 2);
        double *values = malloc(2 * capacities[k] * sizeof *values);
        assert_non_null(values);
        size_t total = 0;
        while (f.chunk.error.status == GRAZE_OK && record_read(f.reader, &f.chunk, capacities[k])) {
            assert_ptr_equal(record_doubles(&f.chunk, values), values);
            assert_int_equal(f.chunk.first, total);
            for (size_t i = 0; i < f.chunk.count; i++, total++) {
                char text[32];
                snprintf(text, sizeof text, "-%zu.%zu", total, total % 10);
                if (values[2 * i] != (double)total || values[2 * i + 1] != strtod(text, NULL))
                    fail_msg("record %zu is %.17g %.17g", total, values[2 * i], values[2 * i + 1]);
            }
        }
        assert_int_equal(total, RECORDS);
        record_report_error(f.reader, &f.chunk);
        assert_string_equal(f.c.text, "in:60001:3: record 60001: 'x' is not a number");
        free(values);
        end(&f);
        fclose(file);
    }
}

static void expect_of_file(FILE *file, size_t records, const char *text) {
    fflush(file);
    lseek(fileno(file), 0, SEEK_SET);
    fixture f;
    open_descriptor(&f, dup(fileno(file)), RECORD_ASCII, 2);
    size_t count = 0;
    graze_status status = GRAZE_OK;
    while (status == GRAZE_OK && (status = receive(&f, 20), f.count > 0))
        count += f.count;
    assert_int_equal(count, records);
    assert_string_equal(f.c.text, text);
    end(&f);
    fclose(file);
}

static FILE *file_with(const char *before, char byte, int count, const char *after) {
    FILE *file = tmpfile();
    fputs(before, file);
    for (int i = 0; i < count; i++)
        putc(byte, file);
    fputs(after, file);
    return file;
}

/* Doubles 0, 1, 2 ... */
static FILE *file_of_doubles(size_t count) {
    FILE *file = tmpfile();
    assert_non_null(file);
    for (size_t i = 0; i < count; i++)
        fwrite(&(double){(double)i}, sizeof(double), 1, file);
    fflush(file);
    return file;
}

static void expect_doubles(record_chunk *c, size_t first, size_t count) {
    const double *values = record_doubles(c, NULL);
    assert_int_equal(c->first, first);
    assert_int_equal(c->count, count);
    for (size_t i = 0; i < 2 * count; i++)
        if (!(values[i] == (double)(2 * (first + 1) + i)))
            fail_msg("number %zu from record %zu on is %g", i, first, values[i]);
}

/* Chunks of a file can be read in any order; what it gets while it is read belongs to it. */
static void test_binary_file(void **state) {
    (void)state;
    enum { CHUNKS = 4, RECORDS = 300, LAST = 200, ALL = (CHUNKS - 1) * RECORDS + LAST };
    FILE *file = file_of_doubles(2 * (1 + ALL) + 1);
    fixture f;
    lseek(fileno(file), 16, SEEK_SET);
    open_descriptor(&f, dup(fileno(file)), RECORD_DOUBLE, 2);
    record_chunk chunks[CHUNKS] = {{0}};
    for (size_t i = 0; i < CHUNKS; i++) {
        assert_true(record_read(f.reader, &chunks[i], RECORDS));
        assert_int_equal(lseek(fileno(file), 0, SEEK_CUR), 16 * (1 + (i < 3 ? (i + 1) * RECORDS : ALL)));
    }
    for (size_t i = CHUNKS; i-- > 0;) {
        expect_doubles(&chunks[i], RECORDS * i, i < 3 ? RECORDS : LAST);
        record_chunk_free(&chunks[i]);
    }
    double more[2] = {2 * (1 + ALL) + 1};
    assert_int_equal(pwrite(fileno(file), more, 12, 16 * (1 + ALL) + 8), 12);
    assert_true(record_read(f.reader, &f.chunk, RECORDS));
    expect_doubles(&f.chunk, ALL, 1);
    assert_int_equal(receive(&f, RECORDS), GRAZE_INPUT_ERROR);
    assert_string_equal(f.c.text, "in: record 1102 is cut short: 4 of 16 bytes");
    end(&f);
    fclose(file);
}

/* Chunks of few records, and of many again. */
static void test_capacities_of_file(void **state) {
    (void)state;
    static const size_t capacities[] = {300, 300, 1, 2, 300, 1, 300};
    FILE *file = file_of_doubles(3000);
    lseek(fileno(file), 16, SEEK_SET);
    fixture f;
    open_descriptor(&f, dup(fileno(file)), RECORD_DOUBLE, 2);
    size_t at = 0;
    for (size_t i = 0; i < sizeof capacities / sizeof *capacities; i++) {
        assert_true(record_read(f.reader, &f.chunk, capacities[i]));
        expect_doubles(&f.chunk, at, capacities[i]);
        at += capacities[i];
    }
    end(&f);
    fclose(file);
}

/* A file that became shorter, and one that cannot be read. */
static void test_failing_file(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        FILE *file = file_of_doubles(40);
        rewind(file);
        fixture f;
        open_descriptor(&f, dup(fileno(file)), RECORD_DOUBLE, 4);
        assert_true(record_read(f.reader, &f.chunk, 1000));
        if (k == 2) {
            int directory = open("/tmp", O_RDONLY);
            assert_int_equal(dup2(directory, f.output), f.output);
            close(directory);
        } else {
            assert_int_equal(ftruncate(f.output, k ? 104 : 96), 0);
        }
        record_doubles(&f.chunk, NULL);
        assert_int_equal(f.chunk.count, k == 2 ? 0 : 3);
        assert_int_equal(record_report_error(f.reader, &f.chunk), GRAZE_INPUT_ERROR);
        assert_string_equal(f.c.text, k == 2 ? "in: record 1: cannot read: Is a directory"
                                      : k    ? "in: record 4 is cut short: 8 of 32 bytes"
                                             : "in: record 4 is cut short: 0 of 32 bytes");
        end(&f);
        fclose(file);
    }
}

static void test_cancelled_file(void **state) {
    (void)state;
    FILE *file = file_of_doubles(8000);
    rewind(file);
    fixture f;
    open_descriptor(&f, dup(fileno(file)), RECORD_DOUBLE, 4);
    assert_true(record_read(f.reader, &f.chunk, 1000));
    record_reader_cancel(f.reader);
    assert_false(record_read(f.reader, &f.chunk, 1000));
    assert_int_equal(f.chunk.count, 0);
    end(&f);
    fclose(file);
}

/* A record without an end is refused, not split in two; blanks before it are nothing of its. */
static void test_endless_records(void **state) {
    (void)state;
    expect_of_file(file_with("1 2\n 3", '3', 150000, " 4\n"), 1, "in:2:2: record 2 is longer than 131072 bytes");
    expect_of_file(file_with("1 2\nx ", '3', 150000, " 4\n"), 1, "in:2:1: record 2: 'x' is not a number");
    expect_of_file(file_with("1 2\n0.", '0', 100000, "4\n5\n6 7"), 3, "");
    expect_of_file(file_with("1 2\n", ' ', 1000000, "\n3 4\n5 x"), 2, "in:4:3: record 3: 'x' is not a number");
    expect_of_file(file_with("1 2", '\n', 1000000, "3 4\n5 x"), 2, "in:1000002:3: record 3: 'x' is not a number");
    expect_of_file(file_with("1 2", '\n', 1000000, " 3\n 4"), 2, "");
    expect_of_file(file_with("1\n2 3", ' ', 1000000, "4\n"), 1, "in:2:3: record 2 is longer than 131072 bytes");
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
        cmocka_unit_test(test_ascii),           cmocka_unit_test(test_capacity),
        cmocka_unit_test(test_empty_inputs),    cmocka_unit_test(test_interactive),
        cmocka_unit_test(test_ascii_errors),    cmocka_unit_test(test_binary_errors),
        cmocka_unit_test(test_failing_read),    cmocka_unit_test(test_every_split),
        cmocka_unit_test(test_floats_in_place), cmocka_unit_test(test_set_error),
        cmocka_unit_test(test_cancel),          cmocka_unit_test(test_long_file),
        cmocka_unit_test(test_binary_file),     cmocka_unit_test(test_capacities_of_file),
        cmocka_unit_test(test_failing_file),    cmocka_unit_test(test_cancelled_file),
        cmocka_unit_test(test_endless_records), cmocka_unit_test(test_transfer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
