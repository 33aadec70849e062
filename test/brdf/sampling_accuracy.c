/* Samples against arbitrary precision, and the promises of brdf.h about their errors. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>
#include <mpfr.h>

#include "brdf/common.h"

/* The table of brdf.h, Ward's sampling before the paired one, the new model before the others. */
enum {
    DIRECTION,
    LENGTH,
    WARD_DENSITY,
    PAIR_DENSITY,
    WARD_WEIGHT,
    WARD_WEIGHT_OF_OTHERS,
    PAIR_WEIGHT,
    PAIR_WEIGHT_OF_OTHERS,
    PRODUCT,
    ROWS
};

/* In units of 2^-53; those of density and weight are to be multiplied by condition numbers. Of weight x density against
 * value x l.z at the rounded direction: either is a dozen roundings. */
static const double bounds[ROWS] = {7, 2, 14, 8, 8, 16, 8, 12, 20};

/* Beyond this much in all, errors are not small, and their products count. */
static const double most_relative_error = 1e-3;

typedef struct sample_case {
    graze_brdf brdf;
    graze_vec3 v;
    double s, t, u;
} sample_case;

static double lowered(double x) {
    return x < 1 ? x : 1 - 0x1p-53;
}

/* The kinds of cases: any; grazing views; extreme roughness; s next to 0 and 1; t at quarters; all of it; and slopes
 * far above 1 at the horizon, where the older models' weights depend most on them. */
enum { ANY, GRAZING, ROUGHNESS, EDGES, QUARTERS, ALL, STEEP, KINDS };

static sample_case draw_steep_case(uint64_t *seed) {
    sample_case c;
    c.brdf.model = (graze_brdf_model)(draw(seed) * 4);
    c.brdf.alpha_x = draw_between(seed, 1, 10);
    c.brdf.alpha_y = draw(seed) < .5 ? c.brdf.alpha_x : draw_between(seed, 1, 10);
    c.v = direction(draw_power(seed, 1e-120, 1e-3), draw_between(seed, 0, 2 * pi));
    c.s = draw(seed);
    c.t = floor(8 * draw(seed)) / 8;
    c.u = draw(seed);
    return c;
}

static sample_case draw_case(uint64_t *seed, int kind) {
    if (kind == STEEP)
        return draw_steep_case(seed);
    sample_case c;
    double rough = kind == ROUGHNESS || kind == ALL ? GRAZE_ROUGHNESS_MIN : .02;
    c.brdf.model = (graze_brdf_model)(draw(seed) * 4);
    c.brdf.alpha_x = fmin(draw_power(seed, rough, 50 * rough < 1 ? 10 : 1), 10);
    c.brdf.alpha_y = draw(seed) < .25 ? c.brdf.alpha_x : fmin(draw_power(seed, rough, 50 * rough < 1 ? 10 : 1), 10);
    int grazing = kind == GRAZING || (kind == ALL && draw(seed) < .7);
    double cosine = grazing ? draw_power(seed, draw(seed) < .5 ? 1e-150 : 1e-5, 1) : draw_between(seed, .01, 1);
    c.v = direction(cosine, kind == QUARTERS ? pi / 2 * floor(8 * draw(seed)) / 2 : draw_between(seed, 0, 2 * pi));
    c.s = draw(seed);
    if (kind == EDGES || kind == ALL)
        c.s = draw(seed) < .5 ? draw_power(seed, 1e-100, 1) : 1 - draw_power(seed, 0x1p-53, 1);
    c.t = draw(seed);
    if (kind == QUARTERS || kind == ALL) {
        double quarter = floor(4 * draw(seed)) / 4, away = draw(seed) < .3 ? 0 : draw_power(seed, 1e-17, .125);
        c.t = draw(seed) < .5 ? quarter + away : fabs(quarter - away);
    }
    c.s = lowered(c.s);
    c.t = lowered(c.t);
    c.u = draw(seed);
    return c;
}

/* --- The model in arbitrary precision: sums of 1 and the smallest cosine are exact enough with these bits. */
enum { BITS = 640 };

/* A slope's candidate. */
typedef struct candidate {
    mpfr_t half, above, weight;          /* v.h; lz (1 + tau^2); of the new model, 0 where l is below the surface */
    double half_condition, lz_condition; /* by how much errors of p and v grow */
} candidate;

typedef struct reference {
    mpfr_t r, px, py, square, qx, qy, pi_number, a, b, x, y, z, density, weight, mean;
    candidate candidates[2];
    double mean_condition;
} reference;

