/* False colour pictures: what stands where, in which colour. */
#include "image/support.h"

#include <float.h>
#include <math.h>

#include "image/color.h"
#include "image/false_color.h"
#include "support/close.h"

enum { WIDTH = 400, HEIGHT = 300 };

/* Values grow by one from column to column; from 0 at the middle of the first. */
static image_values ramp(void) {
    image_values values = {WIDTH, HEIGHT, malloc(WIDTH * HEIGHT * sizeof(float)), 0};
    assert_non_null(values.values);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        values.values[i] = (float)(i % WIDTH);
    return values;
}

static image_false_color settings(image_false_color_style style) {
    return (image_false_color){.style = style,
                               .palette = image_palette_find("def"),
                               .scale = {0, WIDTH, 0, 8},
                               .label = "cd/m2",
                               .decimals = -1,
                               .legend_width = -1,
                               .legend_height = -1,
                               .missing = "B = 0"};
}

static image_canvas draw(const image_values *values, const image *backdrop, const image_false_color *f) {
    image_canvas canvas;
    assert_true(image_draw_false_color(&canvas, values, backdrop, f));
    return canvas;
}

static const unsigned char *pixel(const image_canvas *canvas, int x, int y) {
    return canvas->bytes + 3 * (y * canvas->width + x);
}

static int is_black(const unsigned char *color) {
    return color[0] == 0 && color[1] == 0 && color[2] == 0;
}

static void expect_color(const unsigned char *color, const image_false_color *f, double at) {
    unsigned char expected[3];
    image_palette_color(f->palette, at, expected);
    for (int c = 0; c < 3; c++)
        if (color[c] != expected[c])
            fail_msg("at %g: %d %d %d, not %d %d %d", at, color[0], color[1], color[2], expected[0], expected[1],
                     expected[2]);
}

static void smooth_colors_are_the_palettes(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_SMOOTH);
    image_canvas canvas = draw(&values, NULL, &f);
    int left = canvas.width - WIDTH;
    for (int x = 0; x < WIDTH; x++)
        for (int y = 0; y < HEIGHT; y += HEIGHT - 1)
            expect_color(pixel(&canvas, left + x, y), &f, (double)x / WIDTH);
    image_canvas_free(&canvas);
    f.scale = (image_value_scale){0, 100, 2, 4};
    canvas = draw(&values, NULL, &f);
    left = canvas.width - WIDTH;
    for (int x = 0; x < WIDTH; x++)
        expect_color(pixel(&canvas, left + x, 7), &f, x > 0 ? 1 + log10(x / 100.) / 2 : 0);
    image_canvas_free(&canvas);
    image_values_free(&values);
}

static void posters_have_a_color_for_each_division(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_POSTER);
    f.scale.high = WIDTH / 2;
    image_canvas canvas = draw(&values, NULL, &f);
    for (int x = 0; x < WIDTH; x++)
        expect_color(pixel(&canvas, canvas.width - WIDTH + x, 5), &f, ((x < 200 ? x / 25 : 7) + 0.5) / 8);
    image_canvas_free(&canvas);
    image_values_free(&values);
}

/* A tenth of a division to both sides of each but the lowest; the backdrop elsewhere. */
static void bands_lie_around_divisions(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_BANDS);
    image *backdrop = image_create(WIDTH, HEIGHT, 3, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        backdrop->channels[0][i] = backdrop->channels[1][i] = backdrop->channels[2][i] = 1;
    image_canvas canvas = draw(&values, backdrop, &f);
    for (int x = 0; x < WIDTH; x++) {
        const unsigned char *color = pixel(&canvas, canvas.width - WIDTH + x, 5);
        int off = x % 50 > 25 ? 50 - x % 50 : x % 50;
        if (x > 25 && off < 5)
            expect_color(color, &f, (double)x / WIDTH);
        else if (off != 5)
            assert_true(color[0] == color[1] && color[0] == color[2] && color[0] > 50);
    }
    image_canvas_free(&canvas);
    image_destroy(backdrop);
    image_values_free(&values);
}

