/* Palettes: Radiance's look like Radiance's, ours keep what they promise. */
#include "image/support.h"

#include <math.h>

#include "image/canvas.h"
#include "image/color.h"
#include "image/palette.h"
#include "image/palette_chart.h"
#include "support/close.h"

static const image_palette *find(const char *name) {
    const image_palette *palette = image_palette_find(name);
    assert_non_null(palette);
    return palette;
}

static void linear_color(const char *name, double at, double color[3]) {
    unsigned char bytes[3];
    image_palette_color(find(name), at, bytes);
    for (int c = 0; c < 3; c++)
        color[c] = image_srgb_decode(bytes[c] / 255.);
}

/* Relative luminance of sRGB. */
static double luminance(const char *name, double at) {
    double v[3];
    linear_color(name, at, v);
    return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
}

/* CIE lightness, 0 .. 100. */
static double lightness(const char *name, double at) {
    return 116 * cbrt(luminance(name, at)) - 16;
}

/* What Radiance's falsecolor gives, in linear light, measured on its pictures with pvalue. */
static void radiance_looks_like_radiance(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double at, color[3];
    } measured[] = {
        {"def", 0, {.1890, .0010, .2666}},
        {"def", 101 / 1024., {.0009, .0053, .4834}},
        {"def", 341 / 1024., {.0065, .4639, .1333}},
        {"def", 480 / 1024., {.2085, .2358, .0896}},
        {"def", 717 / 1024., {.4111, .0111, .0186}},
        {"def", 850 / 1024., {.8027, .0273, .0013}},
        {"def", 1000 / 1024., {.9941, .7910, .0151}},
        {"def", 1, {.9863, .9707, .0253}},
        {"spec", .125, {0, .3340, .6660}},
        {"spec", .375, {0, 1, 0}},
        {"spec", .75, {.5996, .4004, 0}},
        {"spec", 1, {1, 0, 0}},
        {"pm3d", .125, {.1006, 0, .4658}},
        {"pm3d", .25, {.2148, 0, 1}},
        {"pm3d", .75, {.7285, .1504, 0}},
        {"hot", .125, {.1155, 0, 0}},
        {"hot", .5, {1, .2148, 0}},
        {"hot", .75, {1, 1, .0508}},
        {"eco", .125, {.0488, 0, .5293}},
        {"eco", .25, {.2173, 0, .2173}},
        {"eco", .75, {1, .2148, 0}},
        {"tbo", 0, {.026, .0031, .0402}},
        {"tbo", .25, {.0176, .5059, .8418}},
        {"tbo", .5, {.3730, .9824, .0410}},
        {"tbo", .75, {.9668, .2207, .0098}},
        {"tbo", 341 / 1024., {.0067, .7832, .4814}},
        {"tbo", 717 / 1024., {.9902, .3779, .0264}},
    };
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        double color[3];
        linear_color(measured[i].name, measured[i].at, color);
        for (int c = 0; c < 3; c++)
            if (fabs(color[c] - measured[i].color[c]) > 0.01)
                fail_msg("%s at %g, channel %d: %g, not %g", measured[i].name, measured[i].at, c, color[c],
                         measured[i].color[c]);
    }
}

static void brighter_is_more(void **state) {
    (void)state;
    static const char *const names[] = {"viridis", "gray", "hot"};
    for (int n = 0; n < 3; n++)
        /* Wide enough steps for the rounding to 8 bits not to matter. */
        for (int i = 1; i <= 64; i++)
            assert_true(luminance(names[n], i / 64.) > luminance(names[n], (i - 1) / 64.));
}

static void steps_of_lightness_are_even(void **state) {
    (void)state;
    double low = lightness("viridis", 0), high = lightness("viridis", 1);
    assert_close(low, 14, 2);
    assert_close(high, 91, 2);
    for (int i = 0; i <= 100; i++)
        assert_close(lightness("viridis", i / 100.), low + i / 100. * (high - low), 2.5);
}

