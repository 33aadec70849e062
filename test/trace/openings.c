/* Openings without glass beside windows, where only samples of the whole sky find it, now and then: answers must not be
 * believed before these would have met one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "one_ray.h"
#include "room.h"

enum { SEEDS = 60, REFERENCE = 200000 };

/* A closed box but for an opening in one wall, most of which has a pane. */
static const char *const room = "void plastic m 0 0 5 .5 .5 .5 0 0 void glass g 0 0 3 .9 .9 .9 "
                                "void glow a 0 0 4 1 1 1 0 a source sky 0 0 4 0 0 1 180 "
                                "void glow b 0 0 4 .3 .3 .3 0 b source ground 0 0 4 0 0 -1 180 " ROOM_WITHOUT_FRONT("m")
                                    ROOM_FRONT("m", "2.5") "g polygon pane 0 0 12 1 0 1 2.6 0 1 2.6 0 2.5 1 0 2.5 ";

/* Of the floor below the window, the ceiling and a wall. */
static const graze_ray rays[] = {
    {.origin = {2, 1, 1.5}, .direction = {0, 0.3, -1}},
    {.origin = {2, 3, 1}, .direction = {0, 0, 1}},
    {.origin = {1, 2, 1}, .direction = {0, 1, 0.2}},
};

/* How many answers are less than 1.96 of their errors from what many more samples find, and the mean square of how far
 * they are. */
static int count_within(const graze_ray *ray, double *square) {
    graze_scene *scene = load_scene(room);
    graze_trace_settings settings = graze_trace_defaults();
    graze_answer reference, answer;
    int within = 0;
    settings.ambient_bounces = 1;
    settings.samples = REFERENCE;
    graze_trace(scene, &settings, ray, 1, &reference, NULL);
    settings.samples = 0;
    *square = 0;
    for (int seed = 1; seed <= SEEDS; seed++) {
        settings.seed = (uint64_t)seed;
        graze_trace(scene, &settings, ray, 1, &answer, NULL);
        double off = answer.value.g - reference.value.g;
        within += fabs(off) < 1.96 * hypot(answer.standard_error.g, reference.standard_error.g);
        *square += off * off / (reference.value.g * reference.value.g) / SEEDS;
    }
    graze_scene_destroy(scene);
    return within;
}

static void answers_are_as_good_as_asked_for(void **state) {
    (void)state;
    const double asked = graze_trace_defaults().error;
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        double square;
        assert_in_range(count_within(&rays[i], &square), 0.85 * SEEDS, SEEDS);
        assert_true(sqrt(square) < 1.2 * asked);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_are_as_good_as_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
