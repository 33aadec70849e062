/* graze_surface_sample_lobe (Eq. 16) and graze_surface_density: weights, densities, and where the samples go. */
#include "support.h"

#include <float.h>

static const rgb orange = {0.9, 0.5, 0.1};

static graze_material turned_material(generator *g, double u, double v) {
    graze_material m = material_make(GRAZE_METAL, orange, 0.7, u, v);
    m.has_orientation = 1;
    m.orientation = random_direction(g);
    return m;
}

static void weight_is_value_cosine_over_density(void **state) {
    (void)state;
    generator g = {21};
    int kept[2] = {0, 0};
    for (int i = 0; i < 40000; i++) {
        graze_lobe lobe = i % 2 ? GRAZE_LOBE_GLOSSY : GRAZE_LOBE_DIFFUSE;
        /* Every fourth a mirror, whose diffuse part has Fresnel's factor. */
        graze_material m = turned_material(&g, 0.02 + uniform(&g), 0.02 + uniform(&g));
        if (i % 4 == 0)
            m.roughness_u = m.roughness_v = 0;
        m.model = (graze_brdf_model)(i / 4 % 4);
        vec3 n = random_direction(&g), view = direction_at(&g, n, 0.02 + 0.98 * uniform(&g));
        graze_surface s;
        graze_surface_prepare(&s, &m, n, view, NULL);
        graze_surface_sample sample = draw(&s, lobe, &g);
        assert_unit(sample.direction);
        double cosine = vec3_dot(sample.direction, s.n);
        double density = graze_surface_density(&s, lobe, sample.direction);
        if (sample.density == 0) {
            assert_true(rgb_is_black(sample.weight));
            continue;
        }
        if (cosine < 0.01)
            continue;
        kept[i % 2]++;
        rgb diffuse, glossy;
        graze_surface_value(&s, sample.direction, &diffuse, &glossy);
        rgb value = lobe == GRAZE_LOBE_DIFFUSE ? diffuse : glossy;
        assert_rgb(sample.weight, value.r * cosine / density, value.g * cosine / density, value.b * cosine / density,
                   1e-12);
        /* The sampler's own density is that of the direction before it was rounded in world space. */
        assert_close_relative(sample.density, density, 1e-10);
    }
    assert_true(kept[0] > 18000 && kept[1] > 15000);
}

static void weights_of_the_new_model_stay_below_the_reflectance(void **state) {
    (void)state;
    generator g = {22};
    for (int i = 0; i < 20000; i++) {
        graze_material m = turned_material(&g, pow(10, -4 * uniform(&g)), pow(10, -4 * uniform(&g)));
        graze_surface s = prepare(&m, &g, pow(10, -6 * uniform(&g)));
        graze_surface_sample sample = draw(&s, GRAZE_LOBE_GLOSSY, &g);
        assert_unit(sample.direction);
        assert_finite_nonnegative(sample.weight);
        assert_true(sample.weight.r <= s.specular.r * (1 + 1e-15));
    }
}

/* Whatever the model; the share that is kept is that of Ward's sampling, and it falls where Ward's does. */
static void unweighted_samples_all_weigh_the_same(void **state) {
    (void)state;
    generator g = {27};
    const double cosines[] = {0.9, 0.1, 0.01};
    enum { COUNT = 40000 };
    for (int i = 0; i < 3; i++) {
        graze_material m = turned_material(&g, 0.1, 0.3);
        m.model = (graze_brdf_model)i;
        graze_surface s = prepare(&m, &g, cosines[i]);
        int kept = 0;
        for (int k = 0; k < COUNT; k++) {
            double r0 = uniform(&g), r1 = uniform(&g);
            graze_surface_sample sample = graze_surface_sample_unweighted(&s, r0, r1);
            graze_brdf_sample ward = graze_brdf_sample_ward(&s.lobe, s.local_view, r0, r1);
            assert_unit(sample.direction);
            assert_true(sample.density == ward.density && (ward.density > 0) == !rgb_is_black(sample.weight));
            if (rgb_is_black(sample.weight))
                continue;
            kept++;
            assert_memory_equal(&sample.weight, &s.specular, sizeof s.specular);
            assert_true(fabs(vec3_dot(sample.direction, s.n) - ward.l.z) < 1e-15);
            assert_true(fabs(vec3_dot(sample.direction, s.x) - ward.l.x) < 1e-14);
        }
        double share = graze_brdf_ward_acceptance(&s.lobe, s.local_view);
        assert_true(fabs(kept - COUNT * share) <= 4 * sqrt(COUNT * share * (1 - share)) + 0.5);
    }
}

