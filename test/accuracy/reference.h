/* The reflectance models in arbitrary precision, typed from the paper's equations: the tests' oracle. It shares nothing
 * with src/brdf. Include it in one file of a test program.
 *
 * How many bits are enough: h = l + v loses 2^-P of itself at worst, and all that follows but W is made of products,
 * quotients and sums of positive numbers: below 2^(6 - P). The exponent of E is at most 2^14 where E matters, which
 * makes that 2^(20 - P). With P = 120, errors are below 2^-100. W alone has a difference in it; its cancellation is
 * bounded as it goes, and where too little is left, all is done again with bits enough for any cosine from 1e-150. */
#ifndef ACCURACY_REFERENCE_H
#define ACCURACY_REFERENCE_H

#include <float.h>
#include <math.h>
#include <mpfr.h>
#include <stdbool.h>

enum { REFERENCE_BITS = 120, REFERENCE_FINE_BITS = 700 };

typedef enum {
    REFERENCE_GMD,
    REFERENCE_WARD,
    REFERENCE_WARD_DUER,
    REFERENCE_WARD_NEUMANN,
    REFERENCE_MODELS
} reference_model;

typedef struct reference_case {
    double alpha_x, alpha_y, l[3], v[3];
} reference_case;

/* All that is asked of a pair of directions above the surface, in so many bits; then what the equations name. */
typedef struct reference_terms {
    mpfr_t value[REFERENCE_MODELS];                                   /* (17), (4), (5), after (9) */
    mpfr_t ward_density;                                              /* per solid angle */
    mpfr_t ward_weight[REFERENCE_MODELS];                             /* value x lz / density */
    mpfr_t pair_density, pair_weight[REFERENCE_MODELS];               /* density x w/W; value x lz / density */
    mpfr_t pi, lz, vz, hx, hy, hz, hh, tan2, gaussian, w_mean, shape; /* hh: h.h; tan2: tan^2 of delta */
    mpfr_t a, b, c, error;
    bool doubtful; /* W is not good to 2^-64 */
} reference_terms;

typedef struct reference {
    reference_terms coarse, fine, *result;
} reference;

static void reference_each(reference_terms *r, mpfr_prec_t bits, void (*act)(mpfr_t, mpfr_prec_t)) {
    for (int model = 0; model < REFERENCE_MODELS; ++model) {
        act(r->value[model], bits);
        act(r->ward_weight[model], bits);
        act(r->pair_weight[model], bits);
    }
    mpfr_ptr others[] = {r->ward_density, r->pair_density, r->pi,     r->lz,    r->vz, r->hx, r->hy, r->hz,   r->hh,
                         r->tan2,         r->gaussian,     r->w_mean, r->shape, r->a,  r->b,  r->c,  r->error};
    for (unsigned i = 0; i < sizeof others / sizeof *others; ++i)
        act(others[i], bits);
}
static void reference_start_one(mpfr_t x, mpfr_prec_t bits) {
    mpfr_init2(x, bits);
}
static void reference_stop_one(mpfr_t x, mpfr_prec_t bits) {
    (void)bits;
    mpfr_clear(x);
}
static void reference_start(reference *r) {
    reference_each(&r->coarse, REFERENCE_BITS, reference_start_one);
    reference_each(&r->fine, REFERENCE_FINE_BITS, reference_start_one);
    mpfr_const_pi(r->coarse.pi, MPFR_RNDN);
    mpfr_const_pi(r->fine.pi, MPFR_RNDN);
}
static void reference_stop(reference *r) {
    reference_each(&r->coarse, REFERENCE_BITS, reference_stop_one);
    reference_each(&r->fine, REFERENCE_FINE_BITS, reference_stop_one);
    mpfr_free_cache();
}

static void reference_sum(mpfr_t sum, double a, double b) {
    mpfr_set_d(sum, a, MPFR_RNDN);
    mpfr_add_d(sum, sum, b, MPFR_RNDN);
}

/* (hx/divisor_x)^2 + (hy/divisor_y)^2 over hz^2 */
static void reference_slopes(reference_terms *r, mpfr_t sum, double divisor_x, double divisor_y) {
    mpfr_div_d(r->a, r->hx, divisor_x, MPFR_RNDN);
    mpfr_sqr(r->a, r->a, MPFR_RNDN);
    mpfr_div_d(r->b, r->hy, divisor_y, MPFR_RNDN);
    mpfr_sqr(r->b, r->b, MPFR_RNDN);
    mpfr_add(sum, r->a, r->b, MPFR_RNDN);
    mpfr_sqr(r->a, r->hz, MPFR_RNDN);
    mpfr_div(sum, sum, r->a, MPFR_RNDN);
}

