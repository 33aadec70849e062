/* Radiance and irradiance where the answer is known in closed form. */
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
#include "support/close.h"
#include "support/scene_text.h"

#define FLOOR  "m polygon floor 0 0 12 -50 -50 0 50 -50 0 50 50 0 -50 50 0\n"
#define SKY(r) "void glow sky_glow 0 0 4 " #r " " #r " " #r " 0 sky_glow source sky 0 0 4 0 0 1 360\n"

static graze_answer ask_of_model(const char *text, graze_brdf_model model, graze_trace_settings settings,
                                 graze_ray ray) {
    const graze_model_choice choice = {NULL, model};
    graze_scene *scene = scene_from_text_with(text, &(graze_scene_settings){.models = &choice, .model_count = 1});
    if (!scene)
        fail_msg("%s", messages);
    graze_answer answer;
    graze_trace(scene, &settings, &ray, 7, &answer, NULL);
    graze_scene_destroy(scene);
    return answer;
}

static graze_answer ask(const char *text, graze_trace_settings settings, graze_ray ray) {
    return ask_of_model(text, GRAZE_BRDF_GMD, settings, ray);
}

/* The answer must lie within four standard errors, and the error be what was asked for or not twice as much: that is
 * decided by samples other than those whose error it is. */
static void assert_answer(graze_answer answer, double truth, double relative_error) {
    assert_true(answer.converged);
    if (answer.standard_error.g > 2 * relative_error * answer.value.g)
        fail_msg("error %g of %g is above %g", answer.standard_error.g, answer.value.g, relative_error);
    if (fabs(answer.value.g - truth) > 4 * answer.standard_error.g + 1e-9 * truth)
        fail_msg("%.9g +- %.3g, but the truth is %.9g", answer.value.g, answer.standard_error.g, truth);
}

static graze_trace_settings settings_for(graze_strategy strategy, int bounces) {
    graze_trace_settings s = graze_trace_defaults();
    s.strategy = strategy;
    s.ambient_bounces = bounces;
    s.error = 0.002;
    s.sample_limit = 1u << 18;
    return s;
}

static const graze_ray down = {.origin = {0.3, 0.2, 5}, .direction = {0, 0, -1}};
static const graze_ray sensor = {.origin = {0, 0, 0}, .direction = {0, 0, 1}};

static void furnace_of_a_diffuse_floor(void **state) {
    (void)state;
    for (int strategy = 0; strategy < 3; strategy++)
        assert_answer(
            ask("void plastic m 0 0 5 .5 .5 .5 0 0\n" FLOOR SKY(2), settings_for((graze_strategy)strategy, 1), down),
            1.0, 0.002);
}

static void furnace_of_a_glossy_floor(void **state) {
    (void)state;
    graze_ray slanted = {.origin = {-10, 0, 10 * tan(angle_radians(20))},
                         .direction = {10, 0, -10 * tan(angle_radians(20))}};
    graze_brdf lobe = {.alpha_x = 0.1, .alpha_y = 0.3};
    double elevation = angle_radians(20);
    vec3 view = {-cos(elevation), 0, sin(elevation)};
    for (int model = 0; model < 4; model++) {
        lobe.model = (graze_brdf_model)model;
        double truth = 0.5 * 0.4 + 0.5 * 0.6 * graze_brdf_albedo(&lobe, view);
        for (int strategy = 0; strategy < 3; strategy++) {
            graze_trace_settings s = settings_for((graze_strategy)strategy, 1);
            /* The weights of this model's reflections have no bound (Eq. 8). The few that are huge must have been met
             * often before the error is known. */
            if (model == GRAZE_BRDF_WARD_DUER && strategy == GRAZE_STRATEGY_BRDF)
                s.samples = s.sample_limit;
            assert_answer(
                ask_of_model("void metal2 m 4 1 0 0 . 0 6 .5 .5 .5 .6 .1 .3\n" FLOOR SKY(1), lobe.model, s, slanted),
                truth, 0.002);
        }
    }
}

/* Without its weights, sampling reflects all that arrives, at grazing angles too, whatever the model. */
static void furnace_without_weights(void **state) {
    (void)state;
    graze_ray grazing = {.origin = {-10, 0, 0.3}, .direction = {10, 0, -0.3}};
    for (int model = 0; model < 4; model++)
        assert_answer(ask_of_model("void metal2 m 4 1 0 0 . 0 6 .5 .5 .5 .6 .1 .3\n" FLOOR SKY(1),
                                   (graze_brdf_model)model, settings_for(GRAZE_STRATEGY_UNWEIGHTED, 1), grazing),
                      0.5, 0.002);
}