static void reference_start(reference *m) {
    mpfr_set_default_prec(BITS);
    mpfr_inits(m->r, m->px, m->py, m->square, m->qx, m->qy, m->pi_number, m->a, m->b, m->x, m->y, m->z, m->density,
               m->weight, m->mean, (mpfr_ptr)NULL);
    for (int i = 0; i < 2; ++i)
        mpfr_inits(m->candidates[i].half, m->candidates[i].above, m->candidates[i].weight, (mpfr_ptr)NULL);
    mpfr_const_pi(m->pi_number, MPFR_RNDN);
}

static void reference_stop(reference *m) {
    mpfr_clears(m->r, m->px, m->py, m->square, m->qx, m->qy, m->pi_number, m->a, m->b, m->x, m->y, m->z, m->density,
                m->weight, m->mean, (mpfr_ptr)NULL);
    for (int i = 0; i < 2; ++i)
        mpfr_clears(m->candidates[i].half, m->candidates[i].above, m->candidates[i].weight, (mpfr_ptr)NULL);
    mpfr_free_cache();
}

/* p = (ax r cos 2 pi t, ay r sin 2 pi t) with r = sqrt(-log(1 - s)), 1 + tau^2, and the parts of q. */
static void reference_slope(reference *m, const sample_case *c) {
    mpfr_set_d(m->a, -c->s, MPFR_RNDN);
    mpfr_log1p(m->a, m->a, MPFR_RNDN);
    mpfr_neg(m->a, m->a, MPFR_RNDN);
    mpfr_sqrt(m->r, m->a, MPFR_RNDN);
    mpfr_set_d(m->a, c->t, MPFR_RNDN);
    mpfr_cosu(m->px, m->a, 1, MPFR_RNDN);
    mpfr_sinu(m->py, m->a, 1, MPFR_RNDN);
    mpfr_mul(m->px, m->px, m->r, MPFR_RNDN);
    mpfr_mul(m->py, m->py, m->r, MPFR_RNDN);
    mpfr_mul_d(m->px, m->px, c->brdf.alpha_x, MPFR_RNDN);
    mpfr_mul_d(m->py, m->py, c->brdf.alpha_y, MPFR_RNDN);
    mpfr_sqr(m->a, m->px, MPFR_RNDN);
    mpfr_sqr(m->b, m->py, MPFR_RNDN);
    mpfr_add(m->square, m->a, m->b, MPFR_RNDN);
    mpfr_add_ui(m->square, m->square, 1, MPFR_RNDN);
    mpfr_mul_d(m->qx, m->px, c->v.x, MPFR_RNDN);
    mpfr_mul_d(m->qy, m->py, c->v.y, MPFR_RNDN);
}

static void reference_candidate(reference *m, candidate *made, double vz, int negative) {
    mpfr_add(m->a, m->qx, m->qy, MPFR_RNDN);
    if (negative)
        mpfr_neg(m->a, m->a, MPFR_RNDN);
    mpfr_add_d(made->half, m->a, vz, MPFR_RNDN);
    mpfr_mul_d(m->b, m->square, vz, MPFR_RNDN);
    mpfr_mul_ui(made->above, made->half, 2, MPFR_RNDN);
    mpfr_sub(made->above, made->above, m->b, MPFR_RNDN);
    mpfr_div(made->weight, made->above, made->half, MPFR_RNDN);
    if (!(mpfr_sgn(made->above) > 0))
        mpfr_set_zero(made->weight, 1);

    mpfr_abs(m->a, m->qx, MPFR_RNDN);
    mpfr_abs(m->x, m->qy, MPFR_RNDN);
    mpfr_add(m->a, m->a, m->x, MPFR_RNDN);
    mpfr_add_d(m->x, m->a, vz, MPFR_RNDN);
    mpfr_div(m->x, m->x, made->half, MPFR_RNDN);
    made->half_condition = fabs(mpfr_get_d(m->x, MPFR_RNDN));
    mpfr_mul_ui(m->a, m->a, 2, MPFR_RNDN);
    mpfr_add(m->a, m->a, m->b, MPFR_RNDN);
    mpfr_div(m->a, m->a, made->above, MPFR_RNDN);
    made->lz_condition = fabs(mpfr_get_d(m->a, MPFR_RNDN));
}

/* Both candidates; for pairs, W and its condition too. */
static void reference_candidates(reference *m, const sample_case *c) {
    reference_slope(m, c);
    double sum = 0;
    for (int i = 0; i < 2; ++i) {
        candidate *made = &m->candidates[i];
        reference_candidate(m, made, c->v.z, i);
        double weight = mpfr_get_d(made->weight, MPFR_RNDN);
        sum += weight > 0 ? weight * made->lz_condition : 0;
    }
    mpfr_add(m->mean, m->candidates[0].weight, m->candidates[1].weight, MPFR_RNDN);
    mpfr_div_ui(m->mean, m->mean, 2, MPFR_RNDN);
    m->mean_condition = sum / (2 * mpfr_get_d(m->mean, MPFR_RNDN));
}

