/* Standard errors are true: over thousands of rays whose answers are known, stopped at several errors, the interval of
 * 1.96 standard errors to each side holds the truth 19 times of 20, and the mean is right. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/brdf.h"
#include "graze/trace.h"
#include "support/scene_text.h"
#include "trace/sampler.h"

/* A ray, or a sensor, and what it must answer. */
typedef struct question {
    graze_ray ray;
    double truth;
} question;

/* Draws one of a family of questions from three random numbers. */
typedef question draw_question(const double random[3]);

typedef struct family {
    const char *name, *text;
    draw_question *draw;
    graze_quantity quantity;
    graze_strategy strategy;
    int bounces;
} family;

/* A grey ball of radius 5 whose cap above z = 3 is cut off by a lamp. All points of the ball see the disk as the cap
 * behind it, under the form factor of its area: 1/5. So all are lit alike, and all light up each other alike. */
#define BALL "void plastic g 0 0 5 .7 .7 .7 0 0 g bubble room 0 0 4 0 0 0 5\n"
static const char *const lamp_in_ball = BALL "void light l 0 0 3 1 1 1 l ring lamp 0 0 8 0 0 3 0 0 -1 0 4\n";

static const char *const small_lamp_in_ball = BALL "void light l 0 0 3 1 1 1 l sphere lamp 0 0 4 0 0 0 1\n";

static double sum_of_bounces(double form_factor) {
    double albedo = 0.7, sum = 0;
    for (int bounce = 4; bounce >= 0; bounce--)
        sum = albedo * (form_factor + (1 - form_factor) * sum);
    return sum;
}

static graze_ray ray_to(vec3 from, vec3 to) {
    return (graze_ray){.origin = from, .direction = vec3_add_scaled(to, -1, from)};
}

/* The wall's points from z = -4.9 up to `top`. */
static vec3 point_on_ball(const double random[2], double top) {
    double z = -4.9 + (top + 4.9) * random[0], angle = 2 * PI * random[1], radius = sqrt(25 - z * z);
    return (vec3){radius * cos(angle), radius * sin(angle), z};
}

static question wall_below_the_lamp(const double random[3]) {
    return (question){ray_to((vec3){0.1, 0.2, 0}, point_on_ball(random, 2.5)), sum_of_bounces(0.2)};
}

/* With the lamp in the middle, 1/25 of what a wall's point sees is lamp. */
static question wall_around_the_lamp(const double random[3]) {
    vec3 point = point_on_ball(random, 4.9);
    return (question){ray_to(vec3_scale(0.5, point), point), sum_of_bounces(0.04)};
}

/* A lamp whose half a blind hides, with an edge that is oblique to those of the lamp. */
#define BLIND "void plastic k 0 0 5 0 0 0 0 0 k polygon blind 0 0 12 -2 -9 1 9 -9 1 9 9 1 2 9 1\n"
static const char *const half_hidden_lamp =
    "void light l 0 0 3 1 1 1 l polygon lamp 0 0 12 -1 -.5 2 -1 .5 2 1 .5 2 1 -.5 2\n" BLIND;

/* A glow that is like a light as far as it reaches. */
static const char *const half_hidden_glow =
    "void glow l 0 0 4 1 1 1 50 l polygon lamp 0 0 12 -1 -.5 2 -1 .5 2 1 .5 2 1 -.5 2\n" BLIND;

/* What of a polygon lies on the side of a plane through the origin that its normal points to. */
static int clip(const vec3 *in, int count, vec3 normal, vec3 *out) {
    int kept = 0;
    for (int i = 0; i < count; i++) {
        vec3 a = in[i], b = in[(i + 1) % count];
        double at_a = vec3_dot(a, normal), at_b = vec3_dot(b, normal);
        if (at_a >= 0)
            out[kept++] = a;
        if ((at_a >= 0) != (at_b >= 0))
            out[kept++] = vec3_add_scaled(a, at_a / (at_a - at_b), vec3_add_scaled(b, -1, a));
    }
    return kept;
}

/* Lambert's formula for the irradiance that a polygon of radiance 1 throws on the origin, facing up. */
static double polygon_irradiance(const vec3 *corner, int count) {
    double sum = 0;
    for (int i = 0; i < count; i++) {
        vec3 a = vec3_safe_normalize(corner[i]), b = vec3_safe_normalize(corner[(i + 1) % count]);
        vec3 across = vec3_cross(a, b);
        sum += atan2(vec3_length(across), vec3_dot(a, b)) * across.z / vec3_length(across);
    }
    return fabs(sum) / 2;
}

