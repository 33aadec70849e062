/* Value, densities and weights at one pair of directions of the ordinary domain, without branches, so that compilers
 * make vector code of them. The same functions serve one pair and arrays.
 *
 * The ordinary domain is where no product leaves double's range: hz^2 at least 2^-80, h.h at most 2^120, and, where
 * cosines are multiplied, those at least 2^-200. Elsewhere the kernels return outside_domain, and out_of_range.h takes
 * over.
 *
 * Errors. The half vector, its squares, the exponent and the factor before E are sums of two doubles that are good to
 * 2^-90 of themselves; but for the paired sampling's W, which is good to 2^-60. So what counts is where they are put
 * together: for q = exp(r) - 1 with |r| <= .347,
 *
 *     result = hi + (hi q + (low + low q)),   low < 2^-28 hi
 *
 * In units of u = 2^-53, and with hi in [1, 2), r^2 P(r) is off by .2 at most and q, by its own rounding, by .25 more
 * where it is largest; P's approximation costs .1 (1 + q), what is left out of exp(low/hi) .02. hi q and its sum with
 * the tail are off by 1/2 each where they are at least 1/2, and by 1/4 each where they are at least 1/4. An ulp of the
 * result is u if that is below 1, which takes q < 0; then hi < 1/(1 + q), and this adds up to most for q = -.293:
 * .45/.707 + .12 + .5 < 1.3 ulp. Otherwise it is less than one. Half an ulp for the last sum makes 1.8. */
#ifndef BRDF_PAIR_KERNELS_H
#define BRDF_PAIR_KERNELS_H

#include "brdf/constants.h"
#include "brdf/double_double.h"
#include "brdf/elementary.h"
#include "graze/brdf.h"

/* No true result is negative. */
static const double outside_domain = -1;

/* What depends on the roughness alone. With s taken out of 1/(pi ax ay), the one quotient r = s/hz^2 is all that (17),
 * h.h r^2 E, and the exponent, (hx^2/(s ax^2) + hy^2/(s ay^2)) r, need of hz; and since r^2 has both 1/(pi ax ay) and
 * 1/hz^4, neither has to be multiplied in with an error of its own. */
typedef struct lobe_constants {
    double s, inverse_s;              /* s is about 1/sqrt(pi ax ay); 1/s to an ulp or two */
    double excess;                    /* s^2 (1 + excess) = 1/(pi ax ay) */
    double_double over_sx2, over_sy2; /* 1/(s ax^2), 1/(s ay^2) */
    double_double quarter;            /* 1/(4 pi ax ay) */
} lobe_constants;

/* The half vector. In double_doubles called loose here, |lo| may be some ulps of hi. */
typedef struct half_vector {
    double_double x, y, z;
    double_double x2, y2, z2;  /* squares, loose */
    double_double horizontal2; /* x2 + y2, loose */
    double_double square;      /* h.h, loose */
    double smaller_cosine;     /* of l and v */
} half_vector;

/* E = exp(-exponent - exponent_low), and s/hz^2 = r (1 + rho). */
typedef struct lobe_terms {
    double exponent, exponent_low;
    double r, rho;
} lobe_terms;

/* number x 2^power. `shifted_power` is what ordinary_result() wants. */
typedef struct powered_number {
    double number, power, shifted_power;
} powered_number;

BRDF_INLINE double_double loose_multiply(double_double a, double_double b) {
    double_double p = exact_product(a.hi, b.hi);
    p.lo += a.hi * b.lo + a.lo * b.hi;
    return p;
}

BRDF_INLINE double_double loose_square(double_double a) {
    double_double p = exact_product(a.hi, a.hi);
    double cross = a.hi * a.lo;
    p.lo += cross + cross;
    return p;
}

/* a + b for numbers not below zero; the same bits for (b, a). */
BRDF_INLINE double_double loose_positive_sum(double_double a, double_double b) {
    double_double s = exact_positive_sum(a.hi, b.hi);
    s.lo += a.lo + b.lo;
    return s;
}

