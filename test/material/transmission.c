/* Surfaces that light goes through: trans of both roughnesses, glass and dielectrics, against what is typed anew from
 * Radiance's documents, and against each other. */
#include "support.h"

#include <float.h>
#include <stdbool.h>

#define PI ((double)SUPPORT_PI)

static graze_material trans(double specularity, double u, double v, double transmission, double transmitted) {
    graze_material m = material_make(GRAZE_TRANS, (rgb){0.9, 0.5, 0.1}, specularity, u, v);
    m.transmission = transmission;
    m.transmitted_specularity = transmitted;
    return m;
}

static graze_material random_trans(generator *g, double least, double most) {
    double u = least * pow(most / least, uniform(g)), v = least * pow(most / least, uniform(g));
    graze_material m = trans(0.2 * uniform(g), u, v, uniform(g), uniform(g));
    m.has_orientation = 1;
    m.orientation = random_direction(g);
    return m;
}

/* rdiff = 1 - rspec - trans, trans = (1 - rspec) t, tspec = trans p. */
static void a_trans_divides_its_light(void **state) {
    (void)state;
    generator g = {1};
    for (int i = 0; i < 100; i++) {
        bool mirror = i % 2;
        double spec = 0.05, t = uniform(&g), p = uniform(&g), cosine = 0.01 + 0.99 * uniform(&g);
        graze_material m = trans(spec, mirror ? 0 : 0.1, mirror ? 0 : 0.1, t, p);
        graze_surface s = prepare(&m, &g, cosine);
        double rspec = mirror ? spec + (exp(-5.85 * cosine) - 0.00287989916) * (1 - spec) : spec;
        double through = (1 - rspec) * t;
        assert_rgb(s.specular, rspec, rspec, rspec, 1e-12);
        assert_close_relative(s.diffuse.g, 0.5 * (1 - rspec - through), 1e-11);
        assert_close_relative(s.transmitted_specular.g, 0.5 * through * p, 1e-12);
        assert_close_relative(s.transmitted_diffuse.r, 0.9 * through * (1 - p), 1e-11);
        assert_int_equal(s.transmitted_lobe, mirror ? GRAZE_LOBE_TRANSMITTED : GRAZE_LOBE_TRANSMITTED_GLOSSY);
        rgb straight = graze_material_straight_through(&m, cosine);
        if (mirror)
            assert_rgb(straight, s.transmitted_specular.r, s.transmitted_specular.g, s.transmitted_specular.b, 1e-9);
        else
            assert_true(rgb_is_black(straight));
    }
}

/* Radiance's formula for light from the other side, where the two cosines are within a factor of 4. */
static void the_rough_lobe_is_radiances_gaussian(void **state) {
    (void)state;
    generator g = {2};
    int count = 0;
    for (int i = 0; i < 2000; i++) {
        double alpha = 0.02 + 0.5 * uniform(&g);
        graze_material m = trans(0, alpha, alpha, 1, 1);
        graze_surface s = prepare(&m, &g, 0.05 + 0.95 * uniform(&g));
        vec3 l = random_direction(&g);
        double lz = -vec3_dot(l, s.n), vz = s.local_view.z;
        rgb diffuse, glossy;
        graze_surface_value(&s, l, &diffuse, &glossy);
        if (!(lz > vz / 4 && lz < 4 * vz))
            continue;
        double gauss = exp((2 * -vec3_dot(s.view, l) - 2) / (alpha * alpha)) / (PI * alpha * alpha);
        assert_close_relative(glossy.g, 0.5 * gauss * sqrt(lz / vz) / lz, 1e-10);
        count++;
    }
    assert_true(count > 500);
}

