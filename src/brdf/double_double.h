/* Numbers of about 106 bits as unevaluated sums of two doubles, by error-free transformations (Dekker 1971, Knuth).
 *
 * Operations are exact or lose less than 2^-98 of the result, sums and differences of the larger operand, as long as no
 * product over- or underflows. The same bits with and without fused multiply-add: it is used for nothing but what is
 * also exact, or rounded once, without it. All else must not be contracted; arithmetic.h sees to that. */
#ifndef BRDF_DOUBLE_DOUBLE_H
#define BRDF_DOUBLE_DOUBLE_H

#include <math.h>

#include "brdf/arithmetic.h"

#if defined(FP_FAST_FMA) && !defined(BRDF_FMA)
#define BRDF_FMA
#endif

typedef struct double_double {
    double hi, lo; /* |lo| is at most an ulp or two of hi */
} double_double;

/* a + b, exactly; the same bits for (b, a). */
BRDF_INLINE double_double exact_sum(double a, double b) {
    double s = a + b, from_b = s - a;
    return (double_double){s, (a - (s - from_b)) + (b - from_b)};
}

/* a + b, exactly, for |a| >= |b|. */
BRDF_INLINE double_double exact_ordered_sum(double a, double b) {
    double s = a + b;
    return (double_double){s, b - (s - a)};
}

/* a + b, exactly, for numbers not below zero; the same bits for (b, a). */
BRDF_INLINE double_double exact_positive_sum(double a, double b) {
    return exact_ordered_sum(a > b ? a : b, a > b ? b : a);
}

/* The upper 26 bits of a (Veltkamp). */
BRDF_INLINE double upper_bits(double a) {
    double big = (0x1p27 + 1) * a;
    return big - (big - a);
}

/* a b - p for p = a b rounded, which is exact. */
BRDF_INLINE double product_error(double a, double b, double p) {
#ifdef BRDF_FMA
    return fma(a, b, -p);
#else
    double a_hi = upper_bits(a), a_lo = a - a_hi, b_hi = upper_bits(b), b_lo = b - b_hi;
    return ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo;
#endif
}

/* a - q b, rounded once, for q within an ulp or so of a / b: then a and q b are so close that, without a fused
 * instruction, their difference is exact but for the product's error. */
BRDF_INLINE double remainder_of(double a, double q, double b) {
#ifdef BRDF_FMA
    return fma(-q, b, a);
#else
    double p = q * b;
    return (a - p) - product_error(q, b, p);
#endif
}

BRDF_INLINE double_double exact_product(double a, double b) {
    double p = a * b;
    return (double_double){p, product_error(a, b, p)};
}

BRDF_INLINE double_double dd_add(double_double a, double_double b) {
    double_double s = exact_sum(a.hi, b.hi);
    return exact_ordered_sum(s.hi, s.lo + (a.lo + b.lo));
}

BRDF_INLINE double_double dd_subtract(double_double a, double_double b) {
    return dd_add(a, (double_double){-b.hi, -b.lo});
}

BRDF_INLINE double_double dd_multiply(double_double a, double_double b) {
    double_double p = exact_product(a.hi, b.hi);
    return exact_ordered_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

BRDF_INLINE double_double dd_multiply_double(double_double a, double b) {
    double_double p = exact_product(a.hi, b);
    return exact_ordered_sum(p.hi, p.lo + a.lo * b);
}

BRDF_INLINE double_double dd_divide(double_double a, double_double b) {
    double quotient = a.hi / b.hi;
    double remainder = remainder_of(a.hi, quotient, b.hi) + (a.lo - quotient * b.lo);
    return exact_ordered_sum(quotient, remainder / b.hi);
}

/* 1/a, with one division. */
BRDF_INLINE double_double dd_reciprocal(double_double a) {
    double reciprocal = 1 / a.hi;
    return exact_ordered_sum(reciprocal, (remainder_of(1, reciprocal, a.hi) - reciprocal * a.lo) * reciprocal);
}

/* sqrt(a) for a > 0. */
BRDF_INLINE double_double dd_sqrt(double_double a) {
    double root = sqrt(a.hi);
    return exact_ordered_sum(root, (remainder_of(a.hi, root, root) + a.lo) / (2 * root));
}

#endif
