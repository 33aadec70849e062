/* How paths go on from a vertex: how likely each lobe is taken, to the last digit, and what the path is then. */
#include "trace/lobes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/close.h"
#include "trace/context.h"
#include "trace/sampler.h"
#include "trace/vertex.h"

/* A path that has come to a vertex of a scene without anything. */
typedef struct arrival {
    graze_scene scene;
    graze_trace_settings settings;
    path_context context;
    sampler random;
    path p;
    vertex v;
} arrival;

static const vec3 up = {0, 0, 1};
static vec3 slanted(void) {
    return vec3_safe_normalize((vec3){.6, 0, .8});
}

static void look_at(arrival *a, graze_material m) {
    a->v = (vertex){.normal = up, .surface = -1, .distance = 2, .before = {1, 1, 1}, .beyond = {1, 1, 1}};
    graze_surface_prepare(&a->v.shading, &m, up, slanted(), NULL);
    vertex_find_ambient(&a->p, &a->v, &m);
}

static arrival begin(void) {
    arrival a = {.settings = graze_trace_defaults()};
    a.settings.ambient_bounces = 1;
    a.settings.minimum_weight = 1e-6;
    a.settings.reflection_limit = 0;
    a.settings.specular_threshold = 0.02;
    a.p.throughput = rgb_gray(1);
    a.p.medium = rgb_gray(1);
    a.p.ambient_limit = 9;
    a.p.last.mirror = -1;
    a.random = sampler_start(sampler_key(1, 2, 3), 0);
    return a;
}

/* Once it stays where it is. */
static void settle(arrival *a, graze_material m) {
    a->context = (path_context){.scene = &a->scene, .settings = &a->settings};
    a->p.context = &a->context;
    a->p.sampler = &a->random;
    look_at(a, m);
}

static graze_material plastic(double diffuse, double specular, double roughness) {
    return (graze_material){.kind = GRAZE_METAL,
                            .color = rgb_gray(diffuse + specular),
                            .specularity = specular / (diffuse + specular),
                            .roughness_u = roughness,
                            .roughness_v = roughness};
}

static double mirror_chance(arrival a, double reflectance) {
    settle(&a, plastic(0, reflectance, 0));
    a.v.shading.specular = rgb_gray(reflectance); /* Fresnel's part left out */
    return lobes_choose(&a.p, &a.v).specular;
}

static double gloss_chance(arrival a, double reflectance, bool *ends) {
    settle(&a, plastic(0, 0.5, 0.2));
    a.v.shading.specular = rgb_gray(reflectance);
    lobe_choice choice = lobes_choose(&a.p, &a.v);
    *ends = choice.specular_ends;
    return choice.specular;
}

static double diffuse_chance(arrival a, double reflectance, bool *ends) {
    settle(&a, plastic(reflectance, 0, 0));
    lobe_choice choice = lobes_choose(&a.p, &a.v);
    *ends = choice.diffuse_ends;
    return choice.diffuse;
}

