/* Pictures whose pixels share indirect light: the same on any number of threads, true, and sooner. */
#include <stdio.h>

#include "../rad/binary_writer.h"
#include "picture/state.h"
#include "picture/support.h"

/* A room with a window, and a dark one behind a thin wall that they share a floor through a door of. */
static const char rooms[] = "void plastic wall 0 0 5 .7 .7 .6 0 0\n"
                            "void plastic wood 0 0 5 .4 .3 .2 .05 .1\n"
                            "void glow sky 0 0 4 10 10 12 0\n"
                            "wood polygon floor 0 0 12 0 0 0 6 0 0 6 4 0 0 4 0\n"
                            "wall polygon ceiling 0 0 12 0 0 3 0 4 3 6 4 3 6 0 3\n"
                            "wall polygon south 0 0 12 0 0 0 0 0 3 6 0 3 6 0 0\n"
                            "wall polygon north 0 0 12 0 4 0 6 4 0 6 4 3 0 4 3\n"
                            "wall polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
                            "wall polygon east 0 0 12 6 0 0 6 0 3 6 4 3 6 4 0\n"
                            "sky polygon window 0 0 12 .01 1 1 .01 3 1 .01 3 2.5 .01 1 2.5\n"
                            "wall polygon left 0 0 12 3.5 2.8 0 3.5 4 0 3.5 4 3 3.5 2.8 3\n"
                            "wall polygon right 0 0 12 3.5 0 0 3.5 1.4 0 3.5 1.4 3 3.5 0 3\n"
                            "wood sphere ball 0 0 4 2.2 3 .4 .4\n";

enum { SIDE = 64, ALL = SIDE * SIDE };

static picture_settings settings_at(double jitter) {
    picture_settings s = room_settings();
    s.width = s.height = SIDE;
    s.jitter = jitter;
    s.view.point = (vec3){0.6, 0.5, 1.6};
    s.view.direction = (vec3){1, 0.5, -0.2};
    s.view.horizontal = s.view.vertical = 75;
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    return s;
}

static graze_trace_settings tracing(void) {
    graze_trace_settings trace = graze_trace_defaults();
    trace.ambient_bounces = 3;
    trace.error = 0.1;
    return trace;
}

static void threads_do_not_change_the_bytes(void **state) {
    (void)state;
    graze_trace_settings trace = tracing();
    picture_settings s = settings_at(1);
    s.threads = 1;
    sitting one = sitting_of(rooms, &trace, &s);
    s.threads = 3;
    sitting three = sitting_of(rooms, &trace, &s);
    assert_non_null(one.picture->shared);
    assert_same_pictures(&one, &three);
    sitting_end(&one);
    sitting_end(&three);
}

static double mean_of(const sitting *s, const char *name, int left, int right) {
    double sum = 0;
    for (int i = 0; i < ALL; i++)
        sum += i % SIDE >= left && i % SIDE < right ? plane(s, name)[i] : 0;
    return sum / SIDE / (right - left);
}

static void assert_means_agree(const sitting *a, const sitting *b, const char *name, double tolerance) {
    for (int left = 0; left < SIDE; left += SIDE / 4) {
        double found = mean_of(a, name, left, left + SIDE / 4), truth = mean_of(b, name, left, left + SIDE / 4);
        if (fabs(found - truth) > tolerance * truth)
            fail_msg("%s from column %d on: %g, in truth %g", name, left, found, truth);
    }
}

static void assert_errors_are_honest(const sitting *a, const sitting *b) {
    const float *value = plane(a, "G"), *truth = plane(b, "G");
    const float *error = plane(a, "standard_error.G"), *other = plane(b, "standard_error.G");
    int within = 0;
    for (int i = 0; i < ALL; i++)
        within += fabs(value[i] - truth[i]) <= 1.96 * hypot(error[i], other[i]);
    if (within < 0.945 * ALL)
        fail_msg("%d of %d are within", within, ALL);
}

/* Beside a picture of many samples, which shares nothing. */
static void assert_true_picture(const char *text, double jitter) {
    graze_trace_settings trace = tracing(), many = trace;
    picture_settings s = settings_at(jitter);
    many.samples = 256;
    sitting whole = sitting_of(text, &trace, &s), truth = sitting_of(text, &many, &s);
    assert_non_null(whole.picture->shared);
    assert_null(truth.picture->shared);
    assert_errors_are_honest(&whole, &truth);
    assert_means_agree(&whole, &truth, "G", 0.01);
    assert_means_agree(&whole, &truth, "direct.G", 0.01);
    assert_means_agree(&whole, &truth, "indirect.G", 0.015);
    sitting_end(&whole);
    sitting_end(&truth);
}

static void what_is_shared_is_true(void **state) {
    (void)state;
    assert_true_picture(rooms, 0);
    assert_true_picture(rooms, 1);
}

