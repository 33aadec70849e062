/* Radiance HDR as others write it, and as nobody should. */
#include "image/support.h"

#include <math.h>
#include <sys/resource.h>

#include "image/hdr.h"

/* A file in memory: header lines, size and pixels. */
typedef struct bytes {
    unsigned char data[4096];
    size_t size;
} bytes;

static void add(bytes *b, const void *data, size_t size) {
    assert_true(b->size + size <= sizeof b->data);
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void begin(bytes *b, const char *header, const char *resolution) {
    b->size = 0;
    add(b, "#?RADIANCE\n", 11);
    add(b, header, strlen(header));
    add(b, "\n", 1);
    add(b, resolution, strlen(resolution));
    add(b, "\n", 1);
}

static graze_status read_memory(image **picture, const bytes *b, const graze_report *report) {
    FILE *in = fmemopen((void *)(size_t)b->data, b->size, "rb");
    assert_non_null(in);
    graze_status status = image_read_hdr(picture, in, "test.hdr", report);
    fclose(in);
    return status;
}

static image *read_good(const bytes *b) {
    captured c;
    captured_begin(&c);
    image *picture;
    EXPECT_OK(&c, read_memory(&picture, b, &c.report));
    return picture;
}

static void expect_pixel(const image *picture, int x, int y, double r, double g, double b) {
    size_t i = (size_t)(y * picture->width + x);
    const double expected[3] = {r, g, b};
    for (int c = 0; c < 3; c++)
        if (fabs((double)picture->channels[c][i] - expected[c]) > 1e-6 * fabs(expected[c]))
            fail_msg("pixel %d %d, channel %d: %.9g instead of %.9g", x, y, c, (double)picture->channels[c][i],
                     expected[c]);
}

/* Exponent 136 makes a mantissa m the value m + 1/2. */
static const unsigned char pixel_a[4] = {130, 20, 30, 136}, pixel_b[4] = {40, 150, 60, 136};

static void old_runs(void **state) {
    (void)state;
    bytes b;
    /* a, then 2 + 1 x 256 times more, then b. */
    begin(&b, "", "-Y 1 +X 260");
    add(&b, pixel_a, 4);
    add(&b, (unsigned char[]){1, 1, 1, 2, 1, 1, 1, 1}, 8);
    add(&b, pixel_b, 4);
    image *picture = read_good(&b);
    assert_int_equal(picture->width, 260);
    for (int x = 0; x < 259; x++)
        expect_pixel(picture, x, 0, 130.5, 20.5, 30.5);
    expect_pixel(picture, 259, 0, 40.5, 150.5, 60.5);
    image_destroy(picture);
}

static void flat_and_new_lines_may_alternate(void **state) {
    (void)state;
    bytes b;
    begin(&b, "FORMAT=32-bit_rle_rgbe\n", "-Y 2 +X 3");
    add(&b, pixel_a, 4);
    add(&b, pixel_b, 4);
    add(&b, pixel_a, 4);
    add(&b, (unsigned char[]){2, 2, 0, 3, 131, 130, 2, 20, 21, 129, 22, 3, 30, 31, 32, 131, 136}, 17);
    image *picture = read_good(&b);
    expect_pixel(picture, 1, 0, 40.5, 150.5, 60.5);
    expect_pixel(picture, 2, 0, 130.5, 20.5, 30.5);
    for (int x = 0; x < 3; x++)
        expect_pixel(picture, x, 1, 130.5, 20.5 + x, 30.5 + x);
    image_destroy(picture);
}

/* A picture of 3 x 2 whose pixel at x, y, from the top left, has red 128 + x + 10 y. */
static void all_orientations(void **state) {
    (void)state;
    static const char *const orientations[8] = {"-Y 2 +X 3", "-Y 2 -X 3", "+Y 2 +X 3", "+Y 2 -X 3",
                                                "+X 3 -Y 2", "+X 3 +Y 2", "-X 3 -Y 2", "-X 3 +Y 2"};
    for (int o = 0; o < 8; o++) {
        const char *name = orientations[o];
        int columns = name[1] == 'X';
        char x_sign = columns ? name[0] : name[5], y_sign = columns ? name[5] : name[0];
        bytes b;
        begin(&b, "", name);
        for (int slow = 0; slow < (columns ? 3 : 2); slow++)
            for (int fast = 0; fast < (columns ? 2 : 3); fast++) {
                int x = columns ? slow : fast, y = columns ? fast : slow;
                x = x_sign == '+' ? x : 2 - x;
                y = y_sign == '-' ? y : 1 - y;
                add(&b, (unsigned char[]){(unsigned char)(128 + x + 10 * y), 0, 0, 136}, 4);
            }
        image *picture = read_good(&b);
        assert_int_equal(picture->width, 3);
        assert_int_equal(picture->height, 2);
        for (int y = 0; y < 2; y++)
            for (int x = 0; x < 3; x++)
                expect_pixel(picture, x, y, 128.5 + x + 10 * y, .5, .5);
        image_destroy(picture);
    }
}

static void header_variables_count_together(void **state) {
    (void)state;
    bytes b;
    begin(&b,
          "rpict -vf x.vf room.oct\r\n"
          "SOFTWARE= RADIANCE 6.1\n"
          "VIEW= -vtv -vp 0 0 0\n"
          "EXPOSURE=2\n"
          "\tVIEW= -vp 9 9 9\n"
          "pfilt -1 -e 2\n"
          "EXPOSURE= 4.0e+00\n"
          "COLORCORR= 0.5 1 2\n"
          "COLORCORR= 1 4 1\n"
          "PIXASPECT= 1.5\n"
          "PIXASPECT=.5\n"
          "VIEW= -vh 20\n"
          "NCOMP=3\n"
          "FORMAT=32-bit_rle_rgbe\n",
          "-Y 1 +X 1");
    add(&b, pixel_a, 4);
    image *picture = read_good(&b);
    assert_true(picture->pixel_aspect == 0.75);
    assert_string_equal(picture->view, "-vtv -vp 0 0 0 -vh 20");
    assert_string_equal(picture->command, "pfilt -1 -e 2");
    assert_string_equal(picture->software, "RADIANCE 6.1");
    expect_pixel(picture, 0, 0, 130.5 / 8 / 0.5, 20.5 / 8 / 4, 30.5 / 8 / 2);
    image_destroy(picture);
}

/* With the weights of primaries around a white of 1/3; Radiance's own are those of .3333, 3e-5 off. */
static double luminance(const image *picture, int i) {
    return 179 * (.2651058201 * (double)picture->channels[0][i] + .6701058201 * (double)picture->channels[1][i] +
                  .0647883598 * (double)picture->channels[2][i]);
}

/* XYZ of (1, 1, 1) W/sr/m^2 is 179 x (1, 1, 1); a green beyond Radiance's gamut keeps its luminance, at the price of
 * negative channels. */
static void xyze(void **state) {
    (void)state;
    bytes b;
    begin(&b, "FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 2");
    add(&b, (unsigned char[]){178, 178, 178, 136, 22, 100, 10, 136}, 8);
    image *picture = read_good(&b);
    expect_pixel(picture, 0, 0, 178.5 / 179, 178.5 / 179, 178.5 / 179);
    assert_true(fabs(luminance(picture, 0) - 178.5) < 1e-4);
    assert_true(picture->channels[0][1] < 0);
    assert_true(fabs(luminance(picture, 1) - 100.5) < 1e-4);
    image_destroy(picture);
}

/* sRGB's primaries: white stays white. */
static void foreign_primaries(void **state) {
    (void)state;
    bytes b;
    begin(&b, "PRIMARIES= .64 .33 .30 .60 .15 .06 .3127 .3290\n", "-Y 1 +X 2");
    add(&b, (unsigned char[]){200, 200, 200, 136, 200, 120, 60, 136}, 8);
    image *picture = read_good(&b);
    expect_pixel(picture, 0, 0, 200.5, 200.5, 200.5);
    /* Worked out with other means. */
    expect_pixel(picture, 1, 0, 189.38840642, 120.08992903, 58.7312431);
    image_destroy(picture);
    begin(&b, "PRIMARIES= .6400 .3300 .2900 .6000 .1500 .0600 .3333 .3333\n", "-Y 1 +X 1");
    add(&b, pixel_a, 4);
    picture = read_good(&b);
    /* The white point's four digits are all the difference. */
    assert_true(fabs((double)picture->channels[0][0] - 130.5) < 0.05);
    image_destroy(picture);
    /* A green purer than Radiance's. */
    begin(&b, "PRIMARIES= .7 .3 .17 .8 .13 .05 .3333 .3333\n", "-Y 1 +X 1");
    add(&b, (unsigned char[]){0, 200, 0, 136}, 4);
    picture = read_good(&b);
    assert_true(picture->channels[0][0] < -50);
    assert_true(picture->channels[1][0] > 200.5f);
    image_destroy(picture);
}

static void bad_headers(void **state) {
    (void)state;
    static const struct {
        const char *header, *resolution, *message;
    } cases[] = {
        {"FORMAT=Radiance_spectra\n", "-Y 1 +X 1", "test.hdr:2: only 32-bit_rle_rgbe"},
        {"a\nEXPOSURE=0\n", "-Y 1 +X 1", "test.hdr:3: EXPOSURE must be"},
        {"EXPOSURE=-1\n", "-Y 1 +X 1", "EXPOSURE must be"},
        {"EXPOSURE=nan\n", "-Y 1 +X 1", "EXPOSURE must be"},
        {"EXPOSURE=1 2\n", "-Y 1 +X 1", "EXPOSURE must be"},
        {"EXPOSURE=1e30\nEXPOSURE=1e30\n", "-Y 1 +X 1", "test.hdr:3: the product of the picture's EXPOSURE is not"},
        {"EXPOSURE=1e300\n", "-Y 1 +X 1", "the product of the picture's EXPOSURE is not"},
        {"COLORCORR=1 1e30 1\nCOLORCORR=1 1e30 1\n", "-Y 1 +X 1", "test.hdr:3: the product of the picture's COLORCORR"},
        {"PIXASPECT=1e-300\n", "-Y 1 +X 1", "the product of the picture's PIXASPECT is not"},
        {"COLORCORR=1 0 1\n", "-Y 1 +X 1", "COLORCORR must be three"},
        {"COLORCORR=1 1\n", "-Y 1 +X 1", "COLORCORR must be"},
        {"PIXASPECT=x\n", "-Y 1 +X 1", "PIXASPECT must be"},
        {"PRIMARIES=1 2 3\n", "-Y 1 +X 1", "PRIMARIES must be"},
        {"PRIMARIES=0 0 0 0 0 0 .3 .3\n", "-Y 1 +X 1", "span no colours"},
        {"PRIMARIES=.6 .3 .3 .6 .1 .1 0 0\n", "-Y 1 +X 1", "span no colours"},
        {"", "-Y 0 +X 1", "test.hdr:3: the picture is empty"},
        {"", "-Y 2147483647 +X 2147483647", "test.hdr:3: the picture is too large"},
        {"", "-Y 99999999999999999999 +X 1", "the picture is too large"},
        {"", "-Y 1 +X 1048577", "the picture is too large"},
        {"", "-Y -1 +X 1", "size must read"},
        {"", "-Y 1 +Y 1", "size must read"},
        {"", "Y 1 +X 1", "size must read"},
        {"", "-Y 1 +X 1 z", "size must read"},
        {"", "-Y 1 +X 999999999", "too large: a side is longer than"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        captured c;
        bytes b;
        begin(&b, cases[i].header, cases[i].resolution);
        add(&b, pixel_a, 4);
        image *picture;
        EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, cases[i].message, read_memory(&picture, &b, &c.report));
        assert_null(picture);
    }
}

static void bad_pixels(void **state) {
    (void)state;
    static const struct {
        const char *resolution, *message;
        unsigned char pixels[24];
        size_t size;
    } cases[] = {
        {"-Y 2 +X 2", "scanline 2, byte 35: the file ends", {128, 0, 0, 136, 128, 0, 0, 136, 128, 0, 0, 136, 1}, 13},
        {"-Y 1 +X 3", "scanline 1, byte 30: a run goes beyond", {128, 0, 0, 136, 1, 1, 1, 3}, 8},
        {"-Y 1 +X 3",
         "a run goes beyond",
         {128, 0, 0, 136, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0},
         24},
        {"-Y 1 +X 3", "scanline's length is not", {2, 2, 0, 4, 131, 1}, 6},
        {"-Y 1 +X 3", "a run goes beyond", {2, 2, 0, 3, 132, 1}, 6},
        {"-Y 1 +X 3", "a run goes beyond", {2, 2, 0, 3, 2, 1, 1, 130, 1}, 9},
        {"-Y 1 +X 3", "a run goes beyond", {2, 2, 0, 3, 4, 1, 1, 1, 1}, 9},
        {"-Y 1 +X 3", "a run of no length", {2, 2, 0, 3, 0}, 5},
        {"-Y 1 +X 3", "a run goes beyond", {2, 2, 0, 3, 128, 0}, 6},
        {"-Y 1 +X 3", "the file ends", {2, 2, 0, 3, 131}, 5},
        {"-Y 1 +X 3", "the file ends", {0}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        captured c;
        bytes b;
        begin(&b, "", cases[i].resolution);
        add(&b, cases[i].pixels, cases[i].size);
        image *picture;
        EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, cases[i].message, read_memory(&picture, &b, &c.report));
        assert_null(picture);
    }
}

static void no_header_at_all(void **state) {
    (void)state;
    captured c;
    image *picture;
    bytes b = {"P6 1 1 255\n", 11};
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "test.hdr:1: no Radiance picture", read_memory(&picture, &b, &c.report));
    b = (bytes){"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", 34};
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "test.hdr:3: the file ends within", read_memory(&picture, &b, &c.report));
    b = (bytes){"#?RADIANCE\nab\0c\n\n-Y 1 +X 1\n", 27};
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "test.hdr:2: a zero byte", read_memory(&picture, &b, &c.report));
}