/* At 50, 100, ... 350: where the field is straight, smoothing moves nothing. */
static void lines_stand_at_divisions(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_LINES);
    image_canvas canvas = draw(&values, NULL, &f);
    int left = canvas.width - WIDTH;
    for (int x = 3; x < WIDTH - 3; x++) {
        const unsigned char *color = pixel(&canvas, left + x, 150);
        int off = x % 50 > 25 ? 50 - x % 50 : x % 50;
        if (x > 25 && off == 0)
            expect_color(color, &f, (double)x / WIDTH);
        else if (x < 25 || off > 1)
            assert_true(is_black(color));
    }
    image_canvas_free(&canvas);
    image_values_free(&values);
}

/* What a colour in the legend's bar says is what it says in the picture. */
static void legend_has_the_pictures_colors(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_SMOOTH);
    f.palette = image_palette_find("gray");
    f.scale.low = -100;
    image_canvas canvas = draw(&values, NULL, &f);
    /* The bar's extent by the first column of it. */
    int x = 12, top = 0, bottom = HEIGHT - 1;
    while (top < HEIGHT && pixel(&canvas, x, top)[0] < 250)
        top++;
    while (bottom > top && is_black(pixel(&canvas, x, bottom)))
        bottom--;
    assert_true(top > 20 && top < 60 && bottom > HEIGHT - 20);
    for (int y = top; y <= bottom; y++) {
        int expected = (int)(255 * (bottom + 0.5 - y) / (bottom + 1 - top) + 0.5);
        assert_in_range(pixel(&canvas, x, y)[0], expected - 2 < 0 ? 0 : expected - 2, expected + 2);
    }
    image_canvas_free(&canvas);
    image_values_free(&values);
}

static void legends_have_the_size_wanted(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_SMOOTH);
    static const struct {
        int width, height, canvas_width, canvas_height;
    } cases[] = {{100, 200, WIDTH + 100, HEIGHT},
                 {70, 500, WIDTH + 70, 500},
                 {0, 200, WIDTH, HEIGHT},
                 {100, 0, WIDTH, HEIGHT},
                 {3, 3, WIDTH + 3, HEIGHT}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        f.legend_width = cases[i].width;
        f.legend_height = cases[i].height;
        image_canvas canvas = draw(&values, NULL, &f);
        assert_int_equal(canvas.width, cases[i].canvas_width);
        assert_int_equal(canvas.height, cases[i].canvas_height);
        /* A legend too small does not reach into the picture. */
        expect_color(pixel(&canvas, canvas.width - WIDTH, 10), &f, 0);
        image_canvas_free(&canvas);
    }
    image_values_free(&values);
}

/* All but the one of no difference. */
static void lines_of_differences_leave_out_zero(void **state) {
    (void)state;
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_LINES);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        values.values[i] = (float)(i % WIDTH - 200) / 200;
    f.scale = (image_value_scale){-1, 1, 0, 8};
    image_canvas canvas = draw(&values, NULL, &f);
    int left = canvas.width - WIDTH;
    for (int line = 1; line < 8; line++) {
        const unsigned char *color = pixel(&canvas, left + 50 * line, 150);
        if (line == 4)
            assert_true(is_black(color));
        else
            expect_color(color, &f, line / 8.);
    }
    image_canvas_free(&canvas);
    image_values_free(&values);
}

static image *gray_picture(int width, int height, const float *values) {
    image *picture = image_create(width, height, 3, NULL);
    assert_non_null(picture);
    for (int c = 0; c < 3; c++)
        memcpy(picture->channels[c], values, (size_t)(width * height) * sizeof(float));
    return picture;
}

static void differences_are_relative(void **state) {
    (void)state;
    image *a = gray_picture(6, 1, (const float[]){1, 3, 0, 5, 0, -1}),
          *b = gray_picture(6, 1, (const float[]){2, 2, 4, 0, 0, 1});
    image_values values;
    assert_true(image_relative_difference(&values, a, b));
    assert_int_equal(values.missing, 2);
    static const double expected[] = {-0.5, 0.5, -1, NAN, NAN, -1};
    for (int i = 0; i < 6; i++)
        if (isnan(expected[i]))
            assert_true(isnan(values.values[i]));
        else
            assert_close(values.values[i], expected[i], 1e-7);
    double usual;
    assert_true(image_values_usual_size(&values, &usual));
    assert_close(usual, 1, 1e-7);
    image_false_color f = settings(IMAGE_FALSE_COLOR_SMOOTH);
    f.palette = image_palette_find("diverging");
    f.scale = (image_value_scale){-1, 1, 0, 8};
    image_canvas canvas = draw(&values, NULL, &f);
    expect_color(pixel(&canvas, canvas.width - 6, 0), &f, 0.25);
    expect_color(pixel(&canvas, canvas.width - 5, 0), &f, 0.75);
    const unsigned char *missing = pixel(&canvas, canvas.width - 3, 0);
    assert_true(missing[0] == missing[1] && missing[0] == missing[2]);
    assert_in_range(missing[0], 60, 160);
    image_canvas_free(&canvas);
    image_values_free(&values);
    image_destroy(a);
    image_destroy(b);
}

