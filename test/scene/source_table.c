/* Sources with patterns: directions are drawn by their density, and where it is bright. */
#include "scene/source_table.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/angle.h"
#include "geometry/solid_angle.h"
#include "scene/light.h"
#include "support/scene_text.h"

static double uniform(uint64_t *state) {
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static graze_scene *source_scene(const char *function, const char *source) {
    char text[400];
    snprintf(text, sizeof text, "void brightfunc f 2 %s . 0 0 f glow g 0 0 4 2 2 2 0 g source s 0 0 4 %s", function,
             source);
    graze_scene *scene = scene_from_text(text);
    if (!scene)
        fail_msg("%s", messages);
    else
        assert_non_null(scene->lights[0].table);
    return scene;
}

static const char *const functions[] = {"1", "Dz*Dz", "if(Dx,exp(8*Dx),0)", "if(.01-(1-Dz),5000,.1)"};
static const char *const sources[] = {"0 0 1 180", "1 2 -.3 360", ".3 .1 .2 10"};

/* Every direction drawn has the density that is told when it is met, and is one of the source. */
static void draws_have_their_density(void **state) {
    (void)state;
    uint64_t random_state = 7;
    for (int f = 0; f < 4; f++)
        for (int s = 0; s < 3; s++) {
            graze_scene *scene = source_scene(functions[f], sources[s]);
            const scene_light *light = &scene->lights[0];
            double least = 0.0999 / (4 * PI * pow(sin(light->half_angle / 2), 2));
            for (int i = 0; i < 2000; i++) {
                const double random[2] = {uniform(&random_state), uniform(&random_state)};
                double density;
                vec3 d = source_table_draw(light->table, random, &density);
                assert_true(fabs(vec3_length(d) - 1) < 1e-12);
                assert_true(vec3_dot(d, light->center) > cos(light->half_angle) - 1e-12);
                assert_true(density >= least);
                /* At a cell's edge it may be its neighbour's: rarely. */
                double told = source_table_density(light->table, d);
                if (fabs(told - density) > 1e-9 * density)
                    assert_true(i % 97 != 0);
                random_state += told == density;
            }
            graze_scene_destroy(scene);
        }
}

/* The integral of the radiance, by brute force. */
static double integral_of(const scene_light *light, double area) {
    enum { SIDE = 1000 };
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        vec3 d =
            solid_angle_draw_cone(light->center, light->half_angle, (i / SIDE + 0.5) / SIDE, (i % SIDE + 0.5) / SIDE);
        sum += light_patterned(light, light->radiance, vec3_make(0, 0, 0), d, d, GEOMETRY_FAR, 0).r;
    }
    return sum / (SIDE * SIDE) * area;
}

/* The integral of the density over the source is 1, and of radiance: the mean of what draws find is the same as that of
 * directions drawn alike, with much less variance. */
static void draws_are_unbiased(void **state) {
    (void)state;
    enum { DRAWS = 40000 };
    uint64_t random_state = 11;
    for (int f = 0; f < 4; f++)
        for (int s = 0; s < 3; s++) {
            graze_scene *scene = source_scene(functions[f], sources[s]);
            const scene_light *light = &scene->lights[0];
            double area = 4 * PI * pow(sin(light->half_angle / 2), 2), integral = 0, square = 0, ones = 0;
            for (int i = 0; i < DRAWS; i++) {
                const double random[2] = {uniform(&random_state), (i + 0.5) / DRAWS};
                light_sample sample = light_draw(scene, vec3_make(0, 0, 0), 0, 0, random);
                double found = sample.radiance.r / sample.density;
                integral += found / DRAWS;
                square += found * found / DRAWS;
                ones += 1 / sample.density / DRAWS;
            }
            double deviation = sqrt(fmax(square - integral * integral, 0));
            assert_true(fabs(ones - area) < 0.05 * area);
            double expected = integral_of(light, area);
            if (!(fabs(integral - expected) < 5 * deviation / sqrt(DRAWS) + 0.001 * expected))
                fail_msg("%s from %s: %g, not %g", functions[f], sources[s], integral, expected);
            /* Good enough to choose lights by. */
            if (!(fabs(light->typical.r * area - expected) < 0.2 * expected))
                fail_msg("%s from %s: typical %g, not %g", functions[f], sources[s], light->typical.r * area, expected);
            /* Drawn alike they would have up to 10 times the mean. */
            if (!(deviation < 0.8 * integral))
                fail_msg("%s from %s: deviation %g of %g", functions[f], sources[s], deviation, integral);
            graze_scene_destroy(scene);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_have_their_density),
        cmocka_unit_test(draws_are_unbiased),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
