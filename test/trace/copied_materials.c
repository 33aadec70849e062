/* Materials of functions in copies: they know the place where they are written for, and what they tell comes from
 * there. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../rad/binary_writer.h"
#include "one_ray.h"

/* A disk at the origin that faces +z, and where that brings it. */
#define PLACED       "-rz 30 -rx 90 -s 2 -t 0 3 0"
#define PLACED_WORDS 10
static const char *const disk = "m ring disk 0 0 8 0 0 0 0 0 1 0 1";
static const char *const placed_disk = "m ring disk 0 0 8 0 3 0 0 -1 0 0 2";

/* Up to the transform, with how many string arguments that is, and after it. */
static const struct {
    const char *type;
    int words;
    const char *strings, *reals;
} materials[] = {
    {"prism1", 5, ".5+.2*Px Dx+.1*Py Dy Dz .", "0 0"},
    {"prism2", 9, ".3 Dx Dy Dz .2+.1*Px Dx+.2 Dy+.1 Dz .", "0 0"},
    {"BRTDfunc", 10, ".1+.1*Px .2+.01*T .1 .3+.2*Nz .2+.1*NzP .3+.01*Ts max min max .",
     "0 9 .1 .2 .3 .3 .2 .1 .1 .05 .1"},
    {"transfunc", 2, "max .", "0 6 .7 .6 .5 .2 .6 .7"},
    {"WGMDfunc", 13, "void .2+.1*Px .2 .1 void .3+.1*Py .2 .3 void 1 Px .5 .", "0 9 .1 .2 .3 .3 .2 .1 .1 .1 .1"},
    {"WGMDfunc", 13, "void .1+.1*Px 0 0 void .4+.1*NzP 0 0 void 1 Px .5 .", "0 9 .1 .2 .3 .3 .2 .1 .1 .1 .1"},
};

static graze_answer answer_of(const char *things, vec3 eye) {
    char text[1200];
    snprintf(text, sizeof text,
             "void colorfunc c 4 1+.9*Dx 1 1+.9*Dz . 0 0 c glow g 0 0 4 1 2 3 0 g source sky 0 0 4 0 0 1 360 void "
             "light l 0 0 3 40 30 20 l sphere a 0 0 4 1 1 2 "
             ".5 l sphere b 0 0 4 -2 5 1 .5 %s",
             things);
    graze_trace_settings settings = graze_trace_defaults();
    settings.samples = 16384;
    settings.ambient_bounces = 1;
    const vec3 direction = vec3_subtract(vec3_make(0.5, 3, 0.3), eye);
    return answer_along(text, &settings, (graze_ray){.origin = eye, .direction = direction});
}

/* A copy is as what is written where it is, with the copy's transform after the material's own arguments. */
static void copies_are_as_what_is_written_there(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        for (int behind = 0; behind < 2; behind++) {
            char text[600];
            const vec3 eye = {0.1, behind ? 5 : 1, 0.6};
            int length = snprintf(text, sizeof text, "void %s m %d %s %s %s", materials[i].type, materials[i].words,
                                  materials[i].strings, materials[i].reals, disk);
            written_file part = written_file_make(text, (size_t)length);
            const binary octree = octree_of_file(part.name, 2);
            written_file file = written_file_make(octree.bytes, octree.length);
            snprintf(text, sizeof text, "void instance x %d %s %s 0 0", 1 + PLACED_WORDS, file.name, PLACED);
            graze_answer copy = answer_of(text, eye);
            unlink(part.name);
            unlink(file.name);
            snprintf(text, sizeof text, "void %s m %d %s %s %s %s", materials[i].type,
                     materials[i].words + PLACED_WORDS, materials[i].strings, PLACED, materials[i].reals, placed_disk);
            graze_answer written = answer_of(text, eye);
            assert_true(copy.value.r > 0 && copy.value.g > 0 && copy.value.b > 0);
            assert_answers_agree(text, copy, written);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_are_as_what_is_written_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