/* The widths across the direction straight on are the two roughnesses, however oblique that is. */
static void the_anisotropic_lobe_has_two_widths(void **state) {
    (void)state;
    graze_material m = trans(0, 0.05, 0.2, 1, 1);
    m.has_orientation = 1;
    m.orientation = vec3_make(1, 0, 0);
    for (int i = 0; i < 4; i++) {
        double tilt = 0.3 * i, turn = 0.01;
        /* Seen in the plane of u, and turned in it or out of it. */
        graze_surface s;
        graze_surface_prepare(&s, &m, vec3_make(0, 0, 1), vec3_make(sin(tilt), 0, cos(tilt)), NULL);
        vec3 d = vec3_negate(s.view), in = {cos(tilt), 0, -sin(tilt)}, out = {0, 1, 0};
        const vec3 ways[] = {in, out};
        for (int k = 0; k < 2; k++) {
            vec3 l = vec3_normalize(vec3_add_scaled(vec3_scale(cos(turn), d), sin(turn), ways[k]));
            double alpha = k ? 0.2 : 0.05, chord = 2 * sin(turn / 2);
            rgb diffuse, glossy;
            graze_surface_value(&s, l, &diffuse, &glossy);
            double gauss = exp(-chord * chord / (alpha * alpha)) / (PI * 0.05 * 0.2);
            assert_close_relative(glossy.r, 0.9 * gauss / sqrt(-l.z * cos(tilt)), 1e-9);
        }
    }
}

static void transmission_is_reciprocal(void **state) {
    (void)state;
    generator g = {3};
    for (int i = 0; i < 2000; i++) {
        bool mirror = i % 3 == 0;
        double alpha = mirror ? 0 : 0.01 + uniform(&g);
        graze_material m = trans(0.1, alpha, alpha, 0.7, 0.6);
        vec3 n = {0, 0, 1}, below = {0, 0, -1}, v = direction_at(&g, n, 0.01 + 0.98 * uniform(&g));
        vec3 l = direction_at(&g, below, 0.01 + 0.98 * uniform(&g));
        graze_surface s, back;
        graze_surface_prepare(&s, &m, n, v, NULL);
        graze_surface_prepare(&back, &m, below, l, NULL);
        rgb diffuse, glossy, back_diffuse, back_glossy;
        graze_surface_value(&s, l, &diffuse, &glossy);
        graze_surface_value(&back, v, &back_diffuse, &back_glossy);
        assert_close_relative(diffuse.r, back_diffuse.r, 1e-12);
        assert_close_relative(glossy.r + DBL_MIN, back_glossy.r + DBL_MIN, 1e-9);
    }
}

static void weight_is_value_cosine_over_density(void **state) {
    (void)state;
    generator g = {4};
    int kept = 0;
    for (int i = 0; i < 40000; i++) {
        graze_material m = random_trans(&g, 1e-3, 1.5);
        graze_surface s = prepare(&m, &g, i % 4 ? 0.02 + 0.98 * uniform(&g) : 0.02 * uniform(&g));
        graze_lobe lobe = i % 2 ? GRAZE_LOBE_TRANSMITTED_GLOSSY : GRAZE_LOBE_TRANSMITTED_DIFFUSE;
        graze_surface_sample sample = draw(&s, lobe, &g);
        assert_unit(sample.direction);
        assert_finite_nonnegative(sample.weight);
        double cosine = -vec3_dot(sample.direction, s.n);
        if (sample.density == 0) {
            assert_true(rgb_is_black(sample.weight));
            continue;
        }
        rgb most = lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY ? s.transmitted_specular : s.transmitted_diffuse;
        assert_true(sample.weight.r <= most.r * (1 + 1e-12));
        if (cosine < 1e-3)
            continue;
        kept++;
        rgb diffuse, glossy;
        double density = graze_surface_density(&s, lobe, sample.direction);
        graze_surface_value(&s, sample.direction, &diffuse, &glossy);
        rgb value = lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY ? glossy : diffuse;
        assert_rgb(sample.weight, value.r * cosine / density, value.g * cosine / density, value.b * cosine / density,
                   1e-8);
        assert_close_relative(sample.density, density, 1e-6);
    }
    assert_true(kept > 30000);
}

/* Below the surface: by cosines from the direction straight on and angles about it, chords in equal steps of what the
 * Gaussian leaves. */