static question sensor_at(vec3 point) {
    /* Sensors stand 0.0001 above their point. */
    vec3 eye = {point.x, point.y, 1e-4};
    const vec3 lamp[4] = {{-1, -0.5, 2}, {-1, 0.5, 2}, {1, 0.5, 2}, {1, -0.5, 2}};
    vec3 seen[4], visible[8];
    for (int i = 0; i < 4; i++)
        seen[i] = vec3_add_scaled(lamp[i], -1, eye);
    vec3 first = vec3_add_scaled((vec3){-2, -9, 1}, -1, eye), second = vec3_add_scaled((vec3){2, 9, 1}, -1, eye);
    int count = clip(seen, 4, vec3_cross(first, second), visible);
    return (question){{.origin = point, .direction = {0, 0, 1}}, polygon_irradiance(visible, count)};
}

static question sensor_in_penumbra(const double random[3]) {
    return sensor_at((vec3){-0.6 + 1.2 * random[0], -0.5 + random[1], 0});
}

/* Some samples in a hundred meet the shadow, or none does. */
static question sensor_at_edge(const double random[3]) {
    return sensor_at((vec3){-1.2 + 0.4 * random[0], -0.3 + 0.6 * random[1], 0});
}

/* A floor with a rough lobe, under a sky that shines everywhere: its albedo. */
static const char *const glossy_floor = "void metal2 m 4 1 0 0 . 0 6 .5 .5 .5 .6 .1 .3\n"
                                        "m polygon floor 0 0 12 -50 -50 0 50 -50 0 50 50 0 -50 50 0\n"
                                        "void glow s 0 0 4 1 1 1 0 s source sky 0 0 4 0 0 1 360\n";
/* The same where the sky is dark in the half that the ray comes from. */
static const char *const glossy_floor_by_half = "void metal2 m 4 1 0 0 . 0 6 .5 .5 .5 1 .1 .3\n"
                                                "m polygon floor 0 0 12 -50 -50 0 50 -50 0 50 50 0 -50 50 0\n"
                                                "void glow s 0 0 4 1 1 1 0 s source sky 0 0 4 1 0 0 180\n";

static const graze_brdf floor_lobe = {.model = GRAZE_BRDF_GMD, .alpha_x = 0.1, .alpha_y = 0.3};

static graze_ray ray_down_at(double degrees) {
    double elevation = angle_radians(degrees);
    return (graze_ray){.origin = {-10, 0, 10 * tan(elevation)}, .direction = {10, 0, -10 * tan(elevation)}};
}

static vec3 view_of(const graze_ray *ray) {
    return vec3_negate(vec3_safe_normalize(ray->direction));
}

static question glossy_under_sky(const double random[3]) {
    graze_ray ray = ray_down_at(10 + 70 * random[0]);
    return (question){ray, 0.5 * 0.4 + 0.5 * 0.6 * graze_brdf_albedo(&floor_lobe, view_of(&ray))};
}

/* The midpoint rule over the half disk that the sky at x > 0 projects to. */
static double albedo_over_half(vec3 view) {
    enum { STEPS = 300 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            double radius = (i + 0.5) / STEPS, angle = PI * ((j + 0.5) / STEPS - 0.5);
            vec3 light = {radius * cos(angle), radius * sin(angle), sqrt(1 - radius * radius)};
            sum += graze_brdf_value(&floor_lobe, light, view) * radius;
        }
    return sum * PI / STEPS / STEPS;
}

/* Steep rays: their lobes, and the samples of them, are cut by the border of the sky. */
static question glossy_under_half(const double random[3]) {
    graze_ray ray = ray_down_at(60 + 25 * random[0]);
    return (question){ray, 0.5 * albedo_over_half(view_of(&ray))};
}

