/* Which settings are taken: those at the ends of their ranges, and none beyond. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "graze/trace.h"
#include "support/written_file.h"

static void assert_refused(const graze_trace_settings *s, const char *why) {
    messages[0] = 0;
    assert_int_equal(graze_trace_check(s, &remembering), GRAZE_INPUT_ERROR);
    if (!strstr(messages, why))
        fail_msg("'%s' does not say that %s", messages, why);
}

/* What is refused with FIELD at each of the values behind, and that it is taken at both ends of its range. */
#define CHECK(field, why, least, most, ...)                                                                            \
    do {                                                                                                               \
        graze_trace_settings s = graze_trace_defaults();                                                               \
        s.field = (least);                                                                                             \
        assert_int_equal(graze_trace_check(&s, NULL), GRAZE_OK);                                                       \
        s.field = (most);                                                                                              \
        assert_int_equal(graze_trace_check(&s, NULL), GRAZE_OK);                                                       \
        const double wrong[] = {__VA_ARGS__};                                                                          \
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {                                                    \
            s.field = wrong[i];                                                                                        \
            assert_refused(&s, why);                                                                                   \
        }                                                                                                              \
    } while (0)

static void reals_have_ranges(void **state) {
    (void)state;
    const char *value = "the ambient value must be in 0 .. 1e100",
               *mist = "the extinction of mist must be in 0 .. 1e100";
    const char *albedo = "the albedo of mist must be in 0 .. 1";
    CHECK(ambient_value.r, value, 0, 1e100, -1e-300, 1.001e100, NAN);
    CHECK(ambient_value.g, value, 0, 1e100, -1e-300, 1.001e100, NAN);
    CHECK(ambient_value.b, value, 0, 1e100, -1e-300, 1.001e100, NAN);
    CHECK(mist_extinction.r, mist, 0, 1e100, -1e-300, 1.001e100, NAN);
    CHECK(mist_extinction.g, mist, 0, 1e100, -1e-300, 1.001e100, NAN);
    CHECK(mist_extinction.b, mist, 0, 1e100, -1e-300, 1.001e100, NAN);
    CHECK(mist_albedo.r, albedo, 0, 1, -1e-300, 1.001, NAN);
    CHECK(mist_albedo.g, albedo, 0, 1, -1e-300, 1.001, NAN);
    CHECK(mist_albedo.b, albedo, 0, 1, -1e-300, 1.001, NAN);
    CHECK(mist_eccentricity, "the eccentricity of mist must be between -1 and 1", -0.999, 0.999, -1, 1, NAN);
    CHECK(minimum_weight, "the minimum weight must be in 0 .. 1", 0, 1, -1e-300, 1.001, NAN);
    CHECK(specular_threshold, "the specular threshold must be in 0 .. 1", 0, 1, -1e-300, 1.001, NAN);
    CHECK(error, "the error must be positive", 1e-300, DBL_MAX, 0, -1, INFINITY, NAN);
    CHECK(floor, "the floor must be finite and not negative", 0, DBL_MAX, -1e-300, INFINITY, NAN);
}

static void whole_numbers_have_ranges(void **state) {
    (void)state;
    const struct {
        int ambient_bounces, reflection_limit;
        uint32_t sample_limit;
        const char *wrong; /* null: nothing */
    } cases[] = {
        {0, 1000000, 2, NULL},
        {2147483647, -1000000, UINT32_MAX, NULL},
        {-1, 0, 2, "ambient bounces must not be negative"},
        {0, 1000001, 2, "the limit of reflections must be in -1000000 .. 1000000"},
        {0, -1000001, 2, "the limit of reflections must be in -1000000 .. 1000000"},
        {0, 0, 1, "the limit must leave at least 2 samples"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        graze_trace_settings s = graze_trace_defaults();
        s.ambient_bounces = cases[i].ambient_bounces;
        s.reflection_limit = cases[i].reflection_limit;
        s.sample_limit = cases[i].sample_limit;
        if (cases[i].wrong)
            assert_refused(&s, cases[i].wrong);
        else
            assert_int_equal(graze_trace_check(&s, NULL), GRAZE_OK);
    }
}

static void choices_exist(void **state) {
    (void)state;
    for (int choice = -1; choice <= 4; choice++) {
        graze_trace_settings s = graze_trace_defaults();
        s.quantity = (graze_quantity)choice;
        if (choice < 0 || choice > (int)GRAZE_IRRADIANCE)
            assert_refused(&s, "unknown quantity");
        else
            assert_int_equal(graze_trace_check(&s, NULL), GRAZE_OK);
        s = graze_trace_defaults();
        s.part = (graze_part)choice;
        if (choice < 0 || choice > (int)GRAZE_UNMIRRORED)
            assert_refused(&s, "unknown part");
        else
            assert_int_equal(graze_trace_check(&s, NULL), GRAZE_OK);
        s = graze_trace_defaults();
        s.strategy = (graze_strategy)choice;
        if (choice < 0 || choice > (int)GRAZE_STRATEGY_UNWEIGHTED)
            assert_refused(&s, "unknown strategy");
        else
            assert_int_equal(graze_trace_check(&s, NULL), GRAZE_OK);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reals_have_ranges),
        cmocka_unit_test(whole_numbers_have_ranges),
        cmocka_unit_test(choices_exist),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
