/* Numbers against the C library, correctly rounded in every locale. */
#include "base/number.h"

#include <fcntl.h>
#include <float.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static uint64_t random_bits(uint64_t *seed) {
    *seed += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = *seed;
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static uint64_t bits_of(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits) {
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The first byte of a page that cannot be read, behind one that can be written: memory up to the very end. */
static char *barrier;

static int make_barrier(void **state) {
    (void)state;
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    int zeros = open("/dev/zero", O_RDWR);
    char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE, zeros, 0);
    close(zeros);
    if (pages == MAP_FAILED || mprotect(pages + page, page, PROT_NONE) != 0)
        return -1;
    barrier = pages + page;
    return 0;
}

/* number_scan gives strtod's bits, and takes the whole text, whatever follows, with up to 47 bytes or nothing at all.
 */
static void check(const char *text) {
    double expected = strtod(text, NULL);
    size_t length = strlen(text), more = bits_of(expected) % 2 ? bits_of(expected) / 2 % 48 : 0;
    char longer[1500];
    if (length + more < sizeof longer) {
        memcpy(longer, text, length);
        memset(longer + length, "\t ,x-+/\xb2"[length % 8], more);
        text = memcpy(barrier - length - more, longer, length + more);
    }
    double value = NAN;
    if (number_scan(text, text + length + more, &value) != text + length)
        fail_msg("'%.*s' was not taken whole", (int)length, text);
    if (bits_of(value) != bits_of(expected))
        fail_msg("'%.*s' became %a, not %a", (int)length, text, value, expected);
}

static void test_random_doubles(void **state) {
    (void)state;
    static const int digits[] = {6, 9, 15, 16, 17, 18, 19, 20, 25};
    uint64_t seed = 1;
    for (int i = 0; i < 600000; i++) {
        uint64_t bits = random_bits(&seed);
        double value;
        memcpy(&value, &bits, sizeof value);
        /* Two of three lie where scenes and rays have their numbers. */
        if (i % 3)
            value = ldexp((double)(int64_t)bits, (int)(bits >> 20 & 127) - 127);
        if (!isfinite(value))
            continue;
        char text[64];
        snprintf(text, sizeof text, i % 2 ? "%.*g" : "%.*e", digits[i % 9] - !(i % 2), value);
        check(text);
    }
}

static void test_random_decimals(void **state) {
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 600000; i++) {
        uint64_t r = random_bits(&seed);
        char text[128], *p = text;
        int whole = (int)(r % 24), fraction = (int)(r / 24 % 24);
        const char *sign[] = {"", "-", "+", ""};
        p += sprintf(p, "%s", sign[r >> 40 & 3]);
        for (int k = 0; k < whole; k++)
            *p++ = (char)('0' + random_bits(&seed) % 10);
        if (fraction || !whole)
            *p++ = '.';
        for (int k = 0; k < fraction + !whole; k++)
            *p++ = (char)('0' + random_bits(&seed) % 10);
        *p = 0;
        if (r >> 50 & 1)
            sprintf(p, "%c%d", r >> 51 & 1 ? 'e' : 'E', (int)(r >> 52) % 330 * (r >> 62 & 1 ? 1 : -1));
        check(text);
    }
}

/* Exact midpoints between neighbouring doubles and their nearest surroundings: the hardest to round. */
static void test_midpoints(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 100000; i++) {
        uint64_t odd = (random_bits(&seed) >> 10) | UINT64_C(1) << 53 | 1;
        int power = (int)(random_bits(&seed) % 10);
        /* odd has 54 bits; below 2^64 the integer has at most 20 digits. */
        uint64_t middle = odd << power;
        for (int off = -1; off <= 1; off++) {
            char text[64];
            snprintf(text, sizeof text, "%llu", (unsigned long long)(middle + (uint64_t)off));
            check(text);
            strcat(text, i % 2 ? ".0000000000000000000000" : ".0000000000000000000001");
            check(text);
        }
        char text[1200];
        snprintf(text, sizeof text, "%.1074f", ldexp((double)(odd >> 1), -(int)(random_bits(&seed) % 200)));
        check(text);
    }
}