static void paths_survive(void **state) {
    (void)state;
    const struct {
        double throughput, minimum;
        int limit, depth;
        double chance;
    } cases[] = {
        {1, 0.01, 0, 0, 1},    {0.01, 0.01, 0, 0, 0.5},  {0.02, 0.01, 5, 0, 1},    {0.01, 0.01, 5, 0, 0},
        {0.01, 0.01, 1, 0, 0}, {0.01, 0.01, -5, 0, 0.5}, {1, 0.01, 3, 2, 1},       {1, 0.01, 3, 3, 0},
        {1, 0.01, -3, 2, 1},   {1, 0.01, -3, 3, 0},      {0.3, 0.01, 0, 3, 1},     {0.3, 0.01, 0, 4, 0.5},
        {0.6, 0.01, 0, 4, 1},  {0.9, 0.01, 0, 4, 1},     {0.02, 1e-3, 0, 4, 0.05}, {1, 0.01, 0, 63, 1},
        {1, 0.01, 0, 64, 0.9}, {0.3, 0.01, 0, 64, 0.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        arrival a = begin();
        a.p.throughput = (rgb){cases[i].throughput / 2, cases[i].throughput, 0};
        a.p.depth = cases[i].depth;
        a.settings.minimum_weight = cases[i].minimum;
        a.settings.reflection_limit = cases[i].limit;
        double chance = mirror_chance(a, 0.5);
        if (fabs(chance - cases[i].chance) > 1e-12)
            fail_msg("case %d: %g", (int)i, chance);
    }
    bool ends;
    arrival a = begin();
    a.settings.minimum_weight = 0;
    assert_close(mirror_chance(a, 0), 0, 0);
    assert_close(diffuse_chance(a, 0, &ends), 0, 0);
}

/* A path that carries nothing itself looks for lights, by what these would give. */
static void passages_are_let_through(void **state) {
    (void)state;
    arrival a = begin();
    a.settings.minimum_weight = 0.1;
    a.settings.reflection_limit = 1;
    a.p.depth = 7;
    a.p.throughput = rgb_gray(0);
    a.p.last.direct = (rgb){0.5, 0, 0};
    a.p.last.indirect = (rgb){0.3, 0, 0};
    assert_close(mirror_chance(a, 0.5), 1, 0);
    a.p.last.direct = (rgb){0.05, 0, 0};
    a.p.last.indirect = (rgb){0.03, 0, 0};
    assert_close(mirror_chance(a, 0.5), 0.4, 1e-12);
    a.p.last.direct = (rgb){2, 0, 0};
    a.p.passages = 56;
    assert_close(mirror_chance(a, 0.5), 1, 0);
    a.p.passages = 57;
    assert_close(mirror_chance(a, 0.5), 0.9, 0);
}

static void lobes_end(void **state) {
    (void)state;
    bool ends;
    arrival a = begin();
    assert_close(gloss_chance(a, 0.5, &ends), 1, 0);
    assert_false(ends);
    assert_close(diffuse_chance(a, 0.5, &ends), 1, 0);
    assert_false(ends);
    assert_close(diffuse_chance(a, 0, &ends), 0, 0);
    /* Below the threshold a gloss is ambient, and beyond the last bounce nothing is: only lights are looked for. */
    const struct {
        graze_strategy strategy;
        int lights;
        double gloss, diffuse;
    } cases[] = {{GRAZE_STRATEGY_MIS, 0, 0, 0},  {GRAZE_STRATEGY_MIS, 1, 1, 0},  {GRAZE_STRATEGY_LIGHT, 1, 0, 0},
                 {GRAZE_STRATEGY_BRDF, 1, 1, 1}, {GRAZE_STRATEGY_BRDF, 0, 0, 0}, {GRAZE_STRATEGY_UNWEIGHTED, 1, 1, 1}};
    a.settings.specular_threshold = 1;
    a.p.ambient_depth = a.p.ambient_limit;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        a.settings.strategy = cases[i].strategy;
        a.scene.light_count = (size_t)cases[i].lights;
        /* The gloss is part of what is ambient then, and diffuse. */
        arrival b = a;
        settle(&b, plastic(0, 0.5, 0.2));
        b.v.ambient = rgb_gray(0);
        lobe_choice choice = lobes_choose(&b.p, &b.v);
        assert_close(choice.specular, cases[i].gloss, 0);
        assert_true(choice.specular_ends);
        assert_close(diffuse_chance(a, 0.5, &ends), cases[i].diffuse, 0);
        assert_true(ends);
        assert_close(diffuse_chance(a, 0, &ends), 0, 0);
    }
    /* What is refracted no light sample finds. */
    a.settings.strategy = GRAZE_STRATEGY_LIGHT;
    a.scene.has_refraction = true;
    assert_close(diffuse_chance(a, 0.5, &ends), 1, 0);
    /* Where the first point's irradiance is known, diffuse reflections find what is refracted, or a sky. */
    a = begin();
    a.p.indirect_known = true;
    a.scene.light_count = 1;
    assert_close(diffuse_chance(a, 0.5, &ends), 0, 0);
    a.scene.has_sky = true;
    assert_close(diffuse_chance(a, 0.5, &ends), 1, 0);
    assert_true(ends);
    a.settings.strategy = GRAZE_STRATEGY_LIGHT;
    assert_close(diffuse_chance(a, 0.5, &ends), 0, 0);
    a.p.depth = 1;
    assert_close(diffuse_chance(a, 0.5, &ends), 1, 0);
    assert_false(ends);
    a.settings.strategy = GRAZE_STRATEGY_MIS;
    a.p.ambient_depth = a.p.ambient_limit;
    assert_close(diffuse_chance(a, 0.5, &ends), 0, 0); /* a sky only from the first */
    a = begin();
    a.p.indirect_known = a.scene.has_refraction = true;
    assert_close(diffuse_chance(a, 0.5, &ends), 1, 0);
    assert_false(ends);
    a = begin();
    a.p.indirect_known = true;
    a.p.depth = 1;
    assert_close(diffuse_chance(a, 0.5, &ends), 1, 0);
}

