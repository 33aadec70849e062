/* graze_surface_prepare: colours, the choice of mirror or lobe, and the shading frame. */
#include "support.h"

static const vec3 up = {0, 0, 1};
static const rgb red = {0.5, 0.25, 0.125};

static graze_surface prepare_at(graze_material m, double cosine) {
    graze_surface s;
    int illegal = -1;
    graze_surface_prepare(&s, &m, up, vec3_make(sqrt(1 - cosine * cosine), 0, cosine), &illegal);
    assert_int_equal(illegal, 0);
    return s;
}

/* Radiance's FRESNE, typed from rt/normal.c's documentation. */
static double fresnel(double c) {
    return exp(-5.85 * c) - 0.00287989916;
}

static void rough_plastic_reflects_white(void **state) {
    (void)state;
    graze_surface s = prepare_at(material_make(GRAZE_PLASTIC, red, 0.25, 0.1, 0.1), 0.3);
    assert_int_equal(s.specular_lobe, GRAZE_LOBE_GLOSSY);
    assert_rgb(s.specular, 0.25, 0.25, 0.25, 1e-15);
    assert_rgb(s.diffuse, 0.375, 0.1875, 0.09375, 1e-15);
    assert_true(s.lobe.alpha_x == 0.1 && s.lobe.alpha_y == 0.1);
    assert_int_equal(s.lobe.model, GRAZE_BRDF_GMD);
    assert_false(s.fresnel);
}

static void rough_metal_reflects_its_colour(void **state) {
    (void)state;
    graze_surface s = prepare_at(material_make(GRAZE_METAL, red, 0.8, 0.1, 0.1), 0.01);
    assert_int_equal(s.specular_lobe, GRAZE_LOBE_GLOSSY);
    assert_rgb(s.specular, 0.4, 0.2, 0.1, 1e-15);
    assert_rgb(s.diffuse, 0.1, 0.05, 0.025, 1e-14);
}

static void mirrors_get_fresnels_estimate(void **state) {
    (void)state;
    const double cosines[] = {1, 0.9, 0.5, 0.1, 0.001, 1e-9, 0};
    for (size_t i = 0; i < sizeof cosines / sizeof *cosines; i++) {
        double c = cosines[i], f = fmax(0, fresnel(fmax(c, 0.001))), s0 = 0.04, white = s0 + f * (1 - s0);
        graze_surface plastic = prepare_at(material_make(GRAZE_PLASTIC, red, s0, 0, 0), c);
        assert_int_equal(plastic.specular_lobe, GRAZE_LOBE_MIRROR);
        assert_true(plastic.fresnel);
        assert_rgb(plastic.specular, white, white, white, 1e-14);
        assert_rgb(plastic.diffuse, red.r * (1 - white), red.g * (1 - white), red.b * (1 - white), 1e-13);

        double s1 = 0.9;
        graze_surface metal = prepare_at(material_make(GRAZE_METAL, red, s1, 0, 0), c);
        double body = 1 - (s1 + f * (1 - s1));
        assert_rgb(metal.specular, f + red.r * s1 * (1 - f), f + red.g * s1 * (1 - f), f + red.b * s1 * (1 - f), 1e-14);
        assert_rgb(metal.diffuse, red.r * body, red.g * body, red.b * body, 1e-12);
    }
}

static void fresnels_estimate_needs_polish(void **state) {
    (void)state;
    assert_true(prepare_at(material_make(GRAZE_PLASTIC, red, 0.018, 0, 0), 0.1).fresnel);
    graze_surface s = prepare_at(material_make(GRAZE_PLASTIC, red, 0.0179, 0, 0), 0.1);
    assert_false(s.fresnel);
    assert_int_equal(s.specular_lobe, GRAZE_LOBE_MIRROR);
    assert_rgb(s.specular, 0.0179, 0.0179, 0.0179, 0);
}

static void isotropic_mirrors_end_at_roughness_squared_1e6(void **state) {
    (void)state;
    assert_int_equal(prepare_at(material_make(GRAZE_METAL, red, 1, 1e-3, 1e-3), 0.5).specular_lobe, GRAZE_LOBE_MIRROR);
    assert_int_equal(prepare_at(material_make(GRAZE_METAL, red, 1, 1.0001e-3, 1.0001e-3), 0.5).specular_lobe,
                     GRAZE_LOBE_GLOSSY);
}