static void test_extremes(void **state) {
    (void)state;
    static const char *const texts[] = {"0",
                                        "-0",
                                        "0.0",
                                        "-0e5",
                                        "0e999999999999999999999",
                                        "1e-999999999999999999999",
                                        "1e-400",
                                        "0e999999999999",
                                        "9e308",
                                        "4.9e-324",
                                        "2.4e-324",
                                        "2.5e-324",
                                        "2.4703282292062327208e-324",
                                        "2.4703282292062328e-324",
                                        "2.2250738585072011e-308",
                                        "2.2250738585072014e-308",
                                        "1.7976931348623157e308",
                                        "1.7976931348623158e308",
                                        "1.7976931348623159e308",
                                        "1e309",
                                        "-1e309",
                                        "1e99999999999999999999",
                                        "9007199254740993",
                                        "9007199254740992",
                                        "9007199254740991",
                                        "9007199254740993e22",
                                        "1e22",
                                        "1e23",
                                        "1e27",
                                        "1e28",
                                        "1e-22",
                                        "1e-23",
                                        "1e-27",
                                        "1e-28",
                                        "18446744073709551615",
                                        "18446744073709551616",
                                        "9999999999999999999e27",
                                        "9999999999999999999e-27",
                                        "1000000000000000000",
                                        "999999999999999999.9",
                                        "0.000000000000000000000000000000000000001e39",
                                        "5.",
                                        ".5",
                                        "+.5E+1",
                                        "8.5e-1",
                                        "123456789012345678901234567890e-30"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check(texts[i]);
}

/* Digits by the thousand: 1 followed by zeros and a last digit that decides a tie, and zeros ahead of the point. */
static void test_long_texts(void **state) {
    (void)state;
    enum { LENGTH = 5000 };
    char *text = malloc(LENGTH + 64);
    strcpy(text, "9007199254740993.");
    size_t start = strlen(text);
    memset(text + start, '0', LENGTH);
    text[start + LENGTH] = 0;
    check(text);
    text[start + LENGTH - 1] = '1';
    check(text);
    double value;
    assert_true(text_to_real(text, &value) && value == 9007199254740994.0);
    strcpy(text + start + LENGTH, "e-16");
    check(text);
    memset(text, '0', LENGTH);
    text[1] = '.';
    strcpy(text + LENGTH, "17e5000");
    check(text);
    memset(text, '7', LENGTH);
    strcpy(text + LENGTH, "e-4990");
    check(text);
    free(text);
}

static void test_malformed_words(void **state) {
    (void)state;
    static const char *const words[] = {"",     "+",   "-",        ".",     "e5",  ".e5",   "1e",     "1e+",
                                        "1e-",  "--1", "+-1",      "1.2.3", "1,5", "0x10",  "nan",    "inf",
                                        "-inf", "NAN", "1f",       "1 ",    " 1",  "1e5.",  "1e5e",   "abc",
                                        "1d3",  "1_0", "infinity", "1e 5",  "١",   "1e999", "-1e999", "1.8e308"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        double value = 42;
        if (text_to_real(words[i], &value))
            fail_msg("'%s' was taken for a number", words[i]);
        assert_true(value == 42);
    }
}

static void test_scan_stops(void **state) {
    (void)state;
    const char *text = "1.25abc";
    double value;
    assert_ptr_equal(number_scan(text, text + 7, &value), text + 4);
    assert_true(value == 1.25);
    assert_ptr_equal(number_scan(text, text + 3, &value), text + 3);
    assert_true(value == 1.2);
    assert_null(number_scan(text, text, &value));
}

static void test_integers(void **state) {
    (void)state;
    static const char *const bad[] = {
        "", "-", "+", "1.", "1e3", "0x1", "2147483648", "-2147483649", "99999999999999999999999", " 1", "1 ", "a"};
    int value = 42;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (text_to_integer(bad[i], &value) || value != 42)
            fail_msg("'%s' was taken for an integer", bad[i]);
    assert_true(text_to_integer("2147483647", &value) && value == INT_MAX);
    assert_true(text_to_integer("-2147483648", &value) && value == INT_MIN);
    assert_true(text_to_integer("+007", &value) && value == 7);
}

static void test_printing(void **state) {
    (void)state;
    char text[NUMBER_TEXT_SIZE];
    assert_int_equal(number_print(text, 0, 1.5), 12);
    assert_string_equal(text, "1.500000e+00");
    number_print(text, 17, .1);
    assert_string_equal(text, "0.10000000000000001");
    assert_int_equal(number_print_exact(text, .1), 3);
    assert_string_equal(text, "0.1");
    number_print_exact(text, -0.0);
    assert_string_equal(text, "-0");
    number_print(text, 17, -DBL_MAX);
    assert_string_equal(text, "-1.7976931348623157e+308");
    assert_int_equal(number_print(text, 6, -INFINITY), 4);
    assert_string_equal(text, "-inf");
    assert_int_equal(number_print_exact(text, INFINITY), 3);
    assert_string_equal(text, "inf");
    number_print_exact(text, fabs(NAN));
    assert_string_equal(text, "nan");
}

/* One of the kinds of values that printing may stumble over. */
static double odd_value(uint64_t *seed) {
    uint64_t bits = random_bits(seed), other = random_bits(seed);
    double value;
    switch (bits % 7) {
    case 0: /* anything */
        return double_of(other);
    case 1: /* a direction's part */
        return (double)(int64_t)other * 0x1p-63;
    case 2: /* few bits, many ties */
        return ldexp((double)(int64_t)(other >> (other % 64)), (int)(bits >> 8 & 63) - 32);
    case 3: /* subnormal */
        return double_of((other >> 12 >> (bits >> 8) % 52) | (other << 63));
    case 4: /* about a power of ten */
        return double_of(bits_of(pow(10, (int)(other % 617) - 308)) + (bits >> 8) % 7 - 3);
    case 5: /* about a power of two */
        value = ldexp(1, (int)(other % 2000) - 1000);
        return double_of(bits_of(value) + (bits >> 8) % 5 - 2);
    default: /* few decimals */
        return floor((double)(other >> (11 + (bits >> 8) % 40))) / pow(10, (int)(bits >> 20) % 18);
    }
}

static void check_printing(int digits, double value) {
    char text[NUMBER_TEXT_SIZE], expected[NUMBER_TEXT_SIZE];
    size_t length = number_print(text, digits, value);
    snprintf(expected, sizeof expected, digits > 0 ? "%.*g" : "%.*e", digits > 0 ? digits : 6, value);
    if (length != strlen(expected) || strcmp(text, expected) != 0)
        fail_msg("%a became '%s' with %d digits, not '%s'", value, text, digits, expected);
}

static void test_printing_like_printf(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 400000; i++) {
        double value = odd_value(&seed);
        check_printing(DBL_DECIMAL_DIG, value);
        check_printing((int)(random_bits(&seed) % 21), value);
    }
    for (int power = -1074; power < 1024; power++)
        for (int digits = 0; digits <= DBL_DECIMAL_DIG; digits++)
            check_printing(digits, ldexp(power % 2 ? -1 : 1, power));
}

