/* A scene that is turned, mirrored, moved and scaled answers as it did. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/scene_text.h"
#include "trace/random_scene.h"

enum { SCENES = 300, CASTS = 40 };

static graze_scene *load(const random_scene *s) {
    const graze_model_choice choice = {NULL, s->model};
    graze_scene *scene = scene_from_text_with(s->text, &(graze_scene_settings){.models = &choice, .model_count = 1});
    if (!scene)
        fail_msg("%s\n%s", messages, s->text);
    return scene;
}

/* The same scene in two places. */
typedef struct twins {
    random_scene here, there;
    graze_scene *scene_here, *scene_there;
} twins;

static void make_twins(twins *t, uint64_t number) {
    dice d = {number * 131 + 7};
    (void)roll(&d);
    random_scene_make(&t->here, number, unplaced);
    random_scene_make(&t->there, number, random_placement(&d));
    t->scene_here = load(&t->here);
    t->scene_there = load(&t->there);
}

static void destroy_twins(twins *t) {
    graze_scene_destroy(t->scene_here);
    graze_scene_destroy(t->scene_there);
}

/* Coordinates are rounded in proportion to what they are, and that counts the more the more oblique a surface is met
 * and the smaller it is. */
static bool is_same_hit(const graze_hit *here, const graze_hit *there, const placement *p, vec3 direction) {
    if (!here->surface || !there->surface)
        return here->surface == there->surface;
    if (here->distance >= GRAZE_FAR || there->distance >= GRAZE_FAR)
        return here->distance == there->distance && strcmp(here->surface, there->surface) == 0;
    double away = 1e-15 * (vec3_max_abs(p->at) / p->scale + 30);
    double cosine = fabs(vec3_dot(here->normal, direction));
    vec3 normal = place_vector(p, here->normal);
    return strcmp(here->surface, there->surface) == 0 &&
           fabs(there->distance / p->scale - here->distance) <= 1e-9 * here->distance + 100 * away / cosine &&
           vec3_length(vec3_subtract(normal, there->normal)) <= 1e-4;
}

static void rays_meet_the_same(void **state) {
    (void)state;
    static twins t;
    int different = 0, hits = 0;
    for (uint64_t number = 0; number < SCENES; number++) {
        make_twins(&t, number);
        dice d = {number * 17 + 3};
        (void)roll(&d);
        graze_trace_settings s = graze_trace_defaults();
        for (int i = 0; i < CASTS; i++) {
            vec3 origin = roll_in_box(&d, vec3_make(-1.5, -1.5, 0.1), vec3_make(1.5, 1.5, 1.9));
            vec3 direction = roll_direction(&d);
            graze_ray here = {.origin = origin, .direction = direction};
            graze_ray there = {.origin = place_point(&t.there.placement, origin),
                               .direction = place_vector(&t.there.placement, direction)};
            graze_hit hit_here, hit_there;
            graze_cast(t.scene_here, &s, &here, &hit_here);
            graze_cast(t.scene_there, &s, &there, &hit_there);
            hits += hit_here.surface != NULL;
            if (!is_same_hit(&hit_here, &hit_there, &t.there.placement, direction)) {
                different++;
                fprintf(stderr, "# scene %d, ray %d: %s at %.17g, but %s at %.17g\n", (int)number, i,
                        hit_here.surface ? hit_here.surface : "nothing", hit_here.distance,
                        hit_there.surface ? hit_there.surface : "nothing",
                        hit_there.distance / t.there.placement.scale);
            }
        }
        destroy_twins(&t);
    }
    assert_int_equal(different, 0);
    assert_true(hits > SCENES * CASTS / 2);
}

static graze_answer ask(const random_scene *s, const graze_scene *scene, int ray, uint32_t samples, uint64_t stream) {
    graze_trace_settings settings = s->settings;
    settings.samples = samples;
    graze_answer a;
    graze_trace(scene, &settings, &s->rays[ray], stream, &a, NULL);
    return a;
}

/* Answers without an error but that of integrals agree to 1e-9, others within their errors. */
static void light_is_the_same(void **state) {
    (void)state;
    static twins t;
    int exact = 0, sampled = 0;
    for (uint64_t number = 0; number < SCENES; number++) {
        make_twins(&t, number);
        for (int ray = 0; ray < RANDOM_RAYS; ray++)
            for (uint32_t samples = 128;; samples <<= 5) {
                graze_answer here = ask(&t.here, t.scene_here, ray, samples, number);
                graze_answer there = ask(&t.there, t.scene_there, ray, samples, number + SCENES);
                double value = fmax(here.value.g, there.value.g), apart = fabs(here.value.g - there.value.g);
                double error = hypot(here.standard_error.g, there.standard_error.g);
                bool closed = error <= 2e-8 * value;
                exact += closed && value > 0;
                sampled += !closed;
                if (apart <= (closed ? 1e-9 * value : 4 * error))
                    break;
                /* What few samples have overlooked, more find. */
                if (samples > 1 << 16)
                    fail_msg("scene %d, ray %d: %.12g +- %g, but there %.12g +- %g", (int)number, ray, here.value.g,
                             here.standard_error.g, there.value.g, there.standard_error.g);
            }
        destroy_twins(&t);
    }
    assert_true(exact > SCENES / 20 && sampled > SCENES / 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_the_same),
        cmocka_unit_test(light_is_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
