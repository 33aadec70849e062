/* Radiance HDR written and read again. */
#include "image/support.h"

#include <float.h>
#include <math.h>

#include "image/hdr.h"
#include "image/rgbe.h"

static const int widths[] = {1, 2, 7, 8, 16, 17, 18, 127, 128, 129, 300, 32767, 32768};

/* Writes to a temporary stream and reads back; *size is the file's. */
static image *round_trip(const image *picture, long *size) {
    captured c;
    captured_begin(&c);
    FILE *stream = tmpfile();
    assert_non_null(stream);
    EXPECT_OK(&c, image_write_hdr(picture, stream, "out.hdr", &c.report));
    *size = ftell(stream);
    rewind(stream);
    image *read;
    EXPECT_OK(&c, image_read_hdr(&read, stream, "in.hdr", &c.report));
    fclose(stream);
    assert_int_equal(read->width, picture->width);
    assert_int_equal(read->height, picture->height);
    return read;
}

/* Half a step of the mantissa that goes with the largest component. */
static void check_pixel(const float v[3], const float decoded[3]) {
    float largest = fmaxf(v[0], fmaxf(v[1], v[2]));
    if (largest <= 1e-32f) {
        for (int c = 0; c < 3; c++)
            assert_true(decoded[c] == 0);
        return;
    }
    int exponent;
    frexp(largest, &exponent);
    double half_step = ldexp(0.5, exponent - 8);
    for (int c = 0; c < 3; c++)
        if (!(fabs((double)decoded[c] - (double)v[c]) <= half_step))
            fail_msg("%.9g of %.9g became %.9g", (double)v[c], (double)largest, (double)decoded[c]);
}

static void check_picture(const image *picture, const image *decoded) {
    for (size_t i = 0; i < (size_t)picture->width * (size_t)picture->height; i++) {
        float v[3], d[3];
        for (int c = 0; c < 3; c++) {
            v[c] = picture->channels[c][i];
            d[c] = decoded->channels[c][i];
        }
        check_pixel(v, d);
    }
}

/* Log-uniform over nearly all that the format holds, with stretches of one value and of black. */
static void fill_randomly(image *picture, uint64_t *seed) {
    size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count;) {
        size_t stretch = random_unit(seed) < 0.5 ? 1 : 1 + (size_t)(300 * random_unit(seed));
        double scale = random_unit(seed) < 0.1 ? 0 : exp(log(1e-30) + log(1e68) * random_unit(seed));
        float v[3];
        for (int c = 0; c < 3; c++)
            v[c] = (float)(scale * random_unit(seed));
        for (; stretch > 0 && i < count; stretch--, i++)
            for (int c = 0; c < 3; c++)
                picture->channels[c][i] = v[c];
    }
}

static void random_pictures_survive(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (size_t w = 0; w < sizeof widths / sizeof *widths; w++)
        for (int round = 0; round < 4; round++) {
            image *picture = image_create(widths[w], 1 + round, 3, NULL);
            fill_randomly(picture, &seed);
            long size;
            image *read = round_trip(picture, &size);
            check_picture(picture, read);
            image_destroy(read);
            image_destroy(picture);
        }
}

/* Runs of every length beside literals of every length, so that each boundary of the encoding is met. */
static void all_lengths_of_runs_survive(void **state) {
    (void)state;
    image *picture = image_create(700, 300, 3, NULL);
    for (int y = 0; y < 300; y++)
        for (int x = 0; x < 700; x++)
            for (int c = 0; c < 3; c++)
                picture->channels[c][y * 700 + x] = x < y           ? 0.75f
                                                    : x < 2 * y     ? (float)(128 + (x * 7 + c) % 128)
                                                    : x < 2 * y + 4 ? 5
                                                                    : (float)(x % 3 + 1);
    long size;
    image *read = round_trip(picture, &size);
    check_picture(picture, read);
    image_destroy(read);
    image_destroy(picture);
}

static void gray_takes_little_room(void **state) {
    (void)state;
    image *picture = image_create(1000, 100, 3, NULL);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 100000; i++)
            picture->channels[c][i] = 0.5f;
    long size;
    image *read = round_trip(picture, &size);
    /* 8 runs of at most 127, of two bytes, in four planes, with four bytes in front: 68 bytes a scanline. */
    assert_in_range(size, 6800, 6900);
    image_destroy(read);
    image_destroy(picture);
}

