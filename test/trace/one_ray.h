/* What one ray through a scene written down in a test answers, and whether two such answers agree. */
#ifndef TEST_TRACE_ONE_RAY_H
#define TEST_TRACE_ONE_RAY_H

#include <math.h>

#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

static inline graze_answer answer_along(const char *text, const graze_trace_settings *settings, graze_ray ray) {
    graze_scene *scene = load_scene(text);
    graze_answer found;
    graze_trace(scene, settings, &ray, 7, &found, NULL);
    graze_scene_destroy(scene);
    return found;
}

/* To 4.5 standard errors in every channel. */
static inline void assert_answers_agree(const char *what, graze_answer a, graze_answer b) {
    const rgb errors[] = {a.standard_error, b.standard_error};
    const double difference[] = {a.value.r - b.value.r, a.value.g - b.value.g, a.value.b - b.value.b};
    const double error[] = {hypot(errors[0].r, errors[1].r), hypot(errors[0].g, errors[1].g),
                            hypot(errors[0].b, errors[1].b)};
    for (int c = 0; c < 3; c++)
        if (!(fabs(difference[c]) <= 4.5 * error[c] + 1e-9))
            fail_msg("%s: %g and %g, off by %g +- %g", what, rgb_brightness(a.value), rgb_brightness(b.value),
                     difference[c], error[c]);
}

#endif