/* Panes before the window, and a flat mirror, show lights that must be found neither twice nor not at all. */
static void what_is_shared_beside_panes_and_mirrors_is_true(void **state) {
    (void)state;
    static const char panes[] = "void glass clear 0 0 3 .9 .9 .9\n"
                                "clear polygon pane 0 0 12 .1 .9 .9 .1 3.1 .9 .1 3.1 2.6 .1 .9 2.6\n"
                                "void mirror silver 0 0 3 .8 .8 .8\n"
                                "silver polygon glass 0 0 12 3.49 .2 .5 3.49 .2 2 3.49 1.3 2 3.49 1.3 .5\n";
    char text[sizeof rooms + sizeof panes];
    snprintf(text, sizeof text, "%s%s", rooms, panes);
    assert_true_picture(text, 1);
}

/* What a ball of glass bends of the window's light is looked for on the floor. */
static void what_is_shared_beside_glass_is_true(void **state) {
    (void)state;
    static const char glass[] = "void dielectric crystal 0 0 5 .9 .95 .98 1.5 0\n"
                                "crystal sphere paperweight 0 0 4 1.8 2 .25 .25\n";
    char text[sizeof rooms + sizeof glass];
    snprintf(text, sizeof text, "%s%s", rooms, glass);
    assert_true_picture(text, 1);
}

/* A glow in a mixture lights what is about, but only by reflections that lead to it; a light there lights nothing. */
static void lights_that_are_only_met_are_not_lost(void **state) {
    (void)state;
    static const char shutter[] = "void %s bright 0 0 %s\n"
                                  "void plastic dark 0 0 5 .1 .1 .1 0 0\n"
                                  "void mixfunc half 4 bright dark .5 . 0 0\n"
                                  "half polygon shutter 0 0 12 3.4 .2 .4 3.4 .2 2.2 3.4 1.2 2.2 3.4 1.2 .4\n";
    char text[sizeof rooms + sizeof shutter + 32];
    size_t length = (size_t)snprintf(text, sizeof text, "%s", rooms);
    snprintf(text + length, sizeof text - length, shutter, "light", "3 9 9 9");
    assert_true_picture(text, 1);
    snprintf(text + length, sizeof text - length, shutter, "glow", "4 9 9 9 0");
    graze_trace_settings trace = tracing();
    picture_settings s = settings_at(1);
    sitting met = sitting_of(text, &trace, &s);
    assert_non_null(met.picture->cache);
    assert_null(met.picture->shared);
    sitting_end(&met);
}

/* The same in a copy is sampled where it stands. */
static void light_of_copies_is_shared(void **state) {
    (void)state;
    static const char lamp[] = "void glow bright 0 0 4 9 9 9 0\n"
                               "bright polygon shutter 0 0 12 .4 .2 0 2.2 .2 0 2.2 1.2 0 .4 1.2 0\n";
    binary octree = {.length = 0};
    written_file part = written_file_make(lamp, strlen(lamp));
    put_octree_head(&octree, 4);
    put_text(&octree, part.name);
    put_text(&octree, "");
    put_integer(&octree, 2, 4);
    put_integer(&octree, 0, 1);
    written_file file = written_file_make(octree.bytes, octree.length);
    char text[sizeof rooms + 128];
    snprintf(text, sizeof text, "%svoid instance x 7 %s -ry -90 -t 3.4 0 0 0 0\n", rooms, file.name);
    assert_true_picture(text, 1);
    unlink(file.name);
    unlink(part.name);
}

static int pixels_of_few_samples(const sitting *s) {
    int count = 0;
    for (int i = 0; i < ALL; i++)
        count += plane(s, "samples.Y")[i] < 17;
    return count;
}

/* Most pixels need next to no samples where light is shared. Through a lens it is not. */
static void most_pixels_share(void **state) {
    (void)state;
    graze_trace_settings trace = tracing();
    picture_settings s = settings_at(1);
    sitting sharp = sitting_of(rooms, &trace, &s);
    s.aperture = 1e-6;
    sitting lens = sitting_of(rooms, &trace, &s);
    assert_non_null(lens.picture->cache);
    assert_null(lens.picture->shared);
    int with = pixels_of_few_samples(&sharp), without = pixels_of_few_samples(&lens);
    if (with < without + ALL / 3)
        fail_msg("%d pixels take few samples, %d where nothing is shared", with, without);
    sitting_end(&sharp);
    sitting_end(&lens);
}

/* Making what is shared is begun again. */
static void stopping_changes_nothing(void **state) {
    (void)state;
    graze_trace_settings trace = tracing();
    picture_settings s = settings_at(1);
    sitting stopped = sitting_begin(rooms, &trace, &s);
    picture_stop(stopped.picture);
    assert_int_equal(picture_render(stopped.picture, NULL), GRAZE_OK);
    assert_null(stopped.picture->shared);
    assert_null(stopped.picture->cache);
    sitting_end(&stopped);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_change_the_bytes),
        cmocka_unit_test(what_is_shared_is_true),
        cmocka_unit_test(what_is_shared_beside_panes_and_mirrors_is_true),
        cmocka_unit_test(what_is_shared_beside_glass_is_true),
        cmocka_unit_test(lights_that_are_only_met_are_not_lost),
        cmocka_unit_test(light_of_copies_is_shared),
        cmocka_unit_test(most_pixels_share),
        cmocka_unit_test(stopping_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
