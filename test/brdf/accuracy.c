/* Value, densities and weights against arbitrary precision, in units in the last place, and the promises of brdf.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "accuracy/reference.h"
#include "brdf/common.h"

enum { VALUE, WARD_DENSITY, WARD_WEIGHT, PAIR_DENSITY, PAIR_WEIGHT, FUNCTIONS };
static const char *const function_names[] = {"value", "Ward density", "Ward weight", "pair density", "pair weight"};
/* What include/graze/brdf.h promises. */
static const double promised[FUNCTIONS] = {1.6, 1.6, 1, 1.6, 1};

static double computed(int function, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    switch (function) {
    case VALUE:
        return graze_brdf_value(brdf, l, v);
    case WARD_DENSITY:
        return graze_brdf_ward_density(brdf, l, v);
    case WARD_WEIGHT:
        return graze_brdf_ward_weight(brdf, l, v);
    case PAIR_DENSITY:
        return graze_brdf_pair_density(brdf, l, v);
    default:
        return graze_brdf_pair_weight(brdf, l, v);
    }
}

static mpfr_ptr exact(int function, reference_terms *r) {
    mpfr_ptr results[] = {r->value, r->pdf, r->weight, r->pair_pdf, r->pair_weight};
    return results[function];
}

/* All functions of all models at one pair; worst errors so far in worst[]. */
static void check(reference_terms *r, reference_case *in, double *worst) {
    graze_vec3 l = {in->l[0], in->l[1], in->l[2]}, v = {in->v[0], in->v[1], in->v[2]};
    for (int model = REFERENCE_GMD; model <= REFERENCE_WARD_NEUMANN; ++model) {
        const graze_brdf brdf = {(graze_brdf_model)model, in->alpha_x, in->alpha_y};
        in->model = (reference_model)model;
        reference_evaluate(r, in);
        for (int function = 0; function < FUNCTIONS; ++function) {
            double number = computed(function, &brdf, l, v), ulps = reference_ulps(number, exact(function, r));
            worst[function] = fmax(worst[function], ulps);
            if (!(ulps <= promised[function]))
                fail_msg("%s of model %d is %g ulp off: %a for alpha %a %a, l %a %a %a, v %a %a %a",
                         function_names[function], model, ulps, number, in->alpha_x, in->alpha_y, l.x, l.y, l.z, v.x,
                         v.y, v.z);
        }
    }
}

static void put(double *where, graze_vec3 a) {
    where[0] = a.x;
    where[1] = a.y;
    where[2] = a.z;
}

static void draw_roughness(uint64_t *seed, reference_case *in) {
    in->alpha_x = draw_power(seed, GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX);
    in->alpha_y = draw(seed) < .3 ? in->alpha_x : draw_power(seed, GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX);
}

static graze_vec3 draw_above(uint64_t *seed) {
    double cosine = 1 - draw(seed);
    return direction(cosine, draw_between(seed, 0, 2 * pi));
}

static void draw_random(uint64_t *seed, reference_case *in) {
    put(in->l, draw_above(seed));
    put(in->v, draw_above(seed));
}

/* l from a slope of `distance` times the roughness; below the horizon, another one is drawn. */
static void draw_at_distance(uint64_t *seed, reference_case *in, double low, double high) {
    do {
        graze_vec3 v = draw_above(seed);
        double distance = draw_between(seed, low, high), azimuth = draw_between(seed, 0, 2 * pi);
        double x = in->alpha_x * distance * cos(azimuth), y = in->alpha_y * distance * sin(azimuth);
        double scale = 2 * (v.x * x + v.y * y + v.z) / (1 + x * x + y * y);
        put(in->v, v);
        put(in->l, (graze_vec3){scale * x - v.x, scale * y - v.y, scale - v.z});
    } while (!(in->l[2] > 0));
}

static void draw_centred(uint64_t *seed, reference_case *in) {
    draw_at_distance(seed, in, 0, 2);
}
static void draw_tail(uint64_t *seed, reference_case *in) {
    draw_at_distance(seed, in, 2, 27.5);
}

static void draw_mirror(uint64_t *seed, reference_case *in) {
    graze_vec3 v = direction(draw_power(seed, 1e-150, 1), draw_between(seed, 0, 2 * pi));
    put(in->v, v);
    put(in->l, mirror_of(v));
}

