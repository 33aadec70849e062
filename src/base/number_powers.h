/* Inner parts of number_scan and number_print: products with powers of ten, and their rounding. */
#ifndef BASE_NUMBER_POWERS_H
#define BASE_NUMBER_POWERS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* The first 128 bits of 5^power, which are those of 10^power: from 2^127 up to 2^128. What follows is cut off. */
typedef struct number_power {
    uint64_t high, low;
} number_power;

enum {
    NUMBER_POWER_MIN = -342,
    NUMBER_POWER_MAX = 340,
    NUMBER_POWER_EXACT = 27, /* 5^0 to 5^27 have no more than 64 bits: the lower word is 0, nothing is cut off */
};
extern const number_power number_powers[NUMBER_POWER_MAX - NUMBER_POWER_MIN + 1];

static inline number_power number_power_of_ten(int power) {
    return number_powers[power - NUMBER_POWER_MIN];
}

/* floor(log2(10^power)), for the powers of the table. The sum is positive, so that the shift is a division. */
static inline int number_log2_of_power(int power) {
    return ((217706 * power + (2048 << 16)) >> 16) - 2048;
}

typedef struct number_product {
    uint64_t high, low;
} number_product;

static inline number_product number_multiply_words(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
    __extension__ unsigned __int128 product = (unsigned __int128)a * b;
    return (number_product){(uint64_t)(product >> 64), (uint64_t)product};
#else
    const uint64_t mask = UINT32_MAX;
    uint64_t low = (a & mask) * (b & mask), left = (a >> 32) * (b & mask), right = (a & mask) * (b >> 32);
    uint64_t carried = (low >> 32) + (left & mask) + (right & mask);
    return (number_product){(a >> 32) * (b >> 32) + (left >> 32) + (right >> 32) + (carried >> 32),
                            (carried << 32) | (low & mask)};
#endif
}

/* With n's first bit in bit 63 and P the upper word of n x number_power_of_ten(power).high, n x 10^power is nearly
 * P 2^(number_log2_of_power(power) + 1): the table cuts off less than one unit of its lowest bit, of 128, so that the
 * true product of 64 and 128 bits has an upper word P or P + 1. */

/* number_round, where the first word leaves it open. */
static inline bool number_round_closely(uint64_t n, int power, int shift, uint64_t *rounded) {
    number_power factor = number_power_of_ten(power);
    number_product upper = number_multiply_words(n, factor.high), lower = number_multiply_words(n, factor.low);
    upper.low += lower.high;
    upper.high += upper.low < lower.high;
    /* What this leaves out, lower.low and n x what was cut off, is less than two units of upper.low. */
    const uint64_t half = UINT64_C(1) << (shift - 1);
    uint64_t whole = upper.high >> shift, part = upper.high & (2 * half - 1);
    *rounded = whole + (part >= half);
    /* A tie means n x 10^power = (2 whole + 1) 2^m, which is less than 2^64 but for 2^m: with a positive power, that
     * has at most 27 factors of 5. With others, what seems to be a tie lies beyond the middle. */
    if (power >= 0 && power <= NUMBER_POWER_EXACT && part == half && upper.low == 0)
        *rounded = whole + (whole & 1);
    /* Next below the middle, it may lie on either side. */
    return part != half - 1 || upper.low != UINT64_MAX;
}

/* As number_round, by the first word alone. What lies behind that counts only at the middle and one below: there the
 * bits under the first that is shifted out are all 0 or all 1, and so are the lowest few, spare < shift. */
static inline bool number_round_first(uint64_t high, int shift, int spare, uint64_t *rounded) {
    *rounded = ((high >> (shift - 1)) + 1) >> 1;
    return ((high + 1) & ((UINT64_C(1) << spare) - 1)) > 1;
}

/* The integer nearest to n x (10^power's first 128 bits and those that follow) / 2^(128 + shift), ties to even, for
 * 1 <= shift <= 63. `high` is the upper word of n x number_power_of_ten(power).high. False where 128 bits of the power
 * do not decide it. */
static inline bool number_round(uint64_t high, uint64_t n, int power, int shift, int spare, uint64_t *rounded) {
    return number_round_first(high, shift, spare, rounded) || number_round_closely(n, power, shift, rounded);
}

/* Eight bytes of text as a number with the first byte lowest. */
static inline uint64_t number_load_text(const char *text) {
    uint64_t word;
    memcpy(&word, text, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    return word;
}

static inline void number_store_text(char *text, uint64_t word) {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    memcpy(text, &word, sizeof word);
}

#endif
