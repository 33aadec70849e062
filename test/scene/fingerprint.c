/* A scene's fingerprint: it changes with every file that the scene names, and with nothing but what is in them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "scene/fingerprint.h"
#include "support/scene_text.h"

/* The fingerprint of a scene that names a file, with that file's text. */
static uint64_t fingerprint_with(const char *scene_text, const char *file, const char *text, size_t length) {
    FILE *out = fopen(file, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(text, 1, length, out), length);
    assert_int_equal(fclose(out), 0);
    graze_scene *scene = load_scene(scene_text);
    uint64_t f = scene_fingerprint(scene);
    graze_scene_destroy(scene);
    return f;
}

static void assert_differs(const char *scene, const char *file, const char *text, const char *other, size_t length) {
    uint64_t f = fingerprint_with(scene, file, text, length);
    assert_true(f == fingerprint_with(scene, file, text, length));
    assert_true(f != fingerprint_with(scene, file, other, length));
}

#define REST " m plastic g 0 0 5 .5 .5 .5 0 0\ng sphere s 0 0 4 0 0 0 1\n"

static void function_files_count(void **state) {
    (void)state;
    assert_differs("void brightfunc m 2 b p.cal 0 0\n" REST, "p.cal", "b = Px;", "b = Py;", 7);
}

static void data_files_count(void **state) {
    (void)state;
    const char *scene = "void brightdata m 4 noneg d.dat . Px 0 0\n" REST;
    assert_differs(scene, "d.dat", "1 0 1 2 3 4", "1 0 1 2 3 5", 11);
    assert_differs(scene, "d.dat", "1 0 1 2 3 4", "1 0 3 2 3 4", 11);
    assert_differs(scene, "d.dat", "1 0 0 2 1 5 3 4", "1 0 0 2 1 6 3 4", 15);
}

#define HEAD "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n"

static void pictures_count(void **state) {
    (void)state;
    static const char first[] = HEAD "\200\200\200\200\200\200\200\200\200\200\200\200\200\200\200\200";
    static const char other[] = HEAD "\200\200\200\200\200\200\200\200\200\200\200\200\200\200\201\200";
    assert_differs("void colorpict m 7 clip_r clip_g clip_b p.hdr . Px Py 0 0\n" REST, "p.hdr", first, other,
                   sizeof first - 1);
}

static int enter_directory(void **state) {
    static char name[] = "/tmp/graze-fingerprint-XXXXXX";
    *state = name;
    return !mkdtemp(name) || chdir(name);
}

static int leave_directory(void **state) {
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", (const char *)*state);
    return chdir("/") || system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(function_files_count),
        cmocka_unit_test(data_files_count),
        cmocka_unit_test(pictures_count),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
