/* The paired sampling's W where its parts cancel. */
#include "brdf/out_of_range.h"
#include "brdf/pair_kernels.h"

/* Terms of hz^2 - hx^2 - hy^2. */
enum { SQUARE_TERMS = 6, TERMS = 3 * SQUARE_TERMS };

/* The sum of the terms, with a relative error of 2^-100 and an absolute one, the terms being about 1, of 2^-580: each
 * pass adds 48 bits (Ogita, Rump, Oishi: "Accurate sum and dot product", 2005). */
static double_double sum_of_terms(double *terms) {
    for (int pass = 0; pass < 12; ++pass)
        for (int i = 1; i < TERMS; ++i) {
            double_double s = exact_sum(terms[i], terms[i - 1]);
            terms[i] = s.hi;
            terms[i - 1] = s.lo;
        }
    double rest = 0;
    for (int i = 0; i < TERMS - 1; ++i)
        rest += terms[i];
    return exact_ordered_sum(terms[TERMS - 1], rest);
}

/* (hi + lo)^2 as the sum of six terms. */
static void square_terms(double hi, double lo, double *terms) {
    const double_double products[] = {exact_product(hi, hi), exact_product(2 * hi, lo), exact_product(lo, lo)};
    for (int i = 0; i < 3; ++i) {
        terms[2 * i] = products[i].hi;
        terms[2 * i + 1] = products[i].lo;
    }
}

/* hz^2 - hx^2 - hy^2; the same bits with x and y exchanged. */
static double_double difference_of_squares(graze_vec3 l, graze_vec3 v) {
    double_double hx = exact_sum(l.x, v.x), hy = exact_sum(l.y, v.y), hz = exact_positive_sum(l.z, v.z);
    double terms[TERMS], x[SQUARE_TERMS], y[SQUARE_TERMS];
    square_terms(hz.hi, hz.lo, terms);
    square_terms(hx.hi, hx.lo, x);
    square_terms(hy.hi, hy.lo, y);
    for (int i = 0; i < SQUARE_TERMS; ++i) {
        double_double both = exact_sum(x[i], y[i]);
        terms[SQUARE_TERMS + 2 * i] = -both.hi;
        terms[SQUARE_TERMS + 2 * i + 1] = -both.lo;
    }
    return sum_of_terms(terms);
}

/* As in mean_weight_of_pair(), with vz u - 2q = (2 vz (hz^2 - hx^2 - hy^2) - lz h.h)/hz^2. What is not finite, where h
 * is far from the normal, does not count as a partner above the surface. */
double_double brdf_out_of_range_mean_weight(graze_vec3 l, graze_vec3 v) {
    half_vector h = half_vector_of(l, v);
    double_double own_share = dd_divide((double_double){l.z, 0}, h.z);
    double_double partner =
        dd_subtract(dd_multiply_double(difference_of_squares(l, v), 2 * v.z), dd_multiply_double(h.square, l.z));
    if (!(partner.hi > 0))
        return own_share;
    double_double tan2 = dd_divide(h.horizontal2, h.z2);
    double_double twice_q = dd_add(exact_sum(l.z, -v.z), dd_multiply(tan2, h.z));
    double_double divisor = dd_multiply(dd_subtract((double_double){2 * v.z, 0}, twice_q), h.z2);
    return dd_add(own_share, dd_divide(partner, divisor));
}
