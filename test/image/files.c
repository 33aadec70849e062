/* Pictures in files: formats by suffix, files that appear whole or not at all, and what cannot be written or read. */
#include "image/support.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "image/color.h"

static char directory[PATH_MAX];

/* Gray wedges of which every pixel differs from its neighbours, so that no format makes it small. */
static image *make_picture(int width, int height) {
    image *picture = image_create(width, height, 3, NULL);
    assert_non_null(picture);
    uint64_t seed = 6;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < width * height; i++)
            picture->channels[c][i] = (float)(0.02 + random_unit(&seed));
    return picture;
}

static void lossless_files_hold_the_exposed_bytes(void **state) {
    (void)state;
    static const char *const files[] = {"a.png", "a.tif", "a.bmp", "a.TGA", "a.ppm", "a.sgi"};
    image *picture = make_picture(31, 17);
    picture->software = "Graze 0.1.0";
    unsigned char bytes[3 * 31 * 17];
    image_expose(picture, bytes);
    make_directory(directory);
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        captured c;
        captured_begin(&c);
        char path[PATH_MAX + 64];
        path_in(path, directory, files[f]);
        EXPECT_OK(&c, image_write(picture, path, &c.report));
        image *read = read_image(path);
        assert_int_equal(read->width, 31);
        assert_int_equal(read->height, 17);
        for (int i = 0; i < 3 * 31 * 17; i++) {
            double encoded = 255 * image_srgb_encode((double)read->channels[i % 3][i / 3]);
            if (fabs(encoded - bytes[i]) > 1e-3)
                fail_msg("%s: byte %d is %g, not %d", files[f], i, encoded, bytes[i]);
        }
        image_destroy(read);
        assert_int_equal(unlink(path), 0);
    }
    image_destroy(picture);
    remove_directory(directory);
}

static void jpeg_comes_close(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    image *picture = image_create(64, 64, 3, NULL);
    for (int i = 0; i < 64 * 64; i++)
        for (int k = 0; k < 3; k++)
            picture->channels[k][i] = 0.1f + (float)(i % 64) / 64;
    char path[PATH_MAX + 64];
    path_in(path, make_directory(directory), "a.jpg");
    EXPECT_OK(&c, image_write(picture, path, &c.report));
    unsigned char bytes[3 * 64 * 64];
    image_expose(picture, bytes);
    image *read = read_image(path);
    for (int i = 0; i < 3 * 64 * 64; i++)
        assert_true(fabs(255 * image_srgb_encode((double)read->channels[i % 3][i / 3]) - bytes[i]) < 8);
    image_destroy(read);
    image_destroy(picture);
    unlink(path);
    remove_directory(directory);
}

/* A gray picture comes as R, G and B, made linear. */
static void gray_becomes_rgb(void **state) {
    (void)state;
    char path[PATH_MAX + 64];
    path_in(path, make_directory(directory), "gray.pgm");
    write_bytes(path, "P5 2 1 255\n\x80\xff", 13);
    image *read = read_image(path);
    assert_int_equal(read->channel_count, 3);
    assert_string_equal(read->channel_names[2], "B");
    for (int c = 0; c < 3; c++) {
        assert_true(fabs((double)read->channels[c][0] - image_srgb_decode(128 / 255.)) < 1e-6);
        assert_true(fabs((double)read->channels[c][1] - 1) < 1e-6);
    }
    image_destroy(read);
    unlink(path);
    remove_directory(directory);
}

static void suffixes_are_checked(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    static const char *const good[] = {"a.hdr", "a.PIC", "./a.b.exr", "a.png", "a.jpeg", "/dev/stdout", "/dev/null"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        EXPECT_OK(&c, image_check_writable(good[i], &c.report));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "a.xyz: no format is known for .xyz; known are .hdr, .pic, .exr",
                   image_check_writable("a.xyz", &c.report));
    assert_non_null(strstr(c.text, ".png"));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "no format is known for .null", image_check_writable("a.null", &c.report));
    /* OpenImageIO's own writer does not survive large ones. */
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "no format is known for .gif", image_check_writable("a.gif", &c.report));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "has no suffix", image_check_writable("picture", &c.report));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "has no suffix", image_check_writable("dir.png/.png", &c.report));
    image *picture = make_picture(2, 2);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "no format is known", image_write(picture, "a.xyz", &c.report));
    image_destroy(picture);
}

static const char *const each_format[] = {"a.hdr", "a.exr", "a.png", "a.tif", "a.jpg", "a.bmp",
                                          "a.ppm", "a.tga", "a.sgi", "a.iff", "a.jp2"};