/* Every truncation and thousands of changed bytes: an error or a picture, nothing else. */
static void damaged_files(void **state) {
    (void)state;
    image *picture = image_create(40, 3, 3, NULL);
    uint64_t seed = 3;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 120; i++)
            picture->channels[c][i] = i % 40 < 20 ? 1.5f : (float)random_unit(&seed);
    picture->view = "-vtv -vp 1 2 3";
    picture->pixel_aspect = 2;
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_int_equal(image_write_hdr(picture, stream, "out", NULL), GRAZE_OK);
    fclose(stream);
    image_destroy(picture);
    bytes whole = {.size = size};
    assert_true(size < sizeof whole.data);
    memcpy(whole.data, text, size);
    free(text);
    int refused = 0, taken = 0;
    for (int round = 0; round < 20000; round++) {
        bytes b = whole;
        if ((size_t)round < size && round > 0)
            b.size = (size_t)round;
        else
            for (int changes = 1 + (int)(3 * random_unit(&seed)); changes > 0; changes--)
                b.data[random_bits(&seed) % b.size] = (unsigned char)random_bits(&seed);
        captured c;
        captured_begin(&c);
        graze_status status = read_memory(&picture, &b, &c.report);
        assert_int_equal(c.errors, status != GRAZE_OK);
        assert_true((picture != NULL) == (status == GRAZE_OK));
        if (status != GRAZE_OK && !strstr(c.text, "test.hdr"))
            fail_msg("no file's name in '%s'", c.text);
        if (picture)
            for (int channel = 0; channel < 3; channel++)
                for (int i = 0; i < picture->width * picture->height; i++)
                    assert_true(isfinite(picture->channels[channel][i]));
        picture ? taken++ : refused++;
        image_destroy(picture);
    }
    assert_true(refused > 1000 && taken > 1000);
}

/* A promise of a terabyte costs nothing as long as no pixels follow. */
static void promises_allocate_nothing(void **state) {
    (void)state;
    captured c;
    bytes b;
    image *picture;
    begin(&b, "", "-Y 1048576 +X 1048576");
    add(&b, pixel_a, 4);
    struct rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "scanline 1, byte", read_memory(&picture, &b, &c.report));
    getrusage(RUSAGE_SELF, &after);
    assert_in_range(after.ru_maxrss, 0, before.ru_maxrss + 4096);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(old_runs),
        cmocka_unit_test(flat_and_new_lines_may_alternate),
        cmocka_unit_test(all_orientations),
        cmocka_unit_test(header_variables_count_together),
        cmocka_unit_test(xyze),
        cmocka_unit_test(foreign_primaries),
        cmocka_unit_test(bad_headers),
        cmocka_unit_test(bad_pixels),
        cmocka_unit_test(no_header_at_all),
        cmocka_unit_test(damaged_files),
        cmocka_unit_test(promises_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