/* Later reflections are followed as they are worth it, where lights are sampled. */
static void what_is_worth_following(void **state) {
    (void)state;
    bool ends;
    arrival a = begin();
    a.p.throughput = rgb_gray(0.1);
    assert_close(gloss_chance(a, 0.5, &ends), 1, 0);
    a.p.depth = 1;
    assert_close(gloss_chance(a, 0.5, &ends), 0.5, 1e-12);
    assert_close(diffuse_chance(a, 0.2, &ends), 0.2, 1e-12);
    a.p.throughput = rgb_gray(1e-3);
    assert_close(gloss_chance(a, 0.5, &ends), 0.05, 1e-12);
    a.settings.strategy = GRAZE_STRATEGY_BRDF;
    assert_close(gloss_chance(a, 0.5, &ends), 1, 0);
    a.settings.strategy = GRAZE_STRATEGY_LIGHT;
    assert_close(gloss_chance(a, 0.5, &ends), 0.05, 1e-12);
    a = begin();
    a.p.wanted = WANTED_BENT;
    assert_close(gloss_chance(a, 0.5, &ends), 0.25, 0);
}

static lobe_choice choose(arrival *a, double diffuse, double specular, double roughness) {
    settle(a, plastic(0.5, 0.5, roughness));
    a->v.shading.diffuse = a->v.ambient = rgb_gray(diffuse);
    a->v.shading.specular = rgb_gray(specular);
    return lobes_choose(&a->p, &a->v);
}

/* By what they reflect, but a tenth at least for each. */
static void lobes_share(void **state) {
    (void)state;
    arrival a = begin();
    lobe_choice choice = choose(&a, 0.6, 0.2, 0.2);
    assert_close(choice.diffuse, 0.75, 1e-12);
    assert_close(choice.specular, 0.25, 1e-12);
    choice = choose(&a, 0.6, 0.01, 0.2);
    assert_close(choice.diffuse, 0.9, 1e-12);
    assert_close(choice.specular, 0.1, 1e-12);
    choice = choose(&a, 0.01, 0.6, 0.2);
    assert_close(choice.diffuse, 0.1, 1e-12);
    assert_close(choice.specular, 0.9, 1e-12);
    /* One of them is taken as often as the likelier one would be. */
    a.p.depth = 1;
    a.p.throughput = rgb_gray(0.1);
    choice = choose(&a, 0.6, 0.3, 0.2);
    assert_close(choice.diffuse, 0.6 * 0.36 / 0.45, 1e-12);
    assert_close(choice.specular, 0.6 * 0.09 / 0.45, 1e-12);
}

static void mirrors_split_off(void **state) {
    (void)state;
    const arrival plain = begin();
    arrival a = plain;
    a.settings.ambient_bounces = 0;
    const arrival quiet = a;
    lobe_choice choice = choose(&a, 0.5, 0.02, 0);
    assert_true(choice.specular_splits && choice.specular == 0 && choice.diffuse == 1);
    assert_false(choose(&a, 0.5, 0.0199, 0).specular_splits);
    assert_false(choose(&a, 0.5, 0.5, 0.2).specular_splits);
    assert_false(choose(&a, 0, 0.5, 0).specular_splits);
    a.p.branches = PATH_BRANCHES - 3;
    assert_true(choose(&a, 0.5, 0.5, 0).specular_splits);
    a.p.branches = PATH_BRANCHES - 2;
    assert_false(choose(&a, 0.5, 0.5, 0).specular_splits);
    a = quiet;
    a.p.scattered = true;
    assert_false(choose(&a, 0.5, 0.5, 0).specular_splits);
    a = quiet;
    a.p.depth = 64;
    assert_false(choose(&a, 0.5, 0.5, 0).specular_splits);
    a = plain;
    assert_true(choose(&a, 0.5, 0.3, 0).specular_splits);
    assert_false(choose(&a, 0.5, 0.299, 0).specular_splits);
    a.p.throughput = rgb_gray(0.5);
    assert_true(choose(&a, 0.5, 0.6, 0).specular_splits);
    assert_false(choose(&a, 0.5, 0.59, 0).specular_splits);
}