enum { FORMATS = sizeof each_format / sizeof *each_format };

static void directories_that_refuse(void **state) {
    (void)state;
    captured c;
    image *picture = make_picture(3, 2);
    make_directory(directory);
    char file[PATH_MAX + 64], below[PATH_MAX + 64], inside[PATH_MAX + 128];
    write_bytes(path_in(file, directory, "file"), "x", 1);
    for (int f = 0; f < FORMATS; f++) {
        snprintf(inside, sizeof inside, "%s/none/%s", directory, each_format[f]);
        EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "cannot be created: No such file",
                       image_write(picture, inside, &c.report));
        snprintf(inside, sizeof inside, "%s/file/%s", directory, each_format[f]);
        EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "cannot be created: Not a directory",
                       image_write(picture, inside, &c.report));
        /* A directory stands where the picture is to be. */
        path_in(below, directory, each_format[f]);
        assert_int_equal(mkdir(below, 0777), 0);
        EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "Is a directory", image_write(picture, below, &c.report));
        assert_int_equal(rmdir(below), 0);
    }
    unlink(file);
    image_destroy(picture);
    remove_directory(directory);
}

/* In a child whose files may hold no more than 2000 bytes: the write fails, what was there before is still there, and
 * nothing else. */
static int write_with_little_room(const image *picture, const char *path) {
    captured c;
    captured_begin(&c);
    struct rlimit limit = {2000, 2000};
    if (signal(SIGXFSZ, SIG_IGN) == SIG_ERR || setrlimit(RLIMIT_FSIZE, &limit) != 0)
        return 10;
    return image_write(picture, path, &c.report) == GRAZE_SYSTEM_ERROR && c.errors == 1 && strstr(c.text, path) ? 0 : 1;
}

static void full_disk_leaves_nothing_behind(void **state) {
    (void)state;
    image *picture = make_picture(60, 50);
    make_directory(directory);
    for (int f = 0; f < FORMATS; f++) {
        char path[PATH_MAX + 64];
        path_in(path, directory, each_format[f]);
        write_bytes(path, "what was there before", 21);
        pid_t child = fork();
        if (child == 0)
            _exit(write_with_little_room(picture, path));
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
            fail_msg("%s: status %#x", each_format[f], (unsigned)status);
        size_t size;
        unsigned char *bytes = read_bytes(path, &size);
        assert_string_equal((char *)bytes, "what was there before");
        free(bytes);
        assert_int_equal(unlink(path), 0);
    }
    image_destroy(picture);
    remove_directory(directory);
}

