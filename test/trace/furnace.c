/* Interreflection where the answer is known: closed rooms of one colour, and white things in a white world. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/material.h"
#include "graze/trace.h"
#include "support/scene_text.h"

/* Of errors that 16 replicates tell, one in 10,000 answers is farther off. */
#define ERRORS 5.2

static void assert_radiance(const graze_scene *scene, const graze_trace_settings *s, const graze_ray *ray,
                            uint64_t stream, double truth, double largest_error) {
    graze_answer a;
    graze_trace(scene, s, ray, stream, &a, NULL);
    double error = a.standard_error.g;
    if (!(fabs(a.value.g - truth) <= ERRORS * error + 1e-9 * truth) || !(error <= largest_error * truth))
        fail_msg("strategy %d, -lw %g -lr %d: %.9g +- %.2g, but the truth is %.9g", (int)s->strategy, s->minimum_weight,
                 s->reflection_limit, a.value.g, error, truth);
}

static void assert_exact(const graze_scene *scene, const graze_trace_settings *s, const graze_ray *ray, uint64_t stream,
                         double truth) {
    graze_answer a;
    graze_trace(scene, s, ray, stream, &a, NULL);
    if (fabs(a.value.g - truth) > 1e-12 * truth || a.standard_error.g > (1 + 1e-9) * truth / s->samples)
        fail_msg("%.17g +- %.2g, but the truth is %.17g", a.value.g, a.standard_error.g, truth);
}

/* A lamp in the middle of a ball fills (r/R)^2 of the sky of every point of the wall, and the wall itself the rest: the
 * light of each bounce is the same everywhere. However paths end, they must not lose light. */
static void lamp_in_a_grey_ball(void **state) {
    (void)state;
    const double albedos[] = {0.5, 0.7, 0.9, 0.95, 0.99}, part = 1.0 / 9;
    const struct {
        int limit;
        double minimum_weight;
    } endings[] = {{0, 1e-4}, {0, 0.5}, {-1000, 0.9}};
    for (int i = 0; i < 5; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "void plastic g 0 0 5 %.17g %.17g %.17g 0 0 g bubble room 0 0 4 5 1 2 3\n"
                 "void light l 0 0 3 4 4 4 l sphere lamp 0 0 4 5 1 2 1\n",
                 albedos[i], albedos[i], albedos[i]);
        graze_scene *scene = load_scene(text);
        const graze_ray ray = {.origin = {5, 1, 4}, .direction = {0.7, 0.2, -0.1}};
        double back = albedos[i] * (1 - part), truth = 4 * albedos[i] * part / (1 - back);
        for (int strategy = 0; strategy < 3; strategy++)
            for (int ending = 0; ending < 3; ending++) {
                graze_trace_settings s = graze_trace_defaults();
                s.strategy = (graze_strategy)strategy;
                s.ambient_bounces = 2000;
                s.reflection_limit = endings[ending].limit;
                s.minimum_weight = endings[ending].minimum_weight;
                s.samples = 4096;
                assert_radiance(scene, &s, &ray, (uint64_t)(i + 10 * ending), truth, 0.08);
            }
        graze_scene_destroy(scene);
    }
}