/* The bound of chi-square with k degrees of freedom that chance exceeds once in 10^5 (Wilson and Hilferty). */
static double chi_square_bound(int k) {
    const double z = 4.265;
    return k * pow(1 - 2.0 / (9 * k) + z * sqrt(2.0 / (9 * k)), 3);
}

#define ROWS    16 /* of equal height, so that all bins have the same solid angle */
#define COLUMNS 32
#define STEPS   24 /* of the quadrature, per bin and axis */
#define SAMPLES 200000

static vec3 sphere_point(double row, double column) {
    double z = 2 * row / ROWS - 1, angle = 2 * (double)SUPPORT_PI * column / COLUMNS, r = sqrt(fmax(0, 1 - z * z));
    return vec3_make(r * cos(angle), r * sin(angle), z);
}

static double bin_probability(const graze_surface *s, graze_lobe lobe, int row, int column) {
    double sum = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++)
            sum += graze_surface_density(s, lobe, sphere_point(row + (i + 0.5) / STEPS, column + (j + 0.5) / STEPS));
    return sum / (STEPS * STEPS) * (4 * (double)SUPPORT_PI / (ROWS * COLUMNS));
}

/* Counts samples in bins of the whole sphere of WORLD directions, and the rejected ones in one more, and compares with
 * the integral of the density over each bin. The bins know nothing of the surface's frame. */
static void check_distribution(const graze_surface *s, graze_lobe lobe, generator *g) {
    static double expected[ROWS * COLUMNS + 1], counted[ROWS * COLUMNS + 1];
    double total = 0;
    for (int b = 0; b < ROWS * COLUMNS; b++) {
        expected[b] = SAMPLES * bin_probability(s, lobe, b / COLUMNS, b % COLUMNS);
        total += expected[b];
        counted[b] = 0;
    }
    expected[ROWS * COLUMNS] = fmax(0, SAMPLES - total);
    counted[ROWS * COLUMNS] = 0;
    for (int i = 0; i < SAMPLES; i++) {
        graze_surface_sample sample = draw(s, lobe, g);
        vec3 d = sample.direction;
        int row = (int)fmin(ROWS - 1, (d.z + 1) / 2 * ROWS);
        double turn = atan2(d.y, d.x) / (2 * (double)SUPPORT_PI);
        int column = (int)fmin(COLUMNS - 1, (turn < 0 ? turn + 1 : turn) * COLUMNS);
        counted[sample.density > 0 ? row * COLUMNS + column : ROWS * COLUMNS]++;
    }
    double chi_square = 0, pooled_expected = 0, pooled_counted = 0;
    int bins = 0;
    for (int b = 0; b <= ROWS * COLUMNS; b++) {
        if (expected[b] < 20) {
            pooled_expected += expected[b];
            pooled_counted += counted[b];
            continue;
        }
        chi_square += (counted[b] - expected[b]) * (counted[b] - expected[b]) / expected[b];
        bins++;
    }
    assert_true(bins > 20);
    if (pooled_expected >= 5) {
        chi_square += (pooled_counted - pooled_expected) * (pooled_counted - pooled_expected) / pooled_expected;
        bins++;
    } else
        assert_true(pooled_counted < 25);
    if (!(chi_square < chi_square_bound(bins - 1)))
        fail_msg("chi-square %.1f with %d bins, at most %.1f expected", chi_square, bins, chi_square_bound(bins - 1));
}

static void glossy_samples_follow_their_density_in_world_space(void **state) {
    (void)state;
    generator g = {23};
    const double cases[][3] = {{0.25, 0.6, 0.9}, {0.6, 0.25, 0.5}, {0.3, 0.3, 0.05}, {0.2, 0.8, 0.02}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        graze_material m = turned_material(&g, cases[i][0], cases[i][1]);
        graze_surface s = prepare(&m, &g, cases[i][2]);
        check_distribution(&s, GRAZE_LOBE_GLOSSY, &g);
    }
}

static void diffuse_samples_follow_their_density_in_world_space(void **state) {
    (void)state;
    generator g = {24};
    graze_material m = turned_material(&g, 0.1, 0.2);
    graze_surface s = prepare(&m, &g, 0.3);
    check_distribution(&s, GRAZE_LOBE_DIFFUSE, &g);
}

