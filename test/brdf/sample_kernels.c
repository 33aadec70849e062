/* The samplers' steps against arbitrary precision: nothing is lost between the slope, in doubles, and its direction,
 * weight and density, however close to the horizon; and what is no sample. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>
#include <mpfr.h>

#include "brdf/common.h"
#include "brdf/kernel_tables.h"
#include "brdf/sample_kernels.h"

/* Sums of the numbers here, from 1 down to a square of the least component, have so many bits. */
enum { BITS = 800 };

/* Of results that are one double: a few roundings; and of terms that may cancel. */
static const double roundings = 0x1p-51, lost = 0x1p-100;

static int cases(void) {
    return is_short_run() ? 3000 : 30000;
}

/* --- A slope's candidate for the very doubles that the slope is made of ---------------------------------------------
 */

typedef struct exact_candidate {
    mpfr_t square, q, half, above; /* 1 + tau^2; vx px + vy py; v.h; lz (1 + tau^2) */
    double terms;                  /* vz + |vx px| + |vy py| */
} exact_candidate;

static void start(exact_candidate *e) {
    mpfr_inits2(BITS, e->square, e->q, e->half, e->above, (mpfr_ptr)NULL);
}

static void stop(exact_candidate *e) {
    mpfr_clears(e->square, e->q, e->half, e->above, (mpfr_ptr)NULL);
}

static void evaluate(exact_candidate *e, const drawn_slope *p, graze_vec3 v) {
    mpfr_t a;
    mpfr_init2(a, BITS);
    mpfr_set_d(a, p->x, MPFR_RNDN);
    mpfr_sqr(e->square, a, MPFR_RNDN);
    mpfr_mul_d(e->q, a, v.x, MPFR_RNDN);
    mpfr_set_d(a, p->y, MPFR_RNDN);
    mpfr_mul_d(e->half, a, v.y, MPFR_RNDN);
    mpfr_add(e->q, e->q, e->half, MPFR_RNDN);
    mpfr_sqr(a, a, MPFR_RNDN);
    mpfr_add(e->square, e->square, a, MPFR_RNDN);
    mpfr_add_ui(e->square, e->square, 1, MPFR_RNDN);
    mpfr_add_d(e->half, e->q, v.z, MPFR_RNDN);
    mpfr_mul_d(a, e->square, v.z, MPFR_RNDN);
    mpfr_mul_ui(e->above, e->half, 2, MPFR_RNDN);
    mpfr_sub(e->above, e->above, a, MPFR_RNDN);
    e->terms = v.z + fabs(v.x * p->x) + fabs(v.y * p->y);
    mpfr_clear(a);
}

static double distance(mpfr_t exact, double hi, double lo) {
    mpfr_t a;
    mpfr_init2(a, BITS);
    mpfr_sub_d(a, exact, hi, MPFR_RNDN);
    mpfr_sub_d(a, a, lo, MPFR_RNDN);
    double result = fabs(mpfr_get_d(a, MPFR_RNDN));
    mpfr_clear(a);
    return result;
}

/* One component of l = hz (p, 1) - v. */
static void check_component(const exact_candidate *e, double p, double v, double found) {
    mpfr_t a;
    mpfr_init2(a, BITS);
    mpfr_div(a, e->half, e->square, MPFR_RNDN);
    mpfr_mul_d(a, a, 2 * p, MPFR_RNDN);
    double terms = fabs(mpfr_get_d(a, MPFR_RNDN)) + fabs(v);
    mpfr_sub_d(a, a, v, MPFR_RNDN);
    assert_true(distance(a, found, 0) <= roundings * fabs(found) + 4 * lost * terms);
    mpfr_clear(a);
}

