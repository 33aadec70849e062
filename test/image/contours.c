/* Lines of equal luminance over pictures. */
#include "image/support.h"

#include <float.h>
#include <math.h>

#include "image/color.h"
#include "image/palette.h"

static image *draw_contours(const image *picture, int per_decade) {
    captured c;
    captured_begin(&c);
    char directory[PATH_MAX], path[PATH_MAX + 64];
    path_in(path, make_directory(directory), "contours.png");
    EXPECT_OK(&c, image_write_contours(picture, path, per_decade, &c.report));
    image *drawing = read_image(path);
    unlink(path);
    remove_directory(directory);
    return drawing;
}

/* How vivid a pixel is, linear: a line's colours are, all else here is gray. */
static float vividness(const image *drawing, int x, int y) {
    size_t i = (size_t)(y * drawing->width + x);
    float low = FLT_MAX, high = 0;
    for (int c = 0; c < 3; c++) {
        low = fminf(low, drawing->channels[c][i]);
        high = fmaxf(high, drawing->channels[c][i]);
    }
    return high - low;
}

static int is_line(const image *drawing, int x, int y) {
    return vividness(drawing, x, y) > 0.15f;
}

/* Luminance falls by a factor of ten each 100 pixels to the right: the lines of 2 levels a decade stand upright, 50
 * pixels apart, and are one to three pixels wide with their soft edges. */