/* What is white, dull or a mirror, cannot be told from a white world around it, whatever its shape. */
static void white_things_in_a_white_world(void **state) {
    (void)state;
    const char *text = "void glow w 0 0 4 3 3 3 0 w bubble world 0 0 4 0 0 0 10\n"
                       "void plastic d 0 0 5 1 1 1 0 0\nvoid metal m 0 0 5 1 1 1 1 0\n"
                       "d polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\n"
                       "d polygon wall 0 0 12 -2 2 0 2 2 0 2 2 3 -2 2 3\n"
                       "m polygon mirror 0 0 12 -2 -2 0 -2 2 0 -2 2 3 -2 -2 3\n"
                       "d cup cup 0 0 8 0 0 0 0 0 1 .2 .5\nm tube tube 0 0 7 1 1 .2 1 .5 1.2 .3\n"
                       "d sphere ball 0 0 4 -1 1 .5 .5\nm sphere globe 0 0 4 1 -1 .5 .5\n"
                       "d ring ring 0 0 8 -1 -1 .7 1 2 3 .2 .6\n";
    graze_scene *scene = load_scene(text);
    for (int strategy = 0; strategy < 3; strategy++)
        for (int i = 0; i < 40; i++) {
            double angle = 2 * PI * i / 40;
            vec3 origin = {3 * cos(angle), 3 * sin(angle), 2.5};
            vec3 target = {-1 + 2 * (i % 7) / 6.0, -1 + 2 * (i % 5) / 4.0, 0.1 * (i % 6)};
            graze_ray ray = {.origin = origin, .direction = vec3_subtract(target, origin)};
            graze_trace_settings s = graze_trace_defaults();
            s.strategy = (graze_strategy)strategy;
            s.ambient_bounces = 1000;
            s.samples = 512;
            assert_radiance(scene, &s, &ray, (uint64_t)i, 3, 0.1);
            /* Reflections find nothing but white, and no sample differs: another might, is all that can be said. */
            if (strategy == GRAZE_STRATEGY_BRDF)
                assert_exact(scene, &s, &ray, (uint64_t)i, 3);
        }
    graze_scene_destroy(scene);
}

/* A glossy ball in a white world reflects its albedo, from the middle to the rim. */
static void glossy_ball_in_a_white_world(void **state) {
    (void)state;
    for (int model = 0; model < GRAZE_BRDF_MODEL_COUNT; model++) {
        const graze_model_choice choice = {NULL, (graze_brdf_model)model};
        graze_scene *scene = scene_from_text_with("void glow w 0 0 4 1 1 1 0 w bubble world 0 0 4 0 0 0 10\n"
                                                  "void metal b 0 0 5 .5 .5 .5 .6 .2 b sphere ball 0 0 4 1 2 3 1\n",
                                                  &(graze_scene_settings){.models = &choice, .model_count = 1});
        if (!scene)
            fail_msg("%s", messages);
        for (int i = 0; i < 8; i++) {
            double angle = angle_radians((const double[]){0, 20, 40, 60, 75, 85, 88, 89}[i]);
            graze_ray ray = {.origin = {1 + sin(angle), 2, 6}, .direction = {0, 0, -1}};
            const graze_brdf lobe = {(graze_brdf_model)model, 0.2, 0.2};
            const vec3 view = {sin(angle), 0, cos(angle)};
            double truth = 0.5 * (0.4 + 0.6 * graze_brdf_albedo(&lobe, view));
            for (int strategy = 0; strategy < 3; strategy++) {
                graze_trace_settings s = graze_trace_defaults();
                s.strategy = (graze_strategy)strategy;
                s.ambient_bounces = 1;
                s.samples = 1 << 14;
                assert_radiance(scene, &s, &ray, (uint64_t)i, truth, strategy == GRAZE_STRATEGY_LIGHT ? 0.15 : 0.02);
            }
        }
        graze_scene_destroy(scene);
    }
}

/* Clear and white bodies, that lose no light, in a white world: from outside they cannot be told from it. Rays that all
 * go through say so without an error; in the others there is chance. */