static void integrate(const graze_surface *s, double alpha, double *albedo, double *density) {
    const int steps = 400, turns = 200;
    frame f = frame_around(s->transmitted);
    *albedo = *density = 0;
    for (int i = 0; i < steps; i++) {
        double x = -alpha * alpha / 2 * log1p(-(i + 0.5) / steps),
               measure_x = alpha * alpha / 2 / (1 - (i + 0.5) / steps);
        if (x >= 2)
            continue;
        double cosine = 1 - x, sine = sqrt(x * (2 - x));
        for (int k = 0; k < turns; k++) {
            double angle = 2 * PI * (k + 0.5) / turns;
            vec3 l = frame_to_world(&f, vec3_make(sine * cos(angle), sine * sin(angle), cosine));
            rgb diffuse, glossy;
            graze_surface_value(s, l, &diffuse, &glossy);
            double below = fmax(0, -vec3_dot(l, s->n)), measure = measure_x / steps * 2 * PI / turns;
            *albedo += glossy.r * below * measure;
            *density += (below > 0 ? graze_surface_density(s, GRAZE_LOBE_TRANSMITTED_GLOSSY, l) : 0) * measure;
        }
    }
}

/* No more than everything gets through, towards the horizon neither, and the density is that of all samples kept. */
static void the_rough_lobe_keeps_energy(void **state) {
    (void)state;
    generator g = {5};
    const double cosines[] = {1, 0.8, 0.5, 0.2, 0.05, 0.01}, roughnesses[] = {0.02, 0.1, 0.3, 1};
    for (int i = 0; i < 24; i++) {
        double alpha = roughnesses[i % 4], cosine = cosines[i / 4], albedo, density;
        graze_material m = trans(0, alpha, alpha, 1, 1);
        m.color = (rgb){1, 1, 1};
        graze_surface s = prepare(&m, &g, cosine);
        integrate(&s, alpha, &albedo, &density);
        const int count = 40000;
        double kept = 0, sum = 0;
        for (int k = 0; k < count; k++) {
            graze_surface_sample sample = draw(&s, GRAZE_LOBE_TRANSMITTED_GLOSSY, &g);
            kept += (sample.density > 0) / (double)count;
            sum += sample.weight.r / count;
        }
        assert_true(albedo <= 1 && albedo > 0.2);
        assert_true(fabs(density - kept) < 4 * sqrt(fmax(kept * (1 - kept), 0) / count) + 4e-3);
        assert_true(fabs(albedo - sum) < 6e-3);
    }
}

/* Where they go: directions in 6 x 8 boxes about the direction straight on, by chord and angle, against the integrated
 * density. */
static void samples_follow_their_density(void **state) {
    (void)state;
    generator g = {6};
    enum { TURNS = 8, RINGS = 6, FINE = 40 };
    for (int round = 0; round < 6; round++) {
        graze_material m = random_trans(&g, 0.05, 0.4);
        m.transmission = m.transmitted_specularity = 1;
        graze_surface s = prepare(&m, &g, (const double[]){0.9, 0.5, 0.2, 0.1, 0.05, 0.02}[round]);
        frame f = frame_around(s.transmitted);
        double most = 1, expected[RINGS][TURNS] = {{0}}, found[RINGS][TURNS] = {{0}};
        for (int i = 0; i < RINGS * FINE; i++)
            for (int k = 0; k < TURNS * FINE; k++) {
                double chord = most * (i + 0.5) / (RINGS * FINE), angle = 2 * PI * (k + 0.5) / (TURNS * FINE);
                double cosine = 1 - chord * chord / 2, sine = sqrt(1 - cosine * cosine);
                vec3 l = frame_to_world(&f, vec3_make(sine * cos(angle), sine * sin(angle), cosine));
                expected[i / FINE][k / FINE] += graze_surface_density(&s, GRAZE_LOBE_TRANSMITTED_GLOSSY, l) * chord *
                                                most / (RINGS * FINE) * 2 * PI / (TURNS * FINE);
            }
        const int count = 200000;
        for (int i = 0; i < count; i++) {
            graze_surface_sample sample = draw(&s, GRAZE_LOBE_TRANSMITTED_GLOSSY, &g);
            vec3 l = frame_to_local(&f, sample.direction);
            double turn = atan2(l.y, l.x) / (2 * PI);
            int ring = (int)(sqrt(2 - 2 * l.z) / most * RINGS), box = (int)((turn < 0 ? turn + 1 : turn) * TURNS);
            if (sample.density > 0 && ring < RINGS && box < TURNS)
                found[ring][box]++;
        }
        double square = 0, freedom = 0;
        for (int i = 0; i < RINGS * TURNS; i++) {
            double e = count * expected[i / TURNS][i % TURNS], d = found[i / TURNS][i % TURNS] - e;
            if (e < 20)
                continue;
            square += d * d / (e + 1e-5 * e * e);
            freedom++;
        }
        if (!(freedom > 5 && square < freedom + 5 * sqrt(2 * freedom)))
            fail_msg("round %d: chi-square %g of %g", round, square, freedom);
    }
}