static void mirrors_reflect_in_one_direction(void **state) {
    (void)state;
    generator g = {25};
    graze_material m = material_make(GRAZE_PLASTIC, orange, 0.5, 0, 0);
    for (int i = 0; i < 2000; i++) {
        vec3 n = random_direction(&g), view = direction_at(&g, n, i ? uniform(&g) : 1);
        graze_surface s;
        graze_surface_prepare(&s, &m, n, view, NULL);
        graze_surface_sample sample = draw(&s, GRAZE_LOBE_MIRROR, &g);
        assert_unit(sample.direction);
        assert_true(fabs(vec3_dot(sample.direction, n) - vec3_dot(view, n)) < 1e-14);
        vec3 sum = vec3_add(sample.direction, view); /* along n */
        assert_true(vec3_length(vec3_cross(sum, n)) < 1e-14);
        assert_rgb(sample.weight, s.specular.r, s.specular.g, s.specular.b, 0);
        assert_true(sample.density == 0);
        assert_true(graze_surface_density(&s, GRAZE_LOBE_MIRROR, sample.direction) == 0);
    }
}

static void assert_rejected(graze_surface_sample sample) {
    assert_unit(sample.direction);
    assert_true(rgb_is_black(sample.weight) && sample.density == 0);
}

static void lobes_that_are_not_there_only_give_rejected_samples(void **state) {
    (void)state;
    const vec3 n = {0, 0, 1}, view = {0.6, 0, 0.8};
    graze_material glossy = material_make(GRAZE_PLASTIC, orange, 0.5, 0.1, 0.1);
    graze_material mirror = material_make(GRAZE_PLASTIC, orange, 0.5, 0, 0);
    graze_material matte = material_make(GRAZE_PLASTIC, orange, 0, 0.1, 0.1);
    const struct {
        const graze_material *material;
        graze_lobe lobe;
    } cases[] = {{&glossy, GRAZE_LOBE_MIRROR}, {&glossy, GRAZE_LOBE_NONE},  {&mirror, GRAZE_LOBE_GLOSSY},
                 {&matte, GRAZE_LOBE_GLOSSY},  {&matte, GRAZE_LOBE_MIRROR}, {&matte, GRAZE_LOBE_NONE}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        graze_surface s;
        graze_surface_prepare(&s, cases[i].material, n, view, NULL);
        assert_rejected(graze_surface_sample_lobe(&s, cases[i].lobe, 0.25, 0.5, 0.75));
        if (cases[i].material != &glossy)
            assert_rejected(graze_surface_sample_unweighted(&s, 0.25, 0.5));
        assert_true(graze_surface_density(&s, cases[i].lobe, vec3_make(-0.6, 0, 0.8)) == 0);
    }
}

/* The caller may have a use for the direction that the material has not, such as an ambient term of its own. */
static void a_black_diffuse_part_is_drawn_all_the_same(void **state) {
    (void)state;
    graze_material polished = material_make(GRAZE_METAL, orange, 1, 0.1, 0.1);
    graze_surface s;
    graze_surface_prepare(&s, &polished, vec3_make(0, 0, 1), vec3_make(0.6, 0, 0.8), NULL);
    graze_surface_sample sample = graze_surface_sample_lobe(&s, GRAZE_LOBE_DIFFUSE, 0.75, 0, 0);
    assert_true(rgb_is_black(sample.weight));
    assert_close_relative(sample.direction.z, 0.5, 1e-15);
    assert_close_relative(sample.density, 0.5 / SUPPORT_PI, 1e-15);
    assert_close_relative(graze_surface_density(&s, GRAZE_LOBE_DIFFUSE, sample.direction), 0.5 / SUPPORT_PI, 1e-15);
}

static void specular_lobes_reject_when_seen_edge_on_or_from_below(void **state) {
    (void)state;
    const double roughnesses[] = {0, 0.1};
    const double cosines[] = {0, -0.1};
    for (int i = 0; i < 4; i++) {
        double c = cosines[i / 2];
        graze_material m = material_make(GRAZE_PLASTIC, orange, 0.5, roughnesses[i % 2], roughnesses[i % 2]);
        graze_surface s;
        graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(sqrt(1 - c * c), 0, c), NULL);
        assert_rejected(graze_surface_sample_lobe(&s, s.specular_lobe, 0.25, 0.5, 0.75));
    }
}