static void oriented_lobes_stay_lobes_however_smooth(void **state) {
    (void)state;
    graze_material m = material_make(GRAZE_METAL, red, 1, 2e-6, 5e-4);
    m.has_orientation = 1;
    m.orientation = vec3_make(1, 0, 0);
    graze_surface s = prepare_at(m, 0.5);
    assert_int_equal(s.specular_lobe, GRAZE_LOBE_GLOSSY);
    assert_true(s.lobe.alpha_x == 2e-6 && s.lobe.alpha_y == 5e-4);
    assert_rgb(s.specular, red.r, red.g, red.b, 0);

    m.orientation = up;
    assert_int_equal(prepare_at(m, 0.5).specular_lobe, GRAZE_LOBE_GLOSSY);
    m.roughness_u = m.roughness_v = 0;
    assert_int_equal(prepare_at(m, 0.5).specular_lobe, GRAZE_LOBE_MIRROR);
}

static void roughness_is_brought_into_the_lobes_domain(void **state) {
    (void)state;
    graze_material m = material_make(GRAZE_METAL, red, 1, 1e-9, 1e9);
    m.has_orientation = 1;
    m.orientation = vec3_make(1, 0, 0);
    graze_surface s = prepare_at(m, 0.5);
    assert_true(s.lobe.alpha_x == GRAZE_ROUGHNESS_MIN && s.lobe.alpha_y == GRAZE_ROUGHNESS_MAX);
}

static void black_parts_are_left_out(void **state) {
    (void)state;
    assert_int_equal(prepare_at(material_make(GRAZE_PLASTIC, red, 0, 0.1, 0.1), 0.5).specular_lobe, GRAZE_LOBE_NONE);
    assert_int_equal(prepare_at(material_make(GRAZE_PLASTIC, red, 0, 0, 0), 0.5).specular_lobe, GRAZE_LOBE_NONE);
    assert_int_equal(prepare_at(material_make(GRAZE_METAL, rgb_gray(0), 1, 0.1, 0.1), 0.5).specular_lobe,
                     GRAZE_LOBE_NONE);
    /* A black mirror still has what Fresnel's estimate adds. */
    assert_int_equal(prepare_at(material_make(GRAZE_METAL, rgb_gray(0), 1, 0, 0), 0.1).specular_lobe,
                     GRAZE_LOBE_MIRROR);
}

static void unphysical_parameters_never_make_a_colour_negative(void **state) {
    (void)state;
    const double specularities[] = {1, 1.5, 40};
    for (size_t i = 0; i < sizeof specularities / sizeof *specularities; i++)
        for (int rough = 0; rough < 2; rough++)
            for (int kind = 0; kind < 2; kind++)
                for (int eighths = 0; eighths <= 8; eighths++) {
                    graze_surface s = prepare_at(material_make((graze_material_kind)kind, (rgb){3, 1, 0},
                                                               specularities[i], 0.1 * rough, 0.1 * rough),
                                                 eighths / 8.0);
                    assert_finite_nonnegative(s.diffuse);
                    assert_finite_nonnegative(s.specular);
                    assert_true(s.specular.r > 0.9);
                    assert_true(rgb_max(s.diffuse) < 1e-9);
                }
}

static void assert_orthonormal(const graze_surface *s) {
    const double eps = 1e-15;
    assert_true(fabs(vec3_length(s->x) - 1) < eps && fabs(vec3_length(s->y) - 1) < eps);
    assert_true(fabs(vec3_dot(s->x, s->y)) < eps && fabs(vec3_dot(s->x, s->n)) < eps &&
                fabs(vec3_dot(s->y, s->n)) < eps);
    vec3 z = vec3_cross(s->x, s->y);
    assert_true(vec3_dot(z, s->n) > 1 - 1e-12);
}

