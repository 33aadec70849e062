/* Numbers to text, as printf has it in the C locale, whatever the locale. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/number_powers.h"

/* A value v of the decimal exponent k, 10^k <= v < 10^(k + 1), has P significant digits in v x 10^(P - 1 - k), rounded
 * to an integer of P digits. The product is computed to 192 bits, of which the upper 128 are known to one unit of the
 * lowest, and the integer takes no more than 57 (number_powers.h). Rounding is in doubt only within that unit of a
 * middle between two integers - one value in 2^64 unless made so, as 1234565 is with 6 digits - and snprintf prints
 * these. */
enum { DIGITS = DBL_DECIMAL_DIG };

static const uint64_t tens[] = {1,
                                10,
                                100,
                                1000,
                                10000,
                                100000,
                                1000000,
                                10000000,
                                100000000,
                                1000000000,
                                10000000000,
                                100000000000,
                                1000000000000,
                                10000000000000,
                                100000000000000,
                                1000000000000000,
                                10000000000000000,
                                100000000000000000};

/* Puts a point in the place of the locale's decimal separator, of however many bytes. */
static size_t mend_point(char *text) {
    char *to = text;
    bool mending = false;
    for (const char *from = text; *from; from++) {
        bool own = (*from >= '0' && *from <= '9') || *from == '-' || *from == '+' || *from == 'e';
        if (own)
            *to++ = *from;
        else if (!mending)
            *to++ = '.';
        mending = !own;
    }
    *to = 0;
    return (size_t)(to - text);
}

static size_t print_slowly(char text[NUMBER_TEXT_SIZE], int digits, double value) {
    if (digits > 0)
        snprintf(text, NUMBER_TEXT_SIZE, "%.*g", digits, value);
    else
        snprintf(text, NUMBER_TEXT_SIZE, "%e", value);
    return isfinite(value) ? mend_point(text) : strlen(text);
}

/* floor(log10(v)), or one less if v is a power of ten, of v = n 2^(binary - 63), n's first bit being bit 63. */
static int decimal_exponent(uint64_t n, int binary) {
    /* That of 2^binary: 78913 / 2^18 is log10(2), closely enough for all doubles. */
    int exponent = ((78913 * binary + (512 << 18)) >> 18) - 512;
    /* The next power of ten may lie between 2^binary and v. Then both have the same binary exponent, and their first
     * bits tell, but for v being that power: its P digits come out as 10^P, and find_digits sees it. */
    int beyond = n > number_power_of_ten(exponent + 1).high, equal = number_log2_of_power(exponent + 1) == binary;
    return exponent + (beyond & equal);
}

/* The decimal digits of a value: an integer of DIGITS digits, of which the first `digits` matter. False where they are
 * in doubt. `bits` are those of a finite value that is not 0. */
static bool find_digits(uint64_t bits, int digits, uint64_t *integer, int *exponent) {
    uint64_t n = bits << 11 | UINT64_C(1) << 63;
    int binary = (int)(bits >> 52 & 0x7ff) - 1023;
    if (binary == -1023) { /* subnormal */
        uint64_t fraction = bits & (UINT64_MAX >> 12);
        int zeros = __builtin_clzll(fraction);
        n = fraction << zeros;
        binary = 63 - 1074 - zeros;
    }
    int k = decimal_exponent(n, binary), power = digits - 1 - k;
    uint64_t high = number_multiply_words(n, number_power_of_ten(power).high).high, rounded;
    /* The integer takes up to 57 bits of 63 or 64. */
    if (!number_round(high, n, power, 62 - binary - number_log2_of_power(power), 5, &rounded))
        return false;
    if (rounded == tens[digits]) {
        rounded = tens[digits - 1];
        k++;
    }
    *integer = rounded * tens[DIGITS - digits];
    *exponent = k;
    return true;
}

/* The digits of n < 10^8, the first in the lowest byte: split in halves three times, all parts at once. A part p moves
 * up and leaves its quotient q = p / d behind: (p - d q) 2^m + q. The factors are 1/100 and 1/10 in fixed point, exact
 * for what they meet. */
static inline uint64_t split(uint32_t n) {
    uint64_t upper = n / 10000, fours = ((uint64_t)n << 32) - upper * ((UINT64_C(10000) << 32) - 1);
    upper = (fours * 10486 >> 20) & 0x0000007f0000007f;
    uint64_t twos = (fours << 16) - upper * ((100 << 16) - 1);
    upper = (twos * 103 >> 10) & 0x000f000f000f000f;
    return (twos << 8) - upper * ((10 << 8) - 1);
}