/* The values' factor before E/(pi ax ay). */
static void reference_value(reference_terms *r, reference_model model, mpfr_t shape) {
    switch (model) {
    case REFERENCE_GMD: /* (17): E h.h/(pi ax ay hz^4) */
        mpfr_pow_ui(r->b, r->hz, 4, MPFR_RNDN);
        mpfr_div(shape, r->hh, r->b, MPFR_RNDN);
        return;
    case REFERENCE_WARD: /* (4) */
        mpfr_mul(r->b, r->lz, r->vz, MPFR_RNDN);
        mpfr_sqrt(r->b, r->b, MPFR_RNDN);
        break;
    case REFERENCE_WARD_DUER: /* (5) */
        mpfr_mul(r->b, r->lz, r->vz, MPFR_RNDN);
        break;
    default: /* after (9) */
        mpfr_max(r->b, r->lz, r->vz, MPFR_RNDN);
        break;
    }
    mpfr_mul_ui(r->b, r->b, 4, MPFR_RNDN);
    mpfr_ui_div(shape, 1, r->b, MPFR_RNDN);
}

/* W = (w + w')/2: w = 2 lz/(lz + vz) (15), and w' = 2 lz'/(lz' + vz) where lz' > 0, with the other candidate's
 * lz' = (vz (1 - tau^2) - 2q)/(1 + tau^2), and q from lz = (vz (1 - tau^2) + 2q)/(1 + tau^2). That is, with
 * m = 2 vz - lz - tau^2 (lz + 2 vz):
 *
 *     lz' = m/(1 + tau^2),    w'/2 = m/(m + vz (1 + tau^2)) */
static void reference_pair(reference_terms *r) {
    mpfr_div(r->w_mean, r->lz, r->hz, MPFR_RNDN); /* w/2 */
    mpfr_mul_ui(r->a, r->vz, 2, MPFR_RNDN);
    mpfr_add(r->b, r->a, r->lz, MPFR_RNDN);
    mpfr_mul(r->c, r->b, r->tan2, MPFR_RNDN);
    mpfr_add(r->error, r->b, r->c, MPFR_RNDN);
    mpfr_mul_2si(r->error, r->error, 8 - mpfr_get_prec(r->error), MPFR_RNDN); /* no less than what m is off */
    mpfr_sub(r->a, r->a, r->lz, MPFR_RNDN);
    mpfr_sub(r->a, r->a, r->c, MPFR_RNDN); /* m */
    mpfr_add(r->b, r->a, r->error, MPFR_RNDN);
    r->doubtful = false;
    if (mpfr_sgn(r->b) < 0)
        return;
    mpfr_div(r->b, r->error, r->vz, MPFR_RNDN); /* no less than what w'/2 is off: its slope is below 1/vz */
    if (mpfr_sgn(r->a) > 0) {
        mpfr_mul(r->c, r->vz, r->tan2, MPFR_RNDN);
        mpfr_add(r->c, r->c, r->vz, MPFR_RNDN);
        mpfr_add(r->c, r->c, r->a, MPFR_RNDN);
        mpfr_div(r->a, r->a, r->c, MPFR_RNDN);
        mpfr_add(r->w_mean, r->w_mean, r->a, MPFR_RNDN);
    }
    mpfr_mul_2ui(r->b, r->b, 64, MPFR_RNDN);
    r->doubtful = mpfr_greater_p(r->b, r->w_mean) != 0;
}