static void clear_things_in_a_white_world(void **state) {
    (void)state;
    const char *text = "void glow w 0 0 4 3 3 3 0 w bubble world 0 0 4 0 0 0 20\n"
                       "void glass g 0 0 3 1 1 1\nvoid dielectric d 0 0 5 1 1 1 1.5 0\n"
                       "void interface i 0 0 8 1 1 1 1.3 1 1 1 1.5\nvoid trans t 0 0 7 1 1 1 .05 0 .6 .7\n"
                       "void trans m 0 0 7 1 1 1 0 0 .7 0\nvoid transfunc f 2 if . 0 6 1 1 1 .1 .6 .3\n"
                       "void BRTDfunc b 10 .2 .2 .2 .3 .3 .3 0 0 0 . 0 9 .3 .3 .3 .3 .3 .3 .2 .2 .2\n"
                       "void WGMDfunc c 13 void .1 0 0 void .2 0 0 void 1 0 0 . 0 9 .4 .4 .4 .4 .4 .4 .3 .3 .3\n"
                       "void mixfunc l 4 m void .3 . 0 0\nvoid mixfunc k 4 void g .3 . 0 0\n"
                       "f sphere by_function 0 0 4 0 0 9 1\nb sphere general 0 0 4 0 0 -9 1\n"
                       "c sphere coated 0 0 4 9 9 0 1\nl sphere lace 0 0 4 -9 9 0 1\nk sphere sieve 0 0 4 9 -9 0 1\n"
                       "g polygon pane 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n"
                       "g polygon other 0 0 12 -1 -1 .5 1 -1 .5 1 1 .5 -1 1 .5\n"
                       "d sphere ball 0 0 4 9 0 0 1\nd sphere whole 0 0 4 -9 0 0 1\ni sphere half 0 0 4 -9 0 0 .5\n"
                       "t polygon sheet 0 0 12 -1 8 0 1 8 0 1 10 0 -1 10 0\nm sphere milk 0 0 4 0 -9 0 1\n";
    const vec3 targets[] = {{0, 0, 0}, {9, 0, 0},  {-9, 0, 0}, {0, 9, 0},  {0, -9, 0},
                            {0, 0, 9}, {0, 0, -9}, {9, 9, 0},  {-9, 9, 0}, {9, -9, 0}};
    graze_scene *scene = load_scene(text);
    for (int strategy = 0; strategy < 3; strategy++)
        for (int i = 0; i < 80; i++) {
            vec3 target = targets[i % 10], away = {cos(i * 0.7), sin(i * 0.7), 0.1 + 0.1 * (i % 9)};
            target.x += 0.3 * cos(i);
            graze_ray ray = {.origin = vec3_add_scaled(target, 4, away), .direction = vec3_negate(away)};
            graze_trace_settings s = graze_trace_defaults();
            s.strategy = (graze_strategy)strategy;
            s.ambient_bounces = 1000;
            s.samples = 2048;
            assert_radiance(scene, &s, &ray, (uint64_t)i, 3, 0.1);
        }
    graze_scene_destroy(scene);
}

/* The other way round: a lamp in a grey room seen through panes, and the floor lit through them, and nothing else. The
 * floor's light is what it would be, times what the panes let through at the angle. */
static void a_floor_lit_through_panes(void **state) {
    (void)state;
    const char *scene_text = "void plastic g 0 0 5 .5 .5 .5 0 0 g polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n"
                             "void light l 0 0 3 1000 1000 1000 l sphere lamp 0 0 4 3 0 4 .001\n"
                             "void glass p 0 0 4 .8 .9 1 1.4 p polygon a 0 0 12 -9 -9 1 9 -9 1 9 9 1 -9 9 1\n"
                             "void trans t 0 0 7 .9 .8 .7 .03 0 .5 1\n"
                             "t polygon b 0 0 12 -9 -9 2 9 -9 2 9 9 2 -9 9 2\n";
    graze_scene *scene = load_scene(scene_text);
    const graze_ray ray = {.origin = {0, 0, 0.5}, .direction = {0, 0, -1}};
    const graze_material glass = {.kind = GRAZE_GLASS, .color = {0.8, 0.9, 1}, .refraction = 1.4};
    const graze_material trans = {.kind = GRAZE_TRANS,
                                  .color = {0.9, 0.8, 0.7},
                                  .specularity = 0.03,
                                  .transmission = 0.5,
                                  .transmitted_specularity = 1};
    double cosine = 0.8, solid_angle = PI * 1e-6 / 25;
    double left = graze_material_straight_through(&glass, cosine).g * graze_material_straight_through(&trans, cosine).g;
    double truth = 0.5 / PI * 1000 * solid_angle * cosine * left;
    for (int strategy = 0; strategy < 2; strategy++) {
        graze_trace_settings s = graze_trace_defaults();
        s.strategy = (graze_strategy)strategy;
        s.samples = 256;
        assert_radiance(scene, &s, &ray, 0, truth, 1e-3);
    }
    graze_scene_destroy(scene);
}