/* Four lobes, of which two may split off. */
static void both_sides_share(void **state) {
    (void)state;
    const struct {
        double diffuse, specular, transmitted_diffuse, transmitted_specular;
        int bounces;
        double chances[4];
        bool splits[2];
    } cases[] = {
        {0.4, 0.1, 0.2, 0.3, 1, {0.4, 0.1, 0.2, 0.3}, {false, false}},
        {0.4, 0.1, 0.2, 0.3, 0, {2 / 3.0, 0, 1 / 3.0, 0}, {true, true}},
        {0.4, 0.1, 0.2, 0, 0, {2 / 3.0, 0, 1 / 3.0, 0}, {true, false}},
        {0, 0.5, 0, 0.5, 0, {0, 0, 0, 1}, {true, false}},
        {0, 0.5, 0, 0, 0, {0, 1, 0, 0}, {false, false}},
        {0.5,
         0.01,
         0,
         0.5,
         1,
         {0.5 / 1.01 / (1.0 / 1.01 + 0.1), 0.1 / (1.0 / 1.01 + 0.1), 0, 0.5 / 1.01 / (1.0 / 1.01 + 0.1)},
         {false, false}},
        {0.4, 0.1, 0, 0, 0, {1, 0, 0, 0}, {true, false}},
        {0, 0.1, 0.2, 0, 0, {0, 0, 1, 0}, {true, false}},
        {0.4, 0, 0, 0.3, 0, {1, 0, 0, 0}, {false, true}},
        {0, 0, 0.2, 0.3, 0, {0, 0, 1, 0}, {false, true}},
        {0, 0, 0, 0.5, 0, {0, 0, 0, 1}, {false, false}},
        {0, 0, 0, 0, 1, {0, 0, 0, 0}, {false, false}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        arrival a = begin();
        a.settings.ambient_bounces = cases[i].bounces;
        settle(&a, (graze_material){.kind = GRAZE_TRANS,
                                    .color = rgb_gray(1),
                                    .specularity = 0.5,
                                    .transmission = 0.5,
                                    .transmitted_specularity = 0.5});
        a.v.shading.diffuse = a.v.ambient = rgb_gray(cases[i].diffuse);
        a.v.shading.specular = rgb_gray(cases[i].specular);
        a.v.shading.transmitted_diffuse = a.v.transmitted_ambient = rgb_gray(cases[i].transmitted_diffuse);
        a.v.shading.transmitted_specular = rgb_gray(cases[i].transmitted_specular);
        if (cases[i].transmitted_specular == 0)
            a.v.shading.transmitted_lobe = GRAZE_LOBE_NONE;
        lobe_choice above, below;
        lobes_choose_both(&a.p, &a.v, &above, &below);
        const double found[] = {above.diffuse, above.specular, below.diffuse, below.specular};
        for (int k = 0; k < 4; k++)
            if (!(fabs(found[k] - cases[i].chances[k]) <= 1e-12))
                fail_msg("case %d, lobe %d: %g", (int)i, k, found[k]);
        assert_int_equal(above.specular_splits, cases[i].splits[0]);
        assert_int_equal(below.specular_splits, cases[i].splits[1]);
    }
}

/* As often as the likeliest would be taken; and gloss below the threshold only for lights. */
static void both_sides_end(void **state) {
    (void)state;
    lobe_choice above, below;
    arrival a = begin();
    a.p.throughput = rgb_gray(0.1);
    a.p.depth = 1;
    settle(&a, (graze_material){.kind = GRAZE_TRANS,
                                .color = rgb_gray(1),
                                .specularity = 0.5,
                                .transmission = 0.5,
                                .transmitted_specularity = 0.5,
                                .roughness_u = 0.2,
                                .roughness_v = 0.2});
    assert_int_equal(a.v.shading.transmitted_lobe, GRAZE_LOBE_TRANSMITTED_GLOSSY);
    a.v.ambient = a.v.shading.specular = a.v.transmitted_ambient = rgb_gray(0);
    a.v.shading.transmitted_specular = rgb_gray(0.5);
    lobes_choose_both(&a.p, &a.v, &above, &below);
    assert_close(below.specular, 0.5, 1e-12);
    assert_false(below.specular_ends);
    a.v.transmitted_gloss_is_ambient = true;
    lobes_choose_both(&a.p, &a.v, &above, &below);
    assert_close(below.specular, 0, 0);
    a.scene.light_count = 1;
    lobes_choose_both(&a.p, &a.v, &above, &below);
    assert_close(below.specular, 1, 0);
    assert_true(below.specular_ends);
}

/* The direction that so many numbers give, drawn as the path draws them. */
static vec3 drawn(const arrival *a, graze_lobe lobe, int numbers, double random[4]) {
    sampler copy = a->random;
    random[2] = random[3] = 0;
    if (numbers == 2)
        sampler_2d(&copy, random);
    else if (numbers == 3)
        sampler_3d(&copy, random);
    else
        sampler_4d(&copy, random);
    if (lobe != GRAZE_LOBE_GLOSSY || a->settings.strategy != GRAZE_STRATEGY_UNWEIGHTED)
        return graze_surface_sample_lobe(&a->v.shading, lobe, random[0], random[1], random[2]).direction;
    graze_surface_sample sample = graze_surface_sample_unweighted(&a->v.shading, random[0], random[1]);
    while (rgb_is_black(sample.weight)) {
        double again[2];
        sampler_2d(&copy, again);
        sample = graze_surface_sample_unweighted(&a->v.shading, again[0], again[1]);
    }
    return sample.direction;
}

/* As many numbers as are needed, in the order that samplers expect; what is rejected without weights is drawn again. */
static void directions_are_drawn(void **state) {
    (void)state;
    const struct {
        lobe_choice choice;
        int numbers;
        graze_strategy strategy;
    } cases[] = {
        {{.diffuse = 1}, 2, GRAZE_STRATEGY_MIS},
        {{.diffuse = 0.5}, 4, GRAZE_STRATEGY_MIS},
        {{.specular = 0.5}, 4, GRAZE_STRATEGY_MIS},
        {{.diffuse = 0.5, .specular = 0.5}, 4, GRAZE_STRATEGY_MIS},
        {{.diffuse = 0.4, .specular = 0.4}, 4, GRAZE_STRATEGY_MIS},
        {{.diffuse = 1e-9, .specular = 1}, 4, GRAZE_STRATEGY_MIS},
        {{.specular = 1}, 3, GRAZE_STRATEGY_MIS},
        {{.specular = 1}, 3, GRAZE_STRATEGY_UNWEIGHTED},
        {{.diffuse = 1}, 2, GRAZE_STRATEGY_UNWEIGHTED},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        arrival a = begin();
        a.settings.strategy = cases[i].strategy;
        settle(&a, plastic(0.5, 0.5, 0.6));
        const path before = a.p;
        int taken = 0;
        for (uint32_t k = 0; k < 256; k++) {
            vec3 direction;
            double random[4];
            a.p = before;
            a.random = sampler_start(sampler_key(1, 2, 3), k);
            sampler copy = a.random;
            (void)drawn(&a, GRAZE_LOBE_DIFFUSE, cases[i].numbers, random);
            graze_lobe lobe = random[3] < cases[i].choice.diffuse ? GRAZE_LOBE_DIFFUSE : GRAZE_LOBE_GLOSSY;
            vec3 expected = drawn(&a, lobe, cases[i].numbers, random);
            a.random = copy;
            bool goes_on = lobes_reflect(&a.p, &a.v, NULL, &cases[i].choice, &direction);
            if (random[3] >= cases[i].choice.diffuse + cases[i].choice.specular)
                assert_false(goes_on);
            if (!goes_on)
                continue;
            taken++;
            assert_close(vec3_dot(direction, expected), 1, 1e-12);
        }
        assert_true(taken > 100);
    }
}

static const lobe_choice only_specular = {.specular = 1}, only_diffuse = {.diffuse = 1};

static void assert_gray(rgb found, double value) {
    assert_close(found.r, value, 1e-12);
    assert_close(found.g, value, 1e-12);
    assert_close(found.b, value, 1e-12);
}

static void a_mirror_draws_nothing(void **state) {
    (void)state;
    vec3 direction;
    arrival a = begin();
    a.p.throughput = rgb_gray(0.5);
    settle(&a, plastic(0, 0.5, 0));
    a.v.shading.specular = rgb_gray(0.5);
    const uint32_t drawn = a.random.group;
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_specular, &direction));
    assert_int_equal(a.random.group, drawn);
    assert_close(direction.x, -0.6, 1e-12);
    assert_close(direction.z, 0.8, 1e-12);
    assert_gray(a.p.throughput, 0.25);
    assert_int_equal(a.p.last.lobe, GRAZE_LOBE_MIRROR);
    assert_true(a.p.depth == 1 && a.p.ambient_depth == 0 && !a.p.scattered && a.p.last.first && a.p.last.ambient);
    assert_true(a.p.last.mirror == -1 && a.p.last.vertex == &a.v && !a.p.searching);
    assert_gray(a.p.last.direct, 0.25);
    assert_gray(a.p.last.indirect, 0.25);
}

