/* The irradiance cache: the same on any number of threads, found where paths come to, and true. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/vector.h"
#include "support/scene_text.h"
#include "trace/irradiance_cache.h"
#include "trace/path.h"

/* A room of 4 x 4 x 3 with a window, a block on the floor, and a ball. */
static const char room[] = "void plastic wall 0 0 5 .7 .7 .7 0 0\n"
                           "void plastic dark 0 0 5 .2 .2 .2 0 0\n"
                           "void plastic gloss 0 0 5 .5 .5 .5 .05 .1\n"
                           "void glow sky 0 0 4 10 10 10 0\n"
                           "dark polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
                           "wall polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
                           "wall polygon south 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0\n"
                           "wall polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
                           "wall polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
                           "wall polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
                           "sky polygon window 0 0 12 .01 1 1 .01 3 1 .01 3 2.5 .01 1 2.5\n"
                           "gloss polygon top 0 0 12 2 1 .8 3 1 .8 3 2 .8 2 2 .8\n"
                           "wall polygon near 0 0 12 2 1 0 3 1 0 3 1 .8 2 1 .8\n"
                           "wall polygon side 0 0 12 2 2 0 2 1 0 2 1 .8 2 2 .8\n"
                           "gloss sphere ball 0 0 4 2.5 3 .4 .4\n";

enum { SIDE = 32, PILOTS = SIDE * SIDE };

typedef struct view {
    path_context context;
} view;

static path_hit look(void *user, size_t index) {
    const view *v = user;
    double x = ((double)(index % SIDE) + 0.5) / SIDE - 0.5, y = ((double)(index / SIDE) + 0.5) / SIDE - 0.5;
    vec3 direction = vec3_normalize((vec3){-0.3 + 1.2 * x, 1, -0.1 + 1.2 * y});
    return path_cast(&v->context, (vec3){3.5, 0.2, 1.6}, direction, GEOMETRY_FAR, -1);
}

static graze_trace_settings bounces(int count) {
    graze_trace_settings s = graze_trace_defaults();
    s.ambient_bounces = count;
    s.error = 0.05;
    return s;
}

static irradiance_cache *build(view *v, int threads) {
    irradiance_cache *cache;
    assert_int_equal(irradiance_cache_build(&cache, &v->context, look, v, PILOTS, threads, NULL), GRAZE_OK);
    return cache;
}

static irradiance_record come_to(const view *v, irradiance_pilot *first_of, size_t pixel, uint32_t number) {
    irradiance_record record = {.surface = -1};
    path_context context = v->context;
    context.record = &record;
    path_hit first = first_of((void *)v, pixel);
    sampler points = sampler_start(sampler_key(99, pixel, 0), number);
    path_sample unused;
    path_radiance(&context, &first, &points, &unused);
    return record;
}

static void threads_do_not_change_what_is_found(void **state) {
    (void)state;
    graze_trace_settings settings = bounces(3);
    graze_scene *scene = scene_from_text(room);
    view v = {{.scene = scene, .settings = &settings}};
    irradiance_cache *one = build(&v, 1), *three = build(&v, 3);
    int come = 0, found = 0;
    for (size_t pixel = 0; pixel < PILOTS; pixel++) {
        irradiance_record record = come_to(&v, look, pixel, 0);
        rgb a[IRRADIANCE_PARTS], b[IRRADIANCE_PARTS];
        if (record.surface < 0)
            continue;
        come++;
        bool in_one = irradiance_cache_find(one, &record, a), in_three = irradiance_cache_find(three, &record, b);
        assert_int_equal(in_one, in_three);
        if (in_one)
            assert_memory_equal(a, b, sizeof a);
        found += in_one;
    }
    assert_true(come > PILOTS / 2);
    /* A cache that knows nothing would pass all other tests. */
    assert_true(found > come / 2);
    irradiance_cache_destroy(one);
    irradiance_cache_destroy(three);
    graze_scene_destroy(scene);
}