static void both_sides_of_a_difference_are_alike(void **state) {
    (void)state;
    double middle[3];
    linear_color("diverging", 0.5, middle);
    assert_close(middle[0], middle[1], 1e-9);
    assert_close(middle[0], middle[2], 1e-9);
    for (int i = 1; i <= 100; i++) {
        double off = i / 200., before = (i - 1) / 200.;
        assert_close(lightness("diverging", 0.5 + off), lightness("diverging", 0.5 - off), 3);
        assert_true(lightness("diverging", 0.5 + off) < lightness("diverging", 0.5 + before));
        assert_true(lightness("diverging", 0.5 - off) < lightness("diverging", 0.5 - before));
    }
}

/* What protanopes and deuteranopes see, after Vienot, Brettel and Mollon 1999: linear light to linear light. */
static void seen_without_red_or_green(bool red_missing, const double v[3], double seen[3]) {
    double share = red_missing ? 0.11238 : 0.29275, blue = red_missing ? 0.00401 : -0.02234;
    seen[0] = seen[1] = share * v[0] + (1 - share) * v[1];
    seen[2] = blue * v[0] - blue * v[1] + v[2];
}

/* More and less stay apart for every eye: one is bluish, the other yellowish. */
static void differences_are_seen_by_all(void **state) {
    (void)state;
    for (int eye = 0; eye < 2; eye++)
        for (int i = 10; i <= 50; i++) {
            double less[3], more[3], less_seen[3], more_seen[3];
            linear_color("diverging", 0.5 - i / 100., less);
            linear_color("diverging", 0.5 + i / 100., more);
            seen_without_red_or_green(eye, less, less_seen);
            seen_without_red_or_green(eye, more, more_seen);
            assert_true(less_seen[2] > 1.3 * less_seen[0]);
            assert_true(more_seen[2] < 0.8 * more_seen[0]);
        }
}

static void ends_go_on(void **state) {
    (void)state;
    char list[256];
    image_palette_list(list, sizeof list);
    assert_string_equal(list, "def, spec, pm3d, hot, eco, tbo, viridis, gray, diverging, vivid");
    for (char *name = strtok(list, ", "); name; name = strtok(NULL, ", ")) {
        static const double beyond[][2] = {{-3, 0}, {7, 1}, {-INFINITY, 0}, {INFINITY, 1}, {NAN, 0}};
        for (int i = 0; i < 5; i++) {
            unsigned char color[3], end[3];
            image_palette_color(find(name), beyond[i][0], color);
            image_palette_color(find(name), beyond[i][1], end);
            assert_memory_equal(color, end, 3);
        }
    }
    assert_null(image_palette_find("rainbow"));
    assert_null(image_palette_find(""));
    image_palette_list(list, 7);
    assert_string_equal(list, "def, s");
}

/* To be seen on a backdrop, whose gray goes up to 3/4 of 255. */
static void vivid_is_bright(void **state) {
    (void)state;
    for (int i = 0; i <= 100; i++) {
        double color[3];
        linear_color("vivid", i / 100., color);
        assert_true(fmax(fmax(color[0], color[1]), color[2]) > image_srgb_decode(0.75));
        assert_true(fmin(fmin(color[0], color[1]), color[2]) < 0.15);
    }
}

static void palettes_are_counted(void **state) {
    (void)state;
    int count = 0;
    for (const image_palette *palette; (palette = image_palette_at(count)); count++)
        assert_ptr_equal(palette, find(image_palette_name(palette)));
    assert_int_equal(count, 10);
}

static void chart_shows_all(void **state) {
    (void)state;
    image_canvas canvas;
    assert_true(image_draw_palettes(&canvas));
    for (int i = 0; image_palette_at(i); i++) {
        unsigned char color[3];
        image_palette_color(image_palette_at(i), 511.5 / 512, color);
        assert_memory_equal(canvas.bytes + 3 * ((20 + 40 * i) * canvas.width + canvas.width - 13), color, 3);
    }
    image_canvas_free(&canvas);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radiance_looks_like_radiance),
        cmocka_unit_test(brighter_is_more),
        cmocka_unit_test(steps_of_lightness_are_even),
        cmocka_unit_test(both_sides_of_a_difference_are_alike),
        cmocka_unit_test(differences_are_seen_by_all),
        cmocka_unit_test(ends_go_on),
        cmocka_unit_test(vivid_is_bright),
        cmocka_unit_test(palettes_are_counted),
        cmocka_unit_test(chart_shows_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
