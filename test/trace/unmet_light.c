/* What is stated of light behind panes that no sample has met: as the middle of each light would give it, once in as
 * many samples as there are. */
#include "trace/unmet_light.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/material.h"
#include "support/close.h"
#include "trace/context.h"
#include "trace/one_ray.h"

/* A floor below a small pane, seen straight on from above it; lamps stand in a ring above the floor, each under a black
 * lid of its own, so that nothing is found. */
#define PANE "void glass pane 0 0 3 .9 .9 .9 pane polygon p 0 0 12 -.01 -.01 9 .01 -.01 9 .01 .01 9 -.01 .01 9\n"
static const graze_ray down = {.origin = {0, 0, 10}, .direction = {0, 0, -1}};
static const double height = 2, ring = 1.5, side = 0.02, radiance = 1e4;

static char text[20000];

static void add_text(const char *more) {
    assert_true(strlen(text) + strlen(more) < sizeof text);
    strcat(text, more);
}

static void add_rectangle(const char *kind, double x0, double x1, double y, double half, double z) {
    char more[500];
    snprintf(more, sizeof more, "%s polygon r 0 0 12 %.17g %.17g %g %.17g %.17g %g %.17g %.17g %g %.17g %.17g %g\n",
             kind, x0, y - half, z, x0, y + half, z, x1, y + half, z, x1, y - half, z);
    add_text(more);
}

static void add_covered_lamp(const char *kind, double angle) {
    double x = ring * cos(angle), y = ring * sin(angle), h = side / 2;
    add_rectangle(kind, x - h, x + h, y, h, height);
    add_rectangle("black", x - 4 * h, x + 4 * h, y, 4 * h, height - 0.001);
}

/* Of the lid's two halves none hides all of the lamp, so that nobody knows that both do. */
static void add_lamp(const char *kind, double angle) {
    double x = ring * cos(angle), y = ring * sin(angle), h = side / 2, lid = height - 0.001;
    add_rectangle(kind, x - h, x + h, y, h, height);
    add_rectangle("black", x - 4 * h, x + h / 4, y, 4 * h, lid);
    add_rectangle("black", x - h / 4, x + 4 * h, y, 4 * h, lid);
}

static void write_scene(const char *floor, const char *kind, int lamps) {
    text[0] = 0;
    add_text(
        "void plastic black 0 0 5 0 0 0 0 0 void light lit 0 0 3 1e4 1e4 1e4 void glow glowing 0 0 4 1e4 1e4 1e4 0 "
        "void glow dark 0 0 4 1e4 1e4 1e4 -1 void light dim 0 0 3 1e-6 1e-6 1e-6 "
        "void spotlight aside 0 0 7 1e4 1e4 1e4 60 1 0 -.1\n");
    add_text(floor);
    add_text(" floor polygon f 0 0 12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n");
    add_text(PANE);
    for (int i = 0; i < lamps; i++)
        add_lamp(kind, 2 * PI * i / lamps);
}

/* What is stated to be missing, times the number of samples. */
static double missing(const char *floor, const char *kind, int lamps, int bounces) {
    graze_trace_settings s = graze_trace_defaults();
    s.samples = 64;
    s.ambient_bounces = bounces;
    write_scene(floor, kind, lamps);
    graze_answer answer = answer_along(text, &s, down);
    assert_close(answer.value.g, 0, 0);
    return answer.standard_error.g * answer.samples;
}

/* What the pane lets through, or reflects, straight on. */
static double of_pane(bool through) {
    graze_trace_settings s = graze_trace_defaults();
    s.samples = 2;
    text[0] = 0;
    add_text(through ? "void glow g 0 0 4 1 1 1 0 g source s 0 0 4 0 0 -1 180\n"
                     : "void glow g 0 0 4 1 1 1 0 g source s 0 0 4 0 0 1 180\n");
    add_text(PANE);
    return answer_along(text, &s, down).value.g;
}

static double transmittance(void) {
    return of_pane(true);
}

/* Of diffuse reflections many paths are taken, and each goes through the pane or is mirrored, a tenth at least: those
 * that do carry so much more. */
static double of_few(void) {
    double share = of_pane(true) / (of_pane(true) + of_pane(false));
    assert_true(share > 0.9);
    return transmittance() * (share + 0.1) / share;
}

/* Of a lamp from the middle of the floor: the solid angle, and its cosine there. */
static void lamp_as_seen(double *solid_angle, double *cosine) {
    double square = height * height + ring * ring;
    *cosine = height / sqrt(square);
    *solid_angle = side * side * *cosine / square;
}