/* The mean over the picture, and its error in the square, with and without the cache. */
static double mean_brightness(const view *v, const irradiance_cache *cache, int samples, double *variance,
                              double *spread) {
    path_context context = v->context;
    path_memory memory = {.alike = false};
    context.cache = cache;
    context.memory = &memory;
    double total = 0, squares = 0, told[IRRADIANCE_PARTS] = {0};
    for (size_t pixel = 0; pixel < PILOTS; pixel += 3) {
        path_hit first = look((void *)v, pixel);
        double sum = 0;
        for (int i = 0; i < samples; i++) {
            sampler points = sampler_start(sampler_key(cache ? 5 : 6, pixel * 1000 + (size_t)i, 0), 0);
            path_sample sample;
            path_radiance(&context, &first, &points, &sample);
            double found = sample.radiance.g;
            for (int k = 0; k < sample.control_count; k++)
                found += sample.controls[k].difference.g;
            sum += found;
            squares += found * found;
            for (int k = 0; k < IRRADIANCE_PARTS && sample.cached; k++)
                told[k] += sample.told[k].g;
        }
        total += sum;
        squares -= sum * sum / samples;
    }
    double count = (PILOTS + 2) / 3 * (double)samples;
    *variance = squares / count / count;
    double mean = 0, differences = 0;
    for (int k = 0; k < IRRADIANCE_PARTS; k++)
        mean += told[k] / IRRADIANCE_PARTS;
    for (int k = 0; k < IRRADIANCE_PARTS; k++)
        differences += (told[k] - mean) * (told[k] - mean);
    *spread = sqrt(differences / IRRADIANCE_PARTS / (IRRADIANCE_PARTS - 1)) / count;
    return total / count;
}

static void the_cache_is_true(void **state) {
    (void)state;
    graze_trace_settings settings = bounces(3);
    graze_scene *scene = scene_from_text(room);
    view v = {{.scene = scene, .settings = &settings}};
    irradiance_cache *cache = build(&v, 2);
    double variance[2], spread[2];
    double with = mean_brightness(&v, cache, 300, &variance[0], &spread[0]);
    double without = mean_brightness(&v, NULL, 300, &variance[1], &spread[1]);
    double error = sqrt(variance[0] + variance[1] + spread[0] * spread[0]);
    assert_true(spread[1] == 0);
    assert_true(spread[0] != 0 && spread[0] < 0.005 * with);
    /* Cells may be wrong by their size: by 0.2% of the value. */
    if (fabs(with - without) > 3 * error + 0.002 * without)
        fail_msg("%g with the cache, %g without, error %g", with, without, error);
    irradiance_cache_destroy(cache);
    graze_scene_destroy(scene);
}

static void there_is_none_where_it_is_of_no_use(void **state) {
    (void)state;
    graze_trace_settings settings = bounces(1);
    graze_scene *scene = scene_from_text(room);
    view v = {{.scene = scene, .settings = &settings}};
    assert_null(build(&v, 1));
    settings = bounces(3);
    settings.strategy = GRAZE_STRATEGY_BRDF;
    assert_null(build(&v, 1));
    settings = bounces(3);
    settings.reflection_limit = 5;
    assert_null(build(&v, 1));
    graze_scene_destroy(scene);
}

/* Points beside each other share a cell, those on the other side of a wall or far away do not, and places where cells
 * are too small to be numbered are in none. */
static void cells_are_where_paths_have_been(void **state) {
    (void)state;
    graze_trace_settings settings = bounces(3);
    graze_scene *scene = scene_from_text(room);
    view v = {{.scene = scene, .settings = &settings}};
    irradiance_cache *cache = build(&v, 2);
    rgb found[IRRADIANCE_PARTS];
    irradiance_record on_floor = {{1.5, 2.5, 0}, {0, 0, 1}, 0, 3};
    assert_true(irradiance_cache_find(cache, &on_floor, found));
    irradiance_record below = on_floor, far = on_floor, close = on_floor;
    below.normal.z = -1;
    assert_false(irradiance_cache_find(cache, &below, found));
    far.point = (vec3){1e300, 0, 0};
    assert_false(irradiance_cache_find(cache, &far, found));
    close.distance = 1e-300;
    assert_false(irradiance_cache_find(cache, &close, found));
    irradiance_cache_destroy(cache);
    graze_scene_destroy(scene);
}

