/* Paths that share a memory, since all begin at one point, find to the bit what each finds with a memory of its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/scene_text.h"
#include "trace/path.h"
#include "trace/random_scene.h"

enum { SCENES = 300, PATHS = 16 };

static path_sample take(path_context context, path_memory *memory, const path_hit *first, uint32_t index) {
    sampler points = sampler_start(sampler_key(1, 2, 3), index);
    context.memory = memory;
    path_sample sample;
    path_radiance(&context, first, &points, &sample);
    return sample;
}

static bool same_rgb(rgb a, rgb b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

static bool same_sample(const path_sample *a, const path_sample *b) {
    bool same = same_rgb(a->radiance, b->radiance) && same_rgb(a->indirect, b->indirect) &&
                same_rgb(a->albedo, b->albedo) && a->noisy == b->noisy && a->searching == b->searching &&
                a->integrated == b->integrated && a->control_count == b->control_count;
    for (int i = 0; same && i < a->control_count; i++)
        same = same_rgb(a->controls[i].difference, b->controls[i].difference) &&
               a->controls[i].lit == b->controls[i].lit && a->controls[i].whole == b->controls[i].whole;
    return same;
}

/* Returns how many of the ray's paths found light in random ways. */
static int compare_paths(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray) {
    path_context context = {.scene = scene, .settings = settings};
    path_hit first = path_cast(&context, ray->origin, vec3_normalize(ray->direction), GEOMETRY_FAR, -1);
    path_memory shared = {.alike = true};
    int noisy = 0;
    for (uint32_t i = 0; i < PATHS; i++) {
        path_memory own = {.alike = true};
        path_sample a = take(context, &shared, &first, i), b = take(context, &own, &first, i);
        assert_true(same_sample(&a, &b));
        noisy += a.noisy && !rgb_is_black(a.radiance);
    }
    return noisy;
}

static void shared_is_own(void **state) {
    (void)state;
    int noisy = 0;
    static random_scene s;
    for (uint64_t number = 0; number < SCENES; number++) {
        random_scene_make(&s, number, unplaced);
        graze_scene *scene = scene_from_text(s.text);
        assert_non_null(scene);
        s.settings.quantity = GRAZE_RADIANCE;
        s.settings.samples = 0;
        for (int ray = 0; ray < RANDOM_RAYS; ray++)
            noisy += compare_paths(scene, &s.settings, &s.rays[ray]);
        graze_scene_destroy(scene);
    }
    assert_true(noisy > SCENES * PATHS / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shared_is_own)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
