/* The paper's identities and statements about the models, and how the functions of brdf.h hang together. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "brdf/common.h"

static void assert_near(double a, double b, double relative) {
    if (!(fabs(a - b) <= relative * fabs(b)))
        fail_msg("%.17g is not %.17g", a, b);
}

typedef struct drawn_case {
    graze_brdf brdf;
    graze_vec3 l, v;
} drawn_case;

/* A pair within the lobe. Directions' roundings matter more the smaller roughness and cosines are. */
static drawn_case draw_case(uint64_t *seed, double roughness, double cosine) {
    for (;;) {
        drawn_case c = {{GRAZE_BRDF_GMD, draw_power(seed, roughness, 2), 0}, {0, 0, 0}, {0, 0, 0}};
        c.brdf.alpha_y = draw_power(seed, roughness, 2);
        c.v = direction(draw_between(seed, cosine, 1), draw_between(seed, 0, 2 * pi));
        c.l = graze_brdf_sample_ward(&c.brdf, c.v, draw(seed), draw(seed)).l;
        if (c.l.z > cosine)
            return c;
    }
}

static void equations_10_and_11(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 20000; ++i) {
        drawn_case c = draw_case(&seed, .05, .1);
        graze_vec3 h = {c.l.x + c.v.x, c.l.y + c.v.y, c.l.z + c.v.z};
        double x = h.x / c.brdf.alpha_x, y = h.y / c.brdf.alpha_y, hz2 = h.z * h.z, length = sqrt(dot(h, h));
        double factor = exp(-(x * x + y * y) / hz2) / (pi * c.brdf.alpha_x * c.brdf.alpha_y);
        double cosine = dot(c.l, h) / length, height = h.z / length;
        assert_near(graze_brdf_value(&c.brdf, c.l, c.v), factor * 2 * (1 + dot(c.l, c.v)) / (hz2 * hz2), 1e-11);
        assert_near(graze_brdf_value(&c.brdf, c.l, c.v), factor / (4 * cosine * cosine * pow(height, 4)), 1e-11);
    }
}

static void equation_12_in_the_mirror_direction(void **state) {
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 20000; ++i) {
        double alpha_x = draw_power(&seed, 1e-6, 10), alpha_y = draw_power(&seed, 1e-6, 10);
        const graze_brdf gmd = {GRAZE_BRDF_GMD, alpha_x, alpha_y}, duer = {GRAZE_BRDF_WARD_DUER, alpha_x, alpha_y};
        double cosine = draw_power(&seed, 1e-100, 1);
        graze_vec3 v = direction(cosine, draw_between(&seed, 0, 2 * pi));
        double expected = 1 / (4 * pi * alpha_x * alpha_y) / cosine / cosine;
        assert_near(graze_brdf_value(&gmd, mirror_of(v), v), expected, 4 * DBL_EPSILON);
        assert_near(graze_brdf_value(&duer, mirror_of(v), v), expected, 4 * DBL_EPSILON);
    }
}

/* (4), (5), (9), (17) at one pair, worked out by hand: h = (.8, 0, 1.4), alpha = .5, h.h = 2.6. */
static void values_by_hand(void **state) {
    (void)state;
    graze_vec3 l = {.8, 0, .6}, v = {0, .6, .8};
    double x = .8 / .5, y = .6 / .25, e = exp(-(x * x + y * y) / (1.4 * 1.4)) / (pi * .5 * .25);
    const double expected[] = {e * (.64 + .36 + 1.96) / pow(1.4, 4), e / 4 / sqrt(.48), e / 4 / .48, e / 4 / .8};
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; ++model) {
        const graze_brdf brdf = {(graze_brdf_model)model, .5, .25};
        assert_near(graze_brdf_value(&brdf, l, v), expected[model], 1e-14);
    }
}

/* Isotropic lobes do not know where x is. */
static void isotropic_lobes_turn(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 10000; ++i) {
        drawn_case c = draw_case(&seed, .1, .1);
        c.brdf.alpha_y = c.brdf.alpha_x;
        c.brdf.model = (graze_brdf_model)(i % 4);
        double turn = draw_between(&seed, 0, 2 * pi), co = cos(turn), si = sin(turn);
        graze_vec3 l = {co * c.l.x - si * c.l.y, si * c.l.x + co * c.l.y, c.l.z};
        graze_vec3 v = {co * c.v.x - si * c.v.y, si * c.v.x + co * c.v.y, c.v.z};
        double value = graze_brdf_value(&c.brdf, c.l, c.v);
        if (value > 1e-6)
            assert_near(graze_brdf_value(&c.brdf, l, v), value, 1e-10);
        /* Quarter turns exchange x and y and leave every bit. */
        graze_vec3 ly = {-c.l.y, c.l.x, c.l.z}, vy = {-c.v.y, c.v.x, c.v.z};
        assert_true(graze_brdf_value(&c.brdf, ly, vy) == value);
    }
}

