/* The reflectance models in arbitrary precision, typed from the paper's equations: the tests' oracle. It shares nothing
 * with src/brdf. Include it in one file of a test program. */
#ifndef ACCURACY_REFERENCE_H
#define ACCURACY_REFERENCE_H

#include <math.h>
#include <mpfr.h>
#include <stdbool.h>

/* Enough for sums of 1 and squares of 1e-150, and for what cancels in them. */
enum { REFERENCE_BITS = 2200 };

typedef enum { REFERENCE_GMD, REFERENCE_WARD, REFERENCE_WARD_DUER, REFERENCE_WARD_NEUMANN } reference_model;

typedef struct {
    reference_model model;
    double alpha_x, alpha_y, l[3], v[3];
} reference_case;

/* Everything the equations name, for one pair of directions above the surface. */
typedef struct {
    mpfr_t lz, vz, hz, hh;      /* hh: h.h */
    mpfr_t tan2;                /* tan^2 of delta */
    mpfr_t gaussian, pi_alphas; /* E; pi ax ay */
    mpfr_t value, pdf, weight;  /* (4), (5), (17); pdf per solid angle; value x lz / pdf */
    mpfr_t pair_w;              /* W */
    mpfr_t pair_pdf, pair_weight;
    mpfr_t a, b, c;
} reference_terms;

static void reference_each(reference_terms *r, void (*act)(mpfr_t)) {
    mpfr_ptr all[] = {r->lz,  r->vz,     r->hz,     r->hh,       r->tan2,        r->gaussian, r->pi_alphas, r->value,
                      r->pdf, r->weight, r->pair_w, r->pair_pdf, r->pair_weight, r->a,        r->b,         r->c};
    for (unsigned i = 0; i < sizeof all / sizeof *all; ++i)
        act(all[i]);
}
static void reference_start_one(mpfr_t x) {
    mpfr_init2(x, REFERENCE_BITS);
}
static void reference_stop_one(mpfr_t x) {
    mpfr_clear(x);
}
static void reference_start(reference_terms *r) {
    reference_each(r, reference_start_one);
}
static void reference_stop(reference_terms *r) {
    reference_each(r, reference_stop_one);
}

/* sum = ((l + v)[axis] / divisor)^2, added to what is there */
static void reference_add_square(reference_terms *r, mpfr_ptr sum, const reference_case *in, int axis, double divisor) {
    mpfr_set_d(r->a, in->l[axis], MPFR_RNDN);
    mpfr_add_d(r->a, r->a, in->v[axis], MPFR_RNDN);
    mpfr_div_d(r->a, r->a, divisor, MPFR_RNDN);
    mpfr_sqr(r->a, r->a, MPFR_RNDN);
    mpfr_add(sum, sum, r->a, MPFR_RNDN);
}

/* The value but for E. */
static void reference_value(reference_terms *r, const reference_case *in) {
    switch (in->model) {
    case REFERENCE_GMD: /* (17): E h.h/(pi ax ay hz^4) */
        mpfr_pow_ui(r->b, r->hz, 4, MPFR_RNDN);
        mpfr_mul(r->b, r->b, r->pi_alphas, MPFR_RNDN);
        mpfr_div(r->value, r->hh, r->b, MPFR_RNDN);
        return;
    case REFERENCE_WARD: /* (4) */
        mpfr_mul(r->b, r->lz, r->vz, MPFR_RNDN);
        mpfr_sqrt(r->b, r->b, MPFR_RNDN);
        break;
    case REFERENCE_WARD_DUER: /* (5) */
        mpfr_mul(r->b, r->lz, r->vz, MPFR_RNDN);
        break;
    case REFERENCE_WARD_NEUMANN: /* after (9) */
        mpfr_max(r->b, r->lz, r->vz, MPFR_RNDN);
        break;
    }
    mpfr_mul(r->b, r->b, r->pi_alphas, MPFR_RNDN);
    mpfr_mul_ui(r->b, r->b, 4, MPFR_RNDN);
    mpfr_ui_div(r->value, 1, r->b, MPFR_RNDN);
}

/* W by u = 1 - tau^2 and rho = |q|/vz, with q from lz = (vz (1 - tau^2) + 2q)/(1 + tau^2), solved for q */
static void reference_pair(reference_terms *r) {
    mpfr_ptr u = r->a, rho = r->b, t = r->c;
    mpfr_ui_sub(u, 1, r->tan2, MPFR_RNDN);
    mpfr_add_ui(rho, r->tan2, 1, MPFR_RNDN);
    mpfr_mul(rho, rho, r->lz, MPFR_RNDN);
    mpfr_mul(t, r->vz, u, MPFR_RNDN);
    mpfr_sub(rho, rho, t, MPFR_RNDN);
    mpfr_div_ui(rho, rho, 2, MPFR_RNDN);
    mpfr_div(rho, rho, r->vz, MPFR_RNDN);
    mpfr_abs(rho, rho, MPFR_RNDN);
    mpfr_mul_ui(t, rho, 2, MPFR_RNDN);
    if (mpfr_less_p(t, u)) { /* both feasible: (u - 2 rho^2)/(1 - rho^2) */
        mpfr_sqr(t, rho, MPFR_RNDN);
        mpfr_mul_ui(r->pair_w, t, 2, MPFR_RNDN);
        mpfr_sub(r->pair_w, u, r->pair_w, MPFR_RNDN);
        mpfr_ui_sub(t, 1, t, MPFR_RNDN);
    } else { /* one: (u + 2 rho)/(2 (1 + rho)) */
        mpfr_add(r->pair_w, u, t, MPFR_RNDN);
        mpfr_add_ui(t, rho, 1, MPFR_RNDN);
        mpfr_mul_ui(t, t, 2, MPFR_RNDN);
    }
    mpfr_div(r->pair_w, r->pair_w, t, MPFR_RNDN);
}

