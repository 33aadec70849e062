/* The rays that an answer consists of, and its mirrored part. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/vector.h"
#include "graze/trace.h"
#include "support/close.h"
#include "support/scene_text.h"

/* A room of all lobes, with a lamp, a glow and a sky that is seen through the open top. */
static const char room[] = "void metal2 brushed 4 1 1 0 . 0 6 .6 .5 .4 .7 .1 .3\n"
                           "void plastic glazed 0 0 5 .5 .4 .3 .3 0\n"
                           "void plastic matt 0 0 5 .3 .6 .4 0 0\n"
                           "void light white 0 0 3 9 8 7\n"
                           "void glow red 0 0 4 .9 .2 .1 0\n"
                           "void glow blue 0 0 4 .1 .2 .3 0\n"
                           "brushed polygon floor 0 0 12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n"
                           "glazed polygon north 0 0 12 -4 4 0 4 4 0 4 4 4 -4 4 4\n"
                           "matt polygon east 0 0 12 4 -4 0 4 -4 4 4 4 4 4 4 0\n"
                           "glazed sphere ball 0 0 4 1 1 .7 .7\n"
                           "white sphere lamp 0 0 4 -1 2 3 .3\n"
                           "red ring coal 0 0 8 -2 0 .1 0 0 1 0 .5\n"
                           "blue source sky 0 0 4 0 0 1 180\n";

static const graze_ray rays[] = {
    {.origin = {0, -3, 2}, .direction = {0, 1, -.4}},    /* the glossy floor */
    {.origin = {0, -3, 2}, .direction = {.1, 1, .1}},    /* the half mirroring wall */
    {.origin = {0, -3, 2}, .direction = {1, .3, 0}},     /* the matt wall */
    {.origin = {0, -3, 2}, .direction = {.25, 1, -.3}},  /* the ball */
    {.origin = {0, -3, 2}, .direction = {-.2, 1, .2}},   /* the lamp */
    {.origin = {0, -3, 2}, .direction = {0, 0, 1}},      /* the sky */
    {.origin = {0, -3, 2}, .direction = {0, -1, -.001}}, /* nothing */
};
enum { RAYS = sizeof rays / sizeof *rays };

/* A tree as it was told. */
typedef struct told {
    graze_tree_ray *rays;
    size_t count;
} told;

static void remember(void *user, const graze_tree_ray *ray) {
    told *t = user;
    if ((t->count & (t->count - 1)) == 0) /* a power of two: room for twice as many */
        t->rays = realloc(t->rays, (t->count ? 2 * t->count : 1) * sizeof *t->rays);
    assert_non_null(t->rays);
    t->rays[t->count++] = *ray;
}

static told tree_of(const graze_scene *scene, const graze_trace_settings *s, graze_ray ray, uint64_t stream,
                    uint32_t paths) {
    told t = {0};
    assert_int_equal(graze_trace_tree(scene, s, &ray, stream, paths, remember, &t, NULL), GRAZE_OK);
    return t;
}

static graze_trace_settings settings_with(graze_strategy strategy, int bounces) {
    graze_trace_settings s = graze_trace_defaults();
    s.strategy = strategy;
    s.ambient_bounces = bounces;
    return s;
}

/* Sum and product, to the rounding of sums whose terms may be in another order. */
static void assert_equal_rgb(rgb a, rgb b) {
    double tolerance = 1e-12 * (rgb_max(a) + 1e-3);
    assert_close(a.r, b.r, tolerance);
    assert_close(a.g, b.g, tolerance);
    assert_close(a.b, b.b, tolerance);
}

/* Every ray comes after its children, whose contributions are its own: nothing but lights adds any. */
static void assert_is_tree(const told *t) {
    enum { DEPTHS = 200 };
    rgb below[DEPTHS + 1] = {{0, 0, 0}};
    assert_true(t->count > 0);
    for (size_t i = 0; i < t->count; i++) {
        const graze_tree_ray *ray = &t->rays[i];
        bool last = i + 1 == t->count;
        assert_int_equal(ray->depth == 0, last);
        assert_true(ray->depth < DEPTHS);
        assert_close(vec3_length(ray->direction), 1, 1e-12);
        rgb children = below[ray->depth + 1];
        below[ray->depth + 1] = rgb_gray(0);
        if (!rgb_is_black(children))
            assert_equal_rgb(ray->contribution, children);
        /* The first ray's coefficient is 1; of a light that other samples find it is 0. */
        assert_equal_rgb(ray->contribution, rgb_multiply(ray->coefficient, ray->radiance));
        below[ray->depth] = rgb_add(below[ray->depth], ray->contribution);
        if (ray->shadow) {
            assert_true(rgb_is_black(children));
            assert_non_null(ray->hit.surface);
        }
    }
    for (int depth = 1; depth <= DEPTHS; depth++)
        assert_true(rgb_is_black(below[depth]));
}

