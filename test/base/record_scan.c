/* What is found many bytes at a time is what is found one by one. */
#include "base/record_scan.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/text.h"

static uint32_t random_state = 1;

static uint32_t random_bits(void) {
    random_state = random_state * 1664525 + 1013904223;
    return random_state >> 8;
}

static void expect_ends(const char *bytes, size_t length) {
    size_t words = 0, lines = 0, found_words = 1000, found_lines = 2000;
    for (size_t i = 0; i < length; i++) {
        words += text_is_blank(bytes[i]) && !text_is_blank(bytes[(ptrdiff_t)i - 1]);
        lines += bytes[i] == '\n';
    }
    record_count_ends(bytes, length, &found_words, &found_lines);
    if (found_words != 1000 + words || found_lines != 2000 + lines)
        fail_msg("%zu bytes: %zu words and %zu lines, not %zu and %zu", length, found_words - 1000, found_lines - 2000,
                 words, lines);
}

/* Every byte beside every other. */
static void test_pairs_of_bytes(void **state) {
    (void)state;
    char bytes[40];
    for (int first = 0; first < 256; first++)
        for (int second = 0; second < 256; second++) {
            memset(bytes, 'x', sizeof bytes);
            size_t at = 1 + random_bits() % 36;
            bytes[at] = (char)first;
            bytes[at + 1] = (char)second;
            expect_ends(bytes + 1, 39);
            memset(bytes, ' ', sizeof bytes);
            bytes[at] = (char)first;
            bytes[at + 1] = (char)second;
            expect_ends(bytes + 1, 39);
        }
}

static void test_lengths_and_alignments(void **state) {
    (void)state;
    static const char some[] = "1 .\n\t\r\v\f-\0\200\377\037!";
    char bytes[400];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = some[random_bits() % (sizeof some - 1)];
    for (size_t from = 1; from < 70; from++)
        for (size_t length = 0; length < 300; length++)
            expect_ends(bytes + from, length);
}

/* Counts beyond what a vector of bytes can hold. */
static void test_many_ends(void **state) {
    (void)state;
    enum { LENGTH = 100000 };
    char *bytes = malloc(LENGTH);
    assert_non_null(bytes);
    for (size_t i = 0; i < LENGTH; i++)
        bytes[i] = i % 2 ? '\n' : '1';
    expect_ends(bytes + 1, LENGTH - 1);
    for (size_t i = 1; i < 300; i++)
        expect_ends(bytes + i, 16 * 255 + i);
    memset(bytes, '\n', LENGTH);
    expect_ends(bytes + 1, LENGTH - 1);
    free(bytes);
}

static void test_finite(void **state) {
    (void)state;
    enum { COUNT = 21 };
    const double bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    double doubles[COUNT];
    float floats[COUNT];
    for (size_t count = 0; count <= COUNT; count++) {
        for (size_t i = 0; i < COUNT; i++) {
            doubles[i] = i % 2 ? 1.7976931348623157e308 : -5e-324;
            floats[i] = i % 2 ? 3.40282347e38f : -1e-45f;
        }
        assert_int_equal(record_finite_doubles(doubles, count), count);
        assert_int_equal(record_finite_floats(floats, count), count);
        for (size_t at = count; at-- > 0;) {
            doubles[at] = bad[random_bits() % 4];
            floats[at] = (float)bad[random_bits() % 4];
            assert_int_equal(record_finite_doubles(doubles, count), at);
            assert_int_equal(record_finite_floats(floats, count), at);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs_of_bytes),
        cmocka_unit_test(test_lengths_and_alignments),
        cmocka_unit_test(test_many_ends),
        cmocka_unit_test(test_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