/* Two to seven digits and a 5: with one digit less, exactly in the middle. */
static void test_printing_ties(void **state) {
    (void)state;
    for (int number = 15; number < 1000000; number += number < 10000 ? 10 : 1230) {
        int digits = (int)floor(log10(number));
        for (int power = -40; power < 40; power++)
            check_printing(digits, ldexp(number, power));
        for (double tens = 10; tens < 1e14; tens *= 10)
            check_printing(digits, number * tens);
    }
    char text[NUMBER_TEXT_SIZE];
    number_print(text, 6, 1234565);
    assert_string_equal(text, "1.23456e+06");
    number_print(text, 6, 1234575);
    assert_string_equal(text, "1.23458e+06");
}

static void test_round_trip(void **state) {
    (void)state;
    uint64_t seed = 4;
    for (int i = 0; i < 400000; i++) {
        double value = odd_value(&seed), back;
        if (!isfinite(value))
            continue;
        char text[NUMBER_TEXT_SIZE];
        number_print(text, DBL_DECIMAL_DIG, value);
        if (!text_to_real(text, &back) || bits_of(back) != bits_of(value))
            fail_msg("%a came back from '%s' as %a", value, text, back);
        number_print_exact(text, value);
        if (!text_to_real(text, &back) || bits_of(back) != bits_of(value))
            fail_msg("%a came back from '%s' as %a", value, text, back);
    }
}

