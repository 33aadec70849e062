/* Legends: which levels have a text where there is not room for all. */
#include "image/support.h"

#include "image/font.h"
#include "image/legend.h"

enum { WIDTH = 100, MOST = 80, TICK_COLUMN = 19, DASH_COLUMN = 15, SHORT_DASH_COLUMN = 8 };

static bool gray(const void *user, double at, unsigned char color[3]) {
    (void)user;
    memset(color, (int)(200 * at), 3);
    return true;
}

/* The first row of each mark in the column, from the top, of a legend in letters of the least size. */
typedef struct marks {
    int count, rows[MOST];
} marks;

static bool is_lit(const image_canvas *canvas, int x, int y) {
    const unsigned char *color = canvas->bytes + 3 * (y * canvas->width + x);
    return y >= 0 && (color[0] || color[1] || color[2]);
}

static marks marks_in(int column, const image_levels *levels, bool dashes, int height) {
    image_legend legend = {.label = "", .color = dashes ? NULL : gray, .centered = levels->scale->low < 0};
    image_legend_entry *entries = image_legend_entries(levels, -1, &legend.count);
    assert_non_null(entries);
    legend.entries = entries;
    image_legend_size size = {.width = WIDTH, .height = height, .scale = 1};
    image_canvas canvas;
    assert_true(image_canvas_create(&canvas, WIDTH, height));
    image_legend_draw(&legend, &size, &canvas);
    marks m = {0, {0}};
    for (int y = 0; y < height; y++)
        if (is_lit(&canvas, column, y) && (y == 0 || !is_lit(&canvas, column, y - 1))) {
            assert_true(m.count < MOST);
            m.rows[m.count++] = y;
        }
    image_canvas_free(&canvas);
    free(entries);
    return m;
}

/* Of texts. */
static marks marks_of(const image_levels *levels, bool dashes, int height) {
    return marks_in(dashes ? DASH_COLUMN : TICK_COLUMN, levels, dashes, height);
}

static marks marks_around_zero(int divisions, bool dashes, int height) {
    image_value_scale scale = {-1, 1, 0, divisions};
    image_levels levels = {.scale = &scale,
                           .palette = image_palette_find("vivid"),
                           .first = 0,
                           .count = divisions + 1,
                           .without = dashes && divisions % 2 == 0 ? divisions / 2 : -1};
    return marks_of(&levels, dashes, height);
}

static void expect_apart(const marks *m, int least) {
    for (int i = 1; i < m->count; i++)
        assert_true(m->rows[i] - m->rows[i - 1] >= least);
}

/* Symmetric, texts apart, both ends marked; 0 as well where it is a level, and alone where there is no more room. */
static void differences_keep_zero_and_the_ends(void **state) {
    (void)state;
    for (int dashes = 0; dashes < 2; dashes++)
        for (int height = 80; height < 400; height += 7) {
            marks ends = marks_around_zero(1, dashes, height);
            assert_int_equal(ends.count, 2);
            for (int divisions = 2; divisions <= 60; divisions++) {
                marks m = marks_around_zero(divisions, dashes, height);
                expect_apart(&m, IMAGE_FONT_HEIGHT);
                int middle = ends.rows[0] + ends.rows[1];
                for (int i = 0; i < m.count; i++)
                    assert_in_range(m.rows[i] + m.rows[m.count - 1 - i], middle - 1, middle + 1);
                bool zero = !dashes && divisions % 2 == 0;
                assert_int_equal(m.count % 2, zero);
                assert_true(m.count >= 2 || zero);
                if (m.count > 1)
                    assert_int_equal(m.rows[0], ends.rows[0]);
            }
        }
}

static void short_differences_have_zero(void **state) {
    (void)state;
    /* A scale of 26 pixels, 13 to each side. */
    int height = 6 + 2 * (IMAGE_FONT_HEIGHT + 5) + 26 + 6 + (IMAGE_FONT_HEIGHT + 1) / 2;
    marks ends = marks_around_zero(1, false, height), m = marks_around_zero(8, false, height - 6);
    assert_int_equal(ends.count, 2);
    assert_int_equal(m.count, 1);
    marks three = marks_around_zero(8, false, height + 10);
    assert_int_equal(three.count, 3);
}

/* The highest in any case, the others evenly below; all have a dash. */
static void others_are_counted_from_the_top(void **state) {
    (void)state;
    image_value_scale scale = {0, 1, 0, 32};
    image_levels levels = {&scale, image_palette_find("vivid"), 1, 32, -1};
    marks all = marks_of(&levels, true, 600), few = marks_of(&levels, true, 200);
    assert_int_equal(all.count, 32);
    assert_true(few.count >= 10 && few.count < 20);
    assert_int_equal(few.rows[0], all.rows[0]);
    assert_int_equal(marks_in(SHORT_DASH_COLUMN, &levels, true, 200).count, 32);
    expect_apart(&few, IMAGE_FONT_HEIGHT);
    for (int i = 2; i < few.count; i++)
        assert_in_range(few.rows[i] - few.rows[i - 1], few.rows[1] - few.rows[0] - 1, few.rows[1] - few.rows[0] + 1);
}

/* Lines without their numbers tell nothing: smaller letters rather than fewer. A bar can do without. */
static void dashes_get_smaller_letters(void **state) {
    (void)state;
    image_value_scale scale = {0, 1000, 3, 30};
    image_levels levels = {&scale, image_palette_find("vivid"), 1, 30, -1};
    image_legend legend = {.label = "cd/m2"};
    image_legend_entry *entries = image_legend_entries(&levels, -1, &legend.count);
    assert_non_null(entries);
    legend.entries = entries;
    double scales[2];
    static const int heights[2] = {1000, 400};
    for (int i = 0; i < 2; i++)
        scales[i] = image_legend_fit(&legend, heights[i], -1, -1).scale;
    legend.color = gray;
    assert_true(image_legend_fit(&legend, 1000, -1, -1).scale == 3.5);
    assert_true(image_legend_fit(&legend, 400, -1, -1).scale == 1.5);
    assert_true(scales[0] == 3);
    assert_true(scales[1] == 1);
    free(entries);
    /* Where even the smallest do not help they stay as they suit the picture. */
    scale.divisions = levels.count = 200;
    legend.color = NULL;
    entries = image_legend_entries(&levels, -1, &legend.count);
    assert_non_null(entries);
    legend.entries = entries;
    assert_true(image_legend_fit(&legend, 1000, -1, -1).scale == 3.5);
    free(entries);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(differences_keep_zero_and_the_ends),
        cmocka_unit_test(short_differences_have_zero),
        cmocka_unit_test(others_are_counted_from_the_top),
        cmocka_unit_test(dashes_get_smaller_letters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