/* A number's digits as text. */
typedef struct digit_text {
    uint64_t second, tenth; /* eight characters from the second digit, and from the tenth */
    char first;
    int count; /* digits up to the last that is not 0 */
} digit_text;

/* The index of the last byte that is not 0. */
static inline int last_byte(uint64_t word) {
    return (int)((63U ^ (unsigned)__builtin_clzll(word)) / 8);
}

static inline digit_text digits_to_text(uint64_t integer) {
    const uint32_t part = 100000000;
    uint64_t upper = integer / part;
    uint32_t first = (uint32_t)(upper / part);
    uint64_t second = split((uint32_t)(upper - (uint64_t)first * part));
    uint64_t tenth = split((uint32_t)(integer - upper * part));
    int count = tenth ? 10 + last_byte(tenth) : second ? 2 + last_byte(second) : 1;
    const uint64_t zeros = 0x3030303030303030;
    return (digit_text){second | zeros, tenth | zeros, (char)('0' + first), count};
}

/* Each of these writes past the end that it returns, up to 25 bytes from `text`. */

/* 0.000d..., or d.ddd for the exponent 0. */
static inline char *lay_out_small(char *text, const digit_text *d, int exponent) {
    number_store_text(text, 0x3030303030302e30); /* 0.000000 */
    text[exponent < 0 ? 1 - exponent : 0] = d->first;
    number_store_text(text + 2 - exponent, d->second);
    number_store_text(text + 10 - exponent, d->tenth);
    int bare = exponent == 0, single = d->count == 1;
    return text + (d->count + 1 - exponent - (bare & single));
}

/* ddd.ddd: the fraction's digits are written once more, a byte further, behind the point. */
static inline char *lay_out_large(char *text, const digit_text *d, int exponent) {
    text[0] = d->first;
    number_store_text(text + 1, d->second);
    number_store_text(text + 9, d->tenth);
    if (d->count <= exponent + 1)
        return text + exponent + 1;
    char *fraction = text + exponent + 2;
    fraction[-1] = '.';
    if (exponent < 8) {
        number_store_text(fraction, d->second >> 8 * exponent | d->tenth << (64 - 8 * exponent));
        number_store_text(fraction + 8, d->tenth >> 8 * exponent);
    } else {
        number_store_text(fraction, d->tenth >> 8 * (exponent - 8));
    }
    return text + d->count + 1;
}

/* d.ddde+xx with `count` digits. */
static inline char *lay_out_scientific(char *text, const digit_text *d, int exponent, int count) {
    text[0] = d->first;
    text[1] = '.';
    number_store_text(text + 2, d->second);
    number_store_text(text + 10, d->tenth);
    char *p = text + (count > 1 ? count + 1 : 1);
    unsigned magnitude = (unsigned)(exponent < 0 ? -exponent : exponent);
    *p++ = 'e';
    *p++ = exponent < 0 ? '-' : '+';
    if (magnitude >= 100)
        *p++ = (char)('0' + magnitude / 100);
    *p++ = (char)('0' + magnitude / 10 % 10);
    *p++ = (char)('0' + magnitude % 10);
    return p;
}

size_t number_print(char text[NUMBER_TEXT_SIZE], int digits, double value) {
    enum { SCIENTIFIC_DIGITS = 7 };
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bool negative = bits >> 63;
    bits &= UINT64_MAX >> 1;
    int asked = digits > 0 ? digits : SCIENTIFIC_DIGITS, exponent = 0;
    uint64_t integer = 0;
    if (bits >= UINT64_C(0x7ff) << 52 || asked > DIGITS)
        return print_slowly(text, digits, value);
    if (bits != 0 && !find_digits(bits, asked, &integer, &exponent))
        return print_slowly(text, digits, value);
    digit_text d = digits_to_text(integer);
    char *begin = text + negative, *end;
    text[0] = '-';
    if (digits <= 0 || exponent < -4 || exponent >= digits)
        end = lay_out_scientific(begin, &d, exponent, digits > 0 ? d.count : SCIENTIFIC_DIGITS);
    else if (exponent <= 0)
        end = lay_out_small(begin, &d, exponent);
    else
        end = lay_out_large(begin, &d, exponent);
    *end = 0;
    return (size_t)(end - text);
}

size_t number_print_exact(char text[NUMBER_TEXT_SIZE], double value) {
    for (int digits = DBL_DIG;; digits++) {
        size_t length = number_print(text, digits, value);
        double back;
        if (digits == DBL_DECIMAL_DIG || (number_scan(text, text + length, &back) && back == value))
            return length;
    }
}
