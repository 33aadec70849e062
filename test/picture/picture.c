/* Pictures: the same bytes on any number of threads, the layers, and the error asked for. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "picture/picture.h"
#include "support/scene_text.h"

static const char room[] =
    "void metal2 m 4 1 0 0 . 0 6 .6 .6 .6 .8 .1 .2 m polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n"
    "void light l 0 0 3 9 9 9 l sphere lamp 0 0 4 0 3 1 .3\n";

static image *render(const char *text, graze_trace_settings trace, int threads, size_t *unconverged) {
    graze_scene *scene = scene_from_text(text);
    assert_non_null(scene);
    picture_settings s = {.view = rad_view_default(),
                          .width = 40,
                          .height = 30,
                          .pixel_aspect = 1,
                          .jitter = 1,
                          .layers = true,
                          .threads = threads};
    s.view.point = (vec3){0, -4, 1};
    s.view.direction = (vec3){0, 1, -0.2};
    assert_int_equal(rad_view_prepare(&s.view, NULL), GRAZE_OK);
    image *picture;
    assert_int_equal(picture_render(&picture, scene, &trace, &s, unconverged, NULL), GRAZE_OK);
    graze_scene_destroy(scene);
    return picture;
}

static void threads_do_not_change_the_bytes(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.error = 0.1;
    size_t unconverged;
    image *one = render(room, trace, 1, &unconverged), *five = render(room, trace, 5, &unconverged);
    for (int c = 0; c < one->channel_count; c++)
        assert_memory_equal(one->channels[c], five->channels[c], sizeof(float) * 40 * 30);
    image_destroy(one);
    image_destroy(five);
}

static void every_pixel_has_the_error_asked_for(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.error = 0.05;
    size_t unconverged;
    image *picture = render(room, trace, 2, &unconverged);
    const float *value = image_channel(picture, "G"), *error = image_channel(picture, "standard_error.G");
    double mean = 0;
    for (int i = 0; i < 40 * 30; i++)
        mean += value[i] / (40 * 30);
    assert_true(mean > 0);
    assert_int_equal(unconverged, 0);
    /* The floor comes from a pilot's estimate of the mean, which is good to a tenth here. Each half of the samples
     * ends when the other half says so: what both together state afterwards may be a little more. */
    int above = 0;
    for (int i = 0; i < 40 * 30; i++) {
        double asked = 0.0501 * fmax(value[i], 1.1 * PICTURE_FLOOR * mean);
        above += error[i] > asked;
        assert_true(error[i] <= 2 * asked);
    }
    assert_true(above < 40 * 30 / 20);
    image_destroy(picture);
}

static void layers_tell_depth_normal_and_samples(void **state) {
    (void)state;
    graze_trace_settings trace = graze_trace_defaults();
    trace.samples = 20;
    size_t unconverged;
    image *picture = render(room, trace, 2, &unconverged);
    const float *samples = image_channel(picture, "samples.Y"), *depth = image_channel(picture, "depth.Z");
    int bottom = 29 * 40 + 20, top = 20;
    assert_true(samples[bottom] == 20 && samples[top] == 20);
    assert_true(image_channel(picture, "normal.Z")[bottom] == 1);
    assert_true(depth[bottom] > 1 && depth[bottom] < 3);
    assert_true(depth[top] == 1e10f);
    image_destroy(picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_change_the_bytes),
        cmocka_unit_test(every_pixel_has_the_error_asked_for),
        cmocka_unit_test(layers_tell_depth_normal_and_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
