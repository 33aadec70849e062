/* ashik2 and mirror: the formula typed anew from Radiance's manual, energy, and samples against values. */
#include "support.h"

#define PI ((double)SUPPORT_PI)

static graze_material ashik2(generator *g, double least, double most) {
    graze_material m = {.kind = GRAZE_ASHIKHMIN, .has_orientation = 1, .orientation = random_direction(g)};
    m.color = (rgb){0.3, 0.5, 0.1};
    m.specular_color = (rgb){0.7, 0.5, 0.05};
    m.power_u = least * pow(most / least, uniform(g));
    m.power_v = least * pow(most / least, uniform(g));
    m.roughness_u = sqrt(2 / (m.power_u + 2));
    m.roughness_v = sqrt(2 / (m.power_v + 2));
    return m;
}

static double schlick(double cosine) {
    return pow(1 - cosine, 5);
}

static void the_value_is_radiances(void **state) {
    (void)state;
    generator g = {41};
    for (int i = 0; i < 2000; i++) {
        graze_material m = ashik2(&g, 1, 1e4);
        graze_surface s = prepare(&m, &g, 0.01 + 0.99 * uniform(&g));
        vec3 l = direction_at(&g, s.n, 0.01 + 0.99 * uniform(&g));
        double lz = vec3_dot(l, s.n), vz = s.local_view.z;
        vec3 v = vec3_normalize(vec3_cross(s.n, m.orientation)), u = vec3_cross(v, s.n);
        vec3 h = vec3_normalize(vec3_add(l, s.view));
        double hu = vec3_dot(h, u), hv = vec3_dot(h, v), hn = vec3_dot(h, s.n);
        double exponent = (m.power_u * hu * hu + m.power_v * hv * hv) / (1 - hn * hn);
        double lobe =
            sqrt((m.power_u + 1) * (m.power_v + 1)) * pow(hn, exponent) / (8 * PI * vec3_dot(l, h) * fmax(lz, vz));
        double green = 0.5 + 0.5 * schlick(vz);
        rgb diffuse, glossy;
        graze_surface_value(&s, l, &diffuse, &glossy);
        assert_close_relative(glossy.g + 1e-9, green * lobe + 1e-9, 1e-6);
        double blue = fmin(0.1, 1 - (0.05 + 0.95 * schlick(vz)));
        assert_close_relative(diffuse.b, blue * (1 - schlick(lz)) / PI, 1e-9);
        assert_true(diffuse.g <= (1 - green) / PI + 1e-12);
    }
}

static void samples_weigh_what_values_say(void **state) {
    (void)state;
    generator g = {42};
    int kept = 0;
    for (int i = 0; i < 20000; i++) {
        graze_material m = ashik2(&g, 0.5, 1e4);
        graze_surface s = prepare(&m, &g, 0.01 + 0.99 * uniform(&g));
        graze_surface_sample sample = draw(&s, GRAZE_LOBE_GLOSSY, &g);
        assert_unit(sample.direction);
        assert_true(sample.weight.r <= s.specular.r * (1 + 1e-12));
        if (sample.density == 0) {
            assert_true(rgb_is_black(sample.weight));
            continue;
        }
        rgb diffuse, glossy;
        graze_surface_value(&s, sample.direction, &diffuse, &glossy);
        double density = graze_surface_density(&s, GRAZE_LOBE_GLOSSY, sample.direction);
        double cosine = vec3_dot(sample.direction, s.n);
        assert_close_relative(sample.density, density, 1e-6);
        if (cosine > 1e-3)
            assert_close_relative(sample.weight.g, glossy.g * cosine / density, 1e-9);
        kept++;
    }
    assert_true(kept > 12000);
}

/* The integral of the density over all directions above the surface is the part of the samples that is kept. */
static void the_density_is_that_of_the_samples(void **state) {
    (void)state;
    generator g = {43};
    for (int round = 0; round < 6; round++) {
        graze_material m = ashik2(&g, 1, 60);
        graze_surface s = prepare(&m, &g, (const double[]){1, 0.8, 0.5, 0.3, 0.1, 0.02}[round]);
        frame f = {s.x, s.y, s.n};
        const int steps = 400, count = 100000;
        double integral = 0, kept = 0, upper = 0, found = 0;
        for (int i = 0; i < steps; i++)
            for (int k = 0; k < steps; k++) {
                double z = (i + 0.5) / steps, r = sqrt(1 - z * z), angle = 2 * PI * (k + 0.5) / steps;
                vec3 l = frame_to_world(&f, vec3_make(r * cos(angle), r * sin(angle), z));
                double part = graze_surface_density(&s, GRAZE_LOBE_GLOSSY, l) * 2 * PI / steps / steps;
                integral += part;
                upper += z > 0.5 ? part : 0;
            }
        for (int i = 0; i < count; i++) {
            double r0 = uniform(&g), r1 = uniform(&g);
            graze_surface_sample sample = graze_surface_sample_lobe(&s, GRAZE_LOBE_GLOSSY, r0, r1, 0);
            kept += (sample.density > 0) / (double)count;
            found += (sample.density > 0 && vec3_dot(sample.direction, s.n) > 0.5) / (double)count;
        }
        assert_true(fabs(kept - integral) < 5 * sqrt(0.25 / count) + 2e-3);
        assert_true(fabs(found - upper) < 5 * sqrt(0.25 / count) + 2e-3);
    }
}

static void mirrors_reflect_from_their_front(void **state) {
    (void)state;
    const graze_material m = {.kind = GRAZE_MIRROR, .color = {0.9, 0.5, 0.1}};
    const vec3 n = {0, 0, 1};
    graze_surface s;
    graze_surface_prepare(&s, &m, n, vec3_make(0.6, 0, 0.8), NULL);
    graze_surface_sample sample = graze_surface_sample_lobe(&s, GRAZE_LOBE_MIRROR, 0, 0, 0);
    assert_rgb(sample.weight, 0.9, 0.5, 0.1, 0);
    assert_true(vec3_length(vec3_subtract(sample.direction, vec3_make(-0.6, 0, 0.8))) < 1e-15);
    assert_false(s.transmits);
    graze_surface_prepare(&s, &m, n, vec3_make(0.6, 0, -0.8), NULL);
    assert_int_equal(s.specular_lobe, GRAZE_LOBE_NONE);
    assert_true(rgb_is_black(s.specular) && rgb_is_black(s.diffuse));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_value_is_radiances),
        cmocka_unit_test(samples_weigh_what_values_say),
        cmocka_unit_test(the_density_is_that_of_the_samples),
        cmocka_unit_test(mirrors_reflect_from_their_front),
    };
    return cmocka_run_group_tests_name("material/ashikhmin", tests, NULL, NULL);
}