static void the_frame_follows_the_orientation(void **state) {
    (void)state;
    generator g = {1};
    for (int i = 0; i < 10000; i++) {
        vec3 n = random_direction(&g), u0 = random_direction(&g);
        graze_material m = material_make(GRAZE_METAL, red, 0.5, 0.1, 0.2);
        m.has_orientation = 1;
        m.orientation = vec3_scale(pow(10, 400 * uniform(&g) - 200), u0);
        graze_surface s;
        graze_surface_prepare(&s, &m, n, direction_at(&g, n, uniform(&g)), NULL);
        assert_orthonormal(&s);
        assert_true(s.lobe.alpha_x == 0.1 && s.lobe.alpha_y == 0.2);
        /* x is the part of u0 in the surface: nothing of u0 goes along y, and x and u0 point the same way. */
        assert_true(fabs(vec3_dot(s.y, u0)) < 1e-14);
        double sine = vec3_length(vec3_cross(n, u0));
        assert_true(fabs(vec3_dot(s.x, u0) - sine) < 1e-14);
        assert_true(vec3_dot(vec3_subtract(s.n, n), vec3_subtract(s.n, n)) == 0);
    }
}

static void the_frame_is_orthonormal_however_steep_the_orientation(void **state) {
    (void)state;
    generator g = {2};
    for (int i = 0; i < 10000; i++) {
        vec3 n = random_direction(&g);
        graze_material m = material_make(GRAZE_METAL, red, 0.5, 0.1, 0.2);
        m.has_orientation = 1;
        m.orientation = vec3_add_scaled(n, pow(10, -20 * uniform(&g)), direction_at(&g, n, 0));
        graze_surface s;
        graze_surface_prepare(&s, &m, n, n, NULL);
        assert_orthonormal(&s);
    }
}

static void an_orientation_along_the_normal_makes_the_lobe_isotropic(void **state) {
    (void)state;
    generator g = {3};
    const double lengths[] = {0, 1, -1, 1e-300, 1e300};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        graze_material m = material_make(GRAZE_METAL, red, 0.5, 0.1, 0.2);
        vec3 n = random_direction(&g);
        m.has_orientation = 1;
        m.orientation = vec3_scale(lengths[i], n);
        graze_surface s;
        int illegal = -1;
        graze_surface_prepare(&s, &m, n, n, &illegal);
        assert_int_equal(illegal, 1);
        assert_close_relative(s.lobe.alpha_x, sqrtl(0.025L), 1e-15);
        assert_true(s.lobe.alpha_x == s.lobe.alpha_y);
        assert_orthonormal(&s);

        m.roughness_v = 0.1009; /* differs by less than 0.001: nobody need know */
        graze_surface_prepare(&s, &m, n, n, &illegal);
        assert_int_equal(illegal, 0);
        assert_close_relative(s.lobe.alpha_x, sqrtl((0.01L + 0.1009L * 0.1009L) / 2), 1e-15);
    }
}

static void the_view_is_kept_in_both_frames(void **state) {
    (void)state;
    generator g = {4};
    vec3 n = random_direction(&g), view = direction_at(&g, n, 0.3);
    graze_material m = material_make(GRAZE_PLASTIC, red, 0.5, 0.1, 0.1);
    graze_surface s;
    graze_surface_prepare(&s, &m, n, view, NULL);
    assert_true(s.view.x == view.x && s.view.y == view.y && s.view.z == view.z);
    assert_true(fabs(s.local_view.z - 0.3) < 1e-15);
    frame f = {s.x, s.y, s.n};
    assert_true(vec3_length(vec3_subtract(frame_to_world(&f, s.local_view), view)) < 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rough_plastic_reflects_white),
        cmocka_unit_test(rough_metal_reflects_its_colour),
        cmocka_unit_test(mirrors_get_fresnels_estimate),
        cmocka_unit_test(fresnels_estimate_needs_polish),
        cmocka_unit_test(isotropic_mirrors_end_at_roughness_squared_1e6),
        cmocka_unit_test(oriented_lobes_stay_lobes_however_smooth),
        cmocka_unit_test(roughness_is_brought_into_the_lobes_domain),
        cmocka_unit_test(black_parts_are_left_out),
        cmocka_unit_test(unphysical_parameters_never_make_a_colour_negative),
        cmocka_unit_test(the_frame_follows_the_orientation),
        cmocka_unit_test(the_frame_is_orthonormal_however_steep_the_orientation),
        cmocka_unit_test(an_orientation_along_the_normal_makes_the_lobe_isotropic),
        cmocka_unit_test(the_view_is_kept_in_both_frames),
    };
    return cmocka_run_group_tests_name("material/surface", tests, NULL, NULL);
}