static void luminances_are_179_times_brightness(void **state) {
    (void)state;
    image *picture = gray_picture(4, 1, (const float[]){1, NAN, -3, FLT_MAX});
    image_values values;
    assert_true(image_values_of(&values, picture, IMAGE_LUMINOUS_EFFICACY));
    assert_close(values.values[0], 179, 1e-4);
    assert_true(values.values[1] == 0 && values.values[2] == 0);
    assert_true(isfinite(values.values[3]) && values.missing == 0);
    assert_true(image_values_largest(&values) == values.values[3]);
    image_values_free(&values);
    image_destroy(picture);
}

/* A green beyond the primaries, 100.25 cd/m2 of chromaticity (.17, .75): its luminance is there only with its negative
 * red and blue. */
static void luminances_count_negative_channels(void **state) {
    (void)state;
    static const char header[] = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
    static const unsigned char xyze[4] = {45, 200, 21, 135};
    unsigned char bytes[sizeof header + 3];
    memcpy(bytes, header, sizeof header - 1);
    memcpy(bytes + sizeof header - 1, xyze, 4);
    char directory[PATH_MAX], path[PATH_MAX + 64];
    make_directory(directory);
    write_bytes(path_in(path, directory, "green.hdr"), bytes, sizeof bytes);
    image *picture = read_image(path);
    unlink(path);
    remove_directory(directory);
    assert_true(picture->channels[0][0] < 0 && picture->channels[2][0] < 0);
    image_values values;
    assert_true(image_values_of(&values, picture, IMAGE_LUMINOUS_EFFICACY));
    assert_close(values.values[0], 100.25, 0.01);
    image_values_free(&values);
    /* What is negative in sum is nothing. */
    set_gray(picture, 0, -INFINITY);
    picture->channels[1][0] = 1;
    assert_true(image_values_of(&values, picture, IMAGE_LUMINOUS_EFFICACY));
    assert_true(values.values[0] == 0);
    image_values_free(&values);
    image_destroy(picture);
}

/* One pixel in two hundred far off does not count. */
static void stray_pixels_do_not_set_the_scale(void **state) {
    (void)state;
    image_values values = {200, 1, malloc(200 * sizeof(float)), 0};
    for (int i = 0; i < 200; i++)
        values.values[i] = i % 2 ? 0.1F : -0.1F;
    values.values[17] = -50;
    double usual;
    assert_true(image_values_usual_size(&values, &usual));
    assert_close(usual, 0.1, 1e-7);
    for (int i = 0; i < 200; i++)
        values.values[i] = NAN;
    assert_true(image_values_usual_size(&values, &usual));
    assert_close(usual, 0, 0);
    image_values_free(&values);
}

/* A white ring where the extrema are, and nothing elsewhere but their numbers. */
static void extrema_are_marked(void **state) {
    (void)state;
    image_values values = ramp();
    values.values[100 * WIDTH + 300] = 1000;
    values.values[200 * WIDTH + 50] = -1;
    values.values[3] = NAN;
    image_false_color f = settings(IMAGE_FALSE_COLOR_NONE);
    f.extrema = true;
    image_canvas canvas = draw(&values, NULL, &f);
    assert_int_equal(canvas.width, WIDTH);
    static const int marks[2][2] = {{300, 100}, {50, 200}};
    for (int m = 0; m < 2; m++) {
        assert_true(is_black(pixel(&canvas, marks[m][0], marks[m][1])));
        assert_true(pixel(&canvas, marks[m][0] - 6, marks[m][1])[0] > 200);
        assert_true(pixel(&canvas, marks[m][0], marks[m][1] - 6)[0] > 200);
    }
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if (abs(y - 100) > 12 && abs(y - 200) > 12)
                assert_true(is_black(pixel(&canvas, x, y)));
    image_canvas_free(&canvas);
    image_values_free(&values);
}