/* Each ambient bounce multiplies by the reflectance, the ambient value stands at the end: no randomness is left. */
static void closed_box_with_ambient_value(void **state) {
    (void)state;
    const char *box = "void plastic m 0 0 5 .5 .5 .5 0 0 m bubble room 0 0 4 0 0 0 3\n";
    graze_trace_settings s = settings_for(GRAZE_STRATEGY_MIS, 3);
    s.ambient_value = (graze_rgb){16, 16, 16};
    graze_ray ray = {.origin = {0, 0, 1}, .direction = {0, 0.3, -1}};
    graze_answer answer = ask(box, s, ray);
    assert_close(answer.value.g, 1.0, 1e-12);
}

static double rectangle_irradiance(double half_width, double half_depth, double height) {
    double x = half_width / height, y = half_depth / height;
    double corner = x / sqrt(1 + x * x) * atan(y / sqrt(1 + x * x)) + y / sqrt(1 + y * y) * atan(x / sqrt(1 + y * y));
    return 4 * corner / 2; /* radiance 1; four quarters of pi x form factor */
}

static void irradiance_of_a_rectangle(void **state) {
    (void)state;
    const char *text = "void light l 0 0 3 1 1 1 l polygon lamp 0 0 12 -1 -.5 2 -1 .5 2 1 .5 2 1 -.5 2\n";
    for (int strategy = 0; strategy < 3; strategy++) {
        graze_trace_settings s = settings_for((graze_strategy)strategy, 0);
        s.quantity = GRAZE_IRRADIANCE;
        /* Sensors stand 0.0001 above their point. */
        assert_answer(ask(text, s, sensor), rectangle_irradiance(1, 0.5, 2 - 1e-4), 0.002);
    }
}

static void irradiance_of_a_sphere_a_ring_and_the_sun(void **state) {
    (void)state;
    double half = angle_radians(0.533 / 2), height = 4 - 1e-4;
    const struct {
        const char *text;
        double truth;
    } lights[] = {
        {"void light l 0 0 3 3 3 3 l sphere lamp 0 0 4 0 0 4 .5\n", 3 * PI * 0.25 / (height * height)},
        {"void light l 0 0 3 3 3 3 l ring lamp 0 0 8 0 0 4 0 0 -1 0 .5\n", 3 * PI * 0.25 / (height * height + 0.25)},
        {"void light l 0 0 3 1e6 1e6 1e6 l source sun 0 0 4 .6 0 .8 .533\n", 1e6 * PI * sin(half) * sin(half) * 0.8},
    };
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++)
        for (int strategy = 0; strategy < 2; strategy++) {
            graze_trace_settings s = settings_for((graze_strategy)strategy, 0);
            s.quantity = GRAZE_IRRADIANCE;
            assert_answer(ask(lights[i].text, s, sensor), lights[i].truth, 0.002);
        }
}

/* As in Radiance, each of several suns lights, the first is seen, and what a glow has behind a sun does not count. */
static void sources_that_overlap(void **state) {
    (void)state;
    static const char lights[] =
        "void glow g 0 0 4 2 2 2 0 g source haze 0 0 4 0 0 1 60 g source more 0 0 4 0 0 1 40\n"
        "void light a 0 0 3 3 3 3 a source sun 0 0 4 0 0 1 20\n"
        "void light b 0 0 3 10 10 10 b source other 0 0 4 0 0 1 10 b source again 0 0 4 0 0 1 20\n";
    double small = pow(sin(angle_radians(5)), 2), sun = pow(sin(angle_radians(10)), 2), haze = 0.25;
    double direct = PI * (3 * sun + 10 * small + 10 * sun), both = direct + 2 * PI * (haze - sun);
    for (int strategy = 0; strategy < 3; strategy++) {
        graze_trace_settings s = settings_for((graze_strategy)strategy, 0);
        assert_answer(ask(lights, s, (graze_ray){.direction = {0, .1, 1}}), 3, 1e-12);
        s.quantity = GRAZE_IRRADIANCE;
        assert_answer(ask(lights, s, sensor), direct, 0.002);
        s.ambient_bounces = 1;
        assert_answer(ask(lights, s, sensor), both, 0.005);
    }
}

