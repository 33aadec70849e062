/* graze_surface_value and graze_surface_direct (Eq. 18) against the formula typed anew. */
#include "support.h"

#include <float.h>
#include <string.h>

static const rgb orange = {0.9, 0.5, 0.1};

static graze_material random_material(generator *g) {
    graze_material m = material_make(uniform(g) < 0.5 ? GRAZE_PLASTIC : GRAZE_METAL, orange, uniform(g),
                                     0.05 + 0.4 * uniform(g), 0.05 + 0.4 * uniform(g));
    m.has_orientation = 1;
    m.orientation = random_direction(g);
    return m;
}

/* A direction to the light: anywhere, or, where the lobe is, its own samples. */
static vec3 random_light(generator *g, const graze_surface *s) {
    double r0 = uniform(g), r1 = uniform(g), r2 = uniform(g);
    return uniform(g) < 0.3 ? random_direction(g)
                            : graze_surface_sample_lobe(s, GRAZE_LOBE_GLOSSY, r0, r1, r2).direction;
}

/* The exponent of the Gaussian is at most some tens where values matter; it carries an error of a few 1e-16 x
 * roughness^-1 from the directions' own rounding, roughness >= 0.05 and cosines >= 0.05: 1e-11 leaves a factor of ten.
 */
static void values_agree_with_the_formula(void **state) {
    (void)state;
    generator g = {11};
    int lit = 0;
    for (int i = 0; i < 20000; i++) {
        graze_material m = random_material(&g);
        vec3 n = random_direction(&g), view = direction_at(&g, n, 0.05 + 0.95 * uniform(&g));
        graze_surface s;
        graze_surface_prepare(&s, &m, n, view, NULL);
        vec3 l = random_light(&g, &s);
        double cosine = vec3_dot(l, n);
        if (fabs(cosine) < 0.05)
            continue;
        rgb diffuse, glossy;
        graze_surface_value(&s, l, &diffuse, &glossy);
        for (int c = 0; c < 3; c++) {
            long double expected_diffuse, expected_glossy;
            reference_value(&m, channel(m.color, c), n, l, view, &expected_diffuse, &expected_glossy);
            assert_close_relative(channel(diffuse, c), expected_diffuse, 1e-14);
            if (expected_glossy == 0)
                assert_true(channel(glossy, c) == 0);
            else if (expected_glossy > 1e-9) {
                lit++;
                assert_close_relative(channel(glossy, c), expected_glossy, 1e-11);
            }
        }
    }
    assert_true(lit > 20000);
}

static void direct_light_is_the_sum_over_the_samples(void **state) {
    (void)state;
    generator g = {12};
    for (int i = 0; i < 1000; i++) {
        graze_material m = random_material(&g);
        vec3 n = random_direction(&g), view = direction_at(&g, n, 0.05 + 0.95 * uniform(&g));
        graze_surface s;
        graze_surface_prepare(&s, &m, n, view, NULL);
        graze_light_sample samples[8];
        long double sum[3] = {0, 0, 0};
        for (int k = 0; k < 8; k++) {
            samples[k] = (graze_light_sample){
                random_light(&g, &s), {uniform(&g), 10 * uniform(&g), 100 * uniform(&g)}, 0.1 * uniform(&g)};
            for (int c = 0; c < 3; c++) {
                long double d, f;
                reference_value(&m, channel(m.color, c), n, samples[k].direction, view, &d, &f);
                long double cosine = wide_dot(widen(samples[k].direction), widen(n));
                if (cosine > 0)
                    sum[c] += channel(samples[k].radiance, c) * (d + f) * cosine * samples[k].solid_angle;
            }
        }
        rgb direct = graze_surface_direct(&s, samples, 8);
        assert_close_relative(direct.r, sum[0], 1e-11);
        assert_close_relative(direct.g, sum[1], 1e-11);
        assert_close_relative(direct.b, sum[2], 1e-11);
    }
}

static void no_samples_give_no_light(void **state) {
    (void)state;
    graze_material m = material_make(GRAZE_PLASTIC, orange, 0.5, 0.1, 0.1);
    graze_surface s;
    graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(0, 0, 1), NULL);
    assert_true(rgb_is_black(graze_surface_direct(&s, NULL, 0)));
}

