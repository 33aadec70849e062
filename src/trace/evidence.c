/* Two laws by which errors may fall, and how much each is believed. */
#include "trace/evidence.h"

#include <math.h>

/* With the fast law two blocks of p samples that make one of 2p have the covariance -1/(2p^2), and so has any part of
 * one with the other; hence the variance of a sum is 1 for each binary digit of n that is 1, of value p, less (the sum
 * of the digits below)/p. */
laws laws_of_mean(uint32_t n) {
    double sum = 0;
    for (uint32_t rest = n, p = UINT32_C(1) << 31; p > 0; p >>= 1)
        if (rest >= p) {
            rest -= p;
            sum += 1 - (double)rest / p;
        }
    return (laws){1.0 / n, sum / ((double)n * n)};
}

laws laws_of_difference(int level) {
    return (laws){0.5 * ldexp(1, -level), 0.75 * ldexp(1, -2 * level)};
}

void evidence_add(evidence *e, laws expected, double freedom, rgb squares) {
    e->freedom += freedom;
    e->slow = rgb_add_scaled(e->slow, 1 / expected.slow, squares);
    e->fast = rgb_add_scaled(e->fast, 1 / expected.fast, squares);
    e->odds += freedom / 2 * log2(expected.slow / expected.fast);
}

/* How much likelier the slow law is beforehand. Of many intervals like those in test/trace/coverage.c 93.7% hold the
 * truth with 1, 96.4% with 4, which also is right where samples are as good as independent. */
#define SLOW_BEFOREHAND 3.0

/* The probability of the fast law (of normal values, their variance unknown). */
static double probability_of_fast(const evidence *e) {
    double slow = e->slow.r + e->slow.g + e->slow.b, fast = e->fast.r + e->fast.g + e->fast.b;
    return 1 / (1 + SLOW_BEFOREHAND * exp2(-e->odds - e->freedom / 2 * log2(slow / fast)));
}

double evidence_widening(double freedom) {
    double f = fmax(freedom, 1);
    return 1 + 2.42 / (f - 1.77 + 0.829 / f);
}

rgb evidence_variance(const evidence *e, laws wanted) {
    if (rgb_max(e->slow) <= 0)
        return rgb_gray(0);
    double probability = probability_of_fast(e), scale = evidence_widening(e->freedom) / e->freedom;
    rgb slow = rgb_scale((1 - probability) * wanted.slow, e->slow);
    return rgb_scale(scale, rgb_add_scaled(slow, probability * wanted.fast, e->fast));
}

evidence evidence_joined(const evidence *a, const evidence *b) {
    return (evidence){a->freedom + b->freedom, rgb_add(a->slow, b->slow), rgb_add(a->fast, b->fast), a->odds + b->odds};
}