static void check_candidate(exact_candidate *e, const drawn_slope *p, graze_vec3 v, graze_brdf_sample made) {
    sample_candidate found = candidate_of(p, v.z);
    evaluate(e, p, v);
    assert_true(distance(e->square, p->square.hi, p->square.lo) <= lost * p->square.hi);
    assert_true(distance(e->q, p->q.hi, p->q.lo) <= lost * e->terms);
    assert_true(distance(e->half, found.half.hi, found.half.lo) <= lost * e->terms);
    check_component(e, p->x, v.x, made.l.x);
    check_component(e, p->y, v.y, made.l.y);
    check_component(e, 1, v.z, made.l.z);
    double half = mpfr_get_d(e->half, MPFR_RNDN), above = mpfr_get_d(e->above, MPFR_RNDN);
    double doubt = lost * (2 * e->terms + v.z * p->square.hi);
    if (!(above > doubt)) {
        assert_true(above > -doubt || found.weight == 0);
        return;
    }
    mpfr_div(e->above, e->above, e->half, MPFR_RNDN);
    assert_true(distance(e->above, found.weight, 0) / found.weight <=
                roundings + doubt / above + lost * e->terms / half);
}

/* The s up to which l is above the surface, to the last bit; 1 if there is none. */
static double horizon_of(const graze_brdf *brdf, graze_vec3 v, double t) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        double middle = (low + high) / 2;
        drawn_slope p = draw_slope(brdf, v, middle, t);
        *(candidate_of(&p, v.z).weight > 0 ? &low : &high) = middle;
    }
    return high;
}

static void nothing_is_lost_at_the_horizon(void **state) {
    (void)state;
    uint64_t seed = 81;
    int close = 0;
    exact_candidate e;
    start(&e);
    for (int i = 0; i < cases(); ++i) {
        const graze_brdf brdf = {GRAZE_BRDF_GMD, draw_power(&seed, .01, 10), draw_power(&seed, .01, 10)};
        graze_vec3 v = direction(draw_power(&seed, i % 2 ? 1e-20 : .01, 1), draw_between(&seed, 0, 2 * pi));
        double t = i % 8 == 0 ? floor(8 * draw(&seed)) / 8 : draw(&seed), s = draw(&seed);
        if (i % 4 != 0)
            s = horizon_of(&brdf, v, t) - floor(draw(&seed) * 4) * 0x1p-53;
        drawn_slope p = draw_slope(&brdf, v, s, t);
        check_candidate(&e, &p, v, sample_ward_kernel(brdf.model, &brdf, v, s, t, 0));
        close += fabs(mpfr_get_d(e.above, MPFR_RNDN)) < 0x1p-40 * e.terms;
    }
    stop(&e);
    assert_true(close > cases() / 10);
}

/* --- What is no sample ----------------------------------------------------------------------------------------------
 */

/* All there is about samples of v, from one table. */
enum { WAYS = 4 };
static void draw_all_ways(const brdf_kernels *set, const graze_brdf *brdf, graze_vec3 v, double s,
                          graze_brdf_sample made[WAYS]) {
    const graze_vec3_arrays views = {&v.x, &v.y, &v.z};
    made[0] = set->sample_ward(brdf, v, s, s);
    made[1] = set->sample_pair(brdf, v, s, s, s);
    for (int way = 2; way < WAYS; ++way) {
        graze_brdf_sample *to = &made[way];
        const graze_brdf_sample_arrays arrays = {&to->l.x, &to->l.y, &to->l.z, &to->density, &to->weight};
        if (way == 2)
            set->sample_ward_batch(brdf, 1, views, &s, &s, arrays);
        else
            set->sample_pair_batch(brdf, 1, views, &s, &s, &s, arrays);
    }
}

/* Vectors below the surface, on it, not numbers, or as long as 2^100 give the null vector; a bit shorter ones do not.
 */