/* The direction of the slope p, or -p. */
static void reference_direction(reference *m, const sample_case *c, int negative) {
    const candidate *kept = &m->candidates[negative];
    mpfr_div(m->a, kept->half, m->square, MPFR_RNDN);
    mpfr_mul_si(m->a, m->a, negative ? -2 : 2, MPFR_RNDN);
    mpfr_mul(m->x, m->a, m->px, MPFR_RNDN);
    mpfr_mul(m->y, m->a, m->py, MPFR_RNDN);
    mpfr_sub_d(m->x, m->x, c->v.x, MPFR_RNDN);
    mpfr_sub_d(m->y, m->y, c->v.y, MPFR_RNDN);
    mpfr_div(m->z, kept->above, m->square, MPFR_RNDN);
}

/* f_model/f_new = hz^2/(4 C (1 + tau^2)), into b. */
static void reference_ratio_to_new_model(reference *m, const sample_case *c) {
    mpfr_add_d(m->b, m->z, c->v.z, MPFR_RNDN);
    mpfr_sqr(m->b, m->b, MPFR_RNDN);
    mpfr_div(m->b, m->b, m->square, MPFR_RNDN);
    mpfr_div_ui(m->b, m->b, 4, MPFR_RNDN);
    mpfr_mul_d(m->a, m->z, c->v.z, MPFR_RNDN);
    switch (c->brdf.model) {
    case GRAZE_BRDF_GMD:
        mpfr_set_ui(m->b, 1, MPFR_RNDN);
        return;
    case GRAZE_BRDF_WARD:
        mpfr_sqrt(m->a, m->a, MPFR_RNDN);
        break;
    case GRAZE_BRDF_WARD_DUER:
        break;
    default:
        mpfr_set_d(m->a, c->v.z, MPFR_RNDN);
        mpfr_max(m->a, m->a, m->z, MPFR_RNDN);
    }
    mpfr_div(m->b, m->b, m->a, MPFR_RNDN);
}

/* (7), (8), (14), (15); for pairs the weight is W instead, and the density in proportion larger. */
static void reference_density_and_weight(reference *m, const sample_case *c, int negative, int pair) {
    const candidate *kept = &m->candidates[negative];
    reference_ratio_to_new_model(m, c);
    mpfr_mul(m->weight, m->b, pair ? m->mean : kept->weight, MPFR_RNDN);
    mpfr_sqr(m->density, m->square, MPFR_RNDN);
    mpfr_set_d(m->a, c->s, MPFR_RNDN);
    mpfr_ui_sub(m->a, 1, m->a, MPFR_RNDN);
    mpfr_mul(m->density, m->density, m->a, MPFR_RNDN);
    mpfr_div(m->density, m->density, kept->half, MPFR_RNDN);
    mpfr_div(m->density, m->density, m->pi_number, MPFR_RNDN);
    mpfr_div_d(m->density, m->density, c->brdf.alpha_x, MPFR_RNDN);
    mpfr_div_d(m->density, m->density, c->brdf.alpha_y, MPFR_RNDN);
    mpfr_div_ui(m->density, m->density, 4, MPFR_RNDN);
    if (pair) {
        mpfr_mul(m->density, m->density, kept->weight, MPFR_RNDN);
        mpfr_div(m->density, m->density, m->mean, MPFR_RNDN);
    }
}

/* --- Comparisons, in units of 2^-53. */
static double relative_error(reference *m, double found, mpfr_t exact) {
    mpfr_sub_d(m->a, exact, found, MPFR_RNDN);
    mpfr_div(m->a, m->a, exact, MPFR_RNDN);
    return fabs(mpfr_get_d(m->a, MPFR_RNDN)) * 0x1p53;
}

static double direction_error(reference *m, graze_vec3 l) {
    mpfr_sub_d(m->x, m->x, l.x, MPFR_RNDN);
    mpfr_sub_d(m->y, m->y, l.y, MPFR_RNDN);
    mpfr_sub_d(m->z, m->z, l.z, MPFR_RNDN);
    mpfr_hypot(m->a, m->x, m->y, MPFR_RNDN);
    mpfr_hypot(m->a, m->a, m->z, MPFR_RNDN);
    return mpfr_get_d(m->a, MPFR_RNDN) * 0x1p53;
}