static void reference_evaluate(reference_terms *r, const reference_case *in) {
    mpfr_set_d(r->lz, in->l[2], MPFR_RNDN);
    mpfr_set_d(r->vz, in->v[2], MPFR_RNDN);
    mpfr_add(r->hz, r->lz, r->vz, MPFR_RNDN);

    mpfr_set_ui(r->tan2, 0, MPFR_RNDN);
    reference_add_square(r, r->tan2, in, 0, 1);
    reference_add_square(r, r->tan2, in, 1, 1);
    mpfr_sqr(r->b, r->hz, MPFR_RNDN);
    mpfr_add(r->hh, r->tan2, r->b, MPFR_RNDN);
    mpfr_div(r->tan2, r->tan2, r->b, MPFR_RNDN);

    mpfr_set_ui(r->gaussian, 0, MPFR_RNDN);
    reference_add_square(r, r->gaussian, in, 0, in->alpha_x);
    reference_add_square(r, r->gaussian, in, 1, in->alpha_y);
    mpfr_div(r->gaussian, r->gaussian, r->b, MPFR_RNDN);
    mpfr_neg(r->gaussian, r->gaussian, MPFR_RNDN);
    mpfr_exp(r->gaussian, r->gaussian, MPFR_RNDN);

    mpfr_const_pi(r->pi_alphas, MPFR_RNDN);
    mpfr_mul_d(r->pi_alphas, r->pi_alphas, in->alpha_x, MPFR_RNDN);
    mpfr_mul_d(r->pi_alphas, r->pi_alphas, in->alpha_y, MPFR_RNDN);

    reference_value(r, in);

    /* E h.h/(2 pi ax ay hz^3), but for E */
    mpfr_pow_ui(r->b, r->hz, 3, MPFR_RNDN);
    mpfr_mul(r->b, r->b, r->pi_alphas, MPFR_RNDN);
    mpfr_mul_ui(r->b, r->b, 2, MPFR_RNDN);
    mpfr_div(r->pdf, r->hh, r->b, MPFR_RNDN);

    mpfr_mul(r->weight, r->value, r->lz, MPFR_RNDN);
    mpfr_div(r->weight, r->weight, r->pdf, MPFR_RNDN);

    /* the pair: pdf w/W, with w = 2 lz/(lz + vz) (15) whatever the model */
    reference_pair(r);
    mpfr_mul_ui(r->a, r->lz, 2, MPFR_RNDN);
    mpfr_div(r->a, r->a, r->hz, MPFR_RNDN);
    mpfr_mul(r->pair_pdf, r->pdf, r->a, MPFR_RNDN);
    mpfr_div(r->pair_pdf, r->pair_pdf, r->pair_w, MPFR_RNDN);
    mpfr_mul(r->pair_weight, r->value, r->lz, MPFR_RNDN);
    mpfr_div(r->pair_weight, r->pair_weight, r->pair_pdf, MPFR_RNDN);

    mpfr_ptr with_gaussian[] = {r->value, r->pdf, r->pair_pdf};
    for (int i = 0; i < 3; ++i)
        mpfr_mul(with_gaussian[i], with_gaussian[i], r->gaussian, MPFR_RNDN);
}

/* |computed - exact| in units in the last place of the exact number; what exceeds DBL_MAX has to be DBL_MAX. */
static double reference_ulps(double computed, mpfr_t exact) {
    if (!isfinite(computed) || computed < 0)
        return HUGE_VAL;
    if (mpfr_cmp_d(exact, 0x1.fffffffffffffp1023) >= 0)
        return computed == 0x1.fffffffffffffp1023 ? 0 : HUGE_VAL;
    long exponent = mpfr_zero_p(exact) ? -2000 : (long)mpfr_get_exp(exact) - 53;
    mpfr_t difference;
    mpfr_init2(difference, REFERENCE_BITS);
    mpfr_sub_d(difference, exact, computed, MPFR_RNDN);
    mpfr_abs(difference, difference, MPFR_RNDN);
    mpfr_mul_2si(difference, difference, exponent > -1074 ? -exponent : 1074, MPFR_RNDN);
    double ulps = mpfr_get_d(difference, MPFR_RNDN);
    mpfr_clear(difference);
    return ulps;
}

#endif