static void draw_grazing(uint64_t *seed, reference_case *in) {
    double azimuth = draw_between(seed, 0, 2 * pi);
    double cosine = draw_power(seed, 1e-150, 1);
    double other =
        draw(seed) < .5 ? fmax(fmin(cosine * draw_power(seed, .01, 100), 1), 1e-150) : draw_power(seed, 1e-150, 1);
    put(in->v, direction(cosine, azimuth));
    put(in->l, direction(other, azimuth + (draw(seed) < .2 ? 0 : pi)));
    if (draw(seed) < .5)
        put(in->l, (graze_vec3){-in->v[0], -in->v[1], other});
}

/* Both grazing, side by side: the exponent takes any value, while h is tiny. */
static void draw_grazing_lobe(uint64_t *seed, reference_case *in) {
    double cosine = draw_power(seed, 1e-150, 1e-3), other = cosine * draw_between(seed, .001, 1);
    double x = cosine * draw(seed);
    put(in->v, (graze_vec3){x, 1, cosine});
    put(in->l, (graze_vec3){in->alpha_x * (cosine + other) * draw_between(seed, -47, 47) - x, -1, other});
}

/* The slope is nearly 1 and l just above the surface: u = 1 - tau^2, and W with it, nearly vanish. */
static void draw_vanishing_pair(uint64_t *seed, reference_case *in) {
    double cosine = draw_power(seed, 1e-10, 1);
    put(in->v, direction(cosine, 0));
    double low = cosine * draw_power(seed, 1e-12, .5);
    double slope = draw_between(seed, .9, 1) - (draw(seed) < .5 ? .1 * draw(seed) : 0);
    if (draw(seed) < .5)
        slope = 1 - draw_power(seed, 1e-15, .1);
    /* h = hz (x, y, 1) with tau as drawn */
    double turn = draw_between(seed, 0, 2 * pi), hz = cosine + low;
    put(in->l, (graze_vec3){hz * slope * cos(turn) - in->v[0], hz * slope * sin(turn) - in->v[1], low});
}

static void check_drawn(void (*draw_case)(uint64_t *, reference_case *), uint64_t seed, int count) {
    reference_terms r;
    double worst[FUNCTIONS] = {0};
    reference_start(&r);
    for (int i = 0; i < count; ++i) {
        reference_case in;
        draw_roughness(&seed, &in);
        draw_case(&seed, &in);
        check(&r, &in, worst);
    }
    reference_stop(&r);
    for (int function = 0; function < FUNCTIONS; ++function)
        print_message("# %s: %.3f ulp\n", function_names[function], worst[function]);
}

static void random_pairs(void **state) {
    (void)state;
    check_drawn(draw_random, 1, 1500);
}
static void lobe_centred_pairs(void **state) {
    (void)state;
    check_drawn(draw_centred, 2, 2000);
}
static void pairs_in_the_tail(void **state) {
    (void)state;
    check_drawn(draw_tail, 3, 2000);
}
static void mirror_exact_pairs(void **state) {
    (void)state;
    check_drawn(draw_mirror, 4, 1000);
}
static void grazing_pairs(void **state) {
    (void)state;
    check_drawn(draw_grazing, 5, 1500);
    check_drawn(draw_grazing_lobe, 6, 2000);
}
static void pairs_with_vanishing_weight(void **state) {
    (void)state;
    check_drawn(draw_vanishing_pair, 7, 1500);
}

/* Pairs that were hardest, see there. */
static void worst_cases(void **state) {
    (void)state;
    FILE *file = fopen("test/accuracy/worst.txt", "r");
    assert_non_null(file); /* tests run at the root of the tree */
    reference_terms r;
    double worst[FUNCTIONS] = {0};
    char line[512];
    int count = 0;
    reference_start(&r);
    while (fgets(line, sizeof line, file)) {
        reference_case in;
        if (line[0] == '#')
            continue;
        assert_int_equal(sscanf(line, "%la %la %la %la %la %la %la %la", &in.alpha_x, &in.alpha_y, &in.l[0], &in.l[1],
                                &in.l[2], &in.v[0], &in.v[1], &in.v[2]),
                         8);
        check(&r, &in, worst);
        ++count;
    }
    reference_stop(&r);
    fclose(file);
    assert_true(count >= 20);
    for (int function = 0; function < FUNCTIONS; ++function)
        print_message("# %s: %.3f ulp\n", function_names[function], worst[function]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_pairs),      cmocka_unit_test(lobe_centred_pairs),
        cmocka_unit_test(pairs_in_the_tail), cmocka_unit_test(mirror_exact_pairs),
        cmocka_unit_test(grazing_pairs),     cmocka_unit_test(pairs_with_vanishing_weight),
        cmocka_unit_test(worst_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
