/* The samplers: one sample of a direction, without branches, so that the same lines serve for one sample and as the
 * body of loops that compilers make vector code of.
 *
 * The slope p that is drawn is a pair of doubles, within a few ulp of the true one. All that follows from it - q,
 * 1 + tau^2, the direction, lz and the weights - is computed with the roundings' errors carried along, so that nothing
 * is lost where terms cancel: at the horizon, and where v is next to the surface. */
#ifndef BRDF_SAMPLE_KERNELS_H
#define BRDF_SAMPLE_KERNELS_H

#include <float.h>
#include <math.h>

#include "brdf/constants.h"
#include "brdf/double_double.h"
#include "brdf/elementary.h"
#include "brdf/parameters.h"
#include "graze/brdf.h"

/* A slope p drawn from the Gaussian. */
typedef struct drawn_slope {
    double x, y;
    double gaussian;      /* E there */
    double_double square; /* 1 + tau^2 */
    double_double q;      /* vx px + vy py */
} drawn_slope;

/* What p, or -p, makes of v. */
typedef struct sample_candidate {
    double_double half; /* v.h = vz + q */
    double weight;      /* of the new model, 2 lz/hz (15); 0 where l is not above the surface */
} sample_candidate;

/* a b with its error; without one where the product is so small that a fused multiply-add would give another. */
BRDF_INLINE double_double product_in_range(double a, double b) {
    double_double p = exact_product(a, b);
    p.lo = fabs(p.hi) > 0x1p-900 ? p.lo : 0;
    return p;
}

BRDF_INLINE drawn_slope draw_slope(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    s = into_unit_interval(s);
    double gaussian = 1 - s, r = sqrt(brdf_minus_log_remainder(s, gaussian));
    brdf_sine_cosine azimuth = brdf_turn(into_unit_interval(t));
    double x = brdf->alpha_x * r * azimuth.cosine, y = brdf->alpha_y * r * azimuth.sine;
    double_double x2 = product_in_range(x, x), y2 = product_in_range(y, y), tan2 = exact_sum(x2.hi, y2.hi);
    double_double square = exact_sum(1, tan2.hi), qx = product_in_range(v.x, x), qy = product_in_range(v.y, y);
    square.lo += tan2.lo + (x2.lo + y2.lo);
    double_double q = exact_sum(qx.hi, qy.hi);
    return (drawn_slope){x, y, gaussian, square, exact_ordered_sum(q.hi, q.lo + (qx.lo + qy.lo))};
}

/* The slope -p. Exact: its square is the same, its q the negative. */
BRDF_INLINE drawn_slope opposite_slope(drawn_slope p) {
    return (drawn_slope){-p.x, -p.y, p.gaussian, p.square, {-p.q.hi, -p.q.lo}};
}

/* 2 lz/hz = above/half, where above = lz (1 + tau^2) = 2 v.h - vz (1 + tau^2). */
BRDF_INLINE sample_candidate candidate_of(const drawn_slope *p, double vz) {
    double_double sum = exact_sum(vz, p->q.hi), half = exact_ordered_sum(sum.hi, sum.lo + p->q.lo);
    double_double product = product_in_range(vz, p->square.hi);
    double above = (2 * half.hi - product.hi) + (2 * half.lo - (product.lo + vz * p->square.lo));
    double weight = above / half.hi;
    weight = weight < 2 ? weight : 2;
    return (sample_candidate){half, above > 0 ? weight : 0};
}

/* a b - c for a scale with its error. */
BRDF_INLINE double scaled_difference(double_double a, double b, double c) {
    double_double product = product_in_range(a.hi, b), difference = exact_sum(product.hi, -c);
    return difference.hi + (difference.lo + (product.lo + a.lo * b));
}