static void weight_is_value_times_cosine_over_density(void **state) {
    (void)state;
    uint64_t seed = 4;
    for (int i = 0; i < 40000; ++i) {
        drawn_case c = draw_case(&seed, 1e-6, i % 2 ? .1 : 1e-6);
        c.brdf.model = (graze_brdf_model)(i % 4);
        double value = graze_brdf_value(&c.brdf, c.l, c.v);
        double ward = graze_brdf_ward_density(&c.brdf, c.l, c.v), pair = graze_brdf_pair_density(&c.brdf, c.l, c.v);
        if (!(value > 1e-280 && ward > 1e-280 && pair > 1e-280))
            continue;
        assert_near(graze_brdf_ward_weight(&c.brdf, c.l, c.v), value * c.l.z / ward, 1e-14);
        assert_near(graze_brdf_pair_weight(&c.brdf, c.l, c.v), value * c.l.z / pair, 1e-14);
    }
}

/* (8), (15) */
static void weights_of_the_paper(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 20000; ++i) {
        drawn_case c = draw_case(&seed, .05, .05);
        double hz = c.l.z + c.v.z;
        double weight = graze_brdf_ward_weight(&c.brdf, c.l, c.v);
        assert_near(weight, 2 / (1 + c.v.z / c.l.z), 1e-15);
        assert_true((weight > 1) == (c.l.z > c.v.z));
        c.brdf.model = GRAZE_BRDF_WARD_DUER;
        assert_near(graze_brdf_ward_weight(&c.brdf, c.l, c.v), hz * hz * hz / (4 * c.v.z * (1 + dot(c.l, c.v))), 1e-11);
    }
}

/* W from both candidates, the second one reflected from the negative slope. */
static void pair_weight_is_the_mean_of_both_candidates(void **state) {
    (void)state;
    uint64_t seed = 6;
    int both = 0;
    for (int i = 0; i < 20000; ++i) {
        drawn_case c = draw_case(&seed, .05, .1);
        double hz = c.l.z + c.v.z, x = -(c.l.x + c.v.x) / hz, y = -(c.l.y + c.v.y) / hz;
        double lz = 2 * (c.v.x * x + c.v.y * y + c.v.z) / (1 + x * x + y * y) - c.v.z;
        double weight = 2 * c.l.z / hz, partner = lz > 0 ? 2 * lz / (lz + c.v.z) : 0, mean = (weight + partner) / 2;
        both += partner > 0;
        assert_near(graze_brdf_pair_weight(&c.brdf, c.l, c.v), mean, 1e-12);
        assert_near(graze_brdf_pair_density(&c.brdf, c.l, c.v),
                    graze_brdf_ward_density(&c.brdf, c.l, c.v) * weight / mean, 1e-12);
    }
    assert_true(both > 5000 && both < 19000);
}

/* What a sampler says of its sample is what density and weight say of its direction. */
static void samples_agree_with_densities(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 60000; ++i) {
        const graze_brdf brdf = {(graze_brdf_model)(i % 4), draw_power(&seed, .05, 2), draw_power(&seed, .05, 2)};
        graze_vec3 v = direction(draw_between(&seed, .05, 1), draw_between(&seed, 0, 2 * pi));
        graze_brdf_sample ward = graze_brdf_sample_ward(&brdf, v, draw(&seed), draw(&seed));
        graze_brdf_sample pair = graze_brdf_sample_pair(&brdf, v, draw(&seed), draw(&seed), draw(&seed));
        assert_true((ward.l.z > 0) == (ward.weight > 0) && (ward.l.z > 0) == (ward.density > 0));
        assert_true((pair.l.z > 0) == (pair.weight > 0) && (pair.l.z > 0) == (pair.density > 0));
        if (ward.l.z > .01) {
            assert_near(ward.density, graze_brdf_ward_density(&brdf, ward.l, v), 1e-9);
            assert_near(ward.weight, graze_brdf_ward_weight(&brdf, ward.l, v), 1e-9);
        }
        if (pair.l.z > .01) {
            assert_near(pair.density, graze_brdf_pair_density(&brdf, pair.l, v), 1e-9);
            assert_near(pair.weight, graze_brdf_pair_weight(&brdf, pair.l, v), 1e-9);
        }
    }
}