static void devices_are_written_directly(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    image *picture = make_picture(60, 50);
    EXPECT_OK(&c, image_write(picture, "/dev/null", &c.report));
    EXPECT_FAILURE(&c, GRAZE_SYSTEM_ERROR, "/dev/full: cannot write the picture: No space left",
                   image_write(picture, "/dev/full", &c.report));
    struct stat status;
    assert_int_equal(stat("/dev/full", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
    image_destroy(picture);
}

/* A child reads the named pipe into a file; the picture in it must be the one that was written. */
static void pipes_take_every_format(void **state) {
    (void)state;
    image *picture = make_picture(60, 50);
    make_directory(directory);
    for (int f = 0; f < 3; f++) {
        char fifo[PATH_MAX + 64], copy[PATH_MAX + 64], name[16];
        path_in(fifo, directory, each_format[f]);
        snprintf(name, sizeof name, "copy%s", strchr(each_format[f], '.'));
        path_in(copy, directory, name);
        assert_int_equal(mkfifo(fifo, 0600), 0);
        pid_t child = fork();
        if (child == 0) {
            size_t size = 0;
            static unsigned char bytes[1 << 20];
            FILE *in = fopen(fifo, "rb"), *out = fopen(copy, "wb");
            if (!in || !out)
                _exit(1);
            size = fread(bytes, 1, sizeof bytes, in);
            _exit(fwrite(bytes, 1, size, out) != size || fclose(out) != 0);
        }
        captured c;
        captured_begin(&c);
        EXPECT_OK(&c, image_write(picture, fifo, &c.report));
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_int_equal(status, 0);
        struct stat fifo_status;
        assert_int_equal(stat(fifo, &fifo_status), 0);
        assert_true(S_ISFIFO(fifo_status.st_mode));
        image *read = read_image(copy);
        assert_int_equal(read->width, 60);
        assert_int_equal(read->height, 50);
        image_destroy(read);
        unlink(fifo);
        unlink(copy);
    }
    image_destroy(picture);
    remove_directory(directory);
}

static void links_stay_links(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    image *picture = make_picture(3, 2);
    make_directory(directory);
    char target[PATH_MAX + 64], link[PATH_MAX + 64];
    write_bytes(path_in(target, directory, "target.hdr"), "old", 3);
    assert_int_equal(symlink("target.hdr", path_in(link, directory, "link.hdr")), 0);
    EXPECT_OK(&c, image_write(picture, link, &c.report));
    struct stat status;
    assert_int_equal(lstat(link, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    image_destroy(read_image(target));
    unlink(link);
    unlink(target);
    image_destroy(picture);
    remove_directory(directory);
}

static void files_that_cannot_be_read(void **state) {
    (void)state;
    captured c;
    image *picture;
    make_directory(directory);
    char path[PATH_MAX + 64];
    path_in(path, directory, "none.hdr");
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "none.hdr: cannot be opened: No such file",
                   image_read(&picture, path, &c.report));
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "Is a directory", image_read(&picture, directory, &c.report));
    write_bytes(path_in(path, directory, "empty.png"), "", 0);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "empty.png: the file is empty", image_read(&picture, path, &c.report));
    unlink(path);
    write_bytes(path_in(path, directory, "text.hdr"), "hello", 5);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "text.hdr:1: ", image_read(&picture, path, &c.report));
    unlink(path);
    write_bytes(path_in(path, directory, "bad.bmp"), "BMnonsense", 10);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "bad.bmp: cannot read the picture: ", image_read(&picture, path, &c.report));
    assert_null(picture);
    unlink(path);
    write_bytes(path_in(path, directory, "what"), "nonsense", 8);
    EXPECT_FAILURE(&c, GRAZE_INPUT_ERROR, "what: cannot read the picture: ", image_read(&picture, path, &c.report));
    unlink(path);
    remove_directory(directory);
}

/* Without the module: the formats that are ours still work, others say what is missing. */
static void module_is_missed_only_when_needed(void **state) {
    (void)state;
    make_directory(directory);
    char copy[PATH_MAX + 64], command[2 * PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", command, sizeof command - 1);
    assert_true(length > 0);
    command[length] = 0;
    size_t size;
    unsigned char *bytes = read_bytes(command, &size);
    write_bytes(path_in(copy, directory, "program"), bytes, size);
    free(bytes);
    assert_int_equal(chmod(copy, 0700), 0);
    pid_t child = fork();
    if (child == 0) {
        execl(copy, "program", "--without-module", directory, (char *)NULL);
        _exit(99);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    unlink(copy);
    remove_directory(directory);
}

static int run_without_module(const char *where) {
    captured c;
    captured_begin(&c);
    char path[PATH_MAX + 64];
    image *picture = make_picture(20, 3);
    int failures = image_write(picture, path_in(path, where, "a.exr"), &c.report) != GRAZE_OK;
    failures += unlink(path) != 0;
    failures += image_write(picture, path_in(path, where, "a.hdr"), &c.report) != GRAZE_OK;
    image_destroy(picture);
    failures += image_read(&picture, path, &c.report) != GRAZE_OK || c.errors > 0;
    failures += unlink(path) != 0;
    path_in(path, where, "a.png");
    failures += image_check_writable(path, &c.report) != GRAZE_SYSTEM_ERROR;
    failures += image_write(picture, path, &c.report) != GRAZE_SYSTEM_ERROR;
    failures += c.errors != 2 || !strstr(c.text, "lib/graze/oiio.so");
    image_destroy(picture);
    return failures;
}

int main(int argc, char **argv) {
    if (argc == 3 && !strcmp(argv[1], "--without-module"))
        return run_without_module(argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lossless_files_hold_the_exposed_bytes),
        cmocka_unit_test(jpeg_comes_close),
        cmocka_unit_test(gray_becomes_rgb),
        cmocka_unit_test(suffixes_are_checked),
        cmocka_unit_test(directories_that_refuse),
        cmocka_unit_test(full_disk_leaves_nothing_behind),
        cmocka_unit_test(devices_are_written_directly),
        cmocka_unit_test(pipes_take_every_format),
        cmocka_unit_test(links_stay_links),
        cmocka_unit_test(files_that_cannot_be_read),
        cmocka_unit_test(module_is_missed_only_when_needed),
    };
    return cmocka_run_group_tests(tests, link_module, NULL);
}