/* With half the chance, twice the weight. */
static void diffuse_reflections_are_drawn(void **state) {
    (void)state;
    vec3 direction;
    arrival a = begin();
    a.p.throughput = rgb_gray(0.5);
    settle(&a, plastic(0.5, 0, 0));
    a.v.ambient = rgb_gray(0.25);
    lobe_choice half = {.diffuse = 0.5};
    int taken = 0;
    const path before = a.p;
    for (uint32_t i = 0; i < 4096; i++) {
        a.p = before;
        a.random = sampler_start(sampler_key(1, 2, 3), i);
        if (!lobes_reflect(&a.p, &a.v, NULL, &half, &direction))
            continue;
        taken++;
        assert_true(direction.z > 0);
        assert_gray(a.p.last.direct, 0.5);
        assert_gray(a.p.last.indirect, 0.25);
        assert_gray(a.p.throughput, 0.25);
        assert_close(a.p.last.density, 0.5 * direction.z / acos(-1), 1e-12);
        assert_true(a.p.depth == 1 && a.p.ambient_depth == 1 && a.p.scattered && a.p.last.first && a.p.last.ambient);
    }
    assert_int_equal(taken, 2048);
    a.p.scattered = true;
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
    assert_false(a.p.last.first);
}

/* Where a path ends only what shines is found. */
static void ends_find_lights(void **state) {
    (void)state;
    vec3 direction;
    arrival a = begin();
    settle(&a, plastic(0.5, 0, 0));
    lobe_choice ending = {.diffuse = 1, .diffuse_ends = true};
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &ending, &direction));
    assert_gray(a.p.throughput, 0);
    assert_gray(a.p.last.direct, 0.5);
    assert_true(a.p.last.ambient);
    a = begin();
    settle(&a, plastic(0.5, 0, 0));
    a.settings.back_faces_visible = 0;
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &ending, &direction));
    assert_false(a.p.last.ambient);
    a = begin();
    a.p.ambient_depth = a.p.ambient_limit;
    settle(&a, plastic(0.5, 0, 0));
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
    assert_false(a.p.last.ambient);
}

