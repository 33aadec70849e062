/* Numbers from text: the common kinds, quickly. */
#include <stdint.h>
#include <string.h>

#include "base/number.h"
#include "base/number_scan.h"

/* The point is taken out of the text and 8 digits are read at a time, with no loop over digits, whose end no processor
 * foresees. This does for up to 7 digits before the point and 23 in all; number_scan_any takes the rest.
 *
 * Both find mantissa x 10^scale. It is rounded by one operation on exact doubles (W. D. Clinger, "How to read floating
 * point numbers accurately", 1990), or else by a product of 128 bits or 192 (after D. Lemire, "Number parsing at a
 * gigabyte per second", 2021), or, where that leaves it undecided, by strtod. */

/* `quick` looks at no more bytes than this: sign and digits, 25, and 6 of an exponent and what ends it. */
enum { QUICK_REACH = 32 };

/* [eE][+-]digits of up to 4 digits at *p. */
static bool quick_exponent(const char **p, int64_t *scale) {
    const char *q = *p + 1;
    bool negative = *q == '-';
    q += negative | (*q == '+');
    int exponent = 0;
    const char *digits = q;
    for (; q - digits < 4 && number_is_digit(*q); q++)
        exponent = 10 * exponent + (*q - '0');
    *p = q;
    *scale += negative ? -exponent : exponent;
    return q > digits && !number_is_digit(*q);
}

/* The digits on both sides of a point, and their end; null where they are too many or none. `values` are the bytes from
 * `p`, where the sign ends, and others = number_find_others(values). Behind the first eight digits, the others are
 * sought from places that do not depend on the sign, so that the end is found, and the next number begun, early. */
static inline const char *quick_fraction(const char *text, uint64_t negative, uint64_t values, uint64_t others,
                                         uint64_t *mantissa) {
    const char *p = text + negative;
    /* The bytes before the point from this word, those behind it from the one that begins a byte later. */
    uint64_t before = (others ^ (others - 1)) >> 8, behind = number_load_values(p + 1), more;
    values = behind ^ ((behind ^ values) & before);
    others = number_find_others(values);
    if (others) {
        unsigned count = number_join_some(values, others, mantissa);
        return count > 0 ? p + 1 + count : NULL;
    }
    *mantissa = number_join(values);
    values = number_load_values(text + 9);
    others = number_find_others(values);
    /* With a sign, the first of these is the last of those before. */
    values &= ~(uint64_t)(negative ? 0xff : 0);
    if (others) {
        unsigned count = number_join_some(values, others, &more);
        *mantissa = *mantissa * number_tens[count - negative] + more;
        return text + 9 + count;
    }
    *mantissa = *mantissa * number_tens[8 - negative] + number_join(values);
    values = number_load_values(text + 17);
    others = number_find_others(values);
    if (!others)
        return NULL;
    unsigned count = number_join_some(values, others, &more);
    if (*mantissa > number_fitting[count])
        return NULL;
    *mantissa = *mantissa * number_tens[count] + more;
    return text + 17 + count;
}

/* A number of the common kinds: its end, or null for number_scan_any to decide. */
static inline const char *quick(const char *text, double *value) {
    /* Signs come at random: no branch. */
    uint64_t negative = *text == '-';
    const char *p = text + negative;
    uint64_t values = number_load_values(p), others = number_find_others(values), mantissa;
    if (!others)
        return NULL;
    int64_t scale = 0;
    unsigned whole = (unsigned)__builtin_ctzll(others) / 8;
    const char *point = p + whole;
    if (*point == '.') {
        p = quick_fraction(text, negative, values, others, &mantissa);
        if (!p)
            return NULL;
        scale = point + 1 - p;
    } else {
        number_join_some(values, others, &mantissa);
        p = point;
        if (whole == 0)
            return NULL;
    }
    if ((*p | 0x20) == 'e' && !quick_exponent(&p, &scale))
        return NULL;
    uint64_t bits;
    if (!number_convert(mantissa, scale, &bits))
        return NULL;
    bits |= negative << 63;
    memcpy(value, &bits, sizeof bits);
    return p;
}

/* With zeros behind the end, which belong to no number. */
static const char *scan_copy(const char *text, const char *end, double *value) {
    char copy[QUICK_REACH] = {0};
    memcpy(copy, text, (size_t)(end - text));
    const char *behind = number_scan(copy, copy + QUICK_REACH, value);
    return behind ? text + (behind - copy) : NULL;
}

const char *number_scan(const char *text, const char *end, double *value) {
    if (end - text < QUICK_REACH)
        return scan_copy(text, end, value);
    const char *behind = quick(text, value);
    return behind ? behind : number_scan_any(text, end, value);
}
