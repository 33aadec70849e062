/* material_from_primitive: what each type of primitive means, and every way in which its arguments can be wrong. */
#include "support.h"

#include <stdio.h>
#include <string.h>

#include "material/from_primitive.h"
#include "material/orientation.h"

typedef struct log_of_report {
    int errors, warnings;
    char text[2000];
} log_of_report;

static void keep(void *user, graze_severity severity, const char *text) {
    log_of_report *log = user;
    *(severity == GRAZE_ERROR ? &log->errors : &log->warnings) += 1;
    snprintf(log->text + strlen(log->text), sizeof log->text - strlen(log->text), "%s\n", text);
}

static const place where = {.file = "room.rad", .line = 12, .column = 3};

static graze_status convert(graze_material *m, log_of_report *log, rad_type type, uint32_t string_count,
                            const char *const *strings, uint32_t real_count, const double *reals) {
    memset(log, 0, sizeof *log);
    rad_primitive p = {.type = type,
                       .modifier = RAD_VOID,
                       .id = "skin",
                       .string_count = string_count,
                       .real_count = real_count,
                       .strings = strings,
                       .reals = reals,
                       .where = &where};
    graze_report report = {keep, log};
    return material_from_primitive(m, &p, &report);
}

static void assert_refused(rad_type type, uint32_t string_count, const char *const *strings, uint32_t real_count,
                           const double *reals, const char *why) {
    graze_material m;
    log_of_report log;
    assert_int_equal(convert(&m, &log, type, string_count, strings, real_count, reals), GRAZE_INPUT_ERROR);
    assert_int_equal(log.errors, 1);
    if (!strstr(log.text, why) || !strstr(log.text, "room.rad:12:3:"))
        fail_msg("\"%s\" does not say where and \"%s\"", log.text, why);
}

static const char *const plain[] = {"1", "-0.5", ".25", "."};
static const double iso[] = {0.1, 0.2, 0.3, 0.4, 0.05};
static const double aniso[] = {0.1, 0.2, 0.3, 0.4, 0.05, 0.15};

static void isotropic_types_are_read(void **state) {
    (void)state;
    const rad_type types[] = {RAD_PLASTIC, RAD_METAL};
    for (int i = 0; i < 2; i++) {
        graze_material m;
        log_of_report log;
        assert_int_equal(convert(&m, &log, types[i], 0, NULL, 5, iso), GRAZE_OK);
        assert_int_equal(log.errors + log.warnings, 0);
        assert_int_equal(m.kind, i ? GRAZE_METAL : GRAZE_PLASTIC);
        assert_int_equal(m.model, GRAZE_BRDF_GMD);
        assert_rgb(m.color, 0.1, 0.2, 0.3, 0);
        assert_true(m.specularity == 0.4 && m.roughness_u == 0.05 && m.roughness_v == 0.05);
        assert_false(m.has_orientation);
    }
}

static void anisotropic_types_are_read(void **state) {
    (void)state;
    const rad_type types[] = {RAD_PLASTIC2, RAD_METAL2};
    for (int i = 0; i < 2; i++) {
        graze_material m;
        log_of_report log;
        assert_int_equal(convert(&m, &log, types[i], 4, plain, 6, aniso), GRAZE_OK);
        assert_int_equal(log.errors + log.warnings, 0);
        assert_int_equal(m.kind, i ? GRAZE_METAL : GRAZE_PLASTIC);
        assert_int_equal(m.model, GRAZE_BRDF_GMD);
        assert_rgb(m.color, 0.1, 0.2, 0.3, 0);
        assert_true(m.specularity == 0.4 && m.roughness_u == 0.05 && m.roughness_v == 0.15);
        assert_true(m.has_orientation);
        assert_true(m.orientation.x == 1 && m.orientation.y == -0.5 && m.orientation.z == 0.25);
    }
}

static void the_transform_turns_the_orientation(void **state) {
    (void)state;
    const char *const strings[] = {"1", "0", "0", ".", "-t", "10", "20", "30", "-rz", "90", "-rz", "-60"};
    graze_material m;
    log_of_report log;
    assert_int_equal(convert(&m, &log, RAD_METAL2, 12, strings, 6, aniso), GRAZE_OK);
    vec3 u = vec3_normalize(m.orientation);
    assert_true(fabs(u.x - sqrt(0.75)) < 1e-15 && fabs(u.y - 0.5) < 1e-15 && fabs(u.z) < 1e-15);
}

