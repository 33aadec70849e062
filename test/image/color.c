/* Colours in other primaries: there and back, and what is known of white and of brightness. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "image/color.h"
#include "support/close.h"

static const image_primaries srgb = {{.64, .33}, {.30, .60}, {.15, .06}, {.3127, .3290}};
static const image_primaries wide = {{.708, .292}, {.170, .797}, {.131, .046}, {.3127, .3290}};

static void assert_inverse(const image_color_matrix *a, const image_color_matrix *b) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += a->m[i][k] * b->m[k][j];
            assert_close(sum, i == j, 1e-12);
        }
}

static void there_and_back(void **state) {
    (void)state;
    const image_primaries *all[] = {&srgb, &wide, &image_radiance_primaries};
    for (int i = 0; i < 3; i++) {
        image_color_matrix from, to;
        assert_true(image_color_from_primaries(&from, all[i]));
        assert_true(image_color_to_primaries(&to, all[i]));
        assert_inverse(&from, &to);
        for (int row = 0; row < 3; row++) /* white stays white */
            assert_close(to.m[row][0] + to.m[row][1] + to.m[row][2], 1, 1e-12);
    }
    image_color_matrix from = image_color_from_xyz(), to = image_color_to_xyz();
    assert_inverse(&from, &to);
}

static void luminance_is_brightness(void **state) {
    (void)state;
    const image_color_matrix xyz = image_color_to_xyz();
    /* Radiance's header rounds its coefficients to these digits, from primaries of three. */
    assert_close(xyz.m[1][0], rgb_brightness((rgb){1, 0, 0}), 1e-4);
    assert_close(xyz.m[1][1], rgb_brightness((rgb){0, 1, 0}), 1e-4);
    assert_close(xyz.m[1][2], rgb_brightness((rgb){0, 0, 1}), 1e-4);
}

static void primaries_without_colours(void **state) {
    (void)state;
    image_color_matrix matrix;
    const image_primaries gray = {{.3, .3}, {.3, .3}, {.3, .3}, {.3, .3}}, nothing = {{0}, {0}, {0}, {0}};
    assert_false(image_color_to_primaries(&matrix, &gray));
    assert_false(image_color_to_primaries(&matrix, &nothing));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_and_back),
        cmocka_unit_test(luminance_is_brightness),
        cmocka_unit_test(primaries_without_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
