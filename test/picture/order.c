/* The order of pixels: each comes once, coarse grids first. */
#include "picture/support.h"

#include "picture/order.h"

static void check(int width, int height, int spacing, int effective) {
    order o = order_create(width, height, spacing);
    size_t count = order_count(&o), pixels = (size_t)width * (size_t)height, seen = 0;
    size_t coarse = (size_t)((width + effective - 1) / effective) * (size_t)((height + effective - 1) / effective);
    int *times = calloc(pixels, sizeof *times);
    assert_non_null(times);
    for (size_t i = 0; i < count; i++) {
        order_piece p = order_piece_at(&o, i);
        for (int y = p.top; y < p.bottom; y += p.step_down)
            for (int x = p.left; x < p.right; x += p.step) {
                assert_true(x >= 0 && y >= 0 && x < width && y < height);
                times[(size_t)y * (size_t)width + (size_t)x]++;
                if (seen++ < coarse)
                    assert_true(x % effective == 0 && y % effective == 0);
            }
    }
    assert_int_equal(seen, pixels);
    for (size_t i = 0; i < pixels; i++)
        assert_int_equal(times[i], 1);
    free(times);
}

static void each_pixel_comes_once_coarse_first(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {16, 16}, {17, 15}, {100, 43}, {3, 200}, {64, 48}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        check(sizes[i][0], sizes[i][1], -3, 1);
        check(sizes[i][0], sizes[i][1], 1, 1);
        check(sizes[i][0], sizes[i][1], 2, 2);
        check(sizes[i][0], sizes[i][1], 7, 4);
        check(sizes[i][0], sizes[i][1], 16, 16);
        check(sizes[i][0], sizes[i][1], 1000, 16);
    }
}

/* The first quarter of a pass leaves no quarter of the picture out. */
static void a_pass_is_spread_over_the_picture(void **state) {
    (void)state;
    order o = order_create(512, 512, 4);
    size_t tiles = order_count(&o) / 5;
    int found[2][2] = {{0}};
    for (size_t i = 0; i < tiles / 4; i++) {
        order_piece p = order_piece_at(&o, i);
        found[p.top >= 256][p.left >= 256]++;
    }
    for (int i = 0; i < 4; i++)
        assert_true(found[i / 2][i % 2] > (int)tiles / 4 / 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pixel_comes_once_coarse_first),
        cmocka_unit_test(a_pass_is_spread_over_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