BRDF_INLINE lobe_constants lobe_constants_of(const graze_brdf *brdf) {
    double ax = brdf->alpha_x, ay = brdf->alpha_y;
    double_double pi_alphas = loose_multiply((double_double){brdf_pi, brdf_pi_low}, exact_product(ax, ay));
    double_double reciprocal = dd_reciprocal(pi_alphas);
    lobe_constants k;
    k.s = sqrt(reciprocal.hi);
    double_double s2 = exact_product(k.s, k.s), inverse_s = loose_multiply((double_double){k.s, 0}, pi_alphas);
    k.excess = (((reciprocal.hi - s2.hi) - s2.lo) + reciprocal.lo) * pi_alphas.hi;
    inverse_s.lo += inverse_s.hi * k.excess; /* 1/s = s (1 + excess) pi ax ay */
    k.inverse_s = inverse_s.hi;
    k.over_sx2 = loose_multiply(inverse_s, dd_reciprocal(exact_product(ax, ax)));
    k.over_sy2 = loose_multiply(inverse_s, dd_reciprocal(exact_product(ay, ay)));
    k.quarter = (double_double){reciprocal.hi / 4, reciprocal.lo / 4};
    return k;
}

BRDF_INLINE half_vector half_vector_of(graze_vec3 l, graze_vec3 v) {
    half_vector h = {.x = exact_sum(l.x, v.x), .y = exact_sum(l.y, v.y), .z = exact_positive_sum(l.z, v.z)};
    h.smaller_cosine = l.z > v.z ? v.z : l.z;
    h.x2 = loose_square(h.x);
    h.y2 = loose_square(h.y);
    h.z2 = loose_square(h.z);
    h.horizontal2 = loose_positive_sum(h.x2, h.y2);
    h.square = loose_positive_sum(h.horizontal2, h.z2);
    return h;
}

BRDF_INLINE lobe_terms lobe_terms_of(const lobe_constants *k, const half_vector *h) {
    double_double sum = loose_positive_sum(loose_multiply(h->x2, k->over_sx2), loose_multiply(h->y2, k->over_sy2));
    lobe_terms t;
    t.r = k->s / h->z2.hi;
    t.rho = (remainder_of(k->s, t.r, h->z2.hi) - t.r * h->z2.lo) * k->inverse_s;
    t.exponent = sum.hi * t.r;
    t.exponent_low = product_error(sum.hi, t.r, t.exponent) + (sum.lo * t.r + t.exponent * t.rho);
    return t;
}

/* (17) but for E: h.h/(pi ax ay hz^4) = h.h r^2 (1 + gmd_correction), loose. */
BRDF_INLINE double_double gmd_factor(const half_vector *h, const lobe_terms *t) {
    return loose_multiply(h->square, exact_product(t->r, t->r));
}
BRDF_INLINE double gmd_correction(const lobe_constants *k, const lobe_terms *t) {
    return (t->rho + t->rho) + k->excess;
}

/* What a model other than GMD divides by: its value is E/(4 pi ax ay C), and C is sqrt(lz vz) (4), lz vz (5) or
 * max(lz, vz) (Ward-Neumann). */