static void what_is_no_direction_gives_the_null_vector(void **state) {
    (void)state;
    const double large = 0x1p100, below = 0x1p100 - 0x1p47;
    const struct {
        graze_vec3 v;
        bool is_direction;
    } views[] = {
        {{.6, 0, .8}, true},
        {{.6, .8, 5e-324}, true},
        {{.6, .8, 0}, false},
        {{.6, .8, -0.}, false},
        {{.6, .8, -5e-324}, false},
        {{0, .6, -.8}, false},
        {{.6, 0, NAN}, false},
        {{NAN, 0, .8}, false},
        {{0, NAN, .8}, false},
        {{HUGE_VAL, 0, .8}, false},
        {{0, 0, HUGE_VAL}, false},
        {{0, 0, large}, false},
        {{0, 0, below}, true},
        {{large / 2, 0, large / 2}, false},
        {{large / 2, 0, below - large / 2}, true},
        {{0, -large / 2, below - large / 2}, true},
        {{large / 4, -large / 2, large / 4}, false},
        {{-large / 4, large / 4, below - large / 2}, true},
    };
    const brdf_kernels *sets[KERNEL_TABLES_MOST];
    int count = kernel_tables_available(sets);
    for (unsigned i = 0; i < sizeof views / sizeof *views; ++i)
        for (int k = 0; k < 4 * count; ++k) {
            const graze_brdf brdf = {(graze_brdf_model)(k % 4), .1, .2};
            graze_brdf_sample made[WAYS];
            draw_all_ways(sets[k / 4], &brdf, views[i].v, .125, made);
            for (int way = 0; way < WAYS; ++way) {
                const graze_vec3 l = made[way].l;
                assert_true((l.x != 0 || l.y != 0 || l.z != 0) == views[i].is_direction);
                if (!views[i].is_direction)
                    assert_true(made[way].density == 0 && made[way].weight == 0);
            }
        }
}

/* Where a direction's cosine is less than any number, it is on the surface whatever its weight: rejected. */
static void what_is_rounded_to_the_surface_is_rejected(void **state) {
    (void)state;
    int on_surface = 0, accepted = 0;
    for (int i = 0; i < 4000; ++i) {
        const graze_brdf brdf = {(graze_brdf_model)(i % 4), 10, 10};
        graze_vec3 v = {1, 0, (1 + i / 4 % 5) * 5e-324};
        double s = i * 1e-5 / 4, t = .25; /* a slope of up to 10 across v: lz is about vz (1 - tau^2)/(1 + tau^2) */
        drawn_slope p = draw_slope(&brdf, v, s, t);
        double weight = candidate_of(&p, v.z).weight;
        const graze_brdf_sample made[] = {graze_brdf_sample_ward(&brdf, v, s, t),
                                          graze_brdf_sample_pair(&brdf, v, s, t, .5)};
        for (int pair = 0; pair < 2; ++pair) {
            on_surface += weight > 0 && made[pair].l.z == 0;
            accepted += made[pair].weight > 0;
            assert_true(made[pair].l.z > 0 || (made[pair].density == 0 && made[pair].weight == 0));
        }
    }
    assert_true(on_surface > 100 && accepted > 100);
}

/* Also where they are next to that, and the terms rounded. */
static void weights_are_at_most_2_in_sum(void **state) {
    (void)state;
    uint64_t seed = 82;
    int twos = 0;
    for (int i = 0; i < 10 * cases(); ++i) {
        const graze_brdf brdf = {GRAZE_BRDF_GMD, draw_power(&seed, 1e-6, .1), draw_power(&seed, 1e-6, .1)};
        graze_vec3 v = direction(draw_power(&seed, 1e-3, 1), draw_between(&seed, 0, 2 * pi));
        drawn_slope p = draw_slope(&brdf, v, draw_power(&seed, 1e-17, 1), draw(&seed)), opposite = opposite_slope(p);
        double sum = candidate_of(&p, v.z).weight + candidate_of(&opposite, v.z).weight;
        assert_true(sum <= 2);
        twos += sum == 2;
    }
    assert_true(twos > cases());
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_lost_at_the_horizon),
        cmocka_unit_test(what_is_no_direction_gives_the_null_vector),
        cmocka_unit_test(what_is_rounded_to_the_surface_is_rejected),
        cmocka_unit_test(weights_are_at_most_2_in_sum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