static void words_that_are_no_transform_are_refused(void **state) {
    (void)state;
    const char *const strings[] = {"1", "0", "0", ".", "-rz", "90", "sideways"};
    assert_refused(RAD_METAL2, 7, strings, 6, aniso, "sideways");
}

/* What they say is material/orientation.h's business. */
static void orientations_by_functions_are_left_null(void **state) {
    (void)state;
    const char *const words[][4] = {{"Nx", "0", "1", "."},  {"1", "1+1", "1", "."},      {"1", "0", "", "."},
                                    {"1", "0", "nan", "."}, {"1", "0", "0", "wood.cal"}, {"1", "0", "0", ""}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const rad_primitive p = {.type = RAD_PLASTIC2, .id = "skin", .string_count = 4, .strings = words[i]};
        graze_material m;
        log_of_report log;
        assert_true(material_orients_by_function(&p));
        assert_int_equal(convert(&m, &log, RAD_PLASTIC2, 4, words[i], 6, aniso), GRAZE_OK);
        assert_int_equal(log.errors + log.warnings, 0);
        assert_int_equal(m.has_orientation, 1);
        assert_true(vec3_max_abs(m.orientation) == 0);
    }
}

static void wrong_counts_are_refused(void **state) {
    (void)state;
    const double seven[7] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
    for (uint32_t n = 0; n <= 7; n++) {
        if (n != 5)
            assert_refused(RAD_PLASTIC, 0, NULL, n, seven, "needs 5 real arguments");
        if (n != 6)
            assert_refused(RAD_METAL2, 4, plain, n, seven, "needs 6 real arguments");
        if (n < 4)
            assert_refused(RAD_METAL2, n, plain, 6, aniso, "needs at least 4 string arguments");
    }
}

static void negative_arguments_are_refused(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        double reals[] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
        char why[40];
        snprintf(why, sizeof why, "argument %d is negative", i + 1);
        reals[i] = -1e-9;
        if (i < 5)
            assert_refused(RAD_METAL, 0, NULL, 5, reals, why);
        assert_refused(RAD_PLASTIC2, 4, plain, 6, reals, why);
    }
}

static void roughness_out_of_its_range_is_refused(void **state) {
    (void)state;
    const double rough[] = {0.1, 0.1, 0.1, 0.1, 10.5, 10.5};
    assert_refused(RAD_METAL, 0, NULL, 5, rough, "roughness 10.5 is above 10");
    assert_refused(RAD_METAL2, 4, plain, 6, rough, "roughness 10.5 is above 10");
    for (int i = 4; i < 6; i++) {
        double smooth[] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
        smooth[i] = 1e-6;
        assert_refused(RAD_METAL2, 4, plain, 6, smooth, "roughness too small");
        graze_material m;
        log_of_report log;
        smooth[i] = 1.000001e-6;
        assert_int_equal(convert(&m, &log, RAD_METAL2, 4, plain, 6, smooth), GRAZE_OK);
    }
}

static void unphysical_values_are_taken_with_a_warning(void **state) {
    (void)state;
    const double bright[] = {0.1, 0.1, 1.2, 0.1, 0.1}, shiny[] = {0.1, 0.1, 0.1, 1.5, 0.1}, white[] = {1, 1, 1, 1, 10};
    graze_material m;
    log_of_report log;
    assert_int_equal(convert(&m, &log, RAD_PLASTIC, 0, NULL, 5, bright), GRAZE_OK);
    assert_true(log.warnings == 1 && m.color.b == 1.2);
    assert_non_null(strstr(log.text, "unphysical: a colour"));
    assert_int_equal(convert(&m, &log, RAD_METAL, 0, NULL, 5, shiny), GRAZE_OK);
    assert_true(log.warnings == 1 && m.specularity == 1.5);
    assert_non_null(strstr(log.text, "unphysical: a specularity"));
    assert_int_equal(convert(&m, &log, RAD_PLASTIC, 0, NULL, 5, white), GRAZE_OK);
    assert_int_equal(log.warnings, 0);
    for (int c = 0; c < 3; c++) {
        double sum[] = {0.75, 0.75, 0.75, 0.25, 0.25, 0.25, 0, 1e6}, mirror[] = {1, 1, 1};
        assert_int_equal(convert(&m, &log, RAD_ASHIK2, 4, plain, 8, sum), GRAZE_OK);
        assert_true(log.warnings == 0 && m.power_u == 0 && m.power_v == 1e6);
        assert_int_equal(convert(&m, &log, RAD_MIRROR, 0, NULL, 3, mirror), GRAZE_OK);
        assert_int_equal(log.warnings, 0);
        sum[c] = 0.76;
        assert_int_equal(convert(&m, &log, RAD_ASHIK2, 4, plain, 8, sum), GRAZE_OK);
        assert_true(log.warnings == 1 && strstr(log.text, "unphysical: its colours add up to more than 1"));
        mirror[c] = 1.01;
        assert_int_equal(convert(&m, &log, RAD_MIRROR, 0, NULL, 3, mirror), GRAZE_OK);
        assert_true(log.warnings == 1 && strstr(log.text, "unphysical: a colour above 1"));
    }
}