/* A lamp over a floor and its image behind a wall that is all mirror: of a ball that is seen wholly, (r/d)^2 cos of its
 * radiance is what a dull surface gets, times its colour. Where the floor shines, the three ways only have to agree. */
static void a_lamp_and_its_image(void **state) {
    (void)state;
    const char *floors[] = {"plastic f 0 0 5 .5 .5 .5 0 0", "metal f 0 0 5 .5 .5 .5 .8 .15"};
    for (int shiny = 0; shiny < 2; shiny++) {
        char text[512];
        snprintf(text, sizeof text,
                 "void %s f polygon floor 0 0 12 -9 -9 0 9 -9 0 9 1 0 -9 1 0\n"
                 "void mirror m 0 0 3 .9 .8 .7 m polygon wall 0 0 12 -900 1 -900 900 1 -900 900 1 900 -900 1 900\n"
                 "void light l 0 0 3 10 10 10 l sphere lamp 0 0 4 .5 0 1 .3\n",
                 floors[shiny]);
        graze_scene *scene = load_scene(text);
        const graze_ray ray = {.origin = {-1, -1.5, 0.8}, .direction = {1, 1.5, -0.8}};
        double direct = pow(1.25, -1.5), image = 0.8 * pow(0.25 + 4 + 1, -1.5);
        double truth = 0.5 * 10 * 0.09 * (direct + image);
        for (int bounces = 0; bounces < 2; bounces++)
            for (int strategy = 0; strategy < 3; strategy++) {
                graze_trace_settings s = graze_trace_defaults();
                graze_answer a;
                s.strategy = (graze_strategy)strategy;
                s.ambient_bounces = bounces;
                s.samples = 1 << 15;
                if (shiny) {
                    graze_trace(scene, &s, &ray, 1, &a, NULL);
                    if (bounces + strategy == 0)
                        truth = a.value.g;
                }
                assert_radiance(scene, &s, &ray, 2, truth, 0.03);
            }
        graze_scene_destroy(scene);
    }
}

/* What a pane of glass with the index 1.52 reflects of light that meets it at this cosine. */
static double reflected_by_pane(double cosine, double transmissivity) {
    double inside = sqrt(1 - (1 - cosine * cosine) / (1.52 * 1.52)), body = pow(transmissivity, 1 / inside), sum = 0;
    const double amplitudes[2] = {(cosine - 1.52 * inside) / (cosine + 1.52 * inside),
                                  (1.52 * cosine - inside) / (1.52 * cosine + inside)};
    for (int i = 0; i < 2; i++) {
        double face = amplitudes[i] * amplitudes[i], through = (1 - face) * body;
        /* Once at the front; at the back after no, two, four... reflections inside. */
        double all = face, inner = through * face * (1 - face) * body;
        for (int k = 0; k < 20; k++, inner *= face * face * body * body)
            all += inner;
        sum += all / 2;
    }
    return sum;
}

/* The sun over a floor, and the same in one of two panes beside each other, from before or from behind it; a pane on
 * the way of light before it is reflected, or after that, takes its part. */
