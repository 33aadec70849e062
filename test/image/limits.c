/* Pictures that are too large for their format, files that must not be written, leftovers, pipes, and what comes byte
 * by byte. */
#include "image/support.h"

#include <limits.h>
#include <sys/wait.h>

#include "image/module.h"

static char directory[PATH_MAX];

static const struct {
    const char *suffix;
    int longest;
} limits[] = {{"ico", 256},   {"iff", 8192},  {"webp", 16383}, {"sgi", 65534},
              {"jpg", 65500}, {"tga", 65535}, {"png", 1000000}};
enum { LIMITS = sizeof limits / sizeof *limits };

static void name_file(char path[PATH_MAX + 64], const char *suffix) {
    char name[32];
    snprintf(name, sizeof name, "a.%s", suffix);
    path_in(path, directory, name);
}

/* On either side. */
static void formats_have_their_limits(void **state) {
    (void)state;
    make_directory(directory);
    for (int l = 0; l < LIMITS; l++)
        for (int tall = 0; tall < 2; tall++) {
            char path[PATH_MAX + 64], message[64];
            captured c;
            captured_begin(&c);
            name_file(path, limits[l].suffix);
            int longest = limits[l].longest;
            image *fits = uniform(tall ? 1 : longest, tall ? longest : 1, .2f);
            image *too_large = uniform(tall ? 1 : longest + 1, tall ? longest + 1 : 1, .2f);
            EXPECT_OK(&c, image_check_size(path, fits->width, fits->height, &c.report));
            EXPECT_OK(&c, image_write(fits, path, &c.report));
            image *read = read_image(path);
            assert_int_equal(read->width, fits->width);
            assert_int_equal(read->height, fits->height);
            image_destroy(read);
            assert_int_equal(unlink(path), 0);
            snprintf(message, sizeof message, "%d x %d pixels is too large for .%s, which has room for %d a side",
                     too_large->width, too_large->height, limits[l].suffix, longest);
            EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, message,
                           image_check_size(path, too_large->width, too_large->height, &c.report));
            EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, message, image_write(too_large, path, &c.report));
            image_destroy(fits);
            image_destroy(too_large);
        }
    remove_directory(directory);
}

static void floats_have_room_for_all(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    EXPECT_OK(&c, image_check_size("a.hdr", 1 << 20, 1 << 20, &c.report));
    EXPECT_OK(&c, image_check_size("a.exr", 1 << 20, 1 << 20, &c.report));
    EXPECT_OK(&c, image_check_size("a.ppm", 1 << 20, 1 << 20, &c.report));
}

/* What the module writes and says when nobody asked before: a GIF cut by 65536, and a reason with the temporary's name.
 */
static void module_checks_what_it_wrote(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    const image_oiio *module;
    EXPECT_OK(&c, image_module_open(&module, "a.gif", &c.report));
    static const unsigned char bytes[3 * 66000];
    const image_oiio_header header = {.pixel_aspect = 1};
    char path[PATH_MAX + 64], message[1024];
    path_in(path, make_directory(directory), "a.gif");
    assert_int_equal(module->write(path, "mine", 66000, 1, bytes, &header, message, sizeof message), 0);
    assert_string_equal(message, "the file came out incomplete");
    unlink(path);
    path_in(path, directory, "a.webp");
    assert_int_equal(module->write(path, "mine", 66000, 1, bytes, &header, message, sizeof message), 0);
    assert_non_null(strstr(message, " mine "));
    assert_null(strstr(message, "a.webp"));
    unlink(path);
    remove_directory(directory);
}

/* GIF is read, though not written. */
static void gif_is_read(void **state) {
    (void)state;
    char path[PATH_MAX + 64];
    path_in(path, make_directory(directory), "a.gif");
    static const unsigned char white[] = {'G', 'I', 'F', '8', '9', 'a', 1, 0, 1, 0, 0x80, 0, 0, 0xff, 0xff, 0xff, 0,  0,
                                          0,   ',', 0,   0,   0,   0,   1, 0, 1, 0, 0,    2, 2, 0x44, 1,    0,    ';'};
    write_bytes(path, white, sizeof white);
    image *read = read_image(path);
    assert_int_equal(read->width, 1);
    assert_true((double)read->channels[1][0] == 1);
    image_destroy(read);
    unlink(path);
    remove_directory(directory);
}

/* What a user may not write stays as it is, though the directory is open to all: as root in another user's name. */
static int write_as_nobody(const image *picture, const char *path) {
    captured c;
    if (geteuid() == 0 && setuid(65534) != 0)
        return 10;
    captured_begin(&c);
    if (image_check_writable(path, &c.report) != GRAZE_INPUT_ERROR ||
        !strstr(c.text, "cannot be written: Permission denied"))
        return 11;
    captured_begin(&c);
    return image_write(picture, path, &c.report) == GRAZE_INPUT_ERROR ? 0 : 12;
}

