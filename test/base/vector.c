/* Frames are orthonormal for every direction. */
#include "base/vector.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* z itself is only unit to an ulp or so; the frame may add a few. */
static const double TOLERANCE = 4 * DBL_EPSILON;

static void check_frame(vec3 z) {
    frame f = frame_around(z);
    vec3 right = vec3_subtract(vec3_cross(f.x, f.y), f.z);
    double worst = fabs(vec3_dot(f.x, f.x) - 1);
    worst = fmax(worst, fabs(vec3_dot(f.y, f.y) - 1));
    worst = fmax(worst, fabs(vec3_dot(f.x, f.y)));
    worst = fmax(worst, fabs(vec3_dot(f.y, f.z)));
    worst = fmax(worst, fabs(vec3_dot(f.z, f.x)));
    worst = fmax(worst, vec3_max_abs(right));
    if (!(worst <= TOLERANCE))
        fail_msg("the frame around (%.17g, %.17g, %.17g) is off by %g", z.x, z.y, z.z, worst);
    if (f.z.x != z.x || f.z.y != z.y || f.z.z != z.z)
        fail_msg("the frame changed its axis (%.17g, %.17g, %.17g)", z.x, z.y, z.z);
}

static void test_frame_of_random_axes(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 200000; i++) {
        double c[3];
        for (int k = 0; k < 3; k++) {
            seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            c[k] = (double)(int64_t)seed * 0x1p-63;
            /* Every third axis lies near a coordinate plane or axis. */
            if (i % 3 == 0 && k == i / 3 % 3)
                c[k] = ldexp(c[k], -(i / 9 % 1070));
        }
        vec3 z = vec3_normalize(vec3_make(c[0], c[1], c[2]));
        check_frame(vec3_normalize(z));
    }
}

static void test_frame_of_special_axes(void **state) {
    (void)state;
    static const double parts[] = {0,         -0.0,       1,     -1,     DBL_MIN, -DBL_MIN,
                                   0x1p-1074, -0x1p-1074, 1e-16, -1e-16, 1e-8,    -1e-8};
    enum { PARTS = sizeof parts / sizeof *parts };
    int checked = 0;
    for (int i = 0; i < PARTS * PARTS * PARTS; i++) {
        vec3 v = {parts[i % PARTS], parts[i / PARTS % PARTS], parts[i / PARTS / PARTS]};
        if (vec3_max_abs(v) == 1) {
            check_frame(vec3_normalize(v));
            checked++;
        }
    }
    assert_int_equal(checked, PARTS * PARTS * PARTS - (PARTS - 2) * (PARTS - 2) * (PARTS - 2));
}

static void test_frame_there_and_back(void **state) {
    (void)state;
    frame f = frame_around(vec3_normalize(vec3_make(.3, -.5, -.8)));
    vec3 v = {1, -2, 3};
    vec3 back = frame_to_world(&f, frame_to_local(&f, v));
    assert_true(vec3_max_abs(vec3_subtract(back, v)) <= 16 * DBL_EPSILON);
    assert_true(fabs(frame_to_local(&f, f.z).z - 1) <= TOLERANCE);
    assert_true(vec3_max_abs(vec3_subtract(frame_to_world(&f, vec3_make(0, 1, 0)), f.y)) == 0);
}

static void test_vectors(void **state) {
    (void)state;
    vec3 a = {1, 2, 3}, b = {-4, 5, 7};
    vec3 c = vec3_cross(a, b);
    assert_true(c.x == -1 && c.y == -19 && c.z == 13);
    assert_true(vec3_dot(a, c) == 0 && vec3_dot(b, c) == 0);
    vec3 s = vec3_add_scaled(a, 2, b);
    assert_true(s.x == -7 && s.y == 12 && s.z == 17);
    assert_true(vec3_length(vec3_make(2, 3, 6)) == 7);
    vec3 none = vec3_normalize(vec3_make(0, 0, 0));
    assert_true(none.x == 0 && none.y == 0 && none.z == 0);
    assert_true(vec3_max_abs(vec3_negate(b)) == 7);
}

static void test_safe_lengths(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p-1074, 0x1p-1000, 0x1p1000, 0x1p1020};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        vec3 v = vec3_scale(scales[i], vec3_make(2, -3, 6));
        assert_true(fabs(vec3_safe_length(v) / scales[i] - 7) <= 8 * DBL_EPSILON);
        vec3 unit = vec3_safe_normalize(v);
        assert_true(vec3_max_abs(vec3_subtract(unit, vec3_make(2 / 7., -3 / 7., 6 / 7.))) <= 2 * DBL_EPSILON);
    }
    vec3 diagonal = vec3_safe_normalize(vec3_make(DBL_MAX, DBL_MAX, -DBL_MAX));
    assert_true(fabs(diagonal.x - sqrt(1 / 3.)) <= 2 * DBL_EPSILON && diagonal.z == -diagonal.x);
    assert_true(vec3_safe_length(vec3_make(0, -0.0, 0)) == 0);
    assert_true(vec3_max_abs(vec3_safe_normalize(vec3_make(0, -0.0, 0))) == 0);
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (int others = 0; others < 2; others++)
            assert_true(vec3_max_abs(vec3_safe_normalize(vec3_make(others, bad[i], 0))) == 0);
}

static void test_colours(void **state) {
    (void)state;
    rgb a = {1, 2, 3}, b = {4, 5, 6};
    rgb c = rgb_add_scaled(rgb_multiply(a, b), 2, rgb_add(a, b));
    assert_true(c.r == 14 && c.g == 24 && c.b == 36);
    assert_true(rgb_max(c) == 36 && rgb_max(rgb_scale(-1, c)) == -14);
    assert_true(rgb_is_black(rgb_gray(0)) && !rgb_is_black((rgb){0, 1e-300, 0}));
    assert_true(fabs(rgb_brightness(rgb_gray(1)) - 1) <= 4 * DBL_EPSILON);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frame_of_random_axes), cmocka_unit_test(test_frame_of_special_axes),
        cmocka_unit_test(test_frame_there_and_back), cmocka_unit_test(test_vectors),
        cmocka_unit_test(test_safe_lengths),         cmocka_unit_test(test_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
