/* What the tests of pictures share: a directory for files, random numbers, the module's place. */
#define _XOPEN_SOURCE 700 /* realpath, mkdtemp */
#ifndef TEST_IMAGE_SUPPORT_H
#define TEST_IMAGE_SUPPORT_H

#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/captured_report.h"
#include "image/image.h"

#define EXPECT_OK(c, call)                                                                                             \
    do {                                                                                                               \
        if ((call) != GRAZE_OK)                                                                                        \
            fail_msg("%s", (c)->text);                                                                                 \
    } while (0)

/* `call` must fail with this status and a message that holds this text. */
#define EXPECT_FAILURE(c, status, part, call)                                                                          \
    do {                                                                                                               \
        captured_begin(c);                                                                                             \
        assert_int_equal((call), (status));                                                                            \
        assert_int_equal((c)->errors, 1);                                                                              \
        if (!strstr((c)->text, (part)))                                                                                \
            fail_msg("'%s' does not say '%s'", (c)->text, (part));                                                     \
    } while (0)

static inline uint64_t random_bits(uint64_t *seed) {
    *seed += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = *seed;
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static inline double random_unit(uint64_t *seed) {
    return (double)(random_bits(seed) >> 11) * 0x1p-53;
}

static inline image *uniform(int width, int height, float value) {
    image *picture = image_create(width, height, 3, NULL);
    assert_non_null(picture);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < width * height; i++)
            picture->channels[c][i] = value;
    return picture;
}

static inline void set_gray(image *picture, int i, float value) {
    for (int c = 0; c < 3; c++)
        picture->channels[c][i] = value;
}

/* A directory of the test's own; its name ends without a slash. */
static inline const char *make_directory(char directory[PATH_MAX]) {
    const char *parent = getenv("TMPDIR");
    snprintf(directory, PATH_MAX, "%s/graze-test-XXXXXX", parent && *parent ? parent : "/tmp");
    assert_non_null(mkdtemp(directory));
    return directory;
}

/* Removes an empty directory: whatever a test leaves in it, such as a temporary file, makes this fail. */
static inline void remove_directory(const char *directory) {
    assert_int_equal(rmdir(directory), 0);
}

static inline const char *path_in(char path[PATH_MAX + 64], const char *directory, const char *name) {
    snprintf(path, PATH_MAX + 64, "%s/%s", directory, name);
    return path;
}

static inline void write_bytes(const char *path, const void *bytes, size_t size) {
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

/* The whole file; free it. */
static inline unsigned char *read_bytes(const char *path, size_t *size) {
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    assert_int_equal(fseek(in, 0, SEEK_END), 0);
    long length = ftell(in);
    assert_true(length >= 0);
    rewind(in);
    unsigned char *bytes = malloc((size_t)length + 1);
    assert_non_null(bytes);
    *size = fread(bytes, 1, (size_t)length, in);
    assert_int_equal(*size, length);
    bytes[*size] = 0;
    fclose(in);
    return bytes;
}

static inline image *read_image(const char *path) {
    captured c;
    captured_begin(&c);
    image *picture;
    EXPECT_OK(&c, image_read(&picture, path, &c.report));
    return picture;
}

/* Programs look for the module in ../lib/graze; test programs stand elsewhere than in bin: a link leads them there. The
 * module lies in the build's own lib/graze, or in the tree's. */
static inline int link_module(void **state) {
    (void)state;
    char build[PATH_MAX], path[PATH_MAX + 64], module[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", build, sizeof build - 1);
    if (length < 0)
        return -1;
    build[length] = 0;
    for (int i = 0; i < 3; i++)
        *strrchr(build, '/') = 0;
    snprintf(path, sizeof path, "%s/lib/graze/oiio.so", build);
    if (!realpath(path, module) && !realpath("lib/graze/oiio.so", module)) {
        fprintf(stderr, "no lib/graze/oiio.so: make it first\n");
        return -1;
    }
    snprintf(path, sizeof path, "%s/test/lib", build);
    mkdir(path, 0777);
    strcat(path, "/graze");
    mkdir(path, 0777);
    strcat(path, "/oiio.so");
    unlink(path);
    if (symlink(module, path) != 0 && access(path, R_OK) != 0)
        return -1;
    return 0;
}

#endif