/* Fresnel's formulas as amplitudes of waves at the two faces, summed over all reflections in between. */
static void glass_sums_its_reflections(void **state) {
    (void)state;
    generator g = {7};
    for (int i = 0; i < 300; i++) {
        double index = 1 + uniform(&g), cosine = 0.02 + 0.98 * uniform(&g);
        graze_material m = {.kind = GRAZE_GLASS, .color = {uniform(&g), 1, 0.5}, .refraction = index};
        graze_surface s = prepare(&m, &g, cosine);
        double outside = acos(cosine), inside = asin(sin(outside) / index);
        const double colours[] = {m.color.r, m.color.g, m.color.b};
        for (int c = 0; c < 3; c++) {
            double reflected = 0, transmitted = 0;
            for (int polarisation = 0; polarisation < 2; polarisation++) {
                double r = polarisation ? sin(outside - inside) / sin(outside + inside)
                                        : tan(outside - inside) / tan(outside + inside);
                double face = r * r, body = pow(colours[c], 1 / cos(inside)), light = 1 - face;
                reflected += face / 2;
                for (int k = 0; k < 4000; k++) { /* face after face */
                    light *= body;
                    *(k % 2 ? &reflected : &transmitted) += light * (1 - face) / 2;
                    light *= face;
                }
            }
            assert_close_relative(channel(s.specular, c), reflected, 1e-9);
            assert_close_relative(channel(s.transmitted_specular, c), transmitted, 1e-9);
            assert_true(channel(s.specular, c) + channel(s.transmitted_specular, c) <= 1 + 1e-12);
        }
        rgb straight = graze_material_straight_through(&m, cosine);
        assert_rgb(straight, s.transmitted_specular.r, s.transmitted_specular.g, s.transmitted_specular.b, 1e-10);
        assert_true(vec3_length(vec3_add(s.transmitted, s.view)) == 0);
    }
}

/* Energy, Snell's law, and the way back. */
static void dielectrics_refract(void **state) {
    (void)state;
    generator g = {8};
    int total = 0;
    for (int i = 0; i < 1000; i++) {
        double index = 0.5 + 2 * uniform(&g), cosine = 0.001 + 0.999 * uniform(&g);
        graze_material m = {.kind = GRAZE_DIELECTRIC, .refraction = index, .inside = {1, 1, 1}, .outside = {1, 1, 1}};
        vec3 front = random_direction(&g), n = i % 2 ? vec3_negate(front) : front, view = direction_at(&g, n, cosine);
        graze_surface s, back;
        graze_surface_prepare(&s, &m, front, view, NULL);
        double ratio = i % 2 ? 1 / index : index; /* index beyond over index here */
        assert_close_relative(vec3_dot(s.n, n), 1, 1e-14);
        double sine = sqrt(1 - cosine * cosine) / ratio;
        if (sine >= 1) {
            total++;
            assert_int_equal(s.transmits, 0);
            assert_rgb(s.specular, 1, 1, 1, 0);
            continue;
        }
        assert_close_relative(s.specular.r + s.transmitted_specular.r * ratio * ratio, 1, 1e-12);
        vec3 d = s.transmitted;
        assert_unit(d);
        assert_close_relative(-vec3_dot(d, n), sqrt(1 - sine * sine), 1e-9);
        double outside = acos(cosine), inside = asin(sine);
        double across = sin(outside - inside) / sin(outside + inside);
        double along = tan(outside - inside) / tan(outside + inside);
        if (fabs(ratio - 1) > 0.01)
            assert_close_relative(s.specular.g, (across * across + along * along) / 2, 1e-6);
        graze_surface_prepare(&back, &m, front, d, NULL);
        assert_close_relative(back.specular.r + 1e-9, s.specular.r + 1e-9, 1e-6);
        assert_true(vec3_length(vec3_subtract(back.transmitted, view)) < 1e-9);
    }
    assert_true(total > 100);
}