#define MATTE "void plastic floor 0 0 5 .5 .5 .5 0 0"

static void matte_floors(void **state) {
    (void)state;
    double solid_angle, cosine;
    lamp_as_seen(&solid_angle, &cosine);
    double one = transmittance() * 0.5 / PI * radiance * solid_angle * cosine;
    /* Of few lamps it is also stated that what is known to come without shadows was never lit (estimate_error.c). */
    for (int lamps = 1; lamps < 20; lamps++)
        assert_close(missing(MATTE, "lit", lamps, 0) / (one * lamps), lamps > PATH_FEW_LIGHTS ? 1 : sqrt(2), 2e-3);
    /* Glows light what is diffuse if a bounce is left. */
    assert_close(missing(MATTE, "glowing", 2, 0), 0, 0);
    assert_close(missing(MATTE, "glowing", 12, 1) / (12 * one), of_few() / transmittance(), 2e-3);
}

/* Narrow gloss may show the lamp wholly, if seldom; wide gloss reflects some of it. */
static void glossy_floors(void **state) {
    (void)state;
    double solid_angle, cosine, through = transmittance();
    lamp_as_seen(&solid_angle, &cosine);
    const char *narrow = "void metal floor 0 0 5 .5 .5 .5 1 .0015", *wide = "void metal floor 0 0 5 .5 .5 .5 1 .3";
    double share = 4 * PI * 0.0015 * 0.0015 / solid_angle;
    assert_true(share < 1);
    assert_close(missing(narrow, "lit", 1, 0) / (through * 0.5 * radiance), 1, 1e-6);
    assert_close(missing(narrow, "glowing", 1, 0) / (through * 0.5 * radiance), 1, 1e-6);
    /* As narrow as the lamp, it shows it by what it reflects there: nothing. */
    char alike[100];
    snprintf(alike, sizeof alike, "void metal floor 0 0 5 .5 .5 .5 1 %g", sqrt(1.5 * solid_angle / (4 * PI)));
    assert_close(missing(alike, "lit", 1, 0), 0, 1e-9);
    graze_surface s;
    const graze_material m = {
        .kind = GRAZE_METAL, .color = {.5, .5, .5}, .specularity = 1, .roughness_u = 0.3, .roughness_v = 0.3};
    rgb diffuse, gloss;
    graze_surface_prepare(&s, &m, (vec3){0, 0, 1}, (vec3){0, 0, 1}, NULL);
    graze_surface_value(&s, (vec3){sqrt(1 - cosine * cosine), 0, cosine}, &diffuse, &gloss);
    assert_close(missing(wide, "lit", 1, 0) / (through * gloss.g * radiance * solid_angle * cosine), sqrt(2), 2e-3);
    /* Where a lobe is seldom followed, light samples that lie in it may find what it shows: the fewer, the more. */
    const char *mixed = "void plastic floor 0 0 5 .5 .5 .5 .01 .0015";
    double seldom = fmax(0.1, share), matte = 0.99 * 0.5 / PI * solid_angle * cosine;
    assert_close(missing(mixed, "lit", 12, 9) / (12 * of_few() * radiance * (matte + 0.01 / seldom)), 1, 2e-3);
}

/* The answer to a scene that has been written. */
static graze_answer answer(graze_trace_settings s) {
    s.samples = 64;
    return answer_along(text, &s, down);
}

/* Lamps that are known to be hidden, that light nothing, or not by the gloss of what is ambient. */
static void not_expected(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = 0;
    write_scene(MATTE, "lit", 1);
    double one = answer(s).standard_error.g;
    add_covered_lamp("lit", 2);
    assert_close(answer(s).standard_error.g, one, 1e-9);
    assert_close(missing(MATTE, "dark", 1, 1), 0, 0);
    assert_close(missing(MATTE, "aside", 1, 0), 0, 0);
    assert_close(missing(MATTE, "aside", 12, 0), 0, 0);
    s.specular_threshold = 1;
    write_scene("void metal floor 0 0 5 .5 .5 .5 1 .0015", "glowing", 1);
    assert_close(answer(s).standard_error.g, 0, 0);
    write_scene(MATTE, "glowing", 1);
    s.ambient_bounces = 1;
    s.back_faces_visible = 0;
    assert_close(answer(s).standard_error.g, 0, 0);
}