static void a_sun_in_a_pane(void **state) {
    (void)state;
    const double albedo = 0.5, radiance = 1e6, half_sine = sin(angle_radians(0.25));
    for (int way = 0; way < 4; way++) {
        char text[800];
        const char *turned = way == 1 ? "12 0 2 0 1 2 0 1 2 3 0 2 3" : "12 0 2 3 1 2 3 1 2 0 0 2 0";
        snprintf(text, sizeof text,
                 "void plastic f 0 0 5 .5 .5 .5 0 0\nf ring floor 0 0 8 0 0 0 0 0 1 0 90\n"
                 "void glass g 0 0 3 .9 .9 .9\ng polygon a 0 0 %s\ng polygon b 0 0 12 -1 2 0 0 2 0 0 2 3 -1 2 3\n"
                 "void light l 0 0 3 1e6 1e6 1e6\nl source sun 0 0 4 0 -3 4 .5\n%s",
                 turned, way == 2 ? "g ring c 0 0 8 0 1.9 1.2 0 1 0 0 1\n" : "");
        graze_scene *scene = load_scene(text);
        /* The floor at y = 1 sees the sun at the height 4/3 of the pane. */
        const graze_ray ray = {.origin = {way == 3 ? -0.2 : 0.2, 1, 0.5}, .direction = {0, 0, -1}};
        double image = reflected_by_pane(0.6, 0.9), clear = 1;
        if (way == 2) {
            double inside = sqrt(1 - 0.64 / (1.52 * 1.52)), body = pow(0.9, 1 / inside);
            double a = pow((0.6 - 1.52 * inside) / (0.6 + 1.52 * inside), 2);
            double b = pow((1.52 * 0.6 - inside) / (1.52 * 0.6 + inside), 2);
            clear = ((1 - a) * (1 - a) * body / (1 - a * a * body * body) +
                     (1 - b) * (1 - b) * body / (1 - b * b * body * body)) /
                    2;
            image = image * clear * clear + image;
        }
        const double direct = albedo * radiance * half_sine * half_sine * 0.8;
        for (int bounces = 0; bounces < 2; bounces++)
            for (int strategy = 0; strategy < 2; strategy++) {
                graze_trace_settings s = graze_trace_defaults();
                s.strategy = strategy ? GRAZE_STRATEGY_LIGHT : GRAZE_STRATEGY_MIS;
                s.ambient_bounces = bounces;
                s.samples = 1 << 12;
                /* What the pane reflects, the floor reflects diffusely only where it may. */
                assert_radiance(scene, &s, &ray, 3, direct * (bounces > 0 ? 1 + image : 1), 0.005);
            }
        graze_scene_destroy(scene);
    }
}

/* What is inside a clear body is seen through so much of it. */
static void a_lamp_in_a_dark_ball(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void dielectric d 0 0 5 .5 .25 1 1.5 0 d sphere ball 0 0 4 1 2 3 2\n"
                                    "void light l 0 0 3 4 4 4 l sphere lamp 0 0 4 1 2 3 .5\n");
    const graze_ray ray = {.origin = {1, 2, 9}, .direction = {0, 0, -1}};
    graze_trace_settings s = graze_trace_defaults();
    s.samples = 65536;
    /* Through 1.5 of it, with 4% reflected once: what comes back after more meets the black world or the lamp again. */
    assert_radiance(scene, &s, &ray, 0, 4 * 0.96 / 2.25 * pow(0.25, 1.5), 0.01);
    graze_scene_destroy(scene);
}

/* Water without a bottom: from an infinite depth nothing comes but through what absorbs nothing. */
static void a_sky_below_open_water(void **state) {
    (void)state;
    static const char *const colors[] = {"1 .9 1", "1 1 1"};
    const graze_ray ray = {.origin = {0, 0, 2}, .direction = {0, 0, -1}};
    graze_trace_settings s = graze_trace_defaults();
    s.samples = 16384;
    for (int clear = 0; clear < 2; clear++) {
        char text[300];
        snprintf(text, sizeof text,
                 "void dielectric d 0 0 5 %s 1.5 0 d ring surface 0 0 8 0 0 0 0 0 1 0 9\n"
                 "void glow g 0 0 4 4 4 4 0 g source sky 0 0 4 0 0 1 360\n",
                 colors[clear]);
        graze_scene *scene = load_scene(text);
        assert_radiance(scene, &s, &ray, 0, 4 * (0.04 + (clear ? 0.96 / 2.25 : 0)), 0.02);
        graze_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clear_things_in_a_white_world),
        cmocka_unit_test(a_floor_lit_through_panes),
        cmocka_unit_test(a_lamp_in_a_dark_ball),
        cmocka_unit_test(a_lamp_and_its_image),
        cmocka_unit_test(a_sun_in_a_pane),
        cmocka_unit_test(lamp_in_a_grey_ball),
        cmocka_unit_test(white_things_in_a_white_world),
        cmocka_unit_test(glossy_ball_in_a_white_world),
        cmocka_unit_test(a_sky_below_open_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
