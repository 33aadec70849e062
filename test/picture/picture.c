/* Pictures: the same bytes on any number of threads, the layers, and the error asked for. */
#include "picture/support.h"

static void neither_threads_nor_order_change_the_bytes(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.error = 0.1;
    picture_settings s = room_settings();
    sitting two = sitting_of(room, &trace, &s);
    s.threads = 5;
    sitting five = sitting_of(room, &trace, &s);
    s.threads = 1;
    s.spacing = 1;
    sitting one = sitting_of(room, &trace, &s);
    assert_same_pictures(&two, &five);
    assert_same_pictures(&two, &one);
    sitting_end(&one);
    sitting_end(&two);
    sitting_end(&five);
}

static void every_pixel_has_the_error_asked_for(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.error = 0.05;
    picture_settings s = room_settings();
    sitting whole = sitting_of(room, &trace, &s);
    const float *value = plane(&whole, "G"), *error = plane(&whole, "standard_error.G");
    const float *samples = plane(&whole, "samples.Y");
    double mean = 0, reached = 0, paths = 0;
    for (int i = 0; i < PIXELS; i++)
        mean += value[i] / PIXELS;
    assert_true(mean > 0);
    /* The floor comes from a pilot's estimate of the mean, which is good to a tenth here. Each half of the samples
     * ends when the other half says so: what both together state afterwards may be a little more. */
    int above = 0;
    for (int i = 0; i < PIXELS; i++) {
        double floored = fmax(value[i], 1.1 * PICTURE_FLOOR * mean), asked = 0.0501 * floored;
        above += error[i] > asked;
        assert_true(error[i] <= 2 * asked);
        reached += error[i] / floored / PIXELS;
        paths += samples[i];
    }
    assert_true(above < PIXELS / 20);
    picture_progress end = picture_look(whole.picture);
    assert_int_equal(end.unconverged, 0);
    assert_int_equal(end.paths, (uint64_t)paths);
    assert_true(fabs(end.error - reached) < 0.1 * reached);
    sitting_end(&whole);
}

static void layers_tell_depth_normal_and_samples(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.samples = 20;
    picture_settings s = room_settings();
    sitting whole = sitting_of(room, &trace, &s);
    const float *samples = plane(&whole, "samples.Y"), *depth = plane(&whole, "depth.Z");
    int bottom = 29 * WIDTH + 20, top = 20;
    assert_true(samples[bottom] == 20 && samples[top] == 20);
    assert_true(plane(&whole, "normal.Z")[bottom] == 1);
    assert_true(depth[bottom] > 1 && depth[bottom] < 3);
    assert_true(depth[top] == 1e10f);
    /* Lobe and diffuse part together: the material reflects 0.6 of all; nothing is seen above. */
    assert_true(fabsf(plane(&whole, "albedo.R")[bottom] - 0.6f) < 1e-6f);
    assert_true(plane(&whole, "albedo.R")[top] == 0);
    sitting_end(&whole);
}

/* A picture without layers has the same colours, and with depth the same depths. */
static void what_is_not_wanted_changes_nothing(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.samples = 20;
    picture_settings s = room_settings();
    sitting layers = sitting_of(room, &trace, &s);
    s.content = PICTURE_COLOR;
    sitting color = sitting_of(room, &trace, &s);
    s.content = PICTURE_DEPTH;
    sitting depth = sitting_of(room, &trace, &s);
    assert_int_equal(picture_image(color.picture)->channel_count, 3);
    assert_int_equal(picture_image(depth.picture)->channel_count, 4);
    assert_memory_equal(plane(&layers, "B"), plane(&color, "B"), PIXELS * sizeof(float));
    assert_memory_equal(plane(&layers, "B"), plane(&depth, "B"), PIXELS * sizeof(float));
    assert_memory_equal(plane(&layers, "depth.Z"), plane(&depth, "depth.Z"), PIXELS * sizeof(float));
    sitting_end(&layers);
    sitting_end(&color);
    sitting_end(&depth);
}

static void assert_parts_make_the_whole(const sitting *s) {
    const float *value = plane(s, "R"), *direct = plane(s, "direct.R"), *indirect = plane(s, "indirect.R");
    for (int i = 0; i < PIXELS; i++) {
        assert_true(direct[i] >= 0 && indirect[i] >= 0);
        assert_true(fabsf(direct[i] + indirect[i] - value[i]) <= 2e-7f * value[i]);
    }
}

/* The ambient value is indirect light: all of it, from a surface that reflects half. */
static void ambient_value_is_indirect(void **state) {
    (void)state;
    static const char plain[] = "void plastic p 0 0 5 .5 .5 .5 0 0 p polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n"
                                "void light l 0 0 3 9 9 9 l sphere lamp 0 0 4 0 3 1 .3\n";
    graze_trace_settings trace = graze_trace_defaults();
    trace.samples = 20;
    trace.ambient_value = (graze_rgb){2, 2, 2};
    picture_settings s = room_settings();
    sitting whole = sitting_of(plain, &trace, &s);
    int bottom = 29 * WIDTH + 20;
    assert_true(fabsf(plane(&whole, "indirect.R")[bottom] - 1) < 1e-6f);
    assert_true(fabsf(plane(&whole, "albedo.R")[bottom] - 0.5f) < 1e-6f);
    assert_true(plane(&whole, "direct.R")[bottom] > 0);
    assert_parts_make_the_whole(&whole);
    trace.ambient_value = (graze_rgb){0, 0, 0};
    sitting dark = sitting_of(plain, &trace, &s);
    assert_memory_equal(plane(&dark, "direct.R"), plane(&dark, "R"), PIXELS * sizeof(float));
    sitting_end(&whole);
    sitting_end(&dark);
}

