/* Ten thousand random scenes, each seen by all three strategies: they must agree within their stated errors, and no
 * answer may be negative or no number. `stress NUMBER...` traces only those scenes and shows them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/scene_text.h"
#include "trace/random_scene.h"

enum { SCENES = 10000, SAMPLES = 128, STRATEGIES = 3 };

/* Larger relative errors come of so few samples that carry light that they tell little of themselves. */
#define LARGEST_ERROR 0.2

static const char *const strategy_names[STRATEGIES] = {"mis", "light", "brdf"};
static const char *const kind_names[RANDOM_KINDS] = {"easy", "small light", "sharp gloss"};

/* What one strategy's differences from `mis` come to, over the scenes of one kind. */
typedef struct tally {
    int count, within[2], above, suspects;
    double bias, bias_square; /* sums of differences in units of the answer, and of their squares */
} tally;

static int failures;
static tally tallies[RANDOM_KINDS][STRATEGIES];

static graze_scene *load(const random_scene *s) {
    const graze_model_choice choice = {NULL, s->model};
    return scene_from_text_with(s->text, &(graze_scene_settings){.models = &choice, .model_count = 1});
}

static void show(const random_scene *s, uint64_t number, int ray) {
    const graze_ray *r = &s->rays[ray];
    const graze_trace_settings *t = &s->settings;
    fprintf(stderr,
            "# scene %d, %s, ray %d: %.17g %.17g %.17g  %.17g %.17g %.17g\n# -ab %d -bv %d -dv %d -lr %d -lw %g "
            "-st %g quantity %d model %d\n%s",
            (int)number, kind_names[s->kind], ray, r->origin.x, r->origin.y, r->origin.z, r->direction.x,
            r->direction.y, r->direction.z, t->ambient_bounces, t->back_faces_visible, t->lights_visible,
            t->reflection_limit, t->minimum_weight, t->specular_threshold, (int)t->quantity, (int)s->model, s->text);
}

static bool is_sound(graze_rgb a) {
    return a.r >= 0 && a.g >= 0 && a.b >= 0 && isfinite(a.r) && isfinite(a.g) && isfinite(a.b);
}

static graze_answer ask(const random_scene *s, const graze_scene *scene, uint64_t number, int ray, int strategy,
                        uint32_t samples, uint64_t seed) {
    graze_trace_settings settings = s->settings;
    settings.strategy = (graze_strategy)strategy;
    settings.samples = samples;
    settings.seed = seed;
    graze_answer answer;
    graze_trace(scene, &settings, &s->rays[ray], number, &answer, NULL);
    if (!is_sound(answer.value) || !is_sound(answer.standard_error)) {
        show(s, number, ray);
        fail_msg("%s, seed %d: %g %g %g +- %g %g %g", strategy_names[strategy], (int)seed, answer.value.r,
                 answer.value.g, answer.value.b, answer.standard_error.r, answer.standard_error.g,
                 answer.standard_error.b);
    }
    return answer;
}

/* Distance of two answers in their errors. Roundings stand in where neither has any. */
static double deviation(const graze_answer *a, const graze_answer *b) {
    double error = hypot(a->standard_error.g, b->standard_error.g) + 1e-9 * fmax(a->value.g, b->value.g);
    return (a->value.g - b->value.g) / (error + 1e-100);
}

/* Errors of a few samples may be too small; a bias stays when there are more. */
static void look_again(const random_scene *s, const graze_scene *scene, uint64_t number, int ray, int strategy) {
    double z = 0;
    graze_answer a = {.samples = 0}, b = a;
    for (int round = 1; round <= 2; round++) {
        uint32_t samples = SAMPLES << 5 * round;
        a = ask(s, scene, number, ray, 0, samples, 10 + (uint64_t)round);
        b = ask(s, scene, number, ray, strategy, samples, 10 + (uint64_t)round);
        z = deviation(&b, &a);
        if (fabs(z) < 3.5)
            return;
    }
    if (!failures++)
        show(s, number, ray);
    fprintf(stderr, "# scene %d, ray %d: %s %g +- %g, but mis %g +- %g (%g)\n", (int)number, ray,
            strategy_names[strategy], b.value.g, b.standard_error.g, a.value.g, a.standard_error.g, z);
}

/* Whether the strategy is one that finds this kind of scene's light, and did so in samples that count no further.
 * Reflections may find nothing. */
