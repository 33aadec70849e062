/* Letters: each its own, and none beyond its place. */
#include "image/support.h"

#include "image/font.h"

enum { LETTER_BYTES = 3 * IMAGE_FONT_ADVANCE * (IMAGE_FONT_HEIGHT + IMAGE_FONT_DEPTH) };
static const unsigned char white[3] = {255, 255, 255};

static image_canvas canvas_of(int width, int height) {
    image_canvas canvas;
    assert_true(image_canvas_create(&canvas, width, height));
    return canvas;
}

/* What of the letter shows, as a sum over its bytes. */
static long ink(const image_canvas *canvas) {
    long sum = 0;
    for (int i = 0; i < 3 * canvas->width * canvas->height; i++)
        sum += canvas->bytes[i];
    return sum;
}

static void letters_differ(void **state) {
    (void)state;
    image_canvas letters[127];
    for (int letter = ' '; letter < 127; letter++) {
        letters[letter] = canvas_of(IMAGE_FONT_ADVANCE, IMAGE_FONT_HEIGHT + IMAGE_FONT_DEPTH);
        image_draw_text(&letters[letter], 0, 0, 1, white, (const char[]){(char)letter, 0});
        assert_true((ink(&letters[letter]) > 0) == (letter != ' '));
        for (int other = ' '; other < letter; other++)
            /* On typewriters, too, a zero is an O. */
            assert_true((memcmp(letters[letter].bytes, letters[other].bytes, LETTER_BYTES) == 0) ==
                        (letter == 'O' && other == '0'));
    }
    for (int letter = ' '; letter < 127; letter++)
        image_canvas_free(&letters[letter]);
}

/* With more room around it a letter shows no more. */
static void letters_keep_to_their_places(void **state) {
    (void)state;
    static const double scales[] = {1, 1.5, 2, 5};
    for (int s = 0; s < 4; s++)
        for (int letter = '!'; letter < 127; letter++) {
            const char text[] = {(char)letter, 0};
            int width = (int)(IMAGE_FONT_ADVANCE * scales[s]), height = (int)(10 * scales[s]);
            image_canvas tight = canvas_of(width, height), wide = canvas_of(3 * width, 3 * height);
            image_draw_text(&tight, 0, 0, scales[s], white, text);
            image_draw_text(&wide, width, height, scales[s], white, text);
            assert_int_equal(ink(&wide), ink(&tight));
            image_canvas_free(&tight);
            image_canvas_free(&wide);
        }
}

/* Strokes run aslant between dots that touch in a corner alone, and leave the corners of upright ones sharp. */
static void strokes_join_dots(void **state) {
    (void)state;
    image_canvas canvas = canvas_of(120, 180);
    image_draw_text(&canvas, 0, 0, 20, white, "/");
    assert_int_equal(canvas.bytes[3 * (40 * 120 + 80)], 255);
    image_canvas_free(&canvas);
    canvas = canvas_of(120, 180);
    image_draw_text(&canvas, 0, 0, 20, white, "L");
    assert_int_equal(canvas.bytes[3 * (130 * 120 + 20)], 255);
    assert_int_equal(canvas.bytes[3 * (117 * 120 + 23)], 0);
    image_canvas_free(&canvas);
    /* At their smallest, upright strokes are whole pixels. */
    canvas = canvas_of(6, 9);
    image_draw_text(&canvas, 0, 0, 1, white, "L");
    assert_int_equal(ink(&canvas), 11 * 3 * 255);
    for (int i = 0; i < LETTER_BYTES; i++)
        assert_true(canvas.bytes[i] == 0 || canvas.bytes[i] == 255);
    image_canvas_free(&canvas);
}

static void edges_cut_text(void **state) {
    (void)state;
    image_canvas canvas = canvas_of(8, 8);
    image_draw_text(&canvas, -200, 0, 2, white, "left");
    image_draw_text(&canvas, 9, 2, 2, white, "right");
    image_draw_text(&canvas, 0, -40, 2, white, "above");
    image_draw_text(&canvas, 0, 12, 2, white, "below");
    image_draw_text(&canvas, 0, 0, 1, white, "\x80\xff\n\t");
    assert_int_equal(ink(&canvas), 0);
    image_draw_rimmed_text(&canvas, -3, -3, 3, "in part");
    assert_true(ink(&canvas) > 0);
    image_canvas_free(&canvas);
}

static void widths_are_of_text(void **state) {
    (void)state;
    assert_int_equal(image_text_width(""), 0);
    assert_int_equal(image_text_width("1"), 5);
    assert_int_equal(image_text_width("100"), 17);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_differ),     cmocka_unit_test(letters_keep_to_their_places),
        cmocka_unit_test(strokes_join_dots),  cmocka_unit_test(edges_cut_text),
        cmocka_unit_test(widths_are_of_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