/* Where light samples, reflections, and what is known without them meet: some of each of the suns is hidden. */
static void glossy_under_suns_that_overlap(void **state) {
    (void)state;
    static const char text[] = "void light a 0 0 3 3 3 3 a source sun 0 0 4 0 0 1 60 a source other 0 0 4 0 .6 1 40\n"
                               "void glow g 0 0 4 2 2 2 0 g source haze 0 0 4 0 -.5 1 90\n"
                               "void metal m 0 0 5 .7 .7 .7 .8 .2 m polygon f 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n"
                               "void plastic black 0 0 5 0 0 0 0 0 black sphere ball 0 0 4 .5 .2 2 .6\n";
    const graze_ray ray = {.origin = {0, -2, 2}, .direction = {0, 2, -2}};
    graze_answer truth = {.samples = 0};
    for (int strategy = 0; strategy < 3; strategy++) {
        graze_trace_settings s = settings_for((graze_strategy)strategy, 1);
        s.error = 0.002;
        graze_answer answer = ask(text, s, ray);
        if (strategy == 0)
            truth = answer;
        double error = hypot(truth.standard_error.g, answer.standard_error.g);
        assert_true(fabs(answer.value.g - truth.value.g) < 4 * error && error < 0.005 * truth.value.g);
    }
}

/* A long thin tube of light at distance d: E = pi L r/d (1 - ...) is a line source; here by a fine independent
 * quadrature over the lit half of the cylinder. */
static double cylinder_irradiance(double radius, double half_length, double height) {
    int n = 400;
    double sum = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double angle = 2 * PI * (i + 0.5) / n, x = half_length * (2 * (j + 0.5) / n - 1);
            vec3 normal = {0, sin(angle), -cos(angle)};
            vec3 point = {x, radius * normal.y, height + radius * normal.z};
            double distance = vec3_length(point), cosine = point.z / distance,
                   at_light = -vec3_dot(normal, point) / distance;
            if (at_light > 0)
                sum += cosine * at_light / (distance * distance);
        }
    return sum * (2 * PI * radius / n) * (2 * half_length / n);
}

static void irradiance_of_a_cylinder(void **state) {
    (void)state;
    graze_trace_settings s = settings_for(GRAZE_STRATEGY_LIGHT, 0);
    s.quantity = GRAZE_IRRADIANCE;
    s.error = 5e-4;
    assert_answer(ask("void light l 0 0 3 1 1 1 l cylinder lamp 0 0 7 -1 0 2 1 0 2 .1\n", s, sensor),
                  cylinder_irradiance(0.1, 1, 2 - 1e-4), 5e-4);
}

/* Fresnel's estimate of a plastic mirror, and the light seen in it. */
static void mirror_image_of_a_light(void **state) {
    (void)state;
    const char *text =
        "void plastic m 0 0 5 0 0 0 .04 0\n" FLOOR "void light l 0 0 3 10 10 10 l sphere lamp 0 0 4 10 0 10 1\n";
    graze_ray ray = {.origin = {-10, 0, 10}, .direction = {1, 0, -1}};
    double fresnel = exp(-5.85 * sqrt(0.5)) - 0.00287989916;
    for (int strategy = 0; strategy < 3; strategy++)
        assert_close(ask(text, settings_for((graze_strategy)strategy, 0), ray).value.r, 10 * (0.04 + 0.96 * fresnel),
                     1e-9);
}

/* The same question answered by each strategy; there must be light. */
static void assert_strategies_agree(const char *what, int number, const graze_answer a[3]) {
    for (int strategy = 1; strategy < 3; strategy++) {
        double error = hypot(a[0].standard_error.g, a[strategy].standard_error.g);
        if (!(a[0].value.g > 0) || fabs(a[0].value.g - a[strategy].value.g) > 4.5 * error)
            fail_msg("%s %d: %g against %g +- %g", what, number, a[0].value.g, a[strategy].value.g, error);
    }
}

