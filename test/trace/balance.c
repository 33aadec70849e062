/* Energy: what a lamp sends out is what surfaces and openings take in. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/trace.h"
#include "support/scene_text.h"

/* A flat thing that takes in light, from a corner along two edges; its normal is first x second. */
typedef struct taker {
    vec3 corner, first, second;
    double albedo; /* 0 for openings and lamps */
} taker;

enum { PLACES = 256, REPLICATES = 8 };

/* The power that one takes in, from irradiance at places that fill it evenly (the R2 sequence: fractions of the powers
 * of the plastic number), moved by each replicate. */
static double absorbed(const graze_scene *scene, const graze_trace_settings *s, const taker *t, int replicate,
                       uint64_t stream) {
    vec3 normal = vec3_cross(t->first, t->second);
    double total = 0;
    for (int i = 0; i < PLACES; i++) {
        double u = fmod(0.618 * replicate + 0.7548776662466927 * i, 1);
        double v = fmod(0.414 * replicate + 0.5698402909980532 * i, 1);
        vec3 point = vec3_add_scaled(vec3_add_scaled(t->corner, u, t->first), v, t->second);
        const graze_ray ray = {.origin = point, .direction = normal};
        graze_answer a;
        graze_trace(scene, s, &ray, stream * PLACES + (uint64_t)i, &a, NULL);
        total += a.value.g;
    }
    return (1 - t->albedo) * vec3_length(normal) * total / PLACES;
}

static void assert_balance(const char *text, const taker *takers, int count, double emitted) {
    graze_scene *scene = load_scene(text);
    for (int strategy = 0; strategy < 3; strategy++) {
        graze_trace_settings s = graze_trace_defaults();
        s.strategy = (graze_strategy)strategy;
        s.quantity = GRAZE_IRRADIANCE;
        s.ambient_bounces = 200;
        s.samples = 16;
        /* Reflections meet the lamp seldom. */
        double largest_error = strategy == GRAZE_STRATEGY_BRDF ? 0.025 : 0.0012;
        double sum = 0, square = 0;
        for (int replicate = 0; replicate < REPLICATES; replicate++) {
            double power = 0;
            for (int i = 0; i < count; i++)
                power += absorbed(scene, &s, &takers[i], replicate, (uint64_t)(replicate * count + i));
            sum += power / REPLICATES;
            square += power * power / REPLICATES;
        }
        double error = sqrt((square - sum * sum) / (REPLICATES - 1));
        /* Of 8 replicates one in 2000 is farther off. */
        if (!(fabs(sum - emitted) <= 6 * error) || !(error < largest_error * emitted))
            fail_msg("strategy %d: %g +- %g of %g W", strategy, sum, error, emitted);
    }
    graze_scene_destroy(scene);
}

#define MATERIALS                                                                                                      \
    "void plastic a 0 0 5 .2 .2 .2 0 0\nvoid plastic b 0 0 5 .5 .5 .5 0 0\nvoid plastic c 0 0 5 .8 .8 .8 0 0\n"
/* 4 x 3 x 2.5; the wall at x = 4 apart. */
#define FIVE_WALLS                                                                                                     \
    "a polygon floor 0 0 12 0 0 0 4 0 0 4 3 0 0 3 0\nc polygon ceiling 0 0 12 0 0 2.5 0 3 2.5 4 3 2.5 4 0 2.5\n"       \
    "b polygon south 0 0 12 0 0 0 0 0 2.5 4 0 2.5 4 0 0\nb polygon north 0 0 12 0 3 0 4 3 0 4 3 2.5 0 3 2.5\n"         \
    "c polygon west 0 0 12 0 0 0 0 3 0 0 3 2.5 0 0 2.5\n"
#define EAST "a polygon east 0 0 12 4 0 0 4 0 2.5 4 3 2.5 4 3 0\n"
/* A panel of 1 x 0.8, half a metre below the ceiling, whose back is in the other lamp's text. */
#define PANEL                                                                                                          \
    "void light l 0 0 3 10 10 10 l polygon panel 0 0 12 1 1 2 1 1.8 2 2 1.8 2 2 1 2\n"                                 \
    "b polygon back 0 0 12 1 1 2 2 1 2 2 1.8 2 1 1.8 2\n"

static const taker panel = {{1, 1, 2}, {0, 0.8, 0}, {1, 0, 0}, 0}, back = {{1, 1, 2}, {1, 0, 0}, {0, 0.8, 0}, 0.5};
static const taker walls[] = {
    {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0.2},   {{0, 0, 2.5}, {0, 3, 0}, {4, 0, 0}, 0.8},
    {{0, 0, 0}, {0, 0, 2.5}, {4, 0, 0}, 0.5}, {{0, 3, 0}, {4, 0, 0}, {0, 0, 2.5}, 0.5},
    {{0, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, 0.8}, {{4, 0, 0}, {0, 0, 2.5}, {0, 3, 0}, 0.2},
};
enum { WALLS = sizeof walls / sizeof *walls };

/* Power of the panel: pi x radiance x area. */
static const double emitted = PI * 10 * 0.8;

static void closed_room(void **state) {
    (void)state;
    taker takers[WALLS + 2] = {[WALLS] = panel, [WALLS + 1] = back};
    memcpy(takers, walls, sizeof walls);
    assert_balance(MATERIALS FIVE_WALLS EAST PANEL, takers, WALLS + 2, emitted);
}

/* Through the missing wall light leaves for good. */
static void open_room(void **state) {
    (void)state;
    taker takers[WALLS + 2] = {[WALLS] = panel, [WALLS + 1] = back};
    memcpy(takers, walls, sizeof walls);
    takers[WALLS - 1].albedo = 0;
    assert_balance(MATERIALS FIVE_WALLS PANEL, takers, WALLS + 2, emitted);
}

/* The lamp in the plane of the ceiling: that part of the ceiling is not there, the rest is four strips around it. */
static void lamp_in_the_ceiling(void **state) {
    (void)state;
    taker takers[WALLS + 4] = {[WALLS] = {{1, 1, 2.5}, {0, 0.8, 0}, {1, 0, 0}, 0},
                               [WALLS + 1] = {{2, 0, 2.5}, {0, 3, 0}, {2, 0, 0}, 0.8},
                               [WALLS + 2] = {{1, 0, 2.5}, {0, 1, 0}, {1, 0, 0}, 0.8},
                               [WALLS + 3] = {{1, 1.8, 2.5}, {0, 1.2, 0}, {1, 0, 0}, 0.8}};
    memcpy(takers, walls, sizeof walls);
    takers[1] = (taker){{0, 0, 2.5}, {0, 3, 0}, {1, 0, 0}, 0.8};
    assert_balance(MATERIALS FIVE_WALLS EAST
                   "void light l 0 0 3 10 10 10 l polygon lamp 0 0 12 1 1 2.5 1 1.8 2.5 2 1.8 2.5 2 1 2.5\n",
                   takers, WALLS + 4, emitted);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_room),
        cmocka_unit_test(open_room),
        cmocka_unit_test(lamp_in_the_ceiling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