static void other_materials_are_not_supported_yet(void **state) {
    (void)state;
    assert_refused(RAD_MIST, 0, NULL, 0, NULL, "mist is not supported yet");
    assert_refused(RAD_BSDF, 4, plain, 0, NULL, "BSDF is not supported yet");
}

static graze_material accept(rad_type type, uint32_t string_count, uint32_t real_count, const double *reals,
                             int warnings) {
    graze_material m;
    log_of_report log;
    assert_int_equal(convert(&m, &log, type, string_count, plain, real_count, reals), GRAZE_OK);
    assert_int_equal(log.errors, 0);
    assert_int_equal(log.warnings, warnings);
    return m;
}

static void transparent_types_are_read(void **state) {
    (void)state;
    const double reals[] = {0.1, 0.2, 0.3, 0.04, 0.5, 0.6, 0.7, 0.8};
    graze_material m = accept(RAD_TRANS, 0, 7, reals, 0);
    assert_true(m.kind == GRAZE_TRANS && m.color.b == 0.3 && m.specularity == 0.04 && m.roughness_u == 0.5 &&
                m.roughness_v == 0.5 && m.transmission == 0.6 && m.transmitted_specularity == 0.7);
    m = accept(RAD_TRANS2, 4, 8, reals, 0);
    assert_true(m.kind == GRAZE_TRANS && m.roughness_u == 0.5 && m.roughness_v == 0.6 && m.transmission == 0.7 &&
                m.transmitted_specularity == 0.8 && m.has_orientation && m.orientation.y == -0.5);
    const double glass[] = {0.9, 1.1, 0.7, 1.4};
    m = accept(RAD_GLASS, 0, 3, glass, 1);
    assert_true(m.kind == GRAZE_GLASS && m.color.r == 0.9 && m.color.g == 1 && m.refraction == 1.52);
    m = accept(RAD_GLASS, 0, 4, glass, 1);
    assert_true(m.refraction == 1.4);
    const double dielectric[] = {0.9, 0.8, 0.7, 1.4, -50};
    m = accept(RAD_DIELECTRIC, 0, 5, dielectric, 0);
    assert_true(m.kind == GRAZE_DIELECTRIC && fabs(m.refraction - 1.3) < 1e-15 && m.inside.g == 0.8);
    assert_rgb(m.outside, 1, 1, 1, 0);
    const double interface[] = {0.9, 0.8, 0.7, 1.5, 0.6, 0.5, 0.4, 1.2};
    m = accept(RAD_INTERFACE, 0, 8, interface, 0);
    assert_true(m.kind == GRAZE_DIELECTRIC && fabs(m.refraction - 1.25) < 1e-15 && m.inside.r == 0.9 &&
                m.outside.b == 0.4);
}