static void too_much_is_no_light(void **state) {
    (void)state;
    vec3 direction;
    arrival a = begin();
    a.p.throughput = rgb_gray(4e30);
    settle(&a, plastic(0.5, 0, 0));
    assert_false(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
    a.v.ambient = rgb_gray(0);
    a.p.throughput = rgb_gray(4e30);
    assert_false(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
    a.v.ambient = rgb_gray(0.5);
    a.v.shading.diffuse = rgb_gray(0);
    a.p.throughput = rgb_gray(4e30);
    assert_false(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
    a.p.throughput = rgb_gray(1e30);
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
}

/* Reflections that may meet lights which no light sample finds. */
static void some_reflections_are_searches(void **state) {
    (void)state;
    vec3 direction;
    for (int brdf = 0; brdf < 2; brdf++)
        for (int mirrors = 0; mirrors < 2; mirrors++) {
            arrival a = begin();
            settle(&a, plastic(0.5, 0, 0));
            a.settings.strategy = brdf ? GRAZE_STRATEGY_BRDF : GRAZE_STRATEGY_MIS;
            a.scene.has_mirrors = mirrors;
            assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
            assert_int_equal(a.p.searching, brdf || mirrors);
        }
}

/* Leaning normals lead into surfaces: nothing is reflected there but by mirrors, which then do as the surface's own
 * normal has it. */
static void leaning_normals(void **state) {
    (void)state;
    vec3 direction;
    arrival a = begin();
    settle(&a, plastic(0, 0.5, 0));
    graze_material m = plastic(0, 0.5, 0);
    a.v.leans = true;
    a.v.normal = vec3_safe_normalize((vec3){0.9, 0, 0.1});
    graze_surface_prepare(&a.v.shading, &m, up, slanted(), NULL);
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_specular, &direction));
    vec3 view = slanted();
    vec3 mirrored = vec3_add_scaled(vec3_negate(view), 2 * vec3_dot(view, a.v.normal), a.v.normal);
    assert_close(vec3_dot(direction, mirrored), 1, 1e-12);
    settle(&a, plastic(0.5, 0, 0));
    a.v.leans = true;
    a.v.normal = (vec3){0, 0, -1};
    assert_false(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
    a.v.normal = up;
    assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_diffuse, &direction));
}

/* Mirrors that lights are sampled in do not end what the last reflection looks for; but light samples find what one of
 * them shows alone, and on the viewer's side. */
