/* Numbers of about 106 bits as unevaluated sums of two doubles, by error-free transformations (Dekker 1971, Knuth).
 *
 * Operations are exact or lose less than 2^-98 of the result, as long as no product over- or underflows: callers keep
 * all magnitudes within 2^-480 .. 2^480. Needs a compiler that does not contract a * b + c. */
#ifndef BRDF_DOUBLE_DOUBLE_H
#define BRDF_DOUBLE_DOUBLE_H

#include <math.h>

#include "brdf/split_number.h"

typedef struct double_double {
    double hi, lo; /* |lo| is at most an ulp or two of hi */
} double_double;

/* a + b, exactly; the same bits for (b, a). */
static inline double_double exact_sum(double a, double b) {
    double s = a + b, from_b = s - a;
    return (double_double){s, (a - (s - from_b)) + (b - from_b)};
}

/* a + b, exactly, for |a| >= |b|. */
static inline double_double exact_ordered_sum(double a, double b) {
    double s = a + b;
    return (double_double){s, b - (s - a)};
}

/* a b, exactly: both ways give the same bits, the second one needs no fused instruction. */
static inline double_double exact_product(double a, double b) {
    double p = a * b;
#ifdef FP_FAST_FMA
    return (double_double){p, fma(a, b, -p)};
#else
    double a_hi = upper_bits(a), b_hi = upper_bits(b);
    double a_lo = a - a_hi, b_lo = b - b_hi;
    return (double_double){p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
#endif
}

static inline double_double dd_add(double_double a, double_double b) {
    double_double s = exact_sum(a.hi, b.hi);
    return exact_ordered_sum(s.hi, s.lo + (a.lo + b.lo));
}

static inline double_double dd_subtract(double_double a, double_double b) {
    return dd_add(a, (double_double){-b.hi, -b.lo});
}

static inline double_double dd_multiply(double_double a, double_double b) {
    double_double p = exact_product(a.hi, b.hi);
    return exact_ordered_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline double_double dd_multiply_double(double_double a, double b) {
    double_double p = exact_product(a.hi, b);
    return exact_ordered_sum(p.hi, p.lo + a.lo * b);
}

static inline double_double dd_square(double_double a) {
    double_double p = exact_product(a.hi, a.hi);
    return exact_ordered_sum(p.hi, p.lo + 2 * (a.hi * a.lo));
}

static inline double_double dd_divide(double_double a, double_double b) {
    double quotient = a.hi / b.hi;
    double_double p = exact_product(quotient, b.hi);
    double remainder = ((a.hi - p.hi) - p.lo) + (a.lo - quotient * b.lo);
    return exact_ordered_sum(quotient, remainder / b.hi);
}

/* sqrt(a) for a > 0. */
static inline double_double dd_sqrt(double_double a) {
    double root = sqrt(a.hi);
    double_double p = exact_product(root, root);
    return exact_ordered_sum(root, (((a.hi - p.hi) - p.lo) + a.lo) / (2 * root));
}

#endif
