/* Numbers from text and to text, correctly rounded and free of the locale. */
#include "base/number.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The parts of a number's text. */
typedef struct decimal {
    const char *digits, *digits_end; /* with the point among them */
    uint64_t mantissa;               /* the first 19 significant digits */
    bool cut;                        /* there were more, and not all of them 0 */
    bool negative;
    int64_t scale;    /* value = mantissa x 10^scale unless cut */
    int64_t exponent; /* as written behind the e */
} decimal;

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static const char *scan_exponent(const char *p, const char *end, int64_t *exponent) {
    bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+'))
        p++;
    if (p == end || !is_digit(*p))
        return NULL;
    int64_t e = 0;
    for (; p < end && is_digit(*p); p++)
        if (e < INT64_MAX / 100)
            e = 10 * e + (*p - '0');
    *exponent = negative ? -e : e;
    return p;
}

static const char *scan_digits(const char *p, const char *end, bool fraction, decimal *d) {
    for (; p < end && is_digit(*p); p++) {
        if (d->mantissa < UINT64_C(1000000000000000000)) {
            d->mantissa = 10 * d->mantissa + (uint64_t)(*p - '0');
            d->scale -= fraction;
        } else {
            d->cut |= *p != '0';
            d->scale += !fraction;
        }
    }
    return p;
}

static const char *scan_decimal(const char *text, const char *end, decimal *d) {
    const char *p = text;
    *d = (decimal){0};
    d->negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+'))
        p++;
    d->digits = p;
    p = scan_digits(p, end, false, d);
    size_t count = (size_t)(p - d->digits);
    if (p < end && *p == '.') {
        const char *fraction = p + 1;
        p = scan_digits(fraction, end, true, d);
        count += (size_t)(p - fraction);
    }
    d->digits_end = p;
    if (count == 0)
        return NULL;
    if (p < end && (*p == 'e' || *p == 'E')) {
        p = scan_exponent(p + 1, end, &d->exponent);
        d->scale += d->exponent;
    }
    return p;
}

/* Any number at all, by strtod: from an integer and an exponent, which have no decimal point for a locale to redefine.
 * No more than 767 digits decide how a double is rounded; what lies beyond counts only as being there. */
static double convert_slowly(const decimal *d) {
    enum { DIGITS = 780 };
    char text[DIGITS + 32];
    size_t length = 0;
    bool fraction = false, beyond = false;
    int64_t exponent = d->exponent;
    for (const char *p = d->digits; p < d->digits_end; p++) {
        if (*p == '.') {
            fraction = true;
        } else if (length < DIGITS) {
            if (length > 0 || *p != '0')
                text[length++] = *p;
            exponent -= fraction;
        } else {
            beyond |= *p != '0';
            exponent += !fraction;
        }
    }
    if (beyond) {
        text[length++] = '1';
        exponent--;
    }
    const int64_t most = 100000;
    exponent = exponent > most ? most : exponent < -most ? -most : exponent;
    snprintf(text + length, sizeof text - length, "e%d", (int)exponent);
    return strtod(text, NULL);
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 uint128;

static int bit_length(uint128 n) {
    uint64_t high = (uint64_t)(n >> 64);
    return high ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll((uint64_t)n);
}

/* n 2^exponent for n > 0, rounded to nearest, ties to even. */
static double round_scaled(uint128 n, int exponent) {
    int shift = bit_length(n) - DBL_MANT_DIG;
    if (shift <= 0)
        return ldexp((double)(uint64_t)n, exponent);
    uint64_t kept = (uint64_t)(n >> shift);
    uint128 rest = n & (((uint128)1 << shift) - 1), half = (uint128)1 << (shift - 1);
    if (rest > half || (rest == half && (kept & 1)))
        kept++;
    return ldexp((double)kept, exponent + shift);
}

/* mantissa x 10^scale for |scale| <= 27 and mantissa > 0: 5^27 fits 64 bits, so that 128 bits hold the product, or 64
 * or more bits of the quotient. */
static double convert_in_128_bits(uint64_t mantissa, int scale) {
    uint64_t power = 1;
    for (int i = abs(scale); i > 0; i--)
        power *= 5;
    if (scale >= 0)
        return round_scaled((uint128)mantissa * power, scale);
    int shift = __builtin_clzll(mantissa) + 64;
    uint128 dividend = (uint128)mantissa << shift, quotient = dividend / power;
    /* The lowest bit lies far below the rounding: it may stand for the remainder. */
    if (quotient * power != dividend)
        quotient |= 1;
    return round_scaled(quotient, scale - shift);
}
#endif

static double convert(const decimal *d) {
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (d->mantissa == 0)
        return 0;
    if (!d->cut) {
#if FLT_EVAL_METHOD == 0
        /* Clinger: both operands are exact, so the one operation rounds correctly. */
        if (d->mantissa <= UINT64_C(1) << DBL_MANT_DIG && d->scale >= -22 && d->scale <= 22)
            return d->scale < 0 ? (double)d->mantissa / powers[-d->scale] : (double)d->mantissa * powers[d->scale];
#endif
#ifdef __SIZEOF_INT128__
        if (d->scale >= -27 && d->scale <= 27)
            return convert_in_128_bits(d->mantissa, (int)d->scale);
#endif
    }
    return convert_slowly(d);
}

const char *number_scan(const char *text, const char *end, double *value) {
    decimal d;
    const char *behind = scan_decimal(text, end, &d);
    if (behind)
        *value = d.negative ? -convert(&d) : convert(&d);
    return behind;
}

bool text_to_real(const char *word, double *value) {
    const char *end = word + strlen(word);
    double number;
    if (number_scan(word, end, &number) != end || !isfinite(number))
        return false;
    *value = number;
    return true;
}

bool text_to_integer(const char *word, int *value) {
    const char *p = word + (*word == '-' || *word == '+');
    if (!is_digit(*p))
        return false;
    int64_t number = 0;
    for (; is_digit(*p); p++)
        if (number <= INT_MAX)
            number = 10 * number + (*p - '0');
    if (*word == '-')
        number = -number;
    if (*p || number < INT_MIN || number > INT_MAX)
        return false;
    *value = (int)number;
    return true;
}

/* Puts a point in the place of the locale's decimal separator, of however many bytes. */
static size_t mend_point(char *text) {
    char *to = text;
    bool mending = false;
    for (const char *from = text; *from; from++) {
        bool own = is_digit(*from) || *from == '-' || *from == '+' || *from == 'e';
        if (own)
            *to++ = *from;
        else if (!mending)
            *to++ = '.';
        mending = !own;
    }
    *to = 0;
    return (size_t)(to - text);
}

size_t number_print(char text[NUMBER_TEXT_SIZE], int digits, double value) {
    if (digits > 0)
        snprintf(text, NUMBER_TEXT_SIZE, "%.*g", digits, value);
    else
        snprintf(text, NUMBER_TEXT_SIZE, "%e", value);
    return isfinite(value) ? mend_point(text) : strlen(text);
}

size_t number_print_exact(char text[NUMBER_TEXT_SIZE], double value) {
    for (int digits = DBL_DIG;; digits++) {
        size_t length = number_print(text, digits, value);
        double back;
        if (digits == DBL_DECIMAL_DIG || (text_to_real(text, &back) && back == value))
            return length;
    }
}

float number_to_float(double value) {
    return value > FLT_MAX ? FLT_MAX : value < -FLT_MAX ? -FLT_MAX : (float)value;
}
