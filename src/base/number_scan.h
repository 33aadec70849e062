/* Inner parts of number_scan, for its quick way and for its careful one. */
#ifndef BASE_NUMBER_SCAN_H
#define BASE_NUMBER_SCAN_H

#include <float.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/number_powers.h"

/* number_scan, of any text. */
const char *number_scan_any(const char *text, const char *end, double *value);

/* mantissa x 10^scale as the bits of a double, rounded to nearest, ties to even; false where 128 bits of the power do
 * not decide it. */
bool number_convert_any(uint64_t mantissa, int64_t scale, uint64_t *bits);

/* Of the upper word at least 10 bits are shifted out. */
enum { NUMBER_SPARE_BITS = 9 };

/* The parts of mantissa x 10^scale for a scale within the table and 0 < mantissa < 2^64. */
typedef struct number_parts {
    uint64_t n, high; /* the mantissa with its first bit in bit 63, and the upper word of its product with the power */
    int shift;        /* of `high` to an integer of the double's 53 bits */
    int biased;       /* the exponent's field, if within 1 and 2046 */
} number_parts;

static inline number_parts number_multiply(uint64_t mantissa, int power) {
    int zeros = __builtin_clzll(mantissa);
    number_parts p = {.n = mantissa << zeros};
    p.high = number_multiply_words(p.n, number_power_of_ten(power).high).high;
    /* The first of its 64 or 63 bits is the first of the double's. */
    p.shift = 10 + (int)(p.high >> 63);
    p.biased = 1076 - zeros + number_log2_of_power(power) + p.shift;
    return p;
}

/* Most of what number_convert_any does, in line. */
static inline bool number_convert(uint64_t mantissa, int64_t scale, uint64_t *bits) {
#if FLT_EVAL_METHOD == 0
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    /* Both operands are exact, so the one operation rounds correctly. */
    if (mantissa <= UINT64_C(1) << DBL_MANT_DIG && scale >= -22 && scale <= 22) {
        double number = (double)(int64_t)mantissa;
        number = scale < 0 ? number / powers[-scale] : number * powers[scale];
        memcpy(bits, &number, sizeof number);
        return true;
    }
#endif
    /* Neither subnormal nor too large, whatever the mantissa. */
    if (scale >= -307 && scale <= 288 && mantissa > 0) {
        number_parts p = number_multiply(mantissa, (int)scale);
        uint64_t rounded;
        if (number_round_first(p.high, p.shift, NUMBER_SPARE_BITS, &rounded)) {
            /* A carry out of the 53 bits moves into the exponent by itself. */
            *bits = ((uint64_t)(p.biased - 1) << 52) + rounded;
            return true;
        }
    }
    return number_convert_any(mantissa, scale, bits);
}

static inline bool number_is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* 10^count for count <= 8, and the largest number that stays below 10^19 with `count` digits more. */
static const uint64_t number_tens[9] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
static const uint64_t number_fitting[9] = {9999999999999999999U, 999999999999999999, 99999999999999999,
                                           9999999999999999,     999999999999999,    99999999999999,
                                           9999999999999,        999999999999,       99999999999};

/* The top bit of each byte that is no digit, up to the first such: a carry runs only upwards from there. The digits'
 * bytes are their values. */
static inline uint64_t number_find_others(uint64_t values) {
    return (values | (values + 0x7676767676767676)) & 0x8080808080808080;
}

static inline uint64_t number_load_values(const char *text) {
    return number_load_text(text) ^ 0x3030303030303030;
}

/* Eight digits, the first in the lowest byte: neighbours join to pairs, these to fours, and these to one. */
static inline uint64_t number_join(uint64_t values) {
    values = (values * (10 << 8 | 1)) >> 8 & 0x00ff00ff00ff00ff;
    values = (values * (100 << 16 | 1)) >> 16 & 0x0000ffff0000ffff;
    return (values * (UINT64_C(10000) << 32 | 1)) >> 32;
}

/* The digits before the first other byte, a part of eight, and their number. */
static inline unsigned number_join_some(uint64_t values, uint64_t others, uint64_t *joined) {
    unsigned bit = (unsigned)__builtin_ctzll(others);
    /* Zeros move in before them; by two shifts, for one by 64 is undefined. */
    *joined = number_join(values << (63 ^ bit) << 8);
    return bit / 8;
}

#endif
