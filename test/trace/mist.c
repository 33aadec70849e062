/* Mist: what it leaves of light, and what it scatters. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "../rad/binary_writer.h"
#include "base/angle.h"
#include "one_ray.h"
#include "scene/mist.h"

static graze_answer answer_of(const char *text, graze_trace_settings settings, vec3 origin, vec3 direction) {
    settings.samples = 16384;
    return answer_along(text, &settings, (graze_ray){.origin = origin, .direction = direction});
}

/* A glow behind a slab of mist, or two that abut or overlap; seen from outside, and from within. */
static void light_is_attenuated(void **state) {
    (void)state;
    static const struct {
        const char *mist;
        double from, depth; /* optical, of red */
    } cases[] = {
        {"void mist m 0 0 3 .5 1 2 m sphere s 0 0 4 0 0 0 1", -5, 1},
        {"void mist m 0 0 3 .5 1 2 m sphere s 0 0 4 0 0 0 1", 0, .5},
        {"void mist m 0 0 3 .5 1 2 m sphere s 0 0 4 0 0 0 1 m sphere t 0 0 4 0 1 0 1", -5, 1.5},
        {"void mist m 0 0 3 .5 1 2 m sphere s 0 0 4 0 0 0 1 void mist n 0 0 3 .25 .5 1 n sphere t 0 0 4 0 1 0 1", -5,
         1.5},
        {"void mist m 0 0 3 .5 1 2 m sphere s 0 0 4 0 -1 0 1 void mist n 0 0 3 .25 .5 1 n sphere t 0 0 4 0 1 0 1", -5,
         1.5},
        {"void mist m 0 0 3 .5 1 2 m ring a 0 0 8 0 -1 0 0 -1 0 0 2 m ring b 0 0 8 0 0 0 0 1 0 0 2 "
         "void mist n 0 0 3 1 2 4 n ring c 0 0 8 0 0 0 0 -1 0 0 2 n ring d 0 0 8 0 1 0 0 1 0 0 2",
         -5, 1.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        snprintf(text, sizeof text, "void glow g 0 0 4 1 1 1 -1 g polygon wall 0 0 12 -9 9 -9 9 9 -9 9 9 9 -9 9 9 %s",
                 cases[i].mist);
        graze_answer a = answer_of(text, graze_trace_defaults(), vec3_make(0, cases[i].from, 0), vec3_make(0, 1, 0));
        double expected[] = {exp(-cases[i].depth), exp(-2 * cases[i].depth), exp(-4 * cases[i].depth)};
        if (fabs(a.value.r - expected[0]) > 1e-9 || fabs(a.value.g - expected[1]) > 1e-9 ||
            fabs(a.value.b - expected[2]) > 1e-9)
            fail_msg("case %zu: %g %g %g, not %g %g %g", i, a.value.r, a.value.g, a.value.b, expected[0], expected[1],
                     expected[2]);
    }
}

/* A small lamp in the middle of a ball of mist, seen past it: the integral along the ray, by quadrature. */
static void lamps_are_scattered(void **state) {
    (void)state;
    const double extinction = 0.4, albedo = 0.7, radius = 0.02, apart = 0.5, end = sqrt(4 - apart * apart);
    for (int k = 0; k < 2; k++) {
        double eccentricity = 0.6 * k, sum = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; i++) {
            double t = -end + 2 * end * (i + 0.5) / steps, square = t * t + apart * apart;
            double cosine = -t / sqrt(square), solid_angle = 2 * PI * (1 - sqrt(1 - radius * radius / square));
            double s = 1 + eccentricity * eccentricity - 2 * eccentricity * cosine;
            double phase = (1 - eccentricity * eccentricity) / (4 * PI * s * sqrt(s));
            /* The shadow ray loses what is absorbed, to the lamp's surface. */
            double left = exp(-extinction * (t + end) - extinction * (1 - albedo) * sqrt(square));
            sum += extinction * albedo * phase * solid_angle * left * 2 * end / steps;
        }
        char text[500];
        snprintf(text, sizeof text,
                 "void light l 0 0 3 100 100 100 l sphere lamp 0 0 4 0 0 0 %g void mist m 1 lamp 0 7 %g %g %g %g %g %g "
                 "%g m sphere s 0 0 4 0 0 0 2",
                 radius, extinction, extinction, extinction, albedo, albedo, albedo, eccentricity);
        graze_answer a = answer_of(text, graze_trace_defaults(), vec3_make(apart, -9, 0), vec3_make(0, 1, 0));
        double expected = 100 * sum;
        /* The way ends at the lamp's surface, not at its middle. */
        if (fabs(a.value.g - expected) > 4.5 * a.standard_error.g + 3e-3 * expected)
            fail_msg("%g +- %g, not %g", a.value.g, a.standard_error.g, expected);
    }
}