static void contributions_sum_up(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(room);
    assert_non_null(scene);
    for (int strategy = 0; strategy < 3; strategy++)
        for (int i = 0; i < RAYS; i++)
            for (uint64_t stream = 0; stream < 50; stream++) {
                const graze_trace_settings s = settings_with((graze_strategy)strategy, 2);
                told t = tree_of(scene, &s, rays[i], stream, stream % 4 + 1);
                assert_is_tree(&t);
                free(t.rays);
            }
    graze_scene_destroy(scene);
}

/* Many small trees average to the answer. */
static void trees_average_to_the_answer(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(room);
    assert_non_null(scene);
    for (int sensor = 0; sensor <= 1; sensor++)
        for (int i = 0; i < RAYS; i++) {
            enum { TREES = 400, PATHS = 16 };
            graze_trace_settings s = settings_with(GRAZE_STRATEGY_MIS, 2);
            s.quantity = sensor ? GRAZE_IRRADIANCE : GRAZE_RADIANCE;
            s.ambient_value = (graze_rgb){.02, .01, .03};
            s.error = .002;
            double sum = 0, squares = 0;
            for (uint64_t stream = 0; stream < TREES; stream++) {
                told t = tree_of(scene, &s, rays[i], stream, PATHS);
                double value = t.rays[t.count - 1].radiance.g;
                sum += value;
                squares += value * value;
                free(t.rays);
            }
            graze_answer answer;
            graze_trace(scene, &s, &rays[i], 0, &answer, NULL);
            double mean = sum / TREES, variance = fmax(0, squares / TREES - mean * mean) / (TREES - 1);
            assert_close(mean, answer.value.g,
                         4 * sqrt(variance + answer.standard_error.g * answer.standard_error.g) + 1e-9 * mean);
        }
    graze_scene_destroy(scene);
}

static void the_ambient_value_needs_no_ray(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("void plastic m 0 0 5 .5 .5 .5 0 0 m sphere s 0 0 4 0 0 0 1\n");
    assert_non_null(scene);
    graze_trace_settings s = settings_with(GRAZE_STRATEGY_MIS, 0);
    s.ambient_value = (graze_rgb){1, 2, 3};
    told t = tree_of(scene, &s, (graze_ray){.origin = {0, 0, 3}, .direction = {0, 0, -2}}, 0, 1);
    assert_int_equal(t.count, 1);
    assert_equal_rgb(t.rays[0].radiance, (rgb){.5, 1, 1.5});
    assert_close(t.rays[0].hit.distance, 2, 1e-12);
    free(t.rays);
    graze_scene_destroy(scene);
}

/* A ray that cannot be traced is told of all the same. */
static void impossible_rays_meet_nothing(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(room);
    assert_non_null(scene);
    const graze_trace_settings s = settings_with(GRAZE_STRATEGY_MIS, 0);
    told t = tree_of(scene, &s, (graze_ray){.origin = {1, 2, 3}, .direction = {0, 0, 0}}, 0, 3);
    assert_int_equal(t.count, 1);
    assert_null(t.rays[0].hit.surface);
    assert_true(rgb_is_black(t.rays[0].radiance));
    free(t.rays);
    graze_scene_destroy(scene);
}

/* The same mirrored ray is in trees and in the parts of answers. */
static void mirrored_part(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(room);
    assert_non_null(scene);
    for (int i = 0; i < RAYS; i++) {
        graze_trace_settings s = settings_with(GRAZE_STRATEGY_MIS, 2), part = s;
        s.error = part.error = .002;
        graze_answer whole, mirrored, rest;
        graze_hit hit;
        graze_trace(scene, &s, &rays[i], 0, &whole, &hit);
        part.part = GRAZE_MIRRORED;
        graze_trace(scene, &part, &rays[i], 1, &mirrored, NULL);
        part.part = GRAZE_UNMIRRORED;
        graze_trace(scene, &part, &rays[i], 2, &rest, NULL);
        double sum = mirrored.value.g + rest.value.g;
        double error =
            sqrt(whole.standard_error.g * whole.standard_error.g +
                 mirrored.standard_error.g * mirrored.standard_error.g + rest.standard_error.g * rest.standard_error.g);
        assert_close(sum, whole.value.g, 4 * error + 1e-9 * sum);
        bool mirror = hit.material && strcmp(hit.material, "glazed") == 0;
        assert_int_equal(mirrored.value.g > 0, mirror);
        assert_true(mirror || graze_mirrored_distance(scene, &s, &rays[i]) == GRAZE_FAR);

        enum { PATHS = 4096 };
        told t = tree_of(scene, &s, rays[i], 0, PATHS);
        const graze_tree_ray *root = &t.rays[t.count - 1];
        assert_close(root->mirrored.g, mirrored.value.g, 0.05 * mirrored.value.g);
        assert_close(root->mirrored_distance, graze_mirrored_distance(scene, &s, &rays[i]), 1e-9);
        free(t.rays);
    }
    graze_scene_destroy(scene);
}

