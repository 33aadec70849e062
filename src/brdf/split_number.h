/* Numbers of about 78 bits as sums of a head of at most 26 bits, so that products of heads are exact, and a tail.
 * Cheaper by far than double_double, for what neither cancels nor needs more.
 *
 * Each operation loses less than 2^-75 of the result, as long as nothing over- or underflows: callers keep all
 * magnitudes within 2^-480 .. 2^480. Needs a compiler that does not contract a * b + c. */
#ifndef BRDF_SPLIT_NUMBER_H
#define BRDF_SPLIT_NUMBER_H

typedef struct split_number {
    double head, tail; /* |tail| < 2^-24 |head| */
} split_number;

/* The upper 26 bits of a (Veltkamp). */
static inline double upper_bits(double a) {
    double big = (0x1p27 + 1) * a;
    return big - (big - a);
}

/* hi + lo, for |lo| < 2^-24 |hi| */
static inline split_number split_make(double hi, double lo) {
    double head = upper_bits(hi);
    return (split_number){head, (hi - head) + lo};
}

static inline double split_round(split_number a) {
    return a.head + a.tail;
}

static inline split_number split_multiply(split_number a, split_number b) {
    return split_make(a.head * b.head, a.head * b.tail + a.tail * split_round(b));
}

/* a / b, where reciprocal is 1 / b to within an ulp or so: divisions are dear, and callers share one. */
static inline split_number split_divide(split_number a, split_number b, double reciprocal) {
    double head = upper_bits(split_round(a) * reciprocal);
    return (split_number){head, (((a.head - head * b.head) - head * b.tail) + a.tail) * reciprocal};
}

/* What the square of a is larger than that of its head, which is exact. */
static inline double split_square_tail(split_number a) {
    return (2 * a.head + a.tail) * a.tail;
}

#endif
