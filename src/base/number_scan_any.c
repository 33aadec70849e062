/* Numbers of any kind from text. */
#include <stdio.h>
#include <stdlib.h>

#include "base/number_scan.h"

bool number_convert_any(uint64_t mantissa, int64_t scale, uint64_t *bits) {
    const uint64_t infinity = UINT64_C(0x7ff) << 52;
    /* 2^64 x 10^-343 is less than half of the least double, 10^309 more than the greatest. */
    if (mantissa == 0 || scale < NUMBER_POWER_MIN || scale > DBL_MAX_10_EXP) {
        *bits = mantissa == 0 || scale < 0 ? 0 : infinity;
        return true;
    }
    number_parts p = number_multiply(mantissa, (int)scale);
    if (p.biased < 1) { /* subnormal: fewer bits, as if with the least exponent and no bit implied */
        p.shift += 1 - p.biased;
        p.biased = 1;
    }
    uint64_t rounded;
    if (p.shift > 63 || !number_round(p.high, p.n, (int)scale, p.shift, NUMBER_SPARE_BITS, &rounded))
        return false;
    *bits = p.biased > 2046 ? infinity : ((uint64_t)(p.biased - 1) << 52) + rounded;
    return true;
}

/* The parts of a number's text. */
typedef struct decimal {
    const char *digits, *digits_end; /* with the point among them */
    uint64_t mantissa;               /* the first 19 significant digits */
    bool cut;                        /* there were more, and not all of them 0 */
    bool negative;
    int64_t scale;    /* value = mantissa x 10^scale unless cut */
    int64_t exponent; /* as written behind the e */
} decimal;

static const char *scan_exponent(const char *p, const char *end, int64_t *exponent) {
    bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+'))
        p++;
    if (p == end || !number_is_digit(*p))
        return NULL;
    int64_t e = 0;
    for (; p < end && number_is_digit(*p); p++)
        if (e < INT64_MAX / 100)
            e = 10 * e + (*p - '0');
    *exponent = negative ? -e : e;
    return p;
}

static const char *scan_digits(const char *p, const char *end, bool fraction, decimal *d) {
    while (end - p >= 8 && d->mantissa <= number_fitting[8] && !number_find_others(number_load_values(p))) {
        d->mantissa = 100000000 * d->mantissa + number_join(number_load_values(p));
        d->scale -= fraction ? 8 : 0;
        p += 8;
    }
    for (; p < end && number_is_digit(*p); p++) {
        if (d->mantissa <= number_fitting[1]) {
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

/* By strtod: from an integer and an exponent, which have no decimal point for a locale to redefine. No more than 767
 * digits decide how a double is rounded; what lies beyond counts only as being there. */
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

static double convert_decimal(const decimal *d) {
    uint64_t bits, above;
    if (!number_convert_any(d->mantissa, d->scale, &bits))
        return convert_slowly(d);
    /* The value lies between the mantissas m and m + 1. */
    if (d->cut && (!number_convert_any(d->mantissa + 1, d->scale, &above) || bits != above))
        return convert_slowly(d);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

const char *number_scan_any(const char *text, const char *end, double *value) {
    decimal d;
    const char *behind = scan_decimal(text, end, &d);
    if (behind)
        *value = d.negative ? -convert_decimal(&d) : convert_decimal(&d);
    return behind;
}