/* f_model/f_new = hz^2/(4 C (1 + tau^2)), with C the model's function of the cosines, which `mean` is the mean of. */
BRDF_INLINE double ratio_to_new_model(graze_brdf_model model, double square, double mean, double lz, double vz) {
    switch (model) {
    case GRAZE_BRDF_GMD:
        return 1;
    case GRAZE_BRDF_WARD: /* in this order, powers of cosines remain in range */
        return mean * (mean / (square * (sqrt(lz) * sqrt(vz))));
    case GRAZE_BRDF_WARD_DUER:
        return mean / lz * (mean / (square * vz));
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    return mean * (mean / (square * (lz > vz ? lz : vz)));
}

/* The sample that keeps the candidate. Its density is `share` x Ward's pdf, where E = 1 - s makes the pdf
 * E (1 + tau^2)^2/(4 pi ax ay v.h); share = numerator/denominator. `weight` is that of the new model. */
BRDF_INLINE graze_brdf_sample finish_sample(graze_brdf_model model, const graze_brdf *brdf, graze_vec3 v,
                                            const drawn_slope *p, const sample_candidate *kept, double numerator,
                                            double denominator, double weight) {
    double square = p->square.hi, reciprocal = 1 / square, scale = 2 * kept->half.hi * reciprocal;
    double_double product = product_in_range(scale, square);
    double rest = (2 * kept->half.hi - product.hi) - product.lo + (2 * kept->half.lo - scale * p->square.lo);
    double_double hz = {scale, rest * reciprocal}; /* l = hz (px, py, 1) - v (26) */
    double x = scaled_difference(hz, p->x, v.x), y = scaled_difference(hz, p->y, v.y);
    double z = (hz.hi - v.z) + hz.lo;

    double density = p->gaussian * (square * square) * numerator /
                     (4 * brdf_pi * brdf->alpha_x * brdf->alpha_y * kept->half.hi * denominator);
    double model_weight = weight * ratio_to_new_model(model, square, .5 * hz.hi, z, v.z);

    /* Positive, or not: conditions as numbers, since compilers make no vector code of conditions combined. */
    double size = fabs(v.x) + fabs(v.y) + fabs(v.z);
    double is_direction = v.z > 0 ? 0x1p100 - size : 0;
    double accepted = z > 0 ? is_direction : 0;
    accepted = weight > 0 ? accepted : 0;
    graze_vec3 l = {is_direction > 0 ? x : 0, is_direction > 0 ? y : 0, is_direction > 0 ? z : 0};
    density = density < DBL_MAX ? density : DBL_MAX;
    model_weight = model_weight < DBL_MAX ? model_weight : DBL_MAX;
    return (graze_brdf_sample){l, accepted > 0 ? density : 0, accepted > 0 ? model_weight : 0};
}

BRDF_INLINE graze_brdf_sample sample_ward_kernel(graze_brdf_model model, const graze_brdf *brdf, graze_vec3 v, double s,
                                                 double t, double u) {
    (void)u;
    drawn_slope p = draw_slope(brdf, v, s, t);
    sample_candidate candidate = candidate_of(&p, v.z);
    return finish_sample(model, brdf, v, &p, &candidate, 1, 1, candidate.weight);
}

/* Of the two candidates, the one that u says; W = (w + w')/2, and the density is Ward's times w/W. */
BRDF_INLINE graze_brdf_sample sample_pair_kernel(graze_brdf_model model, const graze_brdf *brdf, graze_vec3 v, double s,
                                                 double t, double u) {
    drawn_slope p = draw_slope(brdf, v, s, t), opposite = opposite_slope(p);
    sample_candidate candidate = candidate_of(&p, v.z), other = candidate_of(&opposite, v.z);
    double sum = candidate.weight + other.weight;
    int first = into_unit_interval(u) * sum < candidate.weight;
    p.x = first ? p.x : opposite.x;
    p.y = first ? p.y : opposite.y;
    candidate.half.hi = first ? candidate.half.hi : other.half.hi;
    candidate.half.lo = first ? candidate.half.lo : other.half.lo;
    candidate.weight = first ? candidate.weight : other.weight;
    double mean = .5 * sum;
    mean = mean < 1 ? mean : 1;
    return finish_sample(model, brdf, v, &p, &candidate, candidate.weight, mean, mean);
}

#endif
