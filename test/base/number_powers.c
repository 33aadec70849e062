/* The table of powers of five, and rounding with it, against exact integers. */
#include "base/number_powers.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <gmp.h>

static uint64_t random_bits(uint64_t *seed) {
    *seed += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = *seed;
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* numerator / denominator = 10^power. */
static void power_of_ten(mpz_t numerator, mpz_t denominator, int power) {
    mpz_set_ui(numerator, 1);
    mpz_set_ui(denominator, 1);
    if (power >= 0)
        mpz_ui_pow_ui(numerator, 10, (unsigned long)power);
    else
        mpz_ui_pow_ui(denominator, 10, (unsigned long)-power);
}

/* Multiplies numerator / denominator by 2^exponent. */
static void scale(mpz_t numerator, mpz_t denominator, int exponent) {
    if (exponent >= 0)
        mpz_mul_2exp(numerator, numerator, (unsigned long)exponent);
    else
        mpz_mul_2exp(denominator, denominator, (unsigned long)-exponent);
}

static void test_table(void **state) {
    (void)state;
    mpz_t numerator, denominator, quotient, entry;
    mpz_inits(numerator, denominator, quotient, entry, NULL);
    for (int power = NUMBER_POWER_MIN; power <= NUMBER_POWER_MAX; power++) {
        power_of_ten(numerator, denominator, power);
        /* The table's logarithm is right if it makes a number of 128 bits of the power. */
        scale(numerator, denominator, 127 - number_log2_of_power(power));
        mpz_fdiv_q(quotient, numerator, denominator);
        number_power have = number_power_of_ten(power);
        mpz_set_ui(entry, have.high);
        mpz_mul_2exp(entry, entry, 64);
        mpz_add_ui(entry, entry, have.low);
        if (mpz_cmp(quotient, entry) != 0 || mpz_sizeinbase(quotient, 2) != 128)
            fail_msg("10^%d is wrong", power);
        if ((power >= 0 && power <= NUMBER_POWER_EXACT) != (have.low == 0))
            fail_msg("10^%d is not as exact as is said", power);
    }
    mpz_clears(numerator, denominator, quotient, entry, NULL);
}

static void test_product(void **state) {
    (void)state;
    uint64_t seed = 1;
    mpz_t product, have;
    mpz_inits(product, have, NULL);
    for (int i = 0; i < 10000; i++) {
        uint64_t a = random_bits(&seed) >> (i % 3 * 31), b = random_bits(&seed) | (i % 5 ? 0 : UINT64_MAX << 30);
        mpz_set_ui(product, a);
        mpz_mul_ui(product, product, b);
        number_product p = number_multiply_words(a, b);
        mpz_set_ui(have, p.high);
        mpz_mul_2exp(have, have, 64);
        mpz_add_ui(have, have, p.low);
        assert_int_equal(mpz_cmp(product, have), 0);
    }
    mpz_clears(product, have, NULL);
}

/* The nearest integer, ties to even. */
static uint64_t nearest(mpz_t numerator, mpz_t denominator) {
    mpz_t quotient, rest;
    mpz_inits(quotient, rest, NULL);
    mpz_fdiv_qr(quotient, rest, numerator, denominator);
    mpz_mul_2exp(rest, rest, 1);
    int order = mpz_cmp(rest, denominator);
    uint64_t whole = mpz_get_ui(quotient);
    mpz_clears(quotient, rest, NULL);
    return whole + (order > 0 || (order == 0 && (whole & 1)));
}

/* Whether the value lies no further than 2^exponent from the middle of two integers. */
static bool is_near_middle(mpz_t numerator, mpz_t denominator, int exponent) {
    mpz_t off, one;
    mpz_inits(off, one, NULL);
    mpz_fdiv_r(off, numerator, denominator);
    mpz_mul_2exp(off, off, 1);
    mpz_sub(off, off, denominator);
    mpz_abs(off, off);
    mpz_set(one, denominator);
    scale(one, off, exponent + 1);
    bool near = mpz_cmp(off, one) <= 0;
    mpz_clears(off, one, NULL);
    return near;
}

/* n whose product with the power lies next to the middle of two integers: the first above, or one less. */
static uint64_t next_to_middle(int power, int shift, uint64_t whole, bool below) {
    mpz_t numerator, denominator, n;
    mpz_inits(numerator, denominator, n, NULL);
    power_of_ten(numerator, denominator, power);
    scale(numerator, denominator, -1 - number_log2_of_power(power) - shift);
    mpz_set_ui(n, whole);
    mpz_mul_2exp(n, n, 1);
    mpz_add_ui(n, n, 1);
    mpz_mul(n, n, denominator);
    mpz_mul_2exp(numerator, numerator, 1);
    mpz_cdiv_q(n, n, numerator);
    uint64_t word = mpz_sizeinbase(n, 2) == 64 ? mpz_get_ui(n) - below : 0;
    mpz_clears(numerator, denominator, n, NULL);
    return word;
}

static void test_rounding(void **state) {
    (void)state;
    uint64_t seed = 2;
    int decided = 0, undecided = 0;
    mpz_t numerator, denominator;
    mpz_inits(numerator, denominator, NULL);
    for (int i = 0; i < 200000; i++) {
        uint64_t r = random_bits(&seed), n = random_bits(&seed) | UINT64_C(1) << 63;
        int power = i % 4 ? (int)(r % 80) - 20 : (int)(r % 683) - 342;
        int spare = i % 2 ? 5 : 9, shift = spare + 1 + (int)((r >> 32) % (unsigned)(63 - spare));
        if (i % 3) /* with few bits before the point, and n made so that it hits */
            n = next_to_middle(power, shift, (random_bits(&seed) | UINT64_C(1) << 63) >> shift >> (r >> 50 & 1),
                               r >> 51 & 1);
        if (n >> 63 == 0)
            continue;
        uint64_t high = number_multiply_words(n, number_power_of_ten(power).high).high, rounded;
        bool sure = number_round(high, n, power, shift, spare, &rounded);
        power_of_ten(numerator, denominator, power);
        mpz_mul_ui(numerator, numerator, n);
        scale(numerator, denominator, -1 - number_log2_of_power(power) - shift);
        if (sure)
            decided++;
        else
            undecided++;
        if (!sure && !is_near_middle(numerator, denominator, -64 - shift))
            fail_msg("%#llx x 10^%d, shifted by %d, was left undecided", (unsigned long long)n, power, shift);
        if (sure && rounded != nearest(numerator, denominator))
            fail_msg("%#llx x 10^%d, shifted by %d, became %llu", (unsigned long long)n, power, shift,
                     (unsigned long long)rounded);
    }
    mpz_clears(numerator, denominator, NULL);
    assert_true(decided > 100000 && undecided > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_product),
        cmocka_unit_test(test_rounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