static void lines_stand_where_they_belong(void **state) {
    (void)state;
    enum { WIDTH = 440, HEIGHT = 40 };
    image *picture = image_create(WIDTH, HEIGHT, 3, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        set_gray(picture, i, (float)(pow(10, 3.7 - (i % WIDTH + 0.5) / 100) / 179));
    image *drawing = draw_contours(picture, 2);
    int left = drawing->width - WIDTH;
    assert_in_range(left, 50, 150);
    /* log10 of the luminance is 3.7 - x / 100: levels 3.5, 3, ... down to what is four decades below the maximum. */
    for (int y = 0; y < HEIGHT; y++) {
        int lines = 0;
        for (int x = 0; x < WIDTH; x++)
            if (is_line(drawing, left + x, y) && (x == 0 || !is_line(drawing, left + x - 1, y))) {
                int width = 0;
                while (x + width < WIDTH && is_line(drawing, left + x + width, y))
                    width++;
                assert_in_range(width, 1, 3);
                double middle = x + width / 2.;
                if (fabs(middle - (20 + 50 * lines)) > 1)
                    fail_msg("line %d at %g", lines, middle);
                lines++;
            }
        assert_int_equal(lines, 8);
    }
    image_destroy(drawing);
    image_destroy(picture);
}

/* A line right on a column of pixels has soft edges: the pixels beside are touched, the next are not. */
static void lines_are_thin(void **state) {
    (void)state;
    image *picture = image_create(420, 30, 3, NULL);
    for (int i = 0; i < 420 * 30; i++)
        set_gray(picture, i, (float)(pow(10, 2.9 - (i % 420) / 210.) / 179));
    image *drawing = draw_contours(picture, 1);
    /* 100 cd/m^2 */
    int x = drawing->width - 420 + 189;
    float middle = vividness(drawing, x, 15), beside = vividness(drawing, x + 1, 15);
    assert_true(middle > 0.3f);
    assert_true(beside > 0 && beside < 0.5f * middle);
    assert_true(vividness(drawing, x + 2, 15) == 0);
    image_destroy(drawing);
    image_destroy(picture);
}

static void expect_color(const image *drawing, int x, double at) {
    unsigned char expected[3];
    image_palette_color(image_palette_find("vivid"), at, expected);
    for (int c = 0; c < 3; c++) {
        double byte = 255 * image_srgb_encode(drawing->channels[c][15 * drawing->width + x]);
        if (fabs(byte - expected[c]) > 1)
            fail_msg("at %g, channel %d: %g, not %d", at, c, byte, expected[c]);
    }
}

/* The lowest level has the palette's first colour, the highest its last, a single one that in the middle: where a line
 * runs right through a column of pixels. */
static void colors_are_vivid(void **state) {
    (void)state;
    static const struct { int per_decade, level_count; } cases[] = {{1, 2}, {2, 4}};
    image *picture = image_create(420, 30, 3, NULL);
    for (int i = 0; i < 420 * 30; i++)
        set_gray(picture, i, (float)(pow(10, 2.9 - (i % 420) / 210.) / 179));
    for (int k = 0; k < 2; k++) {
        image *drawing = draw_contours(picture, cases[k].per_decade);
        for (int i = 0; i < cases[k].level_count; i++)
            expect_color(drawing, drawing->width - 420 + 399 - 210 * i / cases[k].per_decade,
                         (double)i / (cases[k].level_count - 1));
        image_destroy(drawing);
    }
    /* Of 1, 10, 100 ... only 100 comes by. */
    for (int i = 0; i < 420 * 30; i++)
        set_gray(picture, i, (float)(pow(10, 2 + (i % 420 - 126) / 420.) / 179));
    image *drawing = draw_contours(picture, 1);
    expect_color(drawing, drawing->width - 420 + 126, 0.5);
    image_destroy(drawing);
    image_destroy(picture);
}

static int count_line_pixels(const image *drawing, int from) {
    int count = 0;
    for (int y = 0; y < drawing->height; y++)
        for (int x = from; x < drawing->width; x++)
            count += is_line(drawing, x, y);
    return count;
}

/* A plain has no lines, be its luminance exactly that of a level; neither has black. */
static void plains_have_no_lines(void **state) {
    (void)state;
    static const float values[] = {100 / 179.f, 1, 0};
    for (int i = 0; i < 3; i++) {
        image *picture = uniform(400, 30, values[i]);
        image *drawing = draw_contours(picture, 4);
        assert_int_equal(count_line_pixels(drawing, drawing->width - 400), 0);
        image_destroy(drawing);
        image_destroy(picture);
    }
}

/* Pictures of any size and content, in any format: no crash, and large enough to be looked at. */
static void odd_pictures_are_drawn(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 300}, {300, 1}, {2, 2}, {640, 480}};
    for (int s = 0; s < 5; s++) {
        uint64_t seed = 7;
        image *picture = image_create(sizes[s][0], sizes[s][1], 3, NULL);
        for (int i = 0; i < sizes[s][0] * sizes[s][1]; i++)
            for (int c = 0; c < 3; c++) {
                double u = random_unit(&seed);
                picture->channels[c][i] = u < .1 ? NAN : u < .2 ? INFINITY : u < .3 ? -1 : (float)exp(200 * u - 120);
            }
        image *drawing = draw_contours(picture, 100);
        assert_true(drawing->height >= 60 && drawing->width >= sizes[s][0]);
        image_destroy(drawing);
        image_destroy(picture);
    }
}

static void contours_know_their_formats(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    image *picture = uniform(20, 20, 1);
    char directory[PATH_MAX], path[PATH_MAX + 64];
    make_directory(directory);
    EXPECT_OK(&c, image_write_contours(picture, path_in(path, directory, "a.hdr"), 2, &c.report));
    image_destroy(read_image(path));
    unlink(path);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "no format is known",
                   image_write_contours(picture, path_in(path, directory, "a.xyz"), 2, &c.report));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "0 levels", image_write_contours(picture, path, 0, &c.report));
    remove_directory(directory);
    image_destroy(picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_stand_where_they_belong),
        cmocka_unit_test(lines_are_thin),
        cmocka_unit_test(colors_are_vivid),
        cmocka_unit_test(plains_have_no_lines),
        cmocka_unit_test(odd_pictures_are_drawn),
        cmocka_unit_test(contours_know_their_formats),
    };
    return cmocka_run_group_tests(tests, link_module, NULL);
}