/* Every size, style and value: no crash, no undefined behaviour. */
static void odd_pictures_are_drawn(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 200}, {200, 1}, {3, 2}};
    uint64_t seed = 11;
    for (int s = 0; s < 4; s++)
        for (int style = IMAGE_FALSE_COLOR_SMOOTH; style <= IMAGE_FALSE_COLOR_NONE; style++)
            for (int decades = 0; decades <= 60; decades += 30) {
                int count = sizes[s][0] * sizes[s][1];
                image_values values = {sizes[s][0], sizes[s][1], malloc((size_t)count * sizeof(float)), 0};
                for (int i = 0; i < count; i++) {
                    double u = random_unit(&seed);
                    values.values[i] = u < .2 ? NAN : u < .3 ? FLT_MAX : u < .4 ? -FLT_MAX : (float)exp(100 * u - 60);
                    values.missing += u < .2;
                }
                image_false_color f = settings((image_false_color_style)style);
                f.scale = (image_value_scale){decades ? 0 : -1, 1e-20, decades, 1 + style * 60};
                f.extrema = true;
                f.label = "";
                image_canvas canvas = draw(&values, NULL, &f);
                assert_true(canvas.width >= sizes[s][0] && canvas.height >= sizes[s][1]);
                image_canvas_free(&canvas);
                image_values_free(&values);
            }
}

/* Written colours are the canvas's: to the bit in PNG, and within a step of 8 bits in HDR. */
static void files_hold_the_canvas(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    image_values values = ramp();
    image_false_color f = settings(IMAGE_FALSE_COLOR_SMOOTH);
    image_canvas canvas = draw(&values, NULL, &f);
    image header = {.pixel_aspect = 1, .command = "gfalsecolor", .software = "Graze"};
    char directory[PATH_MAX], path[PATH_MAX + 64];
    make_directory(directory);
    static const char *const names[] = {"a.png", "a.hdr", "a.exr"};
    for (int n = 0; n < 3; n++) {
        EXPECT_OK(&c, image_canvas_write(&canvas, &header, path_in(path, directory, names[n]), &c.report));
        image *picture = read_image(path);
        unlink(path);
        assert_int_equal(picture->width, canvas.width);
        int allowed = n == 1 ? 2 : 0;
        for (int i = 0; i < canvas.width * canvas.height; i++) {
            /* HDR has one exponent for three channels: what is dark beside what is bright is coarse. */
            int brightest = 0;
            for (int k = 0; k < 3; k++)
                brightest = canvas.bytes[3 * i + k] > brightest ? canvas.bytes[3 * i + k] : brightest;
            for (int k = 0; k < 3; k++) {
                int byte = (int)lround(255 * image_srgb_encode(picture->channels[k][i]));
                if (n != 1 || canvas.bytes[3 * i + k] > brightest / 2)
                    assert_true(abs(byte - canvas.bytes[3 * i + k]) <= allowed);
            }
        }
        image_destroy(picture);
    }
    remove_directory(directory);
    image_canvas_free(&canvas);
    image_values_free(&values);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_colors_are_the_palettes),
        cmocka_unit_test(posters_have_a_color_for_each_division),
        cmocka_unit_test(bands_lie_around_divisions),
        cmocka_unit_test(lines_stand_at_divisions),
        cmocka_unit_test(lines_of_differences_leave_out_zero),
        cmocka_unit_test(legend_has_the_pictures_colors),
        cmocka_unit_test(legends_have_the_size_wanted),
        cmocka_unit_test(differences_are_relative),
        cmocka_unit_test(luminances_are_179_times_brightness),
        cmocka_unit_test(luminances_count_negative_channels),
        cmocka_unit_test(stray_pixels_do_not_set_the_scale),
        cmocka_unit_test(extrema_are_marked),
        cmocka_unit_test(odd_pictures_are_drawn),
        cmocka_unit_test(files_hold_the_canvas),
    };
    return cmocka_run_group_tests(tests, link_module, NULL);
}