static void length_by_way_of_a_mirror(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("void metal m 0 0 5 1 1 1 1 0 void light l 0 0 3 1 1 1\n"
                                         "m polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n"
                                         "l ring lamp 0 0 8 0 4 3 0 0 -1 0 1\n");
    assert_non_null(scene);
    graze_trace_settings s = settings_with(GRAZE_STRATEGY_MIS, 0);
    const graze_ray ray = {.origin = {0, -4, 3}, .direction = {0, 4, -3}};
    const graze_ray away = {.origin = {0, -4, 3}, .direction = {0, -4, -3}};
    assert_close(graze_mirrored_distance(scene, &s, &ray), 10, 1e-12);
    assert_close(graze_mirrored_distance(scene, &s, &away), GRAZE_FAR, 0);
    s.quantity = GRAZE_IRRADIANCE;
    assert_close(graze_mirrored_distance(scene, &s, &ray), GRAZE_FAR, 0);
    s.quantity = GRAZE_RADIANCE;
    told t = tree_of(scene, &s, ray, 0, 1);
    assert_int_equal(t.count, 2);
    assert_string_equal(t.rays[0].hit.surface, "lamp");
    assert_equal_rgb(t.rays[0].coefficient, rgb_gray(1));
    assert_close(t.rays[1].mirrored_distance, 10, 1e-12);
    assert_equal_rgb(t.rays[1].mirrored, rgb_gray(1));
    free(t.rays);
    s.part = (graze_part)3;
    assert_int_equal(graze_trace_check(&s, NULL), GRAZE_INPUT_ERROR);
    graze_scene_destroy(scene);
}

/* With -ae and -ai: what a diffuse floor gets of a sky that only interreflection finds. */
static void ambient_modifiers(void **state) {
    (void)state;
    static const char text[] = "void glow g 0 0 4 1 1 1 0 g source sky 0 0 4 0 0 1 180\n"
                               "void plastic a 0 0 5 .5 .5 .5 0 0 a polygon fa 0 0 9 0 0 0 9 0 0 9 9 0\n"
                               "inherit alias b a b polygon fb 0 0 9 0 0 0 9 9 0 0 9 0\n";
    static const char *const names[] = {"b"};
    for (int mode = 0; mode < 3; mode++) { /* all, without b, b alone */
        graze_scene *scene =
            scene_from_text_with(text, &(graze_scene_settings){.ambient_modifiers = names,
                                                               .ambient_modifier_count = mode > 0,
                                                               .ambient_modifiers_included = mode == 2});
        assert_non_null(scene);
        graze_trace_settings s = settings_with(GRAZE_STRATEGY_MIS, 1);
        s.ambient_value = (graze_rgb){.2, .2, .2};
        graze_answer a, b;
        graze_trace(scene, &s, &(graze_ray){.origin = {6, 3, 1}, .direction = {0, 0, -1}}, 0, &a, NULL);
        graze_trace(scene, &s, &(graze_ray){.origin = {3, 6, 1}, .direction = {0, 0, -1}}, 0, &b, NULL);
        assert_close(a.value.g, mode == 2 ? .1 : .5, mode == 2 ? 1e-12 : 4 * a.standard_error.g + 1e-9);
        assert_close(b.value.g, mode == 1 ? .1 : .5, mode == 1 ? 1e-12 : 4 * b.standard_error.g + 1e-9);
        graze_scene_destroy(scene);
    }
    static const char *const nobody[] = {"nobody"};
    graze_scene *scene =
        scene_from_text_with(text, &(graze_scene_settings){.ambient_modifiers = nobody, .ambient_modifier_count = 1});
    assert_non_null(scene);
    assert_non_null(strstr(messages, "'nobody'"));
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contributions_sum_up),
        cmocka_unit_test(trees_average_to_the_answer),
        cmocka_unit_test(the_ambient_value_needs_no_ray),
        cmocka_unit_test(impossible_rays_meet_nothing),
        cmocka_unit_test(mirrored_part),
        cmocka_unit_test(length_by_way_of_a_mirror),
        cmocka_unit_test(ambient_modifiers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