BRDF_INLINE double_double cosine_factor(graze_brdf_model model, double lz, double vz) {
    switch (model) {
    case GRAZE_BRDF_WARD:
        return dd_sqrt(exact_product(lz, vz));
    case GRAZE_BRDF_WARD_DUER:
        return exact_product(lz, vz);
    case GRAZE_BRDF_GMD: /* has none */
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    return (double_double){lz > vz ? lz : vz, 0};
}

/* The paired sampling's W. Of the two candidates that l and its slope's negative give, l's share is w/2 = lz/hz, its
 * partner's (vz u - 2q)/(2 (vz - q)) where that is positive: never for tau >= 1. Here v.h = h.h/2, which unit vectors
 * obey, gives 2q = lz - vz + tau^2 hz: v's rounded x and y would tell nothing about q at grazing angles.
 *
 * Where vz u - 2q is not below 0, tau is at most 1 and vz at least hz/3. By the bounds of each operation, and in units
 * of 2^-106, tau^2 is then good to 69 of itself, vz u to 74 hz, 2q to 83 hz, and with 8 hz for their difference vz u -
 * 2q is good to 165 hz, which is less than 2^-98 hz. The divisor is that plus vz (1 + tau^2), and vz is about hz where
 * lz is small. So if vz u - 2q or lz is 2^-38 hz or more, W is good to 2^-60 of itself, which is 1/128 ulp. Else it is
 * not `certain`. */
typedef struct mean_weight {
    double_double mean;
    int certain;
} mean_weight;

BRDF_INLINE mean_weight mean_weight_of_pair(const half_vector *h, double lz, double vz) {
    double_double own_share = dd_divide((double_double){lz, 0}, h->z);
    double_double tan2 = dd_divide(h->horizontal2, h->z2), u = dd_subtract((double_double){1, 0}, tan2);
    double_double twice_q = dd_add(exact_sum(lz, -vz), dd_multiply(tan2, h->z));
    double_double partner = dd_subtract(dd_multiply_double(u, vz), twice_q);
    double_double divisor = dd_subtract((double_double){2 * vz, 0}, twice_q);
    double_double both = dd_add(own_share, dd_divide(partner, divisor));
    double enough = 0x1p-38 * h->z.hi;
    return (mean_weight){{partner.hi > 0 ? both.hi : own_share.hi, partner.hi > 0 ? both.lo : own_share.lo},
                         (fabs(partner.hi) >= enough) | (lz >= enough)};
}

/* factor (1 + correction) E. Exponents larger than `limit`, at most 4000, count as that. */
BRDF_INLINE powered_number times_gaussian(double_double factor, double correction, const lobe_terms *t, double limit) {
    /* The power of two of the result and the bias of an exponent and 700 are the low bits of shifted_power. */
    const double shift = 0x1.8p52 + 1023 + 700;
    double exponent = t->exponent < limit ? t->exponent : limit;
    double shifted_power = shift - exponent * 0x1.71547652b82fep+0;
    double n = shift - shifted_power;
    double r = n * brdf_ln2_hi - exponent; /* exact */
    double low = factor.lo + factor.hi * (correction + (n * brdf_ln2_lo - t->exponent_low));

    /* exp(r) = 1 + r + r^2 P(r); P's coefficients, found with Remez' algorithm and rounded, leave a relative error of
     * 2^-56.3. */
    double r2 = r * r;
    double even = 0x1.000000000000ap-1 +
                  r2 * (0x1.555555555087cp-5 +
                        r2 * (0x1.6c16c1842a126p-10 + r2 * (0x1.a0199a0c66195p-16 + r2 * 0x1.28ad72cd4ab37p-22)));
    double odd = 0x1.55555555554fap-3 +
                 r2 * (0x1.1111111127be5p-7 +
                       r2 * (0x1.a01a012a57b5ep-13 + r2 * (0x1.71df255235e0bp-19 + r2 * 0x1.ad7f6f0e24922p-26)));
    double q = r + r2 * (even + r * odd);
    return (powered_number){factor.hi + (factor.hi * q + (low + low * q)), -n, shifted_power};
}

/* With this limit the power is at least -1722. */
static const double ordinary_limit = 1193;

/* number x 2^power, rounded once: number x 2^(power + 700) is normal, or so small that the result is 0. The sum makes
 * 0 of -0, which exponents far beyond the limit can bring about. */
BRDF_INLINE double ordinary_result(powered_number a) {
    return a.number * brdf_from_bits(brdf_bits(a.shifted_power) << 52) * 0x1p-700 + 0.0;
}

/* What a kernel returns. A NaN among the cosines may count as above the surface; it is no ordinary pair then. */
BRDF_INLINE double within_domain(const half_vector *h, int ordinary, double result) {
    double known = ordinary ? result : outside_domain;
    return h->smaller_cosine > 0 ? known : 0;
}

BRDF_INLINE int is_ordinary(const half_vector *h) {
    return (h->square.hi <= 0x1p120) & (h->z2.hi >= 0x1p-80);
}

/* The same where cosines are multiplied. */
BRDF_INLINE int has_ordinary_cosines(const half_vector *h) {
    return is_ordinary(h) & (h->smaller_cosine >= 0x1p-200);
}

BRDF_INLINE double value_kernel(graze_brdf_model model, const lobe_constants *k, graze_vec3 l, graze_vec3 v) {
    half_vector h = half_vector_of(l, v);
    lobe_terms t = lobe_terms_of(k, &h);
    if (model == GRAZE_BRDF_GMD) {
        powered_number f = times_gaussian(gmd_factor(&h, &t), gmd_correction(k, &t), &t, ordinary_limit);
        return within_domain(&h, is_ordinary(&h), ordinary_result(f));
    }
    double_double factor = dd_divide(k->quarter, cosine_factor(model, l.z, v.z));
    return within_domain(&h, has_ordinary_cosines(&h), ordinary_result(times_gaussian(factor, 0, &t, ordinary_limit)));
}

/* E (1 + tau^2)/(2 pi ax ay hz), but for E and gmd_correction: half the value times hz */
BRDF_INLINE double_double ward_density_factor(const half_vector *h, const lobe_terms *t) {
    double_double density = loose_multiply(gmd_factor(h, t), h->z);
    return (double_double){.5 * density.hi, .5 * density.lo};
}

BRDF_INLINE double ward_density_kernel(graze_brdf_model model, const lobe_constants *k, graze_vec3 l, graze_vec3 v) {
    (void)model;
    half_vector h = half_vector_of(l, v);
    lobe_terms t = lobe_terms_of(k, &h);
    powered_number f = times_gaussian(ward_density_factor(&h, &t), gmd_correction(k, &t), &t, ordinary_limit);
    return within_domain(&h, is_ordinary(&h), ordinary_result(f));
}

/* pdf w/W = f_new lz/W, but for E and gmd_correction */
BRDF_INLINE double_double pair_density_factor(const half_vector *h, const lobe_terms *t, double lz,
                                              double_double weight) {
    return dd_divide(dd_multiply_double(gmd_factor(h, t), lz), weight);
}

BRDF_INLINE double pair_density_kernel(graze_brdf_model model, const lobe_constants *k, graze_vec3 l, graze_vec3 v) {
    (void)model;
    half_vector h = half_vector_of(l, v);
    lobe_terms t = lobe_terms_of(k, &h);
    mean_weight w = mean_weight_of_pair(&h, l.z, v.z);
    double_double factor = pair_density_factor(&h, &t, l.z, w.mean);
    powered_number f = times_gaussian(factor, gmd_correction(k, &t), &t, ordinary_limit);
    return within_domain(&h, has_ordinary_cosines(&h) & w.certain, ordinary_result(f));
}

/* weight x f_model/f_new = weight x hz^2/(4 C (1 + tau^2)), rounded */
BRDF_INLINE double weight_of_model(graze_brdf_model model, double_double weight, const half_vector *h, double lz,
                                   double vz) {
    double_double divisor = dd_multiply(cosine_factor(model, lz, vz), h->square);
    return .25 * dd_divide(dd_multiply(weight, dd_multiply(h->z2, h->z2)), divisor).hi;
}

/* (15) */
BRDF_INLINE double ward_weight_kernel(graze_brdf_model model, const lobe_constants *k, graze_vec3 l, graze_vec3 v) {
    (void)k;
    half_vector h = half_vector_of(l, v);
    double_double weight = dd_divide((double_double){2 * l.z, 0}, h.z);
    double result = model == GRAZE_BRDF_GMD ? weight.hi : weight_of_model(model, weight, &h, l.z, v.z);
    return within_domain(&h, has_ordinary_cosines(&h), result);
}

BRDF_INLINE double pair_weight_kernel(graze_brdf_model model, const lobe_constants *k, graze_vec3 l, graze_vec3 v) {
    (void)k;
    half_vector h = half_vector_of(l, v);
    mean_weight w = mean_weight_of_pair(&h, l.z, v.z);
    /* W itself is at most 1, also when rounded, as good as it is: with a = lz/hz, 1 - W is 1 - a or
     * ((1 - 2a)^2 + tau^2)/(3 - 4a - tau^2). */
    double result = model == GRAZE_BRDF_GMD ? w.mean.hi : weight_of_model(model, w.mean, &h, l.z, v.z);
    return within_domain(&h, has_ordinary_cosines(&h) & w.certain, result);
}

#endif
