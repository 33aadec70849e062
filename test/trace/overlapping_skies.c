/* Skies that overlap, by way of a window: every strategy finds all of them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "one_ray.h"
#include "room.h"

/* A closed box but for the pane in one wall. */
static const char *const room = "void plastic m 0 0 5 .5 .5 .5 0 0 void glass g 0 0 3 .9 .9 .9 " ROOM_WITHOUT_FRONT("m")
    ROOM_FRONT("m", "2.5") "g polygon pane 0 0 12 1 0 1 3 0 1 3 0 2.5 1 0 2.5 ";

static graze_answer answer_of(const char *skies, graze_strategy strategy) {
    char text[3000];
    snprintf(text, sizeof text, "%s %s", room, skies);
    graze_trace_settings settings = graze_trace_defaults();
    settings.strategy = strategy;
    settings.ambient_bounces = 1;
    settings.samples = 20000;
    return answer_along(text, &settings, (graze_ray){.origin = {2, 1, 1.5}, .direction = {0, 0.3, -1}});
}

static void strategies_find_all(void **state) {
    (void)state;
    static const char *const skies[] = {
        "void light a 0 0 3 1 .8 .6 a source s 0 0 4 0 0 1 180 void light b 0 0 3 2 2 2 b source t 0 0 4 0 -1 .3 100 ",
        "void light b 0 0 3 9 9 9 b source t 0 0 4 0 -1 .7 50 void light a 0 0 3 1 .8 .6 a source s 0 0 4 0 0 1 180 ",
        "void glow a 0 0 4 1 .8 .6 0 a source s 0 0 4 0 0 1 180 void glow b 0 0 4 2 2 2 0 b source t 0 0 4 0 -1 .3 "
        "100 ",
        "void light b 0 0 3 2 2 2 b source t 0 0 4 0 -1 .3 100 void glow a 0 0 4 1 .8 .6 0 a source s 0 0 4 0 0 1 180 ",
    };
    for (size_t i = 0; i < sizeof skies / sizeof *skies; i++) {
        const graze_answer by_reflection = answer_of(skies[i], GRAZE_STRATEGY_BRDF);
        assert_true(by_reflection.value.g > 10 * by_reflection.standard_error.g);
        assert_answers_agree(skies[i], answer_of(skies[i], GRAZE_STRATEGY_MIS), by_reflection);
        assert_answers_agree(skies[i], answer_of(skies[i], GRAZE_STRATEGY_LIGHT), by_reflection);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(strategies_find_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