static void strategies_agree_on_a_glossy_floor(void **state) {
    (void)state;
    const char *text = "void metal2 m 4 1 1 0 . 0 6 .6 .6 .6 .8 .05 .2\n" FLOOR
                       "void light l 0 0 3 50 50 50 l polygon lamp 0 0 12 9 -1 .3 9 -1 2 9 1 2 9 1 .3\n"
                       "void glow g 0 0 4 20 20 20 0 g sphere ball 0 0 4 3 2 1 .5\n";
    for (int degrees = 2; degrees < 60; degrees += 19) {
        double elevation = angle_radians(degrees);
        graze_ray ray = {.origin = {-8, 0, 8 * tan(elevation)}, .direction = {8, 0, -8 * tan(elevation)}};
        for (int model = 0; model < 4; model++) {
            graze_answer a[3];
            for (int strategy = 0; strategy < 3; strategy++) {
                graze_trace_settings s = settings_for((graze_strategy)strategy, 1);
                s.error = 0.005;
                a[strategy] = ask_of_model(text, (graze_brdf_model)model, s, ray);
            }
            assert_strategies_agree("degrees", degrees, a);
        }
    }
}

/* The strategies differ in how they find light, not in what counts: whatever ends paths or changes lobes. */
static void strategies_agree_whatever_the_settings(void **state) {
    (void)state;
    const char *text = "void metal2 m 4 1 1 0 . 0 6 .6 .6 .6 .5 .2 .3\n"
                       "void plastic w 0 0 5 .5 .5 .5 .05 .15\n"
                       "m polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n"
                       "w polygon wall 0 0 12 -2 2 0 2 2 0 2 2 3 -2 2 3\n"
                       "w polygon left 0 0 12 -2 -2 0 -2 2 0 -2 2 3 -2 -2 3\n"
                       "void light l 0 0 3 9 9 9 l polygon lamp 0 0 12 -.7 -.7 2 -.7 .7 2 .7 .7 2 .7 -.7 2\n"
                       "void glow g 0 0 4 5 5 5 0 g sphere ball 0 0 4 1.2 1 1 .4\n";
    const graze_ray ray = {.origin = {-0.5, -4, 1.5}, .direction = {0.1, 1, -0.4}};
    static const struct {
        int bounces, limit, back_faces;
        double threshold, minimum_weight;
    } settings[] = {{0, 0, 1, 0, 1e-4}, {2, 0, 1, 0, 1e-4},  {0, 0, 1, 1, 1e-4},  {2, 0, 1, 1, 1e-4},
                    {2, 1, 1, 0, 1e-4}, {2, -2, 1, 0, 1e-4}, {2, 2, 1, 0, 0.4},   {2, 0, 0, 0, 1e-4},
                    {2, 1, 0, 0, 1e-4}, {1, -1, 1, 1, 0.3},  {0, -1, 1, 0, 1e-4}, {2, -9, 1, 0, 0.9}};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        graze_answer a[3];
        for (int strategy = 0; strategy < 3; strategy++) {
            graze_trace_settings s = settings_for((graze_strategy)strategy, settings[i].bounces);
            s.reflection_limit = settings[i].limit;
            s.back_faces_visible = settings[i].back_faces;
            s.specular_threshold = settings[i].threshold;
            s.minimum_weight = settings[i].minimum_weight;
            s.samples = strategy == GRAZE_STRATEGY_BRDF ? 1 << 16 : 1 << 14;
            a[strategy] = ask(text, s, ray);
        }
        assert_strategies_agree("settings", (int)i, a);
    }
}

/* A lamp let into the ceiling, coplanar with it, shines whichever was written first, for every strategy. */
static void a_lamp_coplanar_with_the_ceiling(void **state) {
    (void)state;
    const char *ceiling = "void plastic w 0 0 5 .5 .5 .5 0 0 w polygon ceiling 0 0 12 -5 -5 2 -5 5 2 5 5 2 5 -5 2\n";
    const char *lamp = "void light l 0 0 3 1 1 1 l polygon lamp 0 0 12 -1 -.5 2 -1 .5 2 1 .5 2 1 -.5 2\n";
    for (int strategy = 0; strategy < 3; strategy++)
        for (int order = 0; order < 2; order++) {
            char text[512];
            snprintf(text, sizeof text, "%s%s", order ? ceiling : lamp, order ? lamp : ceiling);
            graze_trace_settings s = settings_for((graze_strategy)strategy, 1);
            s.quantity = GRAZE_IRRADIANCE;
            assert_answer(ask(text, s, sensor), rectangle_irradiance(1, 0.5, 2 - 1e-4), 0.002);
        }
}

/* Stopping at an error that is itself estimated must neither shift the mean nor make the error a lie: a lamp in a grey
 * ball, where most samples agree and a few differ. Radiance is the sum of the bounces, .02 (1 - .48^5) / .52. */