/* The sun in a ball of mist, and in one that is clear for one colour: the integral along the ray, by quadrature. */
static void the_sun_is_scattered(void **state) {
    (void)state;
    const double albedo = 0.7, angle = 0.2 * PI / 180, solid_angle = 2 * PI * (1 - cos(angle / 2)), e = 0.6;
    const double turned = 1 + e * e - 2 * e * 0.6, phase = (1 - e * e) / (4 * PI * turned * sqrt(turned));
    const double extinctions[] = {0.8, 0.4, 0};
    double sums[3] = {0, 0, 0};
    const int steps = 20000;
    for (int c = 0; c < 2; c++)
        for (int i = 0; i < steps; i++) {
            double t = -2 + 4 * (i + 0.5) / steps, up = -0.6 * t + sqrt(0.36 * t * t + 4 - t * t);
            double left = exp(-extinctions[c] * (t + 2) - extinctions[c] * (1 - albedo) * up);
            sums[c] += 1e6 * extinctions[c] * albedo * phase * solid_angle * left * 4 / steps;
        }
    for (int clear = 0; clear < 2; clear++) {
        char text[500];
        snprintf(text, sizeof text,
                 "void light l 0 0 3 1e6 1e6 1e6 l source sun 0 0 4 0 .6 .8 .2 void mist m 1 sun 0 7 .8 .4 %s .7 .7 .7 "
                 ".6 m sphere s 0 0 4 0 0 0 2",
                 clear ? "0" : ".4");
        graze_answer a = answer_of(text, graze_trace_defaults(), vec3_make(0, -9, 0), vec3_make(0, 1, 0));
        const double found[] = {a.value.r, a.value.g, a.value.b}, expected[] = {sums[0], sums[1], sums[clear ? 2 : 1]},
                     errors[] = {a.standard_error.r, a.standard_error.g, a.standard_error.b};
        for (int c = 0; c < 3; c++)
            if (!(fabs(found[c] - expected[c]) <= 4.5 * errors[c] + 1e-3 * expected[c]) || errors[c] > 0.01 * sums[1])
                fail_msg("%d: %g +- %g, not %g", c, found[c], errors[c], expected[c]);
    }
}

/* A light that two mists name where they overlap is scattered once: a mist in the midst of another need not name it. */
static void lights_that_two_mists_name(void **state) {
    (void)state;
    static const char *const mists[] = {
        "void mist m 1 lamp 0 3 .4 .4 .4 m sphere s 0 0 4 0 0 0 2 void mist n %s 0 6 .3 .2 .1 .7 .6 .5 n sphere t 0 0 "
        "4 0 0 0 1",
        "void mist n %s 0 6 .3 .2 .1 .7 .6 .5 n sphere t 0 0 4 0 0 0 1 void mist m 1 lamp 0 3 .4 .4 .4 m sphere s 0 0 "
        "4 0 0 0 2",
    };
    graze_trace_settings settings = graze_trace_defaults();
    settings.mist_albedo = rgb_gray(0.5);
    for (int i = 0; i < 2; i++) {
        graze_answer answers[2];
        for (int named = 0; named < 2; named++) {
            char mist[300], text[500];
            snprintf(mist, sizeof mist, mists[i], named ? "1 lamp" : "0");
            snprintf(text, sizeof text, "void light l 0 0 3 100 100 100 l sphere lamp 0 0 4 3 0 0 .2 %s", mist);
            answers[named] = answer_of(text, settings, vec3_make(0.3, -9, 0), vec3_make(0, 1, 0));
        }
        assert_true(answers[0].value.b > 0.01);
        assert_memory_equal(&answers[0].value, &answers[1].value, sizeof answers[0].value);
    }
}

/* What stands in the light's way is in the shade; what mist itself shines by the ambient value is not. */
static void things_shade_mist(void **state) {
    (void)state;
    const char *text =
        "void light l 0 0 3 100 100 100 l sphere lamp 0 0 4 5 0 0 .2 void plastic p 0 0 5 0 0 0 0 0 "
        "p sphere shade 0 0 4 5 0 0 .4 void mist m 1 lamp 0 6 .4 .4 .4 .5 .6 .7 m sphere s 0 0 4 0 0 0 2";
    graze_trace_settings settings = graze_trace_defaults();
    graze_answer a = answer_of(text, settings, vec3_make(0, -9, 0), vec3_make(0, 1, 0));
    assert_true(a.value.r == 0 && a.value.g == 0 && a.value.b == 0);
    settings.ambient_value = (graze_rgb){1, 2, 3};
    a = answer_of(text, settings, vec3_make(0, -9, 0), vec3_make(0, 1, 0));
    const double scattered = 1 - exp(-0.4 * 4);
    assert_true(fabs(a.value.r - 0.5 * scattered) < 1e-9 && fabs(a.value.g - 1.2 * scattered) < 1e-9 &&
                fabs(a.value.b - 2.1 * scattered) < 1e-9);
}