static void wrong_transparent_types_are_refused(void **state) {
    (void)state;
    const double thin[] = {0.9, 0.9, 0.9, 0.99}, negative[] = {0.9, -0.1, 0.9, 1.5, 0, 1, 1, 1.5};
    const double opaque[] = {0.9, 0.9, 0.9, 1e-3, 0, 0.9, 0.9, 1.5}, much[] = {0.1, 0.1, 0.1, 0, 0.1, 1.1, 1, 0.5};
    const double specular[] = {0.1, 0.1, 0.1, 0, 0.1, 0.2, 0.5, 1.5}, rough[] = {0.1, 0.1, 0.1, 0, 0.1, 11, 1, 0.5};
    assert_refused(RAD_GLASS, 0, NULL, 4, thin, "index of refraction must be in 1 .. 100");
    assert_refused(RAD_GLASS, 0, NULL, 3, negative, "argument 2 is negative");
    assert_refused(RAD_GLASS, 0, NULL, 2, thin, "needs 3 real arguments");
    assert_refused(RAD_DIELECTRIC, 0, NULL, 5, negative, "argument 2 is negative");
    assert_refused(RAD_DIELECTRIC, 0, NULL, 5, opaque, "index of refraction must be in 0.01 .. 100");
    assert_refused(RAD_DIELECTRIC, 0, NULL, 4, opaque, "needs 5 real arguments");
    assert_refused(RAD_INTERFACE, 0, NULL, 8, opaque, "index of refraction must be in 0.01 .. 100");
    assert_refused(RAD_INTERFACE, 0, NULL, 7, opaque, "needs 8 real arguments");
    assert_refused(RAD_TRANS, 0, NULL, 7, much, "must be in 0 .. 1");
    assert_refused(RAD_TRANS, 0, NULL, 8, specular, "needs 7 real arguments");
    assert_refused(RAD_TRANS2, 4, plain, 8, specular, "must be in 0 .. 1");
    assert_refused(RAD_TRANS2, 4, plain, 8, rough, "roughness 11 is above 10");
}

static void wrong_ashik2_and_mirror_are_refused(void **state) {
    (void)state;
    const double negative[] = {0.1, 0.2, 0.3, 0.1, 0.2, 0.3, -1, 10},
                 steep[] = {0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 10, 1.1e6};
    const double steep_u[] = {0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 1.1e6, 10}, dark[] = {0.5, 0.5, -0.5};
    static const char *const two[] = {"one", "two"};
    assert_refused(RAD_ASHIK2, 4, plain, 7, steep, "needs 8 real arguments");
    assert_refused(RAD_ASHIK2, 4, plain, 8, negative, "argument 7 is negative");
    assert_refused(RAD_ASHIK2, 4, plain, 8, steep, "the powers must be in 0 .. 1000000");
    assert_refused(RAD_ASHIK2, 4, plain, 8, steep_u, "the powers must be in 0 .. 1000000");
    assert_refused(RAD_ASHIK2, 3, plain, 8, steep, "needs at least 4 string arguments, not 3");
    assert_refused(RAD_MIRROR, 0, NULL, 2, dark, "needs 3 real arguments");
    assert_refused(RAD_MIRROR, 0, NULL, 3, dark, "argument 3 is negative");
    assert_refused(RAD_MIRROR, 2, two, 3, iso, "needs 1 string argument at most, not 2");
}

static void a_missing_report_changes_nothing(void **state) {
    (void)state;
    graze_material m;
    rad_primitive p = {.type = RAD_MIST, .modifier = RAD_VOID, .id = "skin", .where = &where};
    assert_int_equal(material_from_primitive(&m, &p, NULL), GRAZE_INPUT_ERROR);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(isotropic_types_are_read),
        cmocka_unit_test(anisotropic_types_are_read),
        cmocka_unit_test(the_transform_turns_the_orientation),
        cmocka_unit_test(words_that_are_no_transform_are_refused),
        cmocka_unit_test(orientations_by_functions_are_left_null),
        cmocka_unit_test(wrong_counts_are_refused),
        cmocka_unit_test(negative_arguments_are_refused),
        cmocka_unit_test(roughness_out_of_its_range_is_refused),
        cmocka_unit_test(unphysical_values_are_taken_with_a_warning),
        cmocka_unit_test(transparent_types_are_read),
        cmocka_unit_test(wrong_transparent_types_are_refused),
        cmocka_unit_test(wrong_ashik2_and_mirror_are_refused),
        cmocka_unit_test(other_materials_are_not_supported_yet),
        cmocka_unit_test(a_missing_report_changes_nothing),
    };
    return cmocka_run_group_tests_name("material/from_primitive", tests, NULL, NULL);
}