static void test_floats(void **state) {
    (void)state;
    assert_true(number_to_float(0.1) == 0.1F && number_to_float(-FLT_MAX) == -FLT_MAX);
    assert_true(number_to_float(3.4028235677973366e38) == FLT_MAX && number_to_float(1e39) == FLT_MAX);
    assert_true(number_to_float(-1e300) == -FLT_MAX && number_to_float(-INFINITY) == -FLT_MAX);
    assert_true(isnan(number_to_float(NAN)));
}

/* A directory with German manners in it, made by localedef; false where the system cannot. */
static int make_locale(const char *directory) {
    char name[256];
    snprintf(name, sizeof name, "%s/de_DE.UTF-8", directory);
    pid_t child = fork();
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr))
            _exit(126);
        execlp("localedef", "localedef", "--no-archive", "-i", "de_DE", "-f", "UTF-8", name, (char *)NULL);
        _exit(127);
    }
    int status;
    return child > 0 && waitpid(child, &status, 0) == child && status == 0 && setenv("LOCPATH", directory, 1) == 0;
}

static void remove_directory(const char *directory) {
    pid_t child = fork();
    if (child == 0) {
        execlp("rm", "rm", "-r", directory, (char *)NULL);
        _exit(127);
    }
    if (child > 0)
        waitpid(child, NULL, 0);
}

static void test_comma_locale(void **state) {
    (void)state;
    char directory[] = "/tmp/graze-locale-XXXXXX";
    assert_non_null(mkdtemp(directory));
    int found =
        setlocale(LC_NUMERIC, "de_DE.UTF-8") || (make_locale(directory) && setlocale(LC_NUMERIC, "de_DE.UTF-8"));
    if (found) {
        char text[NUMBER_TEXT_SIZE];
        double value = 0, slow = 0;
        snprintf(text, sizeof text, "%.2f", 1.25);
        int comma = strcmp(text, "1,25") == 0;
        /* 2^53 + 1 in a manner that leaves it to the C library. */
        int read = text_to_real("1.25", &value) && text_to_real("0.90071992547409930000001e16", &slow);
        /* The last two are left to the C library: more digits, and a tie. */
        char fixed[NUMBER_TEXT_SIZE], scientific[NUMBER_TEXT_SIZE], many[NUMBER_TEXT_SIZE], tie[NUMBER_TEXT_SIZE];
        number_print(fixed, 17, 1234567.25);
        number_print(scientific, 0, -1.25e-7);
        number_print(many, 20, 0x1p-3);
        number_print(tie, 6, 1234565);
        int refused = !text_to_real("1,25", &(double){0});
        setlocale(LC_NUMERIC, "C");
        remove_directory(directory);
        assert_true(comma);
        assert_true(read && refused && value == 1.25 && slow == 9007199254740994);
        assert_string_equal(fixed, "1234567.25");
        assert_string_equal(scientific, "-1.250000e-07");
        assert_string_equal(many, "0.125");
        assert_string_equal(tie, "1.23456e+06");
    } else {
        remove_directory(directory);
        skip();
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_doubles),
        cmocka_unit_test(test_random_decimals),
        cmocka_unit_test(test_midpoints),
        cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_long_texts),
        cmocka_unit_test(test_malformed_words),
        cmocka_unit_test(test_scan_stops),
        cmocka_unit_test(test_integers),
        cmocka_unit_test(test_printing),
        cmocka_unit_test(test_floats),
        cmocka_unit_test(test_printing_like_printf),
        cmocka_unit_test(test_printing_ties),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_comma_locale),
    };
    return cmocka_run_group_tests(tests, make_barrier, NULL);
}