static void clear_bodies_attenuate(void **state) {
    (void)state;
    const graze_material m = {
        .kind = GRAZE_DIELECTRIC, .refraction = 1.5, .inside = {0.5, 0, 1}, .outside = {0.25, 1, 1}};
    const graze_material glass = {.kind = GRAZE_GLASS, .color = {0.5, 0.5, 0.5}, .refraction = 1.5};
    assert_rgb(graze_material_attenuation(&m, 1, 3), 0.125, 0, 1, 1e-14);
    assert_rgb(graze_material_attenuation(&m, 0, 0.5), 0.5, 1, 1, 1e-14);
    assert_rgb(graze_material_attenuation(&m, 1, 0), 1, 1, 1, 0);
    assert_rgb(graze_material_attenuation(&glass, 1, 3), 1, 1, 1, 0);
}

/* Ends of all ranges. */
static void everything_is_finite(void **state) {
    (void)state;
    generator g = {9};
    const double cosines[] = {0, 1e-150, 1e-12, 1e-3, 0.5, 1}, roughnesses[] = {0, 2e-6, 1e-3, 0.1, 1, 10};
    const double ends[] = {0, 0x1p-53, 0.5, 1 - 0x1p-53}, indices[] = {0.01, 1, 1.5, 100};
    for (int i = 0; i < 6 * 6 * 6 * 4 * 4; i++) {
        double c = cosines[i % 6];
        graze_material m = trans(i % 3 / 2.0, roughnesses[i / 6 % 6], roughnesses[i / 36 % 6], 1, 1);
        m.has_orientation = 1;
        m.orientation = random_direction(&g);
        if (i % 5 == 1)
            m = (graze_material){.kind = GRAZE_GLASS, .color = {0, 1, 0.5}, .refraction = fmax(1, indices[i % 4])};
        if (i % 5 == 2)
            m = (graze_material){.kind = GRAZE_DIELECTRIC, .refraction = indices[i % 4]};
        graze_surface s;
        const vec3 n = {0, 0, i % 2 ? 1 : -1};
        graze_surface_prepare(&s, &m, m.kind == GRAZE_DIELECTRIC ? vec3_make(0, 0, 1) : n,
                              vec3_make(sqrt(1 - c * c), 0, n.z * c), NULL);
        assert_finite_nonnegative(s.specular);
        assert_finite_nonnegative(graze_material_straight_through(&m, c));
        for (int lobe = GRAZE_LOBE_DIFFUSE; lobe <= GRAZE_LOBE_TRANSMITTED; lobe++) {
            graze_surface_sample sample =
                graze_surface_sample_lobe(&s, (graze_lobe)lobe, ends[i / 216 % 4], ends[i / 864 % 4], ends[i % 4]);
            rgb diffuse, glossy;
            assert_unit(sample.direction);
            assert_finite_nonnegative(sample.weight);
            assert_true(sample.density >= 0 && sample.density <= DBL_MAX);
            graze_surface_value(&s, sample.direction, &diffuse, &glossy);
            assert_finite_nonnegative(diffuse);
            assert_finite_nonnegative(glossy);
            double density = graze_surface_density(&s, (graze_lobe)lobe, sample.direction);
            assert_true(density >= 0 && density <= DBL_MAX);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_trans_divides_its_light),
        cmocka_unit_test(the_rough_lobe_is_radiances_gaussian),
        cmocka_unit_test(the_anisotropic_lobe_has_two_widths),
        cmocka_unit_test(transmission_is_reciprocal),
        cmocka_unit_test(weight_is_value_cosine_over_density),
        cmocka_unit_test(the_rough_lobe_keeps_energy),
        cmocka_unit_test(samples_follow_their_density),
        cmocka_unit_test(glass_sums_its_reflections),
        cmocka_unit_test(dielectrics_refract),
        cmocka_unit_test(clear_bodies_attenuate),
        cmocka_unit_test(everything_is_finite),
    };
    return cmocka_run_group_tests_name("material/transmission", tests, NULL, NULL);
}
