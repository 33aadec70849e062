/* Lights in copies, as rays see them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../rad/binary_writer.h"
#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

static graze_rgb seen(const char *text, vec3 origin, vec3 direction) {
    graze_scene *scene = scene_from_text(text);
    if (!scene)
        fail_msg("%s", messages);
    const graze_trace_settings settings = graze_trace_defaults();
    const graze_ray ray = {.origin = origin, .direction = direction};
    graze_answer found;
    graze_trace(scene, &settings, &ray, 0, &found, NULL);
    graze_scene_destroy(scene);
    return found.value;
}

/* The cone of a spotlight goes with its copy: an octree of a disk that shines downwards, turned to shine along -x. */
static void spotlights_are_turned_with_their_copies(void **state) {
    (void)state;
    const char *disk = "void spotlight s 0 0 7 2 3 4 40 0 0 -1 s ring disk 0 0 8 0 0 0 0 0 -1 0 1";
    char text[200];
    written_file part = written_file_make(disk, strlen(disk));
    const binary octree = octree_of_file(part.name, 2);
    written_file file = written_file_make(octree.bytes, octree.length);
    snprintf(text, sizeof text, "void instance x 5 %s -ry 90 -s 2 0 0", file.name);
    const double inside = tan(19 * 3.14159265 / 180), outside = tan(21 * 3.14159265 / 180);
    assert_true(seen(text, vec3_make(-5, 0, 0), vec3_make(1, 0, 0)).g == 3);
    assert_true(seen(text, vec3_make(-5, 0, -5 * inside), vec3_make(1, 0, inside)).g == 3);
    assert_true(seen(text, vec3_make(-5, 0, -5 * outside), vec3_make(1, 0, outside)).g == 0);
    snprintf(text, sizeof text, "void instance x 1 %s 0 0", file.name);
    assert_true(seen(text, vec3_make(0, -5 * inside, -5), vec3_make(0, inside, 1)).g == 3);
    assert_true(seen(text, vec3_make(0, -5 * outside, -5), vec3_make(0, outside, 1)).g == 0);
    unlink(file.name);
    unlink(part.name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spotlights_are_turned_with_their_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