static const family families[] = {
    {"lamp in a grey ball", lamp_in_ball, wall_below_the_lamp, GRAZE_RADIANCE, GRAZE_STRATEGY_MIS, 4},
    {"small lamp in a grey ball", small_lamp_in_ball, wall_around_the_lamp, GRAZE_RADIANCE, GRAZE_STRATEGY_MIS, 4},
    {"penumbra", half_hidden_lamp, sensor_in_penumbra, GRAZE_IRRADIANCE, GRAZE_STRATEGY_MIS, 0},
    {"penumbra of a glow", half_hidden_glow, sensor_in_penumbra, GRAZE_IRRADIANCE, GRAZE_STRATEGY_MIS, 0},
    {"edge of a glow's penumbra", half_hidden_glow, sensor_at_edge, GRAZE_IRRADIANCE, GRAZE_STRATEGY_MIS, 0},
    {"penumbra by light samples", half_hidden_lamp, sensor_in_penumbra, GRAZE_IRRADIANCE, GRAZE_STRATEGY_LIGHT, 0},
    {"penumbra by reflection", half_hidden_lamp, sensor_in_penumbra, GRAZE_IRRADIANCE, GRAZE_STRATEGY_BRDF, 0},
    {"glossy floor", glossy_floor, glossy_under_sky, GRAZE_RADIANCE, GRAZE_STRATEGY_MIS, 1},
    {"glossy floor by light samples", glossy_floor, glossy_under_sky, GRAZE_RADIANCE, GRAZE_STRATEGY_LIGHT, 1},
    {"glossy floor by reflection", glossy_floor, glossy_under_sky, GRAZE_RADIANCE, GRAZE_STRATEGY_BRDF, 1},
    {"half a sky", glossy_floor_by_half, glossy_under_half, GRAZE_RADIANCE, GRAZE_STRATEGY_MIS, 0},
    {"half a sky by reflection", glossy_floor_by_half, glossy_under_half, GRAZE_RADIANCE, GRAZE_STRATEGY_BRDF, 0},
};
static const double errors[] = {0.1, 0.05, 0.02, 0.01, 0.005};
enum { FAMILIES = sizeof families / sizeof *families, ERRORS = sizeof errors / sizeof *errors, RAYS = 100 };

typedef struct tally {
    int rays, covered;
    double sum, squares; /* of the answers' relative errors */
} tally;

static void count(tally *t, const graze_answer *answer, double truth) {
    double error = (answer->value.g - truth) / truth, claimed = answer->standard_error.g / truth;
    t->rays++;
    t->covered += fabs(error) <= 1.96 * claimed + 1e-6;
    t->sum += error;
    t->squares += error * error;
}

static void add(tally *sum, const tally *t) {
    sum->rays += t->rays;
    sum->covered += t->covered;
}

static void trace_family(const family *f, tally tallies[ERRORS]) {
    graze_scene *scene = load_scene(f->text);
    graze_trace_settings s = graze_trace_defaults();
    s.quantity = f->quantity;
    s.strategy = f->strategy;
    s.ambient_bounces = f->bounces;
    uint64_t key = sampler_key(2026, 0, 0);
    for (uint32_t i = 0; i < RAYS; i++) {
        double random[3];
        sampler points = sampler_start(key, i);
        sampler_3d(&points, random);
        question q = f->draw(random);
        for (int e = 0; e < ERRORS; e++) {
            graze_answer answer;
            s.error = errors[e];
            s.seed = (uint64_t)e;
            graze_trace(scene, &s, &q.ray, i, &answer, NULL);
            count(&tallies[e], &answer, q.truth);
        }
    }
    graze_scene_destroy(scene);
}

static void assert_covered(const char *what, const tally *t, double least, double most) {
    double share = (double)t->covered / t->rays;
    printf("# %s: %.1f%% of %d covered\n", what, 100 * share, t->rays);
    if (share < least || share > most)
        fail_msg("%s: %.1f%% of %d covered", what, 100 * share, t->rays);
}

static void intervals_cover_the_truth(void **state) {
    (void)state;
    tally all = {0}, by_error[ERRORS] = {{0}};
    for (int i = 0; i < FAMILIES; i++) {
        tally tallies[ERRORS] = {{0}}, of_family = {0};
        trace_family(&families[i], tallies);
        for (int e = 0; e < ERRORS; e++) {
            const tally *t = &tallies[e];
            add(&of_family, t);
            add(&by_error[e], t);
            double mean = t->sum / t->rays, scatter = sqrt(t->squares / t->rays - mean * mean);
            if (fabs(mean) > 3 * scatter / sqrt(t->rays) + 1e-6)
                fail_msg("%s, --error %g: %g too large, +- %g", families[i].name, errors[e], mean,
                         scatter / sqrt(t->rays));
        }
        add(&all, &of_family);
        assert_covered(families[i].name, &of_family, 0.9, 1);
    }
    for (int e = 0; e < ERRORS; e++) {
        char name[32];
        snprintf(name, sizeof name, "--error %g", errors[e]);
        assert_covered(name, &by_error[e], 0.93, 0.98);
    }
    assert_covered("all", &all, 0.94, 0.97);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(intervals_cover_the_truth)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