/* (26) and (6): the direction mirrors v about the half vector whose slopes s and t give. */
static void samples_reflect_the_view(void **state) {
    (void)state;
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .3, .5};
    graze_vec3 v = {.6, 0, .8};
    double s = .4, t = .1, r = sqrt(-log(.6));
    graze_vec3 h = {.3 * r * cos(2 * pi * .1), .5 * r * sin(2 * pi * .1), 1};
    double scale = 2 * dot(v, h) / dot(h, h);
    graze_vec3 l = graze_brdf_sample_ward(&brdf, v, s, t).l;
    assert_near(l.x, scale * h.x - v.x, 1e-14);
    assert_near(l.y, scale * h.y - v.y, 1e-14);
    assert_near(l.z, scale - v.z, 1e-14);
    /* u chooses between that one and its partner */
    graze_vec3 kept = graze_brdf_sample_pair(&brdf, v, s, t, 0).l,
               other = graze_brdf_sample_pair(&brdf, v, s, t, .999).l;
    assert_near(kept.z, l.z, 1e-14);
    scale = 2 * (v.z - v.x * h.x) / dot(h, h);
    assert_near(other.x, -scale * h.x - v.x, 1e-14);
}

/* In the plane of incidence, theta of v where f cos^power(theta) is largest. */
static double peak(const graze_brdf *brdf, graze_vec3 l, int power) {
    double low = 0, high = 90;
    for (int round = 0; round < 12; ++round) { /* the best of 40 and its neighbours */
        double best = -1, at = low, step = (high - low) / 40;
        for (int i = 0; i < 40; ++i) {
            graze_vec3 v = from_degrees(low + step * i, 180);
            double f = graze_brdf_value(brdf, l, v) * pow(v.z, power);
            if (f > best) {
                best = f;
                at = low + step * i;
            }
        }
        low = fmax(at - 2 * step, 0);
        high = fmin(at + 2 * step, 90);
    }
    return (low + high) / 2;
}

static void equations_22_and_23(void **state) {
    (void)state;
    for (double alpha = .05; alpha < .3; alpha += .05)
        for (double theta = 20; theta < 75; theta += 10) {
            const graze_brdf brdf = {GRAZE_BRDF_GMD, alpha, alpha}, ward = {GRAZE_BRDF_WARD, alpha, alpha};
            graze_vec3 l = from_degrees(theta, 0);
            assert_true(fabs(peak(&brdf, l, 1) - theta) < 1e-4);
            assert_true(peak(&brdf, l, 0) > theta + .01);       /* below: nearer to the surface */
            assert_true(fabs(peak(&ward, l, 1) - theta) > .01); /* which is not so for the oldest model */
        }
}

/* Figures 3 to 5 */
static void old_and_new_model_are_close_where_the_lobe_is_narrow(void **state) {
    (void)state;
    uint64_t seed = 8;
    for (int i = 0; i < 20000; ++i) {
        double alpha = draw_power(&seed, .001, .25);
        const graze_brdf gmd = {GRAZE_BRDF_GMD, alpha, alpha}, duer = {GRAZE_BRDF_WARD_DUER, alpha, alpha};
        graze_vec3 v = from_degrees(draw_between(&seed, 0, 45), draw_between(&seed, 0, 360));
        graze_vec3 l = graze_brdf_sample_ward(&gmd, v, draw(&seed), draw(&seed)).l;
        double difference = fabs(graze_brdf_value(&gmd, l, v) - graze_brdf_value(&duer, l, v));
        if (l.z > .5) /* the difference is largest at tau = alpha: E tau^2 = alpha^2/e */
            assert_true(difference <= .4 * alpha * alpha * graze_brdf_value(&gmd, mirror_of(v), v));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_by_hand),
        cmocka_unit_test(equations_10_and_11),
        cmocka_unit_test(equation_12_in_the_mirror_direction),
        cmocka_unit_test(isotropic_lobes_turn),
        cmocka_unit_test(weight_is_value_times_cosine_over_density),
        cmocka_unit_test(weights_of_the_paper),
        cmocka_unit_test(pair_weight_is_the_mean_of_both_candidates),
        cmocka_unit_test(samples_agree_with_densities),
        cmocka_unit_test(samples_reflect_the_view),
        cmocka_unit_test(equations_22_and_23),
        cmocka_unit_test(old_and_new_model_are_close_where_the_lobe_is_narrow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