/* The ends of the random numbers' range, with views and roughnesses at the ends of theirs. */
static void every_sample_is_unit_finite_and_not_negative(void **state) {
    (void)state;
    generator g = {26};
    const double ends[] = {0, 0x1p-53, 0.25, 0.5, 0.75, 1 - 0x1p-53};
    const double cosines[] = {0, 1e-150, 1e-12, 1e-3, 0.5, 1};
    const double roughnesses[] = {0, 2e-6, 1e-3, 0.1, 1, 10};
    for (int i = 0; i < 6 * 6 * 6 * 6 * 6; i++) {
        graze_material m = turned_material(&g, roughnesses[i % 6], roughnesses[(i + i / 1296) % 6]);
        vec3 n = {0, 0, 1};
        double c = cosines[i / 6 % 6];
        graze_surface s;
        graze_surface_prepare(&s, &m, n, vec3_make(sqrt(1 - c * c), 0, c), NULL);
        const graze_lobe lobes[] = {GRAZE_LOBE_DIFFUSE, s.specular_lobe};
        for (int k = 0; k < 2; k++) {
            graze_surface_sample sample =
                graze_surface_sample_lobe(&s, lobes[k], ends[i / 36 % 6], ends[i / 216 % 6], ends[i / 1296]);
            assert_unit(sample.direction);
            assert_finite_nonnegative(sample.weight);
            assert_true(sample.density >= 0 && sample.density <= DBL_MAX);
            double density = graze_surface_density(&s, lobes[k], sample.direction);
            assert_true(density >= 0 && density <= DBL_MAX);
        }
    }
}

/* A round light, 0.1 rad wide, near the mirror direction: Eq. 18 with many samples of the light, Eq. 16 with many of
 * the lobes. */
static void both_equations_see_the_same_light(void **state) {
    (void)state;
    generator g = {27};
    const int count = 100000;
    for (int round = 0; round < 3; round++) {
        graze_material m = turned_material(&g, 0.1, 0.3);
        if (round == 2) /* only the diffuse part can see it, through Fresnel's factor */
            m.roughness_u = m.roughness_v = 0;
        vec3 n = random_direction(&g), view = direction_at(&g, n, round == 1 ? 0.05 : 0.6);
        graze_surface s;
        graze_surface_prepare(&s, &m, n, view, NULL);
        frame aim = frame_around(vec3_normalize(vec3_add_scaled(vec3_negate(view), 2 * s.local_view.z + 0.1, n)));
        const double edge = cos(0.1), solid_angle = 2 * (double)SUPPORT_PI * (1 - edge);

        rgb direct = {0, 0, 0};
        double indirect = 0, indirect_squares = 0;
        for (int i = 0; i < count; i++) {
            double z = 1 - (1 - edge) * (i + 0.5) / count, r = sqrt(1 - z * z), angle = 2.399963229728653 * i;
            graze_light_sample sample = {
                frame_to_world(&aim, vec3_make(r * cos(angle), r * sin(angle), z)), {1, 1, 1}, solid_angle / count};
            direct = rgb_add(direct, graze_surface_direct(&s, &sample, 1));

            double estimate = 0;
            const graze_lobe lobes[] = {GRAZE_LOBE_DIFFUSE, GRAZE_LOBE_GLOSSY};
            for (int k = 0; k < 2; k++) {
                graze_surface_sample found = draw(&s, lobes[k], &g);
                if (vec3_dot(found.direction, aim.z) > edge)
                    estimate += found.weight.r;
            }
            indirect += estimate / count;
            indirect_squares += estimate * estimate / count;
        }
        double standard_error = sqrt((indirect_squares - indirect * indirect) / count);
        assert_true(standard_error < 0.05 * direct.r);
        assert_true(fabs(indirect - direct.r) < 4 * standard_error);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weight_is_value_cosine_over_density),
        cmocka_unit_test(weights_of_the_new_model_stay_below_the_reflectance),
        cmocka_unit_test(unweighted_samples_all_weigh_the_same),
        cmocka_unit_test(glossy_samples_follow_their_density_in_world_space),
        cmocka_unit_test(diffuse_samples_follow_their_density_in_world_space),
        cmocka_unit_test(mirrors_reflect_in_one_direction),
        cmocka_unit_test(lobes_that_are_not_there_only_give_rejected_samples),
        cmocka_unit_test(a_black_diffuse_part_is_drawn_all_the_same),
        cmocka_unit_test(specular_lobes_reject_when_seen_edge_on_or_from_below),
        cmocka_unit_test(every_sample_is_unit_finite_and_not_negative),
        cmocka_unit_test(both_equations_see_the_same_light),
    };
    return cmocka_run_group_tests_name("material/indirect", tests, NULL, NULL);
}