/* Radiance's rule, with its own worked numbers. */
static void encoding_is_exact(void **state) {
    (void)state;
    static const struct {
        float v[3];
        unsigned char rgbe[4];
    } cases[] = {
        {{1, 0.5f, 0.25f}, {128, 64, 32, 129}},
        {{0.999999f, 0, 0}, {255, 0, 0, 128}},
        {{2, 1.999f, 0.001f}, {128, 127, 0, 130}},
        {{0, 0, 0}, {0, 0, 0, 0}},
        {{1e-33f, 1e-33f, 1e-33f}, {0, 0, 0, 0}},
        {{-1, 3, -INFINITY}, {0, 192, 0, 130}},
        {{NAN, 3, NAN}, {0, 192, 0, 130}},
        {{INFINITY, 1, FLT_MAX}, {255, 0, 255, 255}},
        {{NAN, -1, 0}, {0, 0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unsigned char rgbe[4];
        image_rgbe_encode(cases[i].v, rgbe);
        assert_memory_equal(rgbe, cases[i].rgbe, 4);
    }
    double decoded[3];
    image_rgbe_decode((const unsigned char[]){255, 0, 128, 255}, decoded);
    assert_true(decoded[0] == 255.5 * 0x1p119 && decoded[1] == 0.5 * 0x1p119 && decoded[2] == 128.5 * 0x1p119);
    image_rgbe_decode((const unsigned char[]){255, 1, 2, 0}, decoded);
    assert_true(decoded[0] == 0 && decoded[1] == 0 && decoded[2] == 0);
}

/* Coding what was decoded changes nothing more. */
static void encoding_again_is_stable(void **state) {
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 100000; i++) {
        unsigned char rgbe[4], again[4];
        uint64_t bits = random_bits(&seed);
        for (int c = 0; c < 4; c++)
            rgbe[c] = (unsigned char)(bits >> (8 * c));
        rgbe[bits >> 32 & 1] |= 128;
        rgbe[3] = (unsigned char)(30 + rgbe[3] % 226);
        double v[3];
        image_rgbe_decode(rgbe, v);
        image_rgbe_encode((const float[]){(float)v[0], (float)v[1], (float)v[2]}, again);
        assert_memory_equal(again, rgbe, 4);
    }
}

static void header_has_radiances_order(void **state) {
    (void)state;
    image *picture = image_create(2, 1, 3, NULL);
    picture->command = "gpict -vf a.vf \n\x01 room.rad";
    picture->software = "Graze 0.1.0";
    picture->view = "-vtv -vp 1 2 3 -vh 40";
    picture->pixel_aspect = 1.5;
    captured c;
    captured_begin(&c);
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    EXPECT_OK(&c, image_write_hdr(picture, stream, "out.hdr", &c.report));
    fclose(stream);
    const char *expected = "#?RADIANCE\n"
                           "gpict -vf a.vf    room.rad\n"
                           "SOFTWARE= Graze 0.1.0\n"
                           "VIEW= -vtv -vp 1 2 3 -vh 40\n"
                           "PIXASPECT= 1.5\n"
                           "FORMAT=32-bit_rle_rgbe\n"
                           "\n"
                           "-Y        1 +X        2\n";
    assert_int_equal(size, strlen(expected) + 8);
    assert_memory_equal(text, expected, strlen(expected));
    FILE *in = fmemopen(text, size, "rb");
    image *read;
    EXPECT_OK(&c, image_read_hdr(&read, in, "in.hdr", &c.report));
    fclose(in);
    assert_string_equal(read->view, picture->view);
    assert_string_equal(read->software, picture->software);
    assert_string_equal(read->command, "gpict -vf a.vf    room.rad");
    assert_true(read->pixel_aspect == 1.5);
    image_destroy(read);
    image_destroy(picture);
    free(text);
}

static void nearly_square_is_square(void **state) {
    (void)state;
    image *picture = image_create(2, 1, 3, NULL);
    picture->pixel_aspect = 1.004;
    long size;
    image *read = round_trip(picture, &size);
    assert_true(read->pixel_aspect == 1);
    assert_null(read->view);
    assert_null(read->command);
    assert_null(read->software);
    image_destroy(read);
    image_destroy(picture);
}

static void full_device_is_reported(void **state) {
    (void)state;
    captured c;
    image *picture = image_create(100, 100, 3, NULL);
    FILE *full = fopen("/dev/full", "wb");
    assert_non_null(full);
    EXPECT_FAILURE(&c, GRAZE_SYSTEM_ERROR, "full: cannot write the picture: No space left",
                   image_write_hdr(picture, full, "full", &c.report));
    fclose(full);
    image_destroy(picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_pictures_survive),  cmocka_unit_test(all_lengths_of_runs_survive),
        cmocka_unit_test(gray_takes_little_room),   cmocka_unit_test(encoding_is_exact),
        cmocka_unit_test(encoding_again_is_stable), cmocka_unit_test(header_has_radiances_order),
        cmocka_unit_test(nearly_square_is_square),  cmocka_unit_test(full_device_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