static void length(reference *m, mpfr_t result, graze_vec3 a) {
    mpfr_set_d(m->x, a.x, MPFR_RNDN);
    mpfr_set_d(m->y, a.y, MPFR_RNDN);
    mpfr_hypot(result, m->x, m->y, MPFR_RNDN);
    mpfr_set_d(m->x, a.z, MPFR_RNDN);
    mpfr_hypot(result, result, m->x, MPFR_RNDN);
}

static double length_error(reference *m, graze_vec3 l, graze_vec3 v) {
    length(m, m->a, l);
    length(m, m->b, v);
    mpfr_sub(m->a, m->a, m->b, MPFR_RNDN);
    return fabs(mpfr_get_d(m->a, MPFR_RNDN)) * 0x1p53;
}

typedef struct tally {
    double worst[ROWS];
    int accepted, rejected, chosen[2];
} tally;

static void note(tally *t, int row, double error, const sample_case *c) {
    static const char *const names[ROWS] = {"direction",      "length",
                                            "Ward's density", "paired density",
                                            "Ward's weight",  "Ward's weight, older model",
                                            "paired weight",  "paired weight, older model",
                                            "value x cosine"};
    t->worst[row] = fmax(t->worst[row], error);
    if (!(error <= bounds[row]))
        fail_msg("%s is %g off: model %d, alpha %a %a, v %a %a %a, s %a, t %a, u %a", names[row], error, c->brdf.model,
                 c->brdf.alpha_x, c->brdf.alpha_y, c->v.x, c->v.y, c->v.z, c->s, c->t, c->u);
}

/* By how much the roundings of l grow in value and density at l: E depends on (l + v)/hz over the roughness. Of second
 * order, too, where the slope is next to 0. */
static double condition_of_value(const sample_case *c, graze_vec3 l) {
    double hz = l.z + c->v.z, x = (l.x + c->v.x) / hz / c->brdf.alpha_x, y = (l.y + c->v.y) / hz / c->brdf.alpha_y;
    double lx = l.x / hz / c->brdf.alpha_x, ly = l.y / hz / c->brdf.alpha_y;
    return fabs(x * lx) + fabs(y * ly) + (x * x + y * y) * l.z / hz + 0x1p-53 * (lx * lx + ly * ly);
}

/* What a sample says of itself is what is true of its s, t, u and v; and weight x density = value x l.z. */
static void check(reference *m, tally *t, const sample_case *c, graze_brdf_sample found, int negative, int pair) {
    const candidate *kept = &m->candidates[negative];
    reference_direction(m, c, negative);
    ++t->chosen[negative];
    if (kept->lz_condition < 0x1p45)
        assert_true((found.weight > 0) == (mpfr_sgn(kept->weight) > 0));
    if (!(found.weight > 0)) {
        assert_true(found.weight == 0 && found.density == 0);
        ++t->rejected;
    } else {
        ++t->accepted;
        reference_density_and_weight(m, c, negative, pair);
        double density = 1 + kept->half_condition + (pair ? kept->lz_condition + m->mean_condition : 0);
        double weight = 1 + (pair ? m->mean_condition : 0);
        weight += pair && c->brdf.model == GRAZE_BRDF_GMD ? 0 : kept->lz_condition;
        int weight_row = WARD_WEIGHT + 2 * (pair != 0) + (c->brdf.model != GRAZE_BRDF_GMD);
        if (found.density < DBL_MAX && 0x1p-53 * density < most_relative_error)
            note(t, pair ? PAIR_DENSITY : WARD_DENSITY, relative_error(m, found.density, m->density) / density, c);
        if (0x1p-53 * weight < most_relative_error)
            note(t, weight_row, relative_error(m, found.weight, m->weight) / weight, c);
        double product = found.weight * found.density / found.l.z, condition = 1 + condition_of_value(c, found.l);
        if (condition < 0x1p40 && product < 1e300)
            note(t, PRODUCT, fabs(graze_brdf_value(&c->brdf, found.l, c->v) / product - 1) * 0x1p53 / condition, c);
    }
    note(t, DIRECTION, direction_error(m, found.l), c);
    note(t, LENGTH, length_error(m, found.l, c->v), c);
}

/* Which one u keeps; -1 where roundings may decide. */
static int kept_of_pair(reference *m, double u) {
    mpfr_mul_d(m->a, m->mean, 2 * u, MPFR_RNDN);
    mpfr_sub(m->a, m->candidates[0].weight, m->a, MPFR_RNDN);
    double rest = mpfr_get_d(m->a, MPFR_RNDN), mean = mpfr_get_d(m->mean, MPFR_RNDN);
    double doubt = mean * 0x1p-48 * (1 + m->mean_condition);
    return mean > 0 && fabs(rest) < doubt ? -1 : !(rest > 0);
}

