/* OpenEXR written, and read by OpenEXRCore and by OpenImageIO. */
#include "image/support.h"

#include <math.h>

#include <OpenEXR/openexr.h>

static const char *const names[] = {"R",
                                    "G",
                                    "B",
                                    "standard_error.R",
                                    "depth.Z",
                                    "normal.X",
                                    "a_layer_with_a_name_that_is_longer_than_31_letters.value"};
enum { CHANNELS = sizeof names / sizeof *names, WIDTH = 37, HEIGHT = 45 };

static image *make_picture(void) {
    image *picture = image_create(WIDTH, HEIGHT, CHANNELS, names);
    assert_non_null(picture);
    uint64_t seed = 5;
    for (int c = 0; c < CHANNELS; c++)
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            picture->channels[c][i] =
                (float)((random_unit(&seed) - (c < 3 ? 0 : 0.5)) * exp(40 * random_unit(&seed) - 20));
    picture->channels[4][7] = INFINITY; /* a layer may say so where nothing was hit */
    picture->view = "-vtv -vp 1 2 3";
    picture->command = "gpict -o x.exr room.rad";
    picture->software = "Graze 0.1.0";
    picture->pixel_aspect = 2;
    return picture;
}

static char directory[PATH_MAX], path[PATH_MAX + 64];

static void write_picture(const image *picture) {
    captured c;
    captured_begin(&c);
    make_directory(directory);
    path_in(path, directory, "out.exr");
    EXPECT_OK(&c, image_write(picture, path, &c.report));
}

static void clean_up(void) {
    assert_int_equal(unlink(path), 0);
    remove_directory(directory);
}

/* Decodes one chunk into planes of the same order as `names`. */
static void decode_chunk(exr_context_t context, int y, float *planes[CHANNELS]) {
    exr_chunk_info_t chunk;
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    assert_int_equal(exr_read_scanline_chunk_info(context, 0, y, &chunk), EXR_ERR_SUCCESS);
    assert_int_equal(exr_decoding_initialize(context, 0, &chunk, &decoder), EXR_ERR_SUCCESS);
    assert_int_equal(decoder.channel_count, CHANNELS);
    for (int d = 0; d < CHANNELS; d++)
        for (int c = 0; c < CHANNELS; c++)
            if (!strcmp(decoder.channels[d].channel_name, names[c])) {
                assert_int_equal(decoder.channels[d].data_type, EXR_PIXEL_FLOAT);
                decoder.channels[d].user_pixel_stride = sizeof(float);
                decoder.channels[d].user_line_stride = WIDTH * sizeof(float);
                decoder.channels[d].decode_to_ptr = (uint8_t *)(planes[c] + y * WIDTH);
            }
    assert_int_equal(exr_decoding_choose_default_routines(context, 0, &decoder), EXR_ERR_SUCCESS);
    assert_int_equal(exr_decoding_run(context, 0, &decoder), EXR_ERR_SUCCESS);
    exr_decoding_destroy(context, &decoder);
}

static void pixels_are_kept_bit_by_bit(void **state) {
    (void)state;
    image *picture = make_picture(), *copy = image_create(WIDTH, HEIGHT, CHANNELS, names);
    write_picture(picture);
    exr_context_t context;
    assert_int_equal(exr_start_read(&context, path, NULL), EXR_ERR_SUCCESS);
    int32_t rows;
    assert_int_equal(exr_get_scanlines_per_chunk(context, 0, &rows), EXR_ERR_SUCCESS);
    assert_int_equal(rows, 16); /* ZIP */
    for (int y = 0; y < HEIGHT; y += rows)
        decode_chunk(context, y, copy->channels);
    exr_finish(&context);
    for (int c = 0; c < CHANNELS; c++)
        assert_memory_equal(copy->channels[c], picture->channels[c], WIDTH * HEIGHT * sizeof(float));
    image_destroy(copy);
    image_destroy(picture);
    clean_up();
}

static void expect_text(exr_context_t context, const char *name, const char *expected) {
    const char *text;
    int32_t length;
    assert_int_equal(exr_attr_get_string(context, 0, name, &length, &text), EXR_ERR_SUCCESS);
    assert_int_equal(length, strlen(expected));
    assert_memory_equal(text, expected, length);
}

static void attributes_tell_the_units(void **state) {
    (void)state;
    image *picture = make_picture();
    write_picture(picture);
    exr_context_t context;
    assert_int_equal(exr_start_read(&context, path, NULL), EXR_ERR_SUCCESS);
    exr_attr_chromaticities_t p;
    assert_int_equal(exr_attr_get_chromaticities(context, 0, "chromaticities", &p), EXR_ERR_SUCCESS);
    assert_true(p.red_x == .64f && p.red_y == .33f && p.green_x == .29f && p.green_y == .6f);
    assert_true(p.blue_x == .15f && p.blue_y == .06f && p.white_x == 1 / 3.f && p.white_y == 1 / 3.f);
    float value;
    assert_int_equal(exr_attr_get_float(context, 0, "whiteLuminance", &value), EXR_ERR_SUCCESS);
    assert_true(value == 179);
    /* Ours is height over width, OpenEXR's width over height. */
    assert_int_equal(exr_get_pixel_aspect_ratio(context, 0, &value), EXR_ERR_SUCCESS);
    assert_true(value == .5f);
    expect_text(context, "radianceView", picture->view);
    expect_text(context, "command", picture->command);
    expect_text(context, "software", picture->software);
    exr_finish(&context);
    image_destroy(picture);
    clean_up();
}

static void openimageio_reads_all(void **state) {
    (void)state;
    image *picture = make_picture();
    write_picture(picture);
    image *read = read_image(path);
    assert_int_equal(read->width, WIDTH);
    assert_int_equal(read->height, HEIGHT);
    assert_int_equal(read->channel_count, CHANNELS);
    for (int c = 0; c < CHANNELS; c++) {
        const float *plane = image_channel(read, names[c]);
        assert_non_null(plane);
        assert_memory_equal(plane, picture->channels[c], WIDTH * HEIGHT * sizeof(float));
    }
    assert_true(read->pixel_aspect == 2);
    assert_string_equal(read->view, picture->view);
    assert_string_equal(read->command, picture->command);
    assert_string_equal(read->software, picture->software);
    image_destroy(read);
    image_destroy(picture);
    clean_up();
}

static void same_picture_same_bytes(void **state) {
    (void)state;
    image *picture = make_picture();
    write_picture(picture);
    size_t size, size_again;
    unsigned char *bytes = read_bytes(path, &size);
    captured c;
    captured_begin(&c);
    EXPECT_OK(&c, image_write(picture, path, &c.report));
    unsigned char *again = read_bytes(path, &size_again);
    assert_int_equal(size, size_again);
    assert_memory_equal(bytes, again, size);
    free(bytes);
    free(again);
    image_destroy(picture);
    clean_up();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_are_kept_bit_by_bit),
        cmocka_unit_test(attributes_tell_the_units),
        cmocka_unit_test(openimageio_reads_all),
        cmocka_unit_test(same_picture_same_bytes),
    };
    return cmocka_run_group_tests(tests, link_module, NULL);
}
