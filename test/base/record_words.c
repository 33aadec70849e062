/* Numbers converted many at a time are what they are one by one. */
#include "base/record_words.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/record_convert.h"

static uint64_t random_state = 1;

static uint64_t random_bits(void) {
    random_state = random_state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return random_state >> 20;
}

/* Copies the text to the end of a piece of memory, so that a sanitizer sees what is read behind it. */
static void expect_same(const char *text, size_t length, size_t count) {
    enum { BEFORE = 16 };
    char *memory = malloc(BEFORE + length);
    double *one = calloc(count + 1, sizeof *one), *many = calloc(count + 1, sizeof *many);
    assert_non_null(memory);
    assert_non_null(one);
    assert_non_null(many);
    memset(memory, ' ', BEFORE);
    memcpy(memory + BEFORE, text, length);
    const char *at_one = memory + BEFORE, *at_many = at_one, *limit = at_one + length;
    size_t good = record_scan_words(&at_one, limit, one, count);
    size_t found = record_words_scan(&at_many, limit, many, count);
    if (found != good || memcmp(one, many, good * sizeof *one) != 0)
        fail_msg("%zu of %zu numbers, not %zu, or others, in '%.*s'", found, count, good, (int)length, text);
    if (good < count)
        assert_ptr_equal(at_many, at_one);
    free(memory);
    free(one);
    free(many);
}

static size_t write_digits(char *to, size_t count) {
    for (size_t i = 0; i < count; i++)
        to[i] = (char)('0' + random_bits() % 10);
    return count;
}

/* A word of up to 60 bytes. */
static size_t write_word(char *to, bool may_be_bad) {
    static const char *const odd[] = {"0",       "-1",       "+.5",  "7.",       "-0.",    "1e5",
                                      "9.5e-05", "-1.5E+10", "-0.0", "0.0",      "1e-9",   "1.e5",
                                      "12.25",   "-.25",     "00.5", "9.9e-100", "5e-324", "1.0e300"};
    static const char *const bad[] = {"x",     "-",    ".",     "1.2.3",  "1.2x",  "0.1234567:", "a.5",
                                      "--1.5", "1.5-", "0x1p3", "nan",    "1e999", "1.5\x80",    "/.5",
                                      ":.5",   "1./",  "1.5e",  "\x01.5", "1\0.5"};
    size_t kind = random_bits() % 64;
    if (kind < 6) {
        const char *word = odd[random_bits() % (sizeof odd / sizeof *odd)];
        return strlen(strcpy(to, word));
    }
    if (may_be_bad && kind == 6) {
        const char *word = bad[random_bits() % (sizeof bad / sizeof *bad)];
        return strlen(strcpy(to, word));
    }
    char *p = to;
    if (random_bits() % 2)
        *p++ = '-';
    p += write_digits(p, 1 + (kind == 7) * (random_bits() % 4));
    *p++ = '.';
    p += write_digits(p, kind < 40 ? 9 + random_bits() % 4 : 1 + random_bits() % 20);
    return (size_t)(p - to);
}

static size_t write_blanks(char *to, size_t least) {
    static const char blanks[] = " \t\n\r\v\f";
    size_t count = random_bits() % 16 ? least : least + random_bits() % 90;
    for (size_t i = 0; i < count; i++)
        to[i] = blanks[random_bits() % 6];
    return count;
}

/* Words of all kinds, as many as fit and more than are asked for; the last of the text is a blank. */
static void test_many_words(void **state) {
    (void)state;
    enum { WORDS = 200 };
    static char text[WORDS * 160];
    for (int round = 0; round < 4000; round++) {
        size_t words = random_bits() % WORDS, length = write_blanks(text, 0);
        for (size_t i = 0; i < words; i++) {
            length += write_word(text + length, round % 2);
            length += write_blanks(text + length, 1);
        }
        expect_same(text, length, words);
    }
}

/* Every number of digits, at the edge of what takes 53 bits and everywhere else. */
static void test_every_length(void **state) {
    (void)state;
    char text[64];
    for (size_t digits = 1; digits < 25; digits++)
        for (int k = 0; k < 2000; k++) {
            size_t length = (size_t)snprintf(text, sizeof text, "%s%d.", k & 1 ? "-" : "", k % 10);
            length += write_digits(text + length, digits);
            text[length++] = '\n';
            expect_same(text, length, 1);
        }
    for (int i = -3; i <= 3; i++)
        for (int scale = 0; scale < 2; scale++) {
            size_t length = (size_t)snprintf(text, sizeof text, scale ? "0.%lld " : "9.%015lld ",
                                             (scale ? 9007199254740992LL : 7199254740992LL) + i);
            expect_same(text, length, 1);
        }
}

/* Every byte in every place of a number. */
static void test_every_byte(void **state) {
    (void)state;
    for (int byte = 0; byte < 256; byte++)
        for (size_t at = 0; at < 13; at++) {
            char text[] = "-0.1234567890 0.25 ";
            text[at] = (char)byte;
            expect_same(text, sizeof text - 1, 2);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_many_words),
        cmocka_unit_test(test_every_length),
        cmocka_unit_test(test_every_byte),
    };
    if (!record_words_available()) {
        puts("1..0 # SKIP this processor takes words one by one");
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