static void strategies_agree(void **state) {
    (void)state;
    const char *text =
        "void plastic p 0 0 5 .5 .4 .3 .1 .2 p polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0 "
        "void light l 0 0 3 4 3 2 l sphere lamp 0 0 4 .5 0 2 .5 void glow g 0 0 4 1 2 3 0 g polygon ceiling 0 0 12 -2 "
        "-2 3 "
        "-2 2 3 2 2 3 2 -2 3 void mist m 1 lamp 0 7 .3 .4 .5 .8 .7 .6 .4 m sphere cloud 0 0 4 0 .3 1 1.4";
    graze_answer answers[3];
    for (int bounces = 0; bounces < 2; bounces++) {
        for (int i = 0; i < 3; i++) {
            const graze_strategy all[] = {GRAZE_STRATEGY_MIS, GRAZE_STRATEGY_LIGHT, GRAZE_STRATEGY_BRDF};
            graze_trace_settings settings = graze_trace_defaults();
            settings.strategy = all[i];
            settings.ambient_bounces = bounces;
            settings.mist_extinction = rgb_gray(0.05);
            settings.mist_albedo = rgb_gray(0.5);
            answers[i] = answer_of(text, settings, vec3_make(0, -3, 1), vec3_make(0, 3, -1));
        }
        for (int i = 1; i < 3; i++)
            assert_answers_agree(bounces ? "a bounce" : "no bounce", answers[0], answers[i]);
    }
}

/* Many bodies of one mist that overlap are one: light would be scattered, and shadow rays walk, once for each. */
static void overlapping_bodies_are_one_span(void **state) {
    (void)state;
    char text[8000] = "void light l 0 0 3 1 1 1 l sphere lamp 0 0 4 0 0 9 1 void mist m 1 lamp 0 6 .1 .1 .1 .5 .5 .5";
    for (int i = 0; i < 100; i++) {
        size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, " m sphere s%d 0 0 4 %g 0 0 1", i, 0.03 * i);
    }
    graze_scene *scene = scene_from_text(text);
    assert_non_null(scene);
    const mist_medium nothing = {0};
    mist_walk walk;
    mist_span spans[4];
    int count = 0;
    mist_walk_begin(&walk, scene, &nothing, vec3_make(-3, 0, 0), vec3_make(1, 0, 0), 10);
    while (count < 4 && mist_walk_next(&walk, &spans[count]))
        count++;
    graze_scene_destroy(scene);
    assert_int_equal(count, 3);
    assert_true(fabs(spans[1].start - 2) < 1e-12);
    assert_true(fabs(spans[1].end - 6.97) < 1e-12);
    assert_true(spans[1].medium.extinction.r == 0.1);
    assert_true(spans[2].medium.extinction.r == 0);
    assert_true(spans[2].end == 10);
}

/* Without mist the same bytes come out, whatever mist would do. */
/* Mist in copies of copies: 2 to the power of the levels in all, of which the ray meets one. */
static void copies_are_not_counted_one_by_one(void **state) {
    (void)state;
    enum { LEVELS = 30 };
    written_file parts[LEVELS + 1], octrees[LEVELS + 1];
    char text[200];
    for (int i = 0; i <= LEVELS; i++) {
        if (i == 0)
            snprintf(text, sizeof text, "void mist m 0 0 3 .5 1 2 m sphere s 0 0 4 0 0 0 1");
        else
            snprintf(text, sizeof text, "void instance a 1 %s 0 0 void instance b 5 %s -t 50 0 0 0 0",
                     octrees[i - 1].name, octrees[i - 1].name);
        parts[i] = written_file_make(text, strlen(text));
        const binary octree = octree_of_file(parts[i].name, 2);
        octrees[i] = written_file_make(octree.bytes, octree.length);
    }
    snprintf(text, sizeof text,
             "void glow g 0 0 4 1 1 1 -1 g ring wall 0 0 8 0 9 0 0 -1 0 0 9 void instance x 1 %s 0 0",
             octrees[LEVELS].name);
    graze_answer a = answer_of(text, graze_trace_defaults(), vec3_make(0, -5, 0), vec3_make(0, 1, 0));
    assert_true(fabs(a.value.r - exp(-1)) < 1e-9);
    for (int i = 0; i <= LEVELS; i++) {
        unlink(parts[i].name);
        unlink(octrees[i].name);
    }
}

static void no_mist_changes_nothing(void **state) {
    (void)state;
    const char *text = "void plastic p 0 0 5 .5 .4 .3 .1 .2 p polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0 "
                       "void light l 0 0 3 4 3 2 l sphere lamp 0 0 4 .5 0 2 .5 ";
    graze_trace_settings settings = graze_trace_defaults(), misty = settings;
    misty.mist_albedo = rgb_gray(1);
    misty.mist_eccentricity = 0.5;
    graze_answer a = answer_of(text, settings, vec3_make(0, -3, 1), vec3_make(0, 3, -1));
    graze_answer b = answer_of(text, misty, vec3_make(0, -3, 1), vec3_make(0, 3, -1));
    assert_memory_equal(&a.value, &b.value, sizeof a.value);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_attenuated),
        cmocka_unit_test(lamps_are_scattered),
        cmocka_unit_test(the_sun_is_scattered),
        cmocka_unit_test(lights_that_two_mists_name),
        cmocka_unit_test(things_shade_mist),
        cmocka_unit_test(strategies_agree),
        cmocka_unit_test(overlapping_bodies_are_one_span),
        cmocka_unit_test(copies_are_not_counted_one_by_one),
        cmocka_unit_test(no_mist_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