static void stopping_is_honest(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("void plastic g 0 0 5 .5 .5 .5 0 0 g bubble room 0 0 4 0 0 0 5\n"
                                         "void glow l 0 0 4 1 1 1 0 l sphere lamp 0 0 4 0 0 0 1\n");
    const graze_ray ray = {.origin = {3, 0, 0}, .direction = {1, 0, 0}};
    const double truth = 0.02 * (1 - pow(0.48, 5)) / 0.52;
    enum { COUNT = 2000 };
    for (int i = 0; i < 3; i++) {
        graze_trace_settings s = settings_for(GRAZE_STRATEGY_MIS, 5);
        s.error = (double[]){0.02, 0.01, 0.005}[i];
        double sum = 0, variance = 0;
        int covered = 0;
        for (int stream = 0; stream < COUNT; stream++) {
            graze_answer answer;
            graze_trace(scene, &s, &ray, (uint64_t)stream, &answer, NULL);
            sum += answer.value.g;
            variance += answer.standard_error.g * answer.standard_error.g;
            covered += fabs(answer.value.g - truth) <= 1.96 * answer.standard_error.g;
        }
        if (fabs(sum / COUNT - truth) > 4 * sqrt(variance) / COUNT || covered < 0.93 * COUNT)
            fail_msg("--error %g: mean %g of %g, %d of %d covered", s.error, sum / COUNT, truth, covered, COUNT);
    }
    graze_scene_destroy(scene);
}

/* More than half the sky lights what faces exactly away from its middle. */
static void wide_sky_from_below(void **state) {
    (void)state;
    const char *text = "void light sky_light 0 0 3 1 1 1 sky_light source sky 0 0 4 0 0 -1 360\n";
    for (int strategy = 0; strategy < 3; strategy++) {
        graze_trace_settings s = settings_for((graze_strategy)strategy, 0);
        s.quantity = GRAZE_IRRADIANCE;
        assert_answer(ask(text, s, sensor), PI, 0.002);
    }
}