static void protected_files_stay(void **state) {
    (void)state;
    image *picture = uniform(3, 2, 1);
    make_directory(directory);
    assert_int_equal(chmod(directory, 0777), 0);
    static const char *const files[] = {"a.hdr", "a.exr", "a.png"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        char path[PATH_MAX + 64];
        path_in(path, directory, files[f]);
        write_bytes(path, "mine", 4);
        assert_int_equal(chmod(path, 0444), 0);
        pid_t child = fork();
        if (child == 0)
            _exit(write_as_nobody(picture, path));
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_int_equal(status, 0);
        size_t size;
        unsigned char *bytes = read_bytes(path, &size);
        assert_string_equal((char *)bytes, "mine");
        free(bytes);
        unlink(path);
    }
    image_destroy(picture);
    remove_directory(directory);
}

static void leftovers_do_no_harm(void **state) {
    (void)state;
    enum { LEFTOVERS = 1200 };
    captured c;
    captured_begin(&c);
    image *picture = uniform(3, 2, 1);
    make_directory(directory);
    char path[PATH_MAX + 64], name[32];
    for (int i = 0; i < LEFTOVERS; i++) {
        snprintf(name, sizeof name, ".graze-%d.hdr", i);
        write_bytes(path_in(path, directory, name), "", 0);
    }
    EXPECT_OK(&c, image_write(picture, path_in(path, directory, "a.hdr"), &c.report));
    image_destroy(read_image(path));
    unlink(path);
    for (int i = 0; i < LEFTOVERS; i++) {
        snprintf(name, sizeof name, ".graze-%d.hdr", i);
        assert_int_equal(unlink(path_in(path, directory, name)), 0);
    }
    image_destroy(picture);
    remove_directory(directory);
}

/* A child writes the bytes into a named pipe; the status and message of reading from there. */
static graze_status read_pipe(const char *name, const char *bytes, size_t size, captured *c) {
    char path[PATH_MAX + 64];
    path_in(path, directory, name);
    assert_int_equal(mkfifo(path, 0600), 0);
    pid_t child = fork();
    if (child == 0) {
        FILE *out = fopen(path, "wb");
        _exit(!out || fwrite(bytes, 1, size, out) != size || fclose(out) != 0);
    }
    captured_begin(c);
    image *picture;
    graze_status status = image_read(&picture, path, &c->report);
    assert_true((picture != NULL) == (status == GRAZE_OK));
    image_destroy(picture);
    assert_int_equal(waitpid(child, NULL, 0), child);
    unlink(path);
    return status;
}

static void pipes_give_only_hdr(void **state) {
    (void)state;
    captured c;
    make_directory(directory);
    static const char hdr[] = "#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x80";
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "a.png: only Radiance HDR can be read from a pipe",
                   read_pipe("a.png", "P6 1 1 255\nabc", 14, &c));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "a.ppm: only Radiance HDR can be read from a pipe",
                   read_pipe("a.ppm", "P6 1 1 255\nabc", 14, &c));
    EXPECT_OK(&c, read_pipe("a.png", hdr, sizeof hdr - 1, &c));
    EXPECT_OK(&c, read_pipe("a.hdr", hdr, sizeof hdr - 1, &c));
    remove_directory(directory);
}

/* How often this process has written; -1 where the system does not tell. */
static long write_calls(void) {
    FILE *in = fopen("/proc/self/io", "r");
    long calls = -1;
    char line[128];
    while (in && fgets(line, sizeof line, in))
        if (!strncmp(line, "syscw: ", 7))
            calls = strtol(line + 7, NULL, 10);
    if (in)
        fclose(in);
    return calls;
}

/* OpenImageIO gives a PPM away in threes of bytes, and fewer. */
static void bytes_are_gathered(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    image *picture = uniform(300, 200, 1);
    char path[PATH_MAX + 64];
    path_in(path, make_directory(directory), "a.ppm");
    long before = write_calls();
    EXPECT_OK(&c, image_write(picture, path, &c.report));
    long calls = write_calls() - before;
    unlink(path);
    remove_directory(directory);
    image_destroy(picture);
    if (before < 0)
        skip();
    assert_in_range(calls, 1, 100);
}

/* A colour that a display has not: nothing of it where it would be less than nothing. */
static void negatives_are_nothing_to_see(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    unsigned char shown[2][6], *files[2];
    size_t sizes[2];
    make_directory(directory);
    for (int clipped = 0; clipped < 2; clipped++) {
        image *picture = uniform(2, 1, .25f);
        picture->display_exposure = 1;
        picture->channels[0][1] = clipped ? 0 : -.125f;
        image_expose(picture, shown[clipped]);
        char path[PATH_MAX + 64];
        EXPECT_OK(&c, image_write(picture, path_in(path, directory, "a.hdr"), &c.report));
        files[clipped] = read_bytes(path, &sizes[clipped]);
        unlink(path);
        image_destroy(picture);
    }
    assert_memory_equal(shown[0], shown[1], 6);
    assert_int_equal(shown[0][3], 0);
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(files[0], files[1], sizes[0]);
    free(files[0]);
    free(files[1]);
    remove_directory(directory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_have_their_limits),    cmocka_unit_test(floats_have_room_for_all),
        cmocka_unit_test(module_checks_what_it_wrote),  cmocka_unit_test(gif_is_read),
        cmocka_unit_test(protected_files_stay),         cmocka_unit_test(leftovers_do_no_harm),
        cmocka_unit_test(pipes_give_only_hdr),          cmocka_unit_test(bytes_are_gathered),
        cmocka_unit_test(negatives_are_nothing_to_see),
    };
    return cmocka_run_group_tests(tests, link_module, NULL);
}