/* The shell of two rooms on one floor, each 4 by 4 m. */
#define SHELL                                                                                                          \
    "void plastic white 0 0 5 .7 .7 .7 0 0\n"                                                                          \
    "white polygon floor 0 0 12 0 0 0 8.1 0 0 8.1 4 0 0 4 0\n"                                                         \
    "white polygon top 0 0 12 0 0 3 0 4 3 8.1 4 3 8.1 0 3\n"                                                           \
    "white polygon south 0 0 12 0 0 0 0 0 3 8.1 0 3 8.1 0 0\n"                                                         \
    "white polygon north 0 0 12 0 4 0 8.1 4 0 8.1 4 3 0 4 3\n"                                                         \
    "white polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"                                                              \
    "white polygon east 0 0 12 8.1 0 0 8.1 0 3 8.1 4 3 8.1 4 0\n"

/* A wall between them 10 cm thick, one twenty times as bright as the other. */
static const char rooms[] = SHELL "void light lamp 0 0 3 100 100 100\n"
                                  "void light faint 0 0 3 5 5 5\n"
                                  "white polygon near 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
                                  "white polygon far 0 0 12 4.1 0 0 4.1 4 0 4.1 4 3 4.1 0 3\n"
                                  "lamp polygon la 0 0 12 1.5 1.5 2.99 1.5 2.5 2.99 2.5 2.5 2.99 2.5 1.5 2.99\n"
                                  "faint polygon lb 0 0 12 5.5 1.5 2.99 5.5 2.5 2.99 6.5 2.5 2.99 6.5 1.5 2.99\n";

static path_hit look_down(void *user, size_t index) {
    const view *v = user;
    double x = ((double)(index % SIDE) + 0.5) / SIDE, y = ((double)(index / SIDE) + 0.5) / SIDE;
    return path_cast(&v->context, (vec3){8.1 * x, 4 * y, 2.5}, (vec3){0, 0, -1}, GEOMETRY_FAR, -1);
}

static double mean_of(const rgb parts[IRRADIANCE_PARTS]) {
    double sum = 0;
    for (int i = 0; i < IRRADIANCE_PARTS; i++)
        sum += parts[i].g;
    return sum / IRRADIANCE_PARTS;
}

static void walls_divide_cells(void **state) {
    (void)state;
    graze_trace_settings settings = bounces(3);
    graze_scene *scene = scene_from_text(rooms);
    int found_bright = 0, found_dim = 0;
    for (settings.seed = 0; settings.seed < 8; settings.seed++) {
        view v = {{.scene = scene, .settings = &settings}};
        irradiance_cache *cache;
        assert_int_equal(irradiance_cache_build(&cache, &v.context, look_down, &v, PILOTS, 2, NULL), GRAZE_OK);
        for (int i = 0; i < 30; i++) {
            rgb bright[IRRADIANCE_PARTS], dim[IRRADIANCE_PARTS];
            irradiance_record a = {{3.95 - 0.02 * i, 2, 3}, {0, 0, -1}, 1, 3};
            irradiance_record b = {{4.15 + 0.02 * i, 2, 3}, {0, 0, -1}, 1, 3};
            found_dim += irradiance_cache_find(cache, &b, dim);
            if (irradiance_cache_find(cache, &b, dim) && irradiance_cache_find(cache, &a, bright)) {
                found_bright++;
                assert_true(mean_of(dim) < 0.15 * mean_of(bright));
            }
        }
        irradiance_cache_destroy(cache);
    }
    assert_true(found_bright > 20 && found_dim > 20);
    graze_scene_destroy(scene);
}

