/* Lights in copies, as rays see them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../rad/binary_writer.h"
#include "base/angle.h"
#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

static graze_rgb seen(const char *text, vec3 origin, vec3 direction) {
    graze_scene *scene = load_scene(text);
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

/* Of six that coincide one lights, also beside a copy that is of glass, mist or antimatter, or where there is such a
 * copy of them: light passes nothing but what is in that copy. */
static void lights_coincide_beside_glass(void **state) {
    (void)state;
    const char *pane = "w polygon p 0 0 12 0 .2 1.1 .2 .2 1.1 .2 0 1 0 0 1 ";
    const char *ball = "void plastic p 0 0 5 0 0 0 0 0 p sphere b 0 0 4 4 4 1 .1";
    char six[600], text[400];
    snprintf(six, sizeof six, "void glow w 0 0 4 5 5 5 0 %s%s%s%s%s%s", pane, pane, pane, pane, pane, pane);
    written_file parts[] = {written_file_make(six, strlen(six)), written_file_make(ball, strlen(ball))};
    const binary lights = octree_of_file(parts[0].name, 7), beside = octree_of_file(parts[1].name, 2);
    written_file octrees[] = {written_file_make(lights.bytes, lights.length),
                              written_file_make(beside.bytes, beside.length)};
    enum { CASES = 5 };
    static const struct {
        const char *modifier;
        int part;
    } cases[CASES] = {{"void", 1}, {"g", 1}, {"g", 0}, {"m", 0}, {"a", 0}};
    double found[CASES];
    for (int k = 0; k < CASES; k++) {
        snprintf(text, sizeof text,
                 "void plastic q 0 0 5 .5 .5 .5 0 0 q ring floor 0 0 8 0 0 0 0 0 1 0 9 void glass g 0 0 3 .9 .9 .9 "
                 "void mist m 0 0 3 .1 .1 .1 void antimatter a 1 q 0 0 "
                 "void instance x 1 %s 0 0 %s instance y 5 %s -t 0 0 90 0 0",
                 octrees[0].name, cases[k].modifier, octrees[cases[k].part].name);
        graze_scene *scene = scene_from_text(text);
        assert_non_null(scene);
        graze_trace_settings settings = graze_trace_defaults();
        settings.ambient_bounces = 1;
        settings.samples = 4096;
        const graze_ray ray = {.origin = {-1, -2, 1}, .direction = {0.2, 0.4, -0.3}};
        graze_answer answer;
        graze_trace(scene, &settings, &ray, 0, &answer, NULL);
        found[k] = answer.value.g;
        graze_scene_destroy(scene);
        assert_true(found[0] > 0 && fabs(found[k] - found[0]) < 0.05 * found[0]);
    }
    for (int i = 0; i < 2; i++) {
        unlink(parts[i].name);
        unlink(octrees[i].name);
    }
}

/* An octree of one scene file of so many primitives. */
static written_file write_octree(const written_file *part, int count) {
    binary octree = {.length = 0};
    put_octree_head(&octree, 4);
    put_text(&octree, part->name);
    put_text(&octree, "");
    put_integer(&octree, count, 4);
    put_integer(&octree, 0, 1);
    return written_file_make(octree.bytes, octree.length);
}

static graze_answer irradiance(const graze_scene *scene, const graze_trace_settings *s, double x, uint64_t number) {
    const graze_ray sensor = {.origin = {x, 0.3 * x, 0}, .direction = {0, 0, 1}};
    graze_answer answer;
    graze_trace(scene, s, &sensor, number, &answer, NULL);
    return answer;
}

/* Of all shapes, one of them concave and one with a pattern, mirrored and turned: as if they stood there themselves, in
 * all strategies, and soon. */