static void images(void **state) {
    (void)state;
    const struct {
        graze_lobe last;
        int mirror;
        bool noted, any, image, refracted;
    } cases[] = {
        {GRAZE_LOBE_DIFFUSE, -1, true, true, true, false},
        {GRAZE_LOBE_GLOSSY, -1, true, true, true, false},
        {GRAZE_LOBE_TRANSMITTED_DIFFUSE, -1, true, true, true, true},
        {GRAZE_LOBE_DIFFUSE, 0, true, true, true, true},
        {GRAZE_LOBE_DIFFUSE, 1, true, true, true, true},
        {GRAZE_LOBE_NONE, -1, true, true, false, false},
        {GRAZE_LOBE_MIRROR, -1, true, true, false, false},
        {GRAZE_LOBE_DIFFUSE, -1, false, true, false, false},
        {GRAZE_LOBE_DIFFUSE, -1, true, false, false, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vec3 direction;
        scene_surface surface = {.mirrors = cases[i].noted};
        arrival a = begin();
        a.scene.surfaces = &surface;
        a.scene.surface_count = 1;
        a.scene.mirror_count = cases[i].any;
        a.p.last.lobe = cases[i].last;
        a.p.last.mirror = cases[i].mirror;
        a.p.last.direct = rgb_gray(0.5);
        settle(&a, plastic(0, 0.5, 0));
        a.v.shading.specular = rgb_gray(0.5);
        a.v.surface = 0;
        assert_true(lobes_reflect(&a.p, &a.v, NULL, &only_specular, &direction));
        assert_close(direction.z, 0.8, 1e-12);
        assert_gray(a.p.throughput, 0.5);
        assert_int_equal(a.p.depth, 1);
        assert_int_equal(a.p.last.lobe, cases[i].image ? cases[i].last : GRAZE_LOBE_MIRROR);
        assert_int_equal(a.p.last.mirror, cases[i].image ? 0 : -1);
        assert_int_equal(a.p.last.refracted, cases[i].refracted);
        if (cases[i].image)
            assert_gray(a.p.last.direct, 0.25);
    }
}

/* A pane: the path is let through as if nothing were there, but for what is left of it. */
static void panes_let_through(void **state) {
    (void)state;
    vec3 direction;
    for (int scattered = 0; scattered < 2; scattered++) {
        arrival a = begin();
        a.p.throughput = rgb_gray(0.5);
        a.p.last.lobe = scattered ? GRAZE_LOBE_DIFFUSE : GRAZE_LOBE_NONE;
        a.p.last.direct = rgb_gray(0.8);
        a.p.last.indirect = rgb_gray(0.4);
        a.p.last.travelled = 3;
        a.p.known.settled = a.p.known.controls = 3;
        settle(&a, (graze_material){.kind = GRAZE_GLASS, .color = rgb_gray(0.9), .refraction = 1.52});
        a.v.shading.transmitted_specular = rgb_gray(0.5);
        gathering here = {.vertex = a.v};
        other_side beyond = {.lobes = only_specular};
        assert_true(lobes_go_on(&a.p, &here, &beyond, &direction));
        assert_close(vec3_dot(direction, slanted()), -1, 1e-12);
        assert_int_equal(a.random.group, 0);
        assert_gray(a.p.throughput, 0.25);
        assert_gray(a.p.last.direct, scattered ? 0.4 : 0.8);
        assert_gray(a.p.last.indirect, scattered ? 0.2 : 0.4);
        assert_close(a.p.last.travelled, 5, 1e-12);
        assert_true(a.p.passages == 1 && a.p.depth == 0 && a.p.known.settled == 0 && a.p.known.controls == 0);
        assert_false(a.p.last.refracted);
        /* Nor through a leaning one that leads back, or to more light than there can be. */
        here.vertex.normal = (vec3){0, 0, -1};
        assert_true(lobes_go_on(&a.p, &here, &beyond, &direction));
        here.vertex.leans = true;
        assert_false(lobes_go_on(&a.p, &here, &beyond, &direction));
        here.vertex.normal = up;
        assert_true(lobes_go_on(&a.p, &here, &beyond, &direction));
        a.p.throughput = rgb_gray(4e30);
        assert_int_equal(lobes_go_on(&a.p, &here, &beyond, &direction), scattered);
        a.p.throughput = rgb_gray(1);
        a.p.last.indirect = rgb_gray(4e30);
        assert_int_equal(lobes_go_on(&a.p, &here, &beyond, &direction), !scattered);
        beyond.lobes.specular = 0;
        assert_false(lobes_go_on(&a.p, &here, &beyond, &direction));
    }
}

/* A dielectric bends what goes through, and what is then found after a first diffuse reflection is a search. */
static void refraction(void **state) {
    (void)state;
    vec3 direction;
    for (int first = 0; first < 2; first++) {
        arrival a = begin();
        a.scene.has_refraction = true;
        a.p.scattered = true;
        a.p.last.first = first;
        settle(&a, (graze_material){
                       .kind = GRAZE_DIELECTRIC, .inside = rgb_gray(0.5), .outside = rgb_gray(1), .refraction = 1.5});
        a.v.before = rgb_gray(0.75);
        gathering here = {.vertex = a.v, .lobes = {.specular = 0.25}};
        other_side beyond = {.lobes = {.specular = 0.75}};
        int through = 0;
        const path before = a.p;
        for (uint32_t i = 0; i < 4096; i++) {
            a.p = before;
            a.random = sampler_start(sampler_key(1, 2, 3), i);
            assert_true(lobes_go_on(&a.p, &here, &beyond, &direction));
            if (direction.z > 0) {
                assert_gray(a.p.medium, 0.75);
                assert_gray(a.p.throughput, a.v.shading.specular.g / 0.25);
                assert_true(a.p.depth == 1 && a.p.passages == 0);
                continue;
            }
            through++;
            assert_gray(a.p.medium, 0.5);
            assert_gray(a.p.throughput, a.v.shading.transmitted_specular.g / 0.75);
            assert_true(a.p.last.refracted && a.p.searching == first && a.p.depth == 0 && a.p.passages == 1);
        }
        assert_int_equal(through, 3072);
    }
}

/* What is scattered on the other side is not let through. */
static void diffuse_beyond(void **state) {
    (void)state;
    vec3 direction;
    arrival a = begin();
    settle(&a, (graze_material){.kind = GRAZE_TRANS, .color = rgb_gray(0.5), .transmission = 0.5});
    gathering here = {.vertex = a.v};
    other_side beyond = {.lobes = only_diffuse};
    assert_true(lobes_go_on(&a.p, &here, &beyond, &direction));
    assert_true(direction.z < 0 && a.p.scattered && a.p.depth == 1 && a.p.ambient_depth == 1 && a.p.passages == 0);
    assert_int_equal(a.p.last.lobe, GRAZE_LOBE_TRANSMITTED_DIFFUSE);
    assert_gray(a.p.throughput, a.v.shading.transmitted_diffuse.g);
}

/* Both of what a pane shows and mirrors are put by, the path itself left as it is. */
static void branches(void **state) {
    (void)state;
    arrival a = begin();
    a.p.depth = 2;
    a.p.length = 7;
    settle(&a, (graze_material){.kind = GRAZE_GLASS, .color = rgb_gray(0.9), .refraction = 1.52});
    a.v.shading.specular = rgb_gray(0.125);
    a.v.shading.transmitted_specular = rgb_gray(0.5);
    const lobe_choice splits = {.specular_splits = true}, stays = {.specular = 1};
    path_branches found = {.count = 0};
    lobes_split(&a.p, &a.v, &splits, &splits, &found);
    assert_int_equal(found.count, 2);
    assert_int_equal(a.p.branches, 2);
    assert_gray(a.p.throughput, 1);
    assert_int_equal(a.p.depth, 2);
    const path_branch *mirrored = &found.waiting[0], *beyond = &found.waiting[1];
    assert_true(mirrored->direction.z > 0 && beyond->direction.z < 0);
    assert_gray(mirrored->throughput, 0.125);
    assert_gray(beyond->throughput, 0.5);
    assert_true(mirrored->depth == 3 && mirrored->passages == 0 && beyond->depth == 2 && beyond->passages == 1);
    assert_true(mirrored->length == 7 && mirrored->surface == -1 && !mirrored->last.vertex);
    lobes_split(&a.p, &a.v, &splits, NULL, &found);
    lobes_split(&a.p, &a.v, &stays, &stays, &found);
    assert_int_equal(found.count, 3);
    lobes_split(&a.p, &a.v, &stays, &splits, &found);
    assert_int_equal(found.count, 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_survive),
        cmocka_unit_test(passages_are_let_through),
        cmocka_unit_test(lobes_end),
        cmocka_unit_test(what_is_worth_following),
        cmocka_unit_test(lobes_share),
        cmocka_unit_test(mirrors_split_off),
        cmocka_unit_test(both_sides_share),
        cmocka_unit_test(both_sides_end),
        cmocka_unit_test(directions_are_drawn),
        cmocka_unit_test(a_mirror_draws_nothing),
        cmocka_unit_test(diffuse_reflections_are_drawn),
        cmocka_unit_test(ends_find_lights),
        cmocka_unit_test(too_much_is_no_light),
        cmocka_unit_test(some_reflections_are_searches),
        cmocka_unit_test(leaning_normals),
        cmocka_unit_test(panes_let_through),
        cmocka_unit_test(refraction),
        cmocka_unit_test(branches),
        cmocka_unit_test(diffuse_beyond),
        cmocka_unit_test(images),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