/* A closed ball with a lamp: light goes round; the lamp is bright in a mirror, directly. */
static void light_that_goes_round_is_indirect(void **state) {
    (void)state;
    static const char box[] = "void plastic p 0 0 5 .5 .5 .5 0 0 p bubble walls 0 0 4 0 0 0 6\n"
                              "void metal glass 0 0 5 .9 .9 .9 1 0\n"
                              "glass polygon mirror 0 0 12 -1 1 -1 1 1 -1 1 1 1 -1 1 1\n"
                              "void light l 0 0 3 9 9 9 l sphere lamp 0 0 4 0 -5 1 .5\n";
    graze_trace_settings trace = graze_trace_defaults();
    trace.samples = 64;
    picture_settings s = room_settings();
    s.view.direction = (vec3){0, 1, 0};
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    sitting none = sitting_of(box, &trace, &s);
    trace.ambient_bounces = 3;
    sitting whole = sitting_of(box, &trace, &s);
    assert_parts_make_the_whole(&whole);
    /* Bounces leave direct light as it is. */
    double direct = 0, alone = 0, brightest = 0, indirect = 0;
    for (int i = 0; i < PIXELS; i++) {
        direct += plane(&whole, "direct.R")[i];
        indirect += plane(&whole, "indirect.R")[i];
        alone += plane(&none, "direct.R")[i];
        brightest = fmax(brightest, plane(&whole, "direct.R")[i]);
    }
    assert_true(brightest > 0.8 * 9 * 0.9);
    assert_true(fabs(direct - alone) < 0.01 * alone);
    assert_true(indirect > 0.3 * direct);
    sitting_end(&whole);
    sitting_end(&none);
}

/* A lamp and nothing else: a few samples may all fall on one side of its edges, which pixels' corners see. */
static void edges_of_lamps_are_seen(void **state) {
    (void)state;
    static const char lamp[] = "void light l 0 0 3 1000 1000 1000\n"
                               "l polygon lamp 0 0 12 -1 10 -.7 1.1 10 -.6 .9 10 .8 -1.2 10 .7\n";
    graze_trace_settings trace = graze_trace_defaults(), many = trace;
    picture_settings s = room_settings();
    s.view.point = (vec3){0, 0, 0};
    s.view.direction = (vec3){0, 1, 0};
    s.view.horizontal = 20;
    s.view.vertical = 15;
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    many.samples = 4096;
    many.seed = 1;
    sitting whole = sitting_of(lamp, &trace, &s), truth = sitting_of(lamp, &many, &s);
    const float *value = plane(&whole, "G"), *error = plane(&whole, "standard_error.G"), *samples;
    const float *right = plane(&truth, "G");
    int edge = 0, within = 0, few = 0;
    samples = plane(&whole, "samples.Y");
    for (int i = 0; i < PIXELS; i++) {
        if (right[i] == 0 || right[i] == 1000) {
            few += samples[i] == 8;
            continue;
        }
        edge++;
        within += fabsf(value[i] - right[i]) <= 1.96f * error[i] + 1;
        /* What no sample has met is a small part of the brighter side. */
        assert_true(error[i] > 0 || fabsf(value[i] - right[i]) < 0.02f * 1000);
    }
    assert_true(edge > 60);
    if (within < 0.93 * edge)
        fail_msg("%d of %d edges' pixels are within", within, edge);
    /* Nothing is paid where there is no edge, but for what the survey asks about an edge's neighbours. */
    if (few < 0.8 * (PIXELS - edge))
        fail_msg("%d of %d other pixels take few samples", few, PIXELS - edge);
    sitting_end(&whole);
    sitting_end(&truth);
}

static void stopping_ends_soon(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    picture_settings s = room_settings();
    sitting stopped = sitting_begin(room, &trace, &s);
    picture_stop(stopped.picture);
    assert_int_equal(picture_render(stopped.picture, NULL), GRAZE_OK);
    assert_int_equal(picture_look(stopped.picture).finished, 0);
    sitting_end(&stopped);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neither_threads_nor_order_change_the_bytes),
        cmocka_unit_test(every_pixel_has_the_error_asked_for),
        cmocka_unit_test(layers_tell_depth_normal_and_samples),
        cmocka_unit_test(what_is_not_wanted_changes_nothing),
        cmocka_unit_test(ambient_value_is_indirect),
        cmocka_unit_test(light_that_goes_round_is_indirect),
        cmocka_unit_test(edges_of_lamps_are_seen),
        cmocka_unit_test(stopping_ends_soon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
