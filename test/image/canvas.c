/* Drawing on a canvas: nothing is drawn beside it. */
#include "image/support.h"

#include "image/canvas.h"

static const unsigned char white[3] = {255, 255, 255};

static const unsigned char *pixel(const image_canvas *canvas, int x, int y) {
    return canvas->bytes + 3 * (y * canvas->width + x);
}

/* A picture of 5 x 4 pixels of its own brightness each, exposed as it is. */
static image *numbered_picture(void) {
    image *picture = uniform(5, 4, 0);
    picture->display_exposure = 1;
    for (int i = 0; i < 20; i++)
        set_gray(picture, i, (float)(i + 1) / 50);
    return picture;
}

/* Each of its pixels is where it belongs as far as there is room, and all else black. */
static void backdrops_are_cut_to_the_canvas(void **state) {
    (void)state;
    static const struct {
        int width, height, left, zoom;
    } cases[] = {{5, 4, 0, 1},  {12, 9, 2, 2}, {12, 9, 2, 1}, {3, 2, 0, 1}, {6, 3, 3, 2},
                 {4, 4, -2, 1}, {7, 9, -5, 2}, {4, 4, 9, 1},  {4, 4, -9, 1}};
    image *picture = numbered_picture();
    unsigned char bytes[60];
    image_expose(picture, bytes);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        image_canvas canvas;
        assert_true(image_canvas_create(&canvas, cases[k].width, cases[k].height));
        assert_true(image_draw_backdrop(&canvas, cases[k].left, picture, cases[k].zoom));
        for (int y = 0; y < canvas.height; y++)
            for (int x = 0; x < canvas.width; x++) {
                int zoom = cases[k].zoom, right = x - cases[k].left;
                bool inside = right >= 0 && right < 5 * zoom && y < 4 * zoom;
                int expected = inside ? bytes[3 * (y / zoom * 5 + right / zoom)] * 3 / 4 : 0;
                assert_int_equal(*pixel(&canvas, x, y), expected);
            }
        image_canvas_free(&canvas);
    }
    image_destroy(picture);
}

static void fills_are_cut_to_the_canvas(void **state) {
    (void)state;
    image_canvas canvas;
    assert_true(image_canvas_create(&canvas, 4, 3));
    image_fill(&canvas, -2, -1, 3, 2, white);
    image_fill(&canvas, 3, 2, 5, 5, white);
    image_fill(&canvas, 9, 9, 2, 2, white);
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 4; x++)
            assert_int_equal(*pixel(&canvas, x, y), (x == 0 && y == 0) || (x == 3 && y == 2) ? 255 : 0);
    image_canvas_free(&canvas);
}

static void blends_are_cut_to_the_canvas(void **state) {
    (void)state;
    static const int off[][2] = {{-1, 0}, {0, -1}, {2, 0}, {0, 2}};
    image_canvas canvas;
    assert_true(image_canvas_create(&canvas, 2, 2));
    for (int i = 0; i < 4; i++)
        image_blend(&canvas, off[i][0], off[i][1], 1, white);
    for (int i = 0; i < 12; i++)
        assert_int_equal(canvas.bytes[i], 0);
    image_blend(&canvas, 1, 1, 0.5, white);
    assert_int_equal(*pixel(&canvas, 1, 1), 128);
    image_canvas_free(&canvas);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(backdrops_are_cut_to_the_canvas),
        cmocka_unit_test(fills_are_cut_to_the_canvas),
        cmocka_unit_test(blends_are_cut_to_the_canvas),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