static void glows_in_copies_light_as_if_they_stood_there(void **state) {
    (void)state;
    static const char lamps[] = "void glow g 0 0 4 9 8 7 0\n"
                                "void brightfunc stripes 2 if(mod(8*Px,2)-1,1,.1) . 0 0\n"
                                "stripes glow h 0 0 4 20 20 20 0\n"
                                "g polygon l 0 0 18 0 0 0 0 1 0 .3 1 0 .3 .3 0 1 .3 0 1 0 0\n"
                                "h polygon p 0 0 12 -1 -1 .2 -1 -.2 .2 .5 -.2 .2 .5 -1 .2\n"
                                "g sphere s 0 0 4 -1.5 0 0 .2\n"
                                "g ring r 0 0 8 2 0 0 0 0 -1 .1 .4\n"
                                "g cone c 0 0 8 0 2 0 1 2 0 .1 .2\n";
    static const char transform[] = "-mx -rx 25 -rz 40 -s 1.5 -t .5 .2 3";
    char text[400];
    written_file part = written_file_make(lamps, strlen(lamps)), octree = write_octree(&part, 8);
    snprintf(text, sizeof text, "void instance i 12 %s %s 0 0\n", octree.name, transform);
    graze_scene *copied = scene_from_text(text);
    snprintf(text, sizeof text, "!xform %s %s\n", transform, part.name);
    graze_scene *placed = scene_from_text(text);
    if (!copied || !placed)
        fail_msg("%s", messages);
    graze_trace_settings s = graze_trace_defaults();
    s.quantity = GRAZE_IRRADIANCE;
    s.ambient_bounces = 1;
    for (int i = 0; i < 8; i++) {
        s.strategy = GRAZE_STRATEGY_BRDF;
        s.samples = 1u << 17;
        graze_answer truth = irradiance(placed, &s, i - 3.5, 1000 + (uint64_t)i);
        s.samples = 0;
        s.error = 0.01;
        uint32_t samples[3];
        for (int strategy = GRAZE_STRATEGY_MIS; strategy <= GRAZE_STRATEGY_BRDF; strategy++) {
            s.strategy = (graze_strategy)strategy;
            graze_answer found = irradiance(copied, &s, i - 3.5, (uint64_t)i);
            double off = found.value.g - truth.value.g;
            if (fabs(off) > 4 * hypot(found.standard_error.g, truth.standard_error.g) + 0.003 * truth.value.g)
                fail_msg("strategy %d at %d: %g, in truth %g", strategy, i, found.value.g, truth.value.g);
            samples[strategy] = found.samples;
        }
        if (samples[GRAZE_STRATEGY_MIS] > samples[GRAZE_STRATEGY_BRDF] / 4)
            fail_msg("%u samples, by reflection %u", samples[GRAZE_STRATEGY_MIS], samples[GRAZE_STRATEGY_BRDF]);
    }
    s.strategy = GRAZE_STRATEGY_MIS;
    s.ambient_bounces = 0;
    assert_true(irradiance(copied, &s, 0.5, 0).value.g == 0);
    graze_scene_destroy(copied);
    graze_scene_destroy(placed);
    unlink(octree.name);
    unlink(part.name);
}

/* No nearer than their radius, which no transform changes: what is nearer is not lit, as in Radiance. */
static void glows_in_copies_light_from_beyond_their_radius(void **state) {
    (void)state;
    char text[200];
    double found[2];
    for (int wide = 0; wide < 2; wide++) {
        const char *glow = wide ? "void glow g 0 0 4 9 9 9 3.1 g ring r 0 0 8 0 0 0 0 0 -1 0 .5"
                                : "void glow g 0 0 4 9 9 9 2.9 g ring r 0 0 8 0 0 0 0 0 -1 0 .5";
        written_file part = written_file_make(glow, strlen(glow)), octree = write_octree(&part, 2);
        snprintf(text, sizeof text, "void instance i 7 %s -s .1 -t 0 0 3 0 0\n", octree.name);
        graze_scene *scene = scene_from_text(text);
        if (!scene)
            fail_msg("%s", messages);
        graze_trace_settings s = graze_trace_defaults();
        s.quantity = GRAZE_IRRADIANCE;
        s.ambient_bounces = 1;
        found[wide] = irradiance(scene, &s, 0, 0).value.g;
        graze_scene_destroy(scene);
        unlink(octree.name);
        unlink(part.name);
    }
    assert_true(fabs(found[0] / (9 * PI * .05 * .05 / (3 * 3 + .05 * .05)) - 1) < 1e-3);
    assert_true(found[1] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glows_in_copies_light_as_if_they_stood_there),
        cmocka_unit_test(glows_in_copies_light_from_beyond_their_radius),
        cmocka_unit_test(spotlights_are_turned_with_their_copies),
        cmocka_unit_test(lights_coincide_beside_glass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