static void check_case(reference *m, tally *t, const sample_case *c, int pair) {
    reference_candidates(m, c);
    int negative = pair ? kept_of_pair(m, c->u) : 0;
    if (negative < 0)
        return;
    graze_brdf_sample found = pair ? graze_brdf_sample_pair(&c->brdf, c->v, c->s, c->t, c->u)
                                   : graze_brdf_sample_ward(&c->brdf, c->v, c->s, c->t);
    check(m, t, c, found, negative, pair);
}

static int is_of_other_sampling(int row, int pair) {
    int of_pairs = row == PAIR_DENSITY || row == PAIR_WEIGHT || row == PAIR_WEIGHT_OF_OTHERS;
    int of_ward = row == WARD_DENSITY || row == WARD_WEIGHT || row == WARD_WEIGHT_OF_OTHERS;
    return pair ? of_ward : of_pairs;
}

static void survey(int kind, int pair, int count) {
    reference m;
    tally t = {{0}, 0, 0, {0, 0}};
    uint64_t seed = 50 + (uint64_t)kind;
    reference_start(&m);
    for (int i = 0; i < count; ++i) {
        sample_case c = draw_case(&seed, kind);
        check_case(&m, &t, &c, pair);
    }
    reference_stop(&m);
    for (int row = 0; row < ROWS; ++row) /* a bound ten times the truth would be none */
        assert_true(t.worst[row] > .1 || is_of_other_sampling(row, pair));
    assert_true(t.accepted > count / 5 && (pair || t.rejected > count / 1000));
    assert_true(!pair || (t.chosen[0] > count / 5 && t.chosen[1] > count / 5));
}

static int cases(void) {
    return is_short_run() ? 1000 : 4000;
}

static void samples_of_ward(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; ++kind)
        survey(kind, 0, cases());
}

static void samples_of_pairs(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; ++kind)
        survey(kind, 1, cases());
}

/* The largest errors that searches found: next to the horizon, with slopes far above 1. */
static void hard_cases(void **state) {
    (void)state;
    static const struct {
        sample_case c;
        int pair, row;
        double error; /* about */
    } found[] = {
        {{{GRAZE_BRDF_WARD, 7.6989748237109481, 7.6989748237109481},
          {1, 0, 1.1776344856436879e-65},
          .47434612688489064,
          .24553196191689963,
          0},
         0,
         WARD_WEIGHT_OF_OTHERS,
         8.6},
        {{{GRAZE_BRDF_WARD, 10, .00066646555711870434},
          {-1.8369701987210297e-16, -1, 6.9102494161849409e-21},
          .55578170699832208,
          .875,
          0},
         0,
         WARD_WEIGHT_OF_OTHERS,
         8.2},
        {{{GRAZE_BRDF_WARD_DUER, 1.5113716107645967, 6.8361696523643252},
          {-1, 1.2246467991473532e-16, 2.2132180905159895e-41},
          .75649116334750333,
          .62500000000002953,
          0},
         0,
         WARD_WEIGHT_OF_OTHERS,
         10},
        {{{GRAZE_BRDF_WARD_DUER, 1.5113716107645669, 6.8361696523645286},
          {-1, -2.3149294301179738e-13, 2.2132180905157451e-41},
          .75649116325536914,
          .625,
          0},
         0,
         WARD_DENSITY,
         8},
        {{{GRAZE_BRDF_WARD, 9.4852034535525274, 2.1043426288784248},
          {-2.8253475240680394e-15, 1, 8.6551840443162722e-69},
          .80188588570099462,
          .625,
          .86640396131346231},
         1,
         PAIR_DENSITY,
         4.1},
        {{{GRAZE_BRDF_WARD, 9.4852034535525274, 2.1043426288784288},
          {-2.8253475240680394e-15, 1, 8.6551840443162722e-69},
          .80188588570099462,
          .625,
          .57962919611313501},
         1,
         PAIR_WEIGHT_OF_OTHERS,
         7.6},
    };
    reference m;
    reference_start(&m);
    for (unsigned i = 0; i < sizeof found / sizeof *found; ++i) {
        tally t = {{0}, 0, 0, {0, 0}};
        check_case(&m, &t, &found[i].c, found[i].pair);
        assert_true(t.worst[found[i].row] > found[i].error);
    }
    reference_stop(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_of_ward),
        cmocka_unit_test(samples_of_pairs),
        cmocka_unit_test(hard_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