static void reference_evaluate_terms(reference_terms *r, const reference_case *in) {
    mpfr_set_d(r->lz, in->l[2], MPFR_RNDN);
    mpfr_set_d(r->vz, in->v[2], MPFR_RNDN);
    reference_sum(r->hx, in->l[0], in->v[0]);
    reference_sum(r->hy, in->l[1], in->v[1]);
    reference_sum(r->hz, in->l[2], in->v[2]);
    reference_slopes(r, r->tan2, 1, 1);
    mpfr_add_ui(r->hh, r->tan2, 1, MPFR_RNDN);
    mpfr_mul(r->hh, r->hh, r->a, MPFR_RNDN); /* a: hz^2, from there */
    reference_pair(r);
    if (r->doubtful)
        return;

    reference_slopes(r, r->gaussian, in->alpha_x, in->alpha_y);
    mpfr_neg(r->gaussian, r->gaussian, MPFR_RNDN);
    mpfr_exp(r->gaussian, r->gaussian, MPFR_RNDN);
    mpfr_div_d(r->gaussian, r->gaussian, in->alpha_x, MPFR_RNDN);
    mpfr_div_d(r->gaussian, r->gaussian, in->alpha_y, MPFR_RNDN);
    mpfr_div(r->gaussian, r->gaussian, r->pi, MPFR_RNDN); /* E/(pi ax ay) */

    /* E h.h/(2 pi ax ay hz^3); its factor before E/(pi ax ay) stays in c */
    mpfr_pow_ui(r->c, r->hz, 3, MPFR_RNDN);
    mpfr_div(r->c, r->hh, r->c, MPFR_RNDN);
    mpfr_div_ui(r->c, r->c, 2, MPFR_RNDN);
    mpfr_mul(r->ward_density, r->c, r->gaussian, MPFR_RNDN);
    for (int model = 0; model < REFERENCE_MODELS; ++model) {
        reference_value(r, (reference_model)model, r->shape);
        mpfr_mul(r->value[model], r->shape, r->gaussian, MPFR_RNDN);
        mpfr_mul(r->a, r->shape, r->lz, MPFR_RNDN);
        mpfr_div(r->ward_weight[model], r->a, r->c, MPFR_RNDN);
        /* The kept sample's density is density x w/W, so its weight is W/w times the other: w = 2 lz/(lz + vz) (15). */
        mpfr_mul(r->a, r->ward_weight[model], r->w_mean, MPFR_RNDN);
        mpfr_mul(r->a, r->a, r->hz, MPFR_RNDN);
        mpfr_div(r->a, r->a, r->lz, MPFR_RNDN);
        mpfr_div_ui(r->pair_weight[model], r->a, 2, MPFR_RNDN);
    }
    mpfr_mul(r->a, r->ward_density, r->lz, MPFR_RNDN);
    mpfr_mul_ui(r->a, r->a, 2, MPFR_RNDN);
    mpfr_div(r->a, r->a, r->hz, MPFR_RNDN);
    mpfr_div(r->pair_density, r->a, r->w_mean, MPFR_RNDN);
}

static reference_terms *reference_evaluate(reference *r, const reference_case *in) {
    r->result = &r->coarse;
    reference_evaluate_terms(&r->coarse, in);
    if (r->coarse.doubtful) {
        r->result = &r->fine;
        reference_evaluate_terms(&r->fine, in);
    }
    return r->result;
}

/* What distinguishes double and float here. */
typedef struct reference_format {
    int digits, least_exponent; /* the least number is 2^least_exponent */
    double largest;
} reference_format;
static const reference_format reference_double = {DBL_MANT_DIG, -1074, DBL_MAX};
static const reference_format reference_float = {FLT_MANT_DIG, -149, (double)FLT_MAX};

static bool reference_is_normal(const reference_format *format, mpfr_t exact) {
    return mpfr_sgn(exact) > 0 && mpfr_get_exp(exact) >= format->least_exponent + format->digits;
}

/* |computed - exact| in units in the last place of the exact number; what is too large counts as the largest number.
 * The exact number may be overwritten. */
static double reference_ulps(const reference_format *format, double computed, mpfr_t exact) {
    if (!(computed >= 0 && computed <= format->largest))
        return HUGE_VAL;
    if (mpfr_cmp_d(exact, format->largest) > 0)
        mpfr_set_d(exact, format->largest, MPFR_RNDN);
    long unit =
        reference_is_normal(format, exact) ? (long)mpfr_get_exp(exact) - format->digits : format->least_exponent;
    long power;
    mpfr_sub_d(exact, exact, computed, MPFR_RNDN);
    double difference = fabs(mpfr_get_d_2exp(&power, exact, MPFR_RNDN));
    return difference > 0 ? ldexp(difference, (int)fmin(fmax((double)(power - unit), -2000), 2000)) : 0;
}

#endif