/* A dark room beside a lit one: light comes through a hole in the wall, 40 by 80 cm. */
static const char dark_room[] =
    SHELL "void light lamp 0 0 3 300 300 300\n"
          "white polygon wall 0 0 30 4 0 0 4 0 3 4 4 3 4 4 0 4 2.2 0 4 2.2 1.8 4 1.8 1.8 4 1.8 1 4 2.2 1 4 2.2 0\n"
          "lamp polygon la 0 0 12 1.5 1.5 2.99 1.5 2.5 2.99 2.5 2.5 2.99 2.5 1.5 2.99\n";

static path_hit look_aside(void *user, size_t index) {
    const view *v = user;
    double x = ((double)(index % SIDE) + 0.5) / SIDE - 0.5, y = ((double)(index / SIDE) + 0.5) / SIDE - 0.5;
    vec3 direction = vec3_normalize((vec3){0.7 + 1.2 * x, 0.7 - 1.2 * x, -0.1 + 1.7 * y});
    return path_cast(&v->context, (vec3){4.4, 0.3, 1.6}, direction, GEOMETRY_FAR, -1);
}

/* Irradiance at a point, by this many paths. */
static double irradiance_by_paths(const view *v, const irradiance_record *record, uint64_t key, uint32_t count) {
    path_memory memory = {.alike = false};
    path_context context = v->context;
    context.memory = &memory;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        sampler points = sampler_start(key, i);
        path_sample sample;
        path_irradiance_at(&context, record, &points, &sample);
        sum += sample.radiance.g;
        for (int k = 0; k < sample.control_count; k++)
            sum += sample.controls[k].difference.g;
    }
    return sum / count;
}

/* A point that paths come to, and what it gets: by two answers, one of which tells whether it is dark. */
typedef struct known_point {
    irradiance_record record;
    double value, other;
} known_point;

static size_t find_points(const view *v, known_point points[PILOTS]) {
    size_t count = 0;
    for (size_t pixel = 0; pixel < PILOTS; pixel++) {
        irradiance_record record = come_to(v, look_aside, pixel, 0);
        if (record.surface >= 0)
            points[count++] = (known_point){record, irradiance_by_paths(v, &record, sampler_key(7, pixel, 0), 256),
                                            irradiance_by_paths(v, &record, sampler_key(8, pixel, 0), 256)};
    }
    return count;
}

/* Cells whose means stood for all of each made dark places 4 % too bright here. A cache's noise in their mean is about
 * 0.3 %. */
static void what_is_dark_stays_dark(void **state) {
    (void)state;
    static known_point points[PILOTS];
    graze_trace_settings settings = bounces(3);
    settings.floor = 0.001;
    graze_scene *scene = scene_from_text(dark_room);
    view v = {{.scene = scene, .settings = &settings}};
    size_t count = find_points(&v, points), dark = 0;
    double told = 0, true_sum = 0;
    for (settings.seed = 0; settings.seed < 4; settings.seed++) {
        irradiance_cache *cache;
        assert_int_equal(irradiance_cache_build(&cache, &v.context, look_aside, &v, PILOTS, 2, NULL), GRAZE_OK);
        for (size_t i = 0; i < count; i++) {
            rgb found[IRRADIANCE_PARTS];
            if (points[i].other > 0.3 || !irradiance_cache_find(cache, &points[i].record, found))
                continue;
            dark++;
            told += mean_of(found);
            true_sum += points[i].value;
        }
        irradiance_cache_destroy(cache);
    }
    assert_true(dark > count);
    assert_true(fabs(told / true_sum - 1) < 0.02);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_change_what_is_found),
        cmocka_unit_test(the_cache_is_true),
        cmocka_unit_test(there_is_none_where_it_is_of_no_use),
        cmocka_unit_test(cells_are_where_paths_have_been),
        cmocka_unit_test(walls_divide_cells),
        cmocka_unit_test(what_is_dark_stays_dark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