/* Of many lamps one that matters; and not more than what is seen. */
static void chosen_lamps(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = 0;
    double solid_angle, cosine;
    lamp_as_seen(&solid_angle, &cosine);
    double one = transmittance() * 0.5 / PI * radiance * solid_angle * cosine;
    for (int last = 0; last < 2; last++) {
        write_scene(MATTE, last ? "dim" : "lit", 1);
        for (int i = 1; i < 12; i++)
            add_lamp(last && i == 11 ? "lit" : "dim", 2 * PI * i / 12);
        /* The others are chosen once in 200 times. */
        assert_close(answer(s).standard_error.g * 64 / one, 1.005, 2e-3);
    }
    for (int lamps = 2; lamps < 20; lamps += 10) {
        write_scene(MATTE, "lit", lamps);
        s.ambient_value = rgb_gray(one / 1000);
        graze_answer capped = answer(s);
        assert_true(capped.value.g > 0 && capped.standard_error.g >= capped.value.g &&
                    capped.standard_error.g < 1.5 * capped.value.g);
    }
}

/* Nothing is missing of what is met. */
static void nothing_is_missing(void **state) {
    (void)state;
    graze_trace_settings s = graze_trace_defaults();
    s.samples = 64;
    s.ambient_bounces = 0;
    text[0] = 0;
    add_text("void light lit 0 0 3 1e4 1e4 1e4 " MATTE " floor polygon f 0 0 12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n" PANE
             "lit polygon lamp 0 0 12 .5 0 2 .5 .02 2 .52 .02 2 .52 0 2\n");
    graze_answer lit = answer_along(text, &s, down);
    assert_true(lit.value.g > 0 && lit.standard_error.g < 0.01 * lit.value.g);
}

/* Each place has a note of its own; lights in mirrors take half of the room. */
static void notes(void **state) {
    (void)state;
    path_memory memory = {.alike = false};
    const path_context context = {.memory = &memory};
    path p = {.context = &context, .depth = 1, .passages = 2};
    path_unmet_at *first = unmet_light_at(&p, -1, -1);
    assert_true(first && first->expected == UNMET_LIGHT_NEW && !first->met);
    assert_true(unmet_light_at(&p, -1, -1) == first);
    assert_true(unmet_light_at(&p, 3, 4) != first);
    assert_true(unmet_light_at(&p, 3, 4) == unmet_light_at(&p, 3, 4));
    assert_true(unmet_light_at(&p, 3, 4) != unmet_light_at(&p, 3, 5));
    assert_true(unmet_light_at(&p, 3, 4) != unmet_light_at(&p, 2, 4));
    assert_int_equal(memory.unmet.count, 4);
    p.depth = 2;
    assert_true(unmet_light_at(&p, -1, -1) != first);
    p.depth = 1;
    p.passages = 3;
    assert_true(unmet_light_at(&p, -1, -1) != first);
    assert_int_equal(memory.unmet.count, 6);
    for (int i = 0; i < PATH_UNMET; i++)
        (void)unmet_light_at(&p, i, 0);
    assert_int_equal(memory.unmet.count, PATH_UNMET / 2);
    assert_null(unmet_light_at(&p, 0, 7));
    for (int i = 0; i < PATH_UNMET; i++, p.depth++)
        (void)unmet_light_at(&p, -1, -1);
    assert_int_equal(memory.unmet.count, PATH_UNMET);
    assert_null(unmet_light_at(&p, -1, -1));
    assert_int_equal(memory.unmet.count, PATH_UNMET);
}

/* What was found since then is what counts; of a path that scattered, what it found straight on. */
static void what_is_met(void **state) {
    (void)state;
    const struct {
        bool scattered, met_before;
        double before, direct, radiance;
        bool met;
    } cases[] = {{false, false, 1, 1, 1, false}, {false, false, 1, 1, 2, true}, {false, false, 1, 2, 1, false},
                 {true, false, 1, 2, 1, true},   {true, false, 1, 1, 2, false}, {true, true, 1, 1, 1, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        path_unmet_at at = {.met = cases[i].met_before};
        path p = {.unmet = &at,
                  .scattered = cases[i].scattered,
                  .before = rgb_gray(cases[i].before),
                  .direct = rgb_gray(cases[i].direct),
                  .radiance = rgb_gray(cases[i].radiance)};
        unmet_light_settle(&p);
        assert_int_equal(at.met, cases[i].met);
        assert_null(p.unmet);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matte_floors), cmocka_unit_test(glossy_floors), cmocka_unit_test(nothing_is_missing),
        cmocka_unit_test(not_expected), cmocka_unit_test(chosen_lamps),  cmocka_unit_test(notes),
        cmocka_unit_test(what_is_met),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
