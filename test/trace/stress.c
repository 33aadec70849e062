/* Ten thousand random scenes, each seen by all three strategies: they must agree within their stated errors, and no
 * answer may be negative or no number. `stress NUMBER...` shows those scenes, and what more and more samples say. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/scene_text.h"
#include "trace/random_scene.h"

enum { SCENES = 10000, SAMPLES = 96, STRATEGIES = 3, ROUNDS = 4 };

/* By how many powers of two the samples grow while two answers are too far apart. */
static const int more[ROUNDS] = {0, 5, 9, 15};

/* Larger relative errors come of so few samples that carry light that they tell little of themselves. */
#define LARGEST_ERROR 0.2
/* Errors of 16 replicates each: the difference of two answers is off by more than this in 4 of 10,000 cases. */
#define TOO_FAR 4.0

/* Of the radiance in these scenes, what is hardly any. */
#define FAINT 0.01

static const char *const strategy_names[STRATEGIES] = {"mis", "light", "brdf"};
static const char *const kind_names[RANDOM_KINDS] = {"easy", "small light", "sharp gloss"};

/* What one strategy's differences from `mis` come to, over the scenes of one kind; of `mis`, from its own answer with
 * another seed. Differences are counted in their errors, or, for the bias, in units of the answer that do not depend on
 * the samples compared. */
typedef struct tally {
    int count, within_one, within_two, above;
    double bias, bias_square;
} tally;

typedef struct tallies {
    tally of[RANDOM_KINDS][STRATEGIES];
    int failures;
} tallies;

static void show(const random_scene *s, uint64_t number, int ray) {
    const graze_ray *r = &s->rays[ray];
    const graze_trace_settings *t = &s->settings;
    fprintf(stderr,
            "# scene %d, %s, ray %d: %.17g %.17g %.17g  %.17g %.17g %.17g\n"
            "# -ab %d -bv %d -dv %d -lr %d -lw %g -st %g quantity %d model %d\n%s",
            (int)number, kind_names[s->kind], ray, r->origin.x, r->origin.y, r->origin.z, r->direction.x,
            r->direction.y, r->direction.z, t->ambient_bounces, t->back_faces_visible, t->lights_visible,
            t->reflection_limit, t->minimum_weight, t->specular_threshold, (int)t->quantity, (int)s->model, s->text);
}