static bool can_answer(const random_scene *s, int strategy, const graze_answer *pilot) {
    random_kind kind = s->kind;
    bool finds = strategy == GRAZE_STRATEGY_LIGHT  ? kind != RANDOM_SHARP_GLOSS
                 : strategy == GRAZE_STRATEGY_BRDF ? kind != RANDOM_SMALL_LIGHT && s->model == GRAZE_BRDF_GMD
                                                   : true;
    if (strategy == GRAZE_STRATEGY_BRDF && pilot->value.g == 0)
        return false;
    return finds && pilot->standard_error.g <= LARGEST_ERROR * pilot->value.g;
}

static void compare(const random_scene *s, const graze_scene *scene, uint64_t number, int ray) {
    graze_answer pilots[STRATEGIES], answers[STRATEGIES], mis;
    for (int strategy = 0; strategy < STRATEGIES; strategy++) {
        pilots[strategy] = ask(s, scene, number, ray, strategy, SAMPLES, 1);
        answers[strategy] = ask(s, scene, number, ray, strategy, SAMPLES, 2 + (uint64_t)strategy);
    }
    mis = answers[0];
    for (int strategy = 1; strategy < STRATEGIES; strategy++) {
        graze_answer other = answers[strategy];
        double z = deviation(&other, &mis);
        if (!can_answer(s, 0, &pilots[0]) || !can_answer(s, strategy, &pilots[strategy]) ||
            (mis.samples == 1 && other.samples == 1 && z == 0))
            continue;
        tally *t = &tallies[s->kind][strategy];
        double unit = pilots[0].value.g + pilots[strategy].value.g;
        double bias = unit > 0 ? (other.value.g - mis.value.g) / unit : 0;
        t->count++;
        t->within[0] += fabs(z) < 1;
        t->within[1] += fabs(z) < 2;
        t->above += z > 4;
        t->bias += bias;
        t->bias_square += bias * bias;
        if (fabs(z) > 4) {
            t->suspects++;
            look_again(s, scene, number, ray, strategy);
        }
    }
}

static graze_scene *make(random_scene *s, uint64_t number) {
    random_scene dice = {.dice = number * 77 + 5};
    (void)roll(&dice);
    random_scene_make(s, number, number % 2 ? random_placement(&dice) : unplaced);
    graze_scene *scene = load(s);
    if (!scene) {
        show(s, number, 0);
        fail_msg("scene %d: %s", (int)number, messages);
    }
    return scene;
}

static void trace_scene(uint64_t number) {
    static random_scene s;
    graze_scene *scene = make(&s, number);
    for (int ray = 0; ray < RANDOM_RAYS; ray++)
        compare(&s, scene, number, ray);
    graze_scene_destroy(scene);
}

static void strategies_agree(void **state) {
    (void)state;
    for (uint64_t number = 0; number < SCENES; number++)
        trace_scene(number);
    for (int kind = 0; kind < RANDOM_KINDS; kind++)
        for (int strategy = 1; strategy < STRATEGIES; strategy++) {
            const tally *t = &tallies[kind][strategy];
            if (!t->count)
                continue;
            fprintf(stderr, "# %s, %s: %d, within 1: %.3f, 2: %.3f, %d above 4, %d +-4, bias %.2g (%.2f sigma)\n",
                    kind_names[kind], strategy_names[strategy], t->count, (double)t->within[0] / t->count,
                    (double)t->within[1] / t->count, t->above, t->suspects, t->bias / t->count,
                    t->bias / sqrt(t->bias_square));
        }
}

static int numbers;
static char **arguments;

/* What each strategy says with more and more samples. */
static void examine(uint64_t number) {
    static random_scene s;
    graze_scene *scene = make(&s, number);
    for (int ray = 0; ray < RANDOM_RAYS; ray++) {
        show(&s, number, ray);
        for (uint32_t samples = SAMPLES; samples <= SAMPLES << 10; samples <<= 5)
            for (int strategy = 0; strategy < STRATEGIES; strategy++) {
                graze_answer a = ask(&s, scene, number, ray, strategy, samples, 20);
                fprintf(stderr, "# %8d %5s %.6g +- %.2g\n", (int)a.samples, strategy_names[strategy], a.value.g,
                        a.standard_error.g);
            }
    }
    graze_scene_destroy(scene);
}

static void those_named(void **state) {
    (void)state;
    for (int i = 1; i < numbers; i++)
        examine(strtoull(arguments[i], NULL, 10));
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(strategies_agree)};
    const struct CMUnitTest named[] = {cmocka_unit_test(those_named)};
    numbers = argc;
    arguments = argv;
    return argc > 1 ? cmocka_run_group_tests(named, NULL, NULL) : cmocka_run_group_tests(tests, NULL, NULL);
}