/* The closed form at normal incidence and in the mirror direction: Eq. 12. */
static void the_mirror_direction_has_its_closed_form(void **state) {
    (void)state;
    const double cosines[] = {1, 0.5, 0.1, 1e-3, 1e-9, 1e-100};
    for (size_t i = 0; i < sizeof cosines / sizeof *cosines; i++) {
        double c = cosines[i], sine = sqrt(1 - c * c);
        graze_material m = material_make(GRAZE_METAL, orange, 0.5, 0.1, 0.1);
        graze_surface s;
        graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(sine, 0, c), NULL);
        rgb diffuse, glossy;
        graze_surface_value(&s, vec3_make(-sine, 0, c), &diffuse, &glossy);
        long double lobe = 1 / (4 * SUPPORT_PI * 0.01L * c * c);
        assert_close_relative(glossy.r, 0.45L * lobe, 1e-12);
        assert_close_relative(glossy.b, 0.05L * lobe, 1e-12);
    }
}

static void nothing_comes_from_below_the_shading_horizon(void **state) {
    (void)state;
    generator g = {13};
    for (int i = 0; i < 1000; i++) {
        graze_material m = random_material(&g);
        if (i % 2)
            m.roughness_u = m.roughness_v = 0;
        vec3 n = {0, 0, 1}, view = direction_at(&g, n, uniform(&g));
        graze_surface s;
        graze_surface_prepare(&s, &m, n, view, NULL);
        rgb diffuse, glossy;
        vec3 l = direction_at(&g, n, i % 3 ? -uniform(&g) : 0);
        l.z = i % 3 ? l.z : 0;
        graze_surface_value(&s, l, &diffuse, &glossy);
        assert_true(rgb_is_black(diffuse) && rgb_is_black(glossy));
        graze_light_sample sample = {l, {1, 1, 1}, 1};
        assert_true(rgb_is_black(graze_surface_direct(&s, &sample, 1)));
        assert_true(graze_surface_density(&s, GRAZE_LOBE_DIFFUSE, l) == 0);
        assert_true(graze_surface_density(&s, GRAZE_LOBE_GLOSSY, l) == 0);
    }
}

/* Seen exactly edge-on, the specular part reflects nothing; the diffuse part does not depend on the view. */
static void the_view_may_be_exactly_grazing(void **state) {
    (void)state;
    graze_material m = material_make(GRAZE_PLASTIC, orange, 0.5, 0.1, 0.1);
    graze_surface s;
    graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(1, 0, 0), NULL);
    rgb diffuse, glossy;
    graze_surface_value(&s, vec3_make(-0.8, 0, 0.6), &diffuse, &glossy);
    assert_true(rgb_is_black(glossy));
    assert_close_relative(diffuse.r, 0.45L / SUPPORT_PI, 1e-15);
}

/* Light at cosine c enters a polished body by 1 - F(c), and leaves it by 1 - F(view): exchanging both changes nothing.
 */
static void mirrors_give_their_diffuse_part_only(void **state) {
    (void)state;
    const double view_cosine = 0.6, light_cosine = 0.28;
    graze_material m = material_make(GRAZE_PLASTIC, orange, 0.04, 0, 0);
    graze_surface s;
    vec3 view = {0.8, 0, 0.6}, l = {-0.96, 0, 0.28};
    graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), view, NULL);
    graze_light_sample samples[] = {{l, {2, 2, 2}, 0.01}, {{-0.8, 0, 0.6}, {0, 0, 0}, 0.01}};
    long double share = 0.96L * (1 - (expl(-5.85L * view_cosine) - 0.00287989916L)) *
                        (1 - (expl(-5.85L * light_cosine) - 0.00287989916L)) / SUPPORT_PI * 2 * 0.28L * 0.01L;
    rgb direct = graze_surface_direct(&s, samples, 2);
    assert_close_relative(direct.r, 0.9L * share, 1e-13);
    assert_close_relative(direct.b, 0.1L * share, 1e-13);

    rgb forth, back, glossy;
    graze_surface_value(&s, l, &forth, &glossy);
    assert_true(rgb_is_black(glossy));
    graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), l, NULL);
    graze_surface_value(&s, view, &back, &glossy);
    assert_close_relative(forth.g, back.g, 1e-15);
}

static void light_and_viewer_may_be_exchanged(void **state) {
    (void)state;
    generator g = {14};
    for (int i = 0; i < 2000; i++) {
        graze_material m = random_material(&g);
        vec3 n = random_direction(&g), a = direction_at(&g, n, uniform(&g)), b = direction_at(&g, n, uniform(&g));
        graze_surface s, t;
        graze_surface_prepare(&s, &m, n, a, NULL);
        graze_surface_prepare(&t, &m, n, b, NULL);
        rgb diffuse[2], glossy[2];
        graze_surface_value(&s, b, &diffuse[0], &glossy[0]);
        graze_surface_value(&t, a, &diffuse[1], &glossy[1]);
        assert_memory_equal(&glossy[0], &glossy[1], sizeof *glossy);
        assert_memory_equal(&diffuse[0], &diffuse[1], sizeof *diffuse);
    }
}