/* Every other scene stands somewhere, in some size. */
static graze_scene *make(random_scene *s, uint64_t number) {
    dice d = {number * 77 + 5};
    (void)roll(&d);
    random_scene_make(s, number, number % 2 ? random_placement(&d) : unplaced);
    const graze_model_choice choice = {NULL, s->model};
    graze_scene *scene = scene_from_text_with(s->text, &(graze_scene_settings){.models = &choice, .model_count = 1});
    if (!scene) {
        show(s, number, 0);
        fail_msg("scene %d: %s", (int)number, messages);
    }
    return scene;
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

/* Distance of two answers in their errors. Roundings stand in where neither has any, and squares of errors that small
 * are lost. */
static double deviation(const graze_answer *a, const graze_answer *b) {
    double error = hypot(a->standard_error.g, b->standard_error.g) + 1e-9 * fmax(a->value.g, b->value.g) + 1e-100;
    return (a->value.g - b->value.g) / error;
}

/* Few samples know nothing of light that none of them found: then the difference goes away with more, a mistake does
 * not. */
static bool stay_apart(const random_scene *s, const graze_scene *scene, uint64_t number, int ray, int strategy) {
    graze_answer a = {.samples = 0}, b = a;
    for (int round = 1; round < ROUNDS; round++) {
        uint32_t samples = (uint32_t)SAMPLES << more[round];
        a = ask(s, scene, number, ray, 0, samples, 10 + (uint64_t)round);
        b = ask(s, scene, number, ray, strategy, samples, 20 + (uint64_t)round);
        if (fabs(deviation(&a, &b)) <= TOO_FAR)
            return false;
    }
    show(s, number, ray);
    fprintf(stderr, "# scene %d, ray %d: %s %g +- %g, but mis %g +- %g\n", (int)number, ray, strategy_names[strategy],
            b.value.g, b.standard_error.g, a.value.g, a.standard_error.g);
    return true;
}

/* Whether the strategy can find the light of this kind of scene with samples so few, and says so in some that count no
 * further. Reflections may meet no light; and only of GMD their weights are bounded. */
static bool can_answer(const random_scene *s, int strategy, const graze_answer *pilot) {
    if (strategy == GRAZE_STRATEGY_LIGHT && s->kind == RANDOM_SHARP_GLOSS)
        return false;
    if (strategy == GRAZE_STRATEGY_BRDF &&
        (s->kind == RANDOM_SMALL_LIGHT || s->model != GRAZE_BRDF_GMD || pilot->value.g == 0))
        return false;
    return pilot->standard_error.g <= LARGEST_ERROR * pilot->value.g;
}

static void count_difference(tally *t, double z, double difference, double unit) {
    double bias = unit > 0 ? difference / unit : 0;
    t->count++;
    t->within_one += fabs(z) < 1;
    t->within_two += fabs(z) < 2;
    t->above += z > TOO_FAR;
    t->bias += bias;
    t->bias_square += bias * bias;
}

static void compare(const random_scene *s, const graze_scene *scene, uint64_t number, int ray, tallies *all) {
    graze_answer pilots[STRATEGIES], answers[STRATEGIES];
    for (int strategy = 0; strategy < STRATEGIES; strategy++) {
        pilots[strategy] = ask(s, scene, number, ray, strategy, SAMPLES, 1);
        answers[strategy] = ask(s, scene, number, ray, strategy, SAMPLES, 2 + (uint64_t)strategy);
    }
    if (!can_answer(s, 0, &pilots[0]))
        return;
    for (int strategy = 0; strategy < STRATEGIES; strategy++) {
        const graze_answer *mis = &answers[0], *other = strategy ? &answers[strategy] : &pilots[0];
        double z = deviation(other, mis);
        bool exact = mis->samples == 1 && other->samples == 1 && z == 0;
        if (exact || !can_answer(s, strategy, &pilots[strategy]))
            continue;
        double unit = strategy ? pilots[0].value.g + pilots[strategy].value.g + FAINT : 0;
        count_difference(&all->of[s->kind][strategy], z, other->value.g - mis->value.g, unit);
        if (fabs(z) > TOO_FAR)
            all->failures += stay_apart(s, scene, number, ray, strategy);
    }
}

static void show_tally(int kind, int strategy, const tally *t) {
    fprintf(stderr, "# %s, %s: %d, within one error %.3f, two %.3f, %d above four, bias %.2g (%.2f errors)\n",
            kind_names[kind], strategy_names[strategy], t->count, (double)t->within_one / t->count,
            (double)t->within_two / t->count, t->above, t->bias / t->count, t->bias / sqrt(t->bias_square + 1e-100));
}

/* Where a strategy finds all there is with few samples, differences are distributed as their errors say, which are
 * stated for 95% intervals and are the larger the less is known of them: with few samples of what is smooth, more than
 * 68% lie within one, but not nearly all. Elsewhere only their mean is: it is 0 however rare the light. Nothing but
 * chance makes another strategy's answer larger than that of `mis` by many errors. */
static bool is_distributed(int kind, int strategy, const tally *t) {
    if (fabs(t->bias) > 3.5 * sqrt(t->bias_square) || t->above > 1 + t->count / 1000)
        return false;
    if (strategy == GRAZE_STRATEGY_BRDF || kind == RANDOM_SHARP_GLOSS)
        return true;
    double one = (double)t->within_one / t->count, two = (double)t->within_two / t->count;
    return one > 0.65 && one < 0.84 && two > 0.93 && two < 0.995;
}

static void strategies_agree(void **state) {
    (void)state;
    static random_scene s;
    static tallies all;
    for (uint64_t number = 0; number < SCENES; number++) {
        graze_scene *scene = make(&s, number);
        for (int ray = 0; ray < RANDOM_RAYS; ray++)
            compare(&s, scene, number, ray, &all);
        graze_scene_destroy(scene);
    }
    int compared = 0;
    for (int kind = 0; kind < RANDOM_KINDS; kind++)
        for (int strategy = 0; strategy < STRATEGIES; strategy++) {
            const tally *t = &all.of[kind][strategy];
            if (t->count) {
                show_tally(kind, strategy, t);
                all.failures += !is_distributed(kind, strategy, t);
            }
            compared += t->count;
        }
    assert_int_equal(all.failures, 0);
    assert_true(compared > SCENES);
}

static int argument_count;
static char **arguments;

static void examine(void **state) {
    (void)state;
    static random_scene s;
    for (int i = 1; i < argument_count; i++) {
        uint64_t number = strtoull(arguments[i], NULL, 10);
        graze_scene *scene = make(&s, number);
        for (int ray = 0; ray < RANDOM_RAYS; ray++) {
            show(&s, number, ray);
            for (int round = 0; round < ROUNDS; round++)
                for (int strategy = 0; strategy < STRATEGIES; strategy++) {
                    graze_answer a = ask(&s, scene, number, ray, strategy, (uint32_t)SAMPLES << more[round], 30);
                    fprintf(stderr, "# %8d %5s %.6g +- %.2g\n", (int)a.samples, strategy_names[strategy], a.value.g,
                            a.standard_error.g);
                }
        }
        graze_scene_destroy(scene);
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest all[] = {cmocka_unit_test(strategies_agree)};
    const struct CMUnitTest named[] = {cmocka_unit_test(examine)};
    argument_count = argc;
    arguments = argv;
    return argc > 1 ? cmocka_run_group_tests(named, NULL, NULL) : cmocka_run_group_tests(all, NULL, NULL);
}
