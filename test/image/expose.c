/* Exposure for the eye. */
#include "image/support.h"

#include <float.h>
#include <math.h>

#include "image/color.h"

/* sRGB of 0.18. */
enum { MIDDLE_GRAY = 118 };

static void brightness_itself_does_not_matter(void **state) {
    (void)state;
    static const float values[] = {1e-30f, 1e-3f, 1, 1e6f, 1e29f};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        image *picture = uniform(5, 4, values[i]);
        unsigned char bytes[60];
        image_expose(picture, bytes);
        for (int b = 0; b < 60; b++)
            assert_int_equal(bytes[b], MIDDLE_GRAY);
        image_destroy(picture);
    }
}

/* Two values in a ratio of 16: their log-average lies 4 times from each. */
static void log_average_becomes_middle_gray(void **state) {
    (void)state;
    image *picture = uniform(2, 1, 1);
    set_gray(picture, 1, 16);
    unsigned char bytes[6];
    image_expose(picture, bytes);
    assert_int_equal(bytes[0], (int)(255 * image_srgb_encode(0.18 / 4) + 0.5));
    assert_int_equal(bytes[3], (int)(255 * image_srgb_encode(0.72) + 0.5));
    image_destroy(picture);
}

/* Lamps, and what they are mirrored in, a factor of ten darker, do not both end up white. */
static void bright_parts_stay_apart(void **state) {
    (void)state;
    image *picture = uniform(6, 1, 1);
    set_gray(picture, 4, 1e3F);
    set_gray(picture, 5, 1e4F);
    unsigned char bytes[18];
    image_expose(picture, bytes);
    assert_int_equal(bytes[15], 255);
    assert_in_range(bytes[12], 200, 245);
    image_destroy(picture);
}

static void black_stays_black(void **state) {
    (void)state;
    image *picture = uniform(2, 2, 0);
    unsigned char bytes[12];
    image_expose(picture, bytes);
    for (int b = 0; b < 12; b++)
        assert_int_equal(bytes[b], 0);
    image_destroy(picture);
}

/* What is no number does not change how the rest looks. */
static void odd_values_are_harmless(void **state) {
    (void)state;
    image *picture = uniform(100, 1, 1);
    unsigned char bytes[300];
    set_gray(picture, 0, NAN);
    set_gray(picture, 1, -5);
    set_gray(picture, 2, 0);
    set_gray(picture, 3, 1e-20f);
    image_expose(picture, bytes);
    for (int i = 0; i < 100; i++)
        assert_int_equal(bytes[3 * i + 1], i < 4 ? 0 : MIDDLE_GRAY);
    set_gray(picture, 4, INFINITY);
    set_gray(picture, 5, FLT_MAX);
    image_expose(picture, bytes);
    assert_int_equal(bytes[3 * 4], 255);
    assert_int_equal(bytes[3 * 5], 255);
    assert_int_equal(bytes[0], 0);
    image_destroy(picture);
}

static void brighter_is_never_darker(void **state) {
    (void)state;
    image *picture = uniform(2000, 1, 1);
    for (int i = 0; i < 2000; i++)
        set_gray(picture, i, (float)exp(0.01 * (i - 1000)));
    unsigned char bytes[6000];
    image_expose(picture, bytes);
    for (int i = 1; i < 2000; i++)
        assert_true(bytes[3 * i] >= bytes[3 * i - 3]);
    assert_int_equal(bytes[5997], 255);
    image_destroy(picture);
}

static void srgb_inverts_itself(void **state) {
    (void)state;
    for (int i = 0; i < 256; i++) {
        assert_true(fabs(image_srgb_encode(image_srgb_decode(i / 255.)) - i / 255.) < 1e-6);
        assert_true(i == 0 || image_srgb_decode(i / 255.) > image_srgb_decode((i - 1) / 255.));
    }
    assert_true(fabs(image_srgb_decode(0.5) - 0.214041) < 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(brightness_itself_does_not_matter),
        cmocka_unit_test(log_average_becomes_middle_gray),
        cmocka_unit_test(bright_parts_stay_apart),
        cmocka_unit_test(black_stays_black),
        cmocka_unit_test(odd_values_are_harmless),
        cmocka_unit_test(brighter_is_never_darker),
        cmocka_unit_test(srgb_inverts_itself),
    };
    return cmocka_run_group_tests(tests, link_module, NULL);
}