/* What a glow lights: nothing diffuse without an ambient bounce, everything within its radius, nothing if negative. */
static void roles_of_glows(void **state) {
    (void)state;
    char text[512];
    const struct {
        double radius;
        int bounces;
        double share; /* of the irradiance that a light of the same size gives */
    } cases[] = {{0, 0, 0}, {0, 1, 1}, {10, 0, 1}, {1, 0, 0}, {1, 1, 1}, {-1, 0, 0}, {-1, 1, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int strategy = 0; strategy < 3; strategy++) {
            graze_trace_settings s = settings_for((graze_strategy)strategy, cases[i].bounces);
            s.quantity = GRAZE_IRRADIANCE;
            snprintf(text, sizeof text,
                     "void glow l 0 0 4 1 1 1 %g l polygon lamp 0 0 12 -1 -.5 2 -1 .5 2 1 .5 2 1 -.5 2\n",
                     cases[i].radius);
            assert_answer(ask(text, s, sensor), cases[i].share * rectangle_irradiance(1, 0.5, 2 - 1e-4), 0.002);
        }
}

static void spotlight_shines_in_its_cone_only(void **state) {
    (void)state;
    const char *text = "void spotlight l 0 0 7 5 5 5 20 0 0 -1 l ring lamp 0 0 8 0 0 4 0 0 -1 0 .05\n";
    graze_trace_settings s = settings_for(GRAZE_STRATEGY_MIS, 0);
    s.quantity = GRAZE_IRRADIANCE;
    graze_ray beside = {.origin = {2, 0, 0}, .direction = {0, 0, 1}};
    double height = 4 - 1e-4;
    /* The aim vector of length 1 puts the focus 1 behind the lamp, which weakens the light by (d / (d + 1))^2. Over the
     * disk, r dr = d dd, so that E = 2 pi 5 h^2 times the integral of 1 / (d (d + 1)^2) from h to the rim. */
    double rim = sqrt(height * height + 0.0025);
    double integral = log(rim / (rim + 1) * (height + 1) / height) + 1 / (rim + 1) - 1 / (height + 1);
    for (int strategy = 0; strategy < 2; strategy++) {
        s.strategy = (graze_strategy)strategy;
        assert_answer(ask(text, s, sensor), 2 * PI * 5 * height * height * integral, 0.002);
    }
    s.strategy = GRAZE_STRATEGY_MIS;
    assert_close(ask(text, s, beside).value.g, 0, 0);
}

static void lights_shine_from_their_front_only(void **state) {
    (void)state;
    graze_trace_settings s = settings_for(GRAZE_STRATEGY_MIS, 0);
    graze_ray up = {.origin = {0.1, 0.1, 0}, .direction = {0, 0, 1}};
    const char *facing_up = "void light l 0 0 3 1 1 1 l polygon lamp 0 0 12 -1 -1 2 1 -1 2 1 1 2 -1 1 2\n";
    assert_close(ask(facing_up, s, up).value.g, 0, 0);
    s.quantity = GRAZE_IRRADIANCE;
    assert_close(ask(facing_up, s, sensor).value.g, 0, 0);
    s.quantity = GRAZE_RADIANCE;
    assert_close(ask(facing_up, s, (graze_ray){.origin = {0.1, 0.1, 4}, .direction = {0, 0, -1}}).value.g, 1, 0);
}

static void hidden_back_faces_are_passed(void **state) {
    (void)state;
    const char *text = "void plastic m 0 0 5 .5 .5 .5 0 0 m polygon lid 0 0 12 -1 -1 3 1 -1 3 1 1 3 -1 1 3\n"
                       "void light l 0 0 3 7 7 7 l polygon lamp 0 0 12 -1 -1 4 -1 1 4 1 1 4 1 -1 4\n";
    graze_ray up = {.origin = {0.1, 0.1, 0}, .direction = {0, 0, 1}};
    graze_trace_settings s = settings_for(GRAZE_STRATEGY_MIS, 0);
    assert_close(ask(text, s, up).value.g, 0, 0);
    s.back_faces_visible = 0;
    assert_close(ask(text, s, up).value.g, 7, 0);
    s.lights_visible = 0;
    assert_close(ask(text, s, up).value.g, 0, 0);
}

/* A room of perfect mirrors with nothing in it must end, and answer 0. */
static void room_of_mirrors_ends(void **state) {
    (void)state;
    graze_ray ray = {.origin = {0.1, 0.2, 0.3}, .direction = {0.3, 0.5, 1}};
    graze_answer answer =
        ask("void metal m 0 0 5 1 1 1 1 0 m bubble room 0 0 4 0 0 0 3\n", settings_for(GRAZE_STRATEGY_MIS, 0), ray);
    assert_close(answer.value.g, 0, 0);
}

static void same_ray_same_bits_other_seed_other_bits(void **state) {
    (void)state;
    const char *text = "void metal2 m 4 1 1 0 . 0 6 .6 .6 .6 .8 .05 .2\n" FLOOR SKY(
        1) "void light l 0 0 3 50 50 50 l polygon lamp 0 0 12 9 -1 .3 9 -1 2 9 1 2 9 1 .3\n";
    graze_trace_settings s = settings_for(GRAZE_STRATEGY_MIS, 1);
    graze_answer first = ask(text, s, down), second = ask(text, s, down);
    assert_memory_equal(&first.value, &second.value, sizeof first.value);
    s.seed = 1;
    graze_answer other = ask(text, s, down);
    assert_true(other.value.g != first.value.g);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(furnace_of_a_diffuse_floor),
        cmocka_unit_test(furnace_of_a_glossy_floor),
        cmocka_unit_test(furnace_without_weights),
        cmocka_unit_test(closed_box_with_ambient_value),
        cmocka_unit_test(irradiance_of_a_rectangle),
        cmocka_unit_test(irradiance_of_a_sphere_a_ring_and_the_sun),
        cmocka_unit_test(sources_that_overlap),
        cmocka_unit_test(glossy_under_suns_that_overlap),
        cmocka_unit_test(irradiance_of_a_cylinder),
        cmocka_unit_test(mirror_image_of_a_light),
        cmocka_unit_test(strategies_agree_on_a_glossy_floor),
        cmocka_unit_test(strategies_agree_whatever_the_settings),
        cmocka_unit_test(stopping_is_honest),
        cmocka_unit_test(wide_sky_from_below),
        cmocka_unit_test(a_lamp_coplanar_with_the_ceiling),
        cmocka_unit_test(roles_of_glows),
        cmocka_unit_test(spotlight_shines_in_its_cone_only),
        cmocka_unit_test(lights_shine_from_their_front_only),
        cmocka_unit_test(hidden_back_faces_are_passed),
        cmocka_unit_test(room_of_mirrors_ends),
        cmocka_unit_test(same_ray_same_bits_other_seed_other_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