/* Sizes that leave a double's range give DBL_MAX, and zero where one factor is zero. */
static void overflow_is_bounded(void **state) {
    (void)state;
    graze_material m = material_make(GRAZE_METAL, (rgb){1, 5, 0}, 1, 1e-6, 1e-6);
    m.has_orientation = 1;
    m.orientation = vec3_make(1, 0, 0);
    graze_surface s;
    graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(1, 0, 1e-150), NULL);
    rgb diffuse, glossy;
    vec3 l = {-1, 0, 1e-150};
    graze_surface_value(&s, l, &diffuse, &glossy);
    assert_finite_nonnegative(glossy);
    assert_true(glossy.g == DBL_MAX && glossy.b == 0);

    graze_light_sample samples[] = {{l, {1e300, 1e300, 1e300}, 6}, {l, {1e300, 0, 1e300}, 6}, {l, {1e300, 1, 0}, 0}};
    for (size_t first = 0; first < 3; first++)
        for (size_t count = 0; count + first <= 3; count++)
            assert_finite_nonnegative(graze_surface_direct(&s, samples + first, count));
    graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(0, 0, 1), NULL);
    samples[0].direction = samples[1].direction = vec3_make(0, 0, 1);
    rgb direct = graze_surface_direct(&s, samples, 2);
    assert_true(direct.r == DBL_MAX && direct.g == DBL_MAX && direct.b == 0);
}

/* Directions, roughnesses, specularities and colours from the ends of their domains, all with all. */
static void every_value_is_finite_and_not_negative(void **state) {
    (void)state;
    const double cosines[] = {0, 1e-150, 1e-16, 1e-3, 0.5, 1};
    const double roughnesses[] = {0, 1e-6, 1.1e-3, 0.1, 1, 10};
    const double specularities[] = {0, 1e-300, 0.5, 1, 2};
    const size_t n_cosines = sizeof cosines / sizeof *cosines, n_rough = sizeof roughnesses / sizeof *roughnesses;
    for (size_t i = 0; i < n_cosines * n_cosines * n_rough * n_rough * 5 * 2 * 2; i++) {
        size_t k = i;
        double view_cosine = cosines[k % n_cosines], light_cosine = cosines[(k /= n_cosines) % n_cosines];
        double u = roughnesses[(k /= n_cosines) % n_rough], v = roughnesses[(k /= n_rough) % n_rough];
        double specularity = specularities[(k /= n_rough) % 5];
        k /= 5;
        graze_material m = material_make(k % 2 ? GRAZE_METAL : GRAZE_PLASTIC, (rgb){1, 0, 1e-300}, specularity, u, v);
        m.has_orientation = 1;
        m.orientation = k / 2 ? vec3_make(1, 1, 0) : vec3_make(0, 0, 1);
        graze_surface s;
        vec3 view = {sqrt(1 - view_cosine * view_cosine), 0, view_cosine};
        vec3 l = {-sqrt(1 - light_cosine * light_cosine), 0, light_cosine};
        graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), view, NULL);
        rgb diffuse, glossy;
        graze_surface_value(&s, l, &diffuse, &glossy);
        assert_finite_nonnegative(diffuse);
        assert_finite_nonnegative(glossy);
        graze_light_sample sample = {l, {1, 1, 1}, 1e-3};
        assert_finite_nonnegative(graze_surface_direct(&s, &sample, 1));
        double density = graze_surface_density(&s, GRAZE_LOBE_GLOSSY, l);
        assert_true(density >= 0 && density <= DBL_MAX);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_agree_with_the_formula),
        cmocka_unit_test(direct_light_is_the_sum_over_the_samples),
        cmocka_unit_test(no_samples_give_no_light),
        cmocka_unit_test(the_mirror_direction_has_its_closed_form),
        cmocka_unit_test(nothing_comes_from_below_the_shading_horizon),
        cmocka_unit_test(the_view_may_be_exactly_grazing),
        cmocka_unit_test(mirrors_give_their_diffuse_part_only),
        cmocka_unit_test(light_and_viewer_may_be_exchanged),
        cmocka_unit_test(overflow_is_bounded),
        cmocka_unit_test(every_value_is_finite_and_not_negative),
    };
    return cmocka_run_group_tests_name("material/direct", tests, NULL, NULL);
}
