/* Samplers against their densities: chi-square tests, and the integral of the density as the share of accepted samples.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "brdf/common.h"

/* Bins in the scaled slope (hx/hz/ax, hy/hz/ay): rings of equal probability but for the horizon, and sectors. The last
 * bin is for rejected samples. */
enum { RINGS = 12, SECTORS = 24, BINS = RINGS * SECTORS + 1, SAMPLES = 60000 };

typedef double density_function(const graze_brdf *, graze_vec3, graze_vec3);

static graze_brdf_sample draw_ward(const graze_brdf *brdf, graze_vec3 v, uint64_t *seed) {
    double s = draw(seed), t = draw(seed);
    return graze_brdf_sample_ward(brdf, v, s, t);
}

static graze_brdf_sample draw_pair(const graze_brdf *brdf, graze_vec3 v, uint64_t *seed) {
    double s = draw(seed), t = draw(seed), u = draw(seed);
    return graze_brdf_sample_pair(brdf, v, s, t, u);
}

typedef struct sampler {
    const char *name;
    graze_brdf_sample (*sample)(const graze_brdf *, graze_vec3, uint64_t *);
    density_function *density;
} sampler;

static const sampler samplers[] = {{"Ward", draw_ward, graze_brdf_ward_density},
                                   {"paired", draw_pair, graze_brdf_pair_density}};

static double ring_edge(int ring) {
    return ring == RINGS ? 8 : sqrt(-log(1 - (double)ring / RINGS));
}

/* The distance in units of the roughness at which slopes of this azimuth send v below the surface. */
static double horizon(const graze_brdf *brdf, graze_vec3 v, double azimuth) {
    double x = brdf->alpha_x * cos(azimuth), y = brdf->alpha_y * sin(azimuth);
    double q = v.x * x + v.y * y, square = (x * x + y * y) * v.z;
    /* vz (1 - tau^2) + 2q = 0 for tau^2 = r^2 (x^2 + y^2) */
    double root = sqrt(q * q + square * v.z);
    return q >= 0 ? (q + root) / square : v.z / (root - q);
}

/* density x d(solid angle of l)/d(scaled slopes) at the slope r (ax cos, ay sin). */
static double slope_density(const graze_brdf *brdf, density_function *density, graze_vec3 v, double r, double azimuth) {
    double x = brdf->alpha_x * r * cos(azimuth), y = brdf->alpha_y * r * sin(azimuth), square = 1 + x * x + y * y;
    double q = v.x * x + v.y * y, scale = 2 * (q + v.z) / square;
    graze_vec3 l = {scale * x - v.x, scale * y - v.y, (v.z * (2 - square) + 2 * q) / square};
    /* reflection: 4 (v.h); the slope's solid angle: cos^3 */
    return density(brdf, l, v) * 4 * (q + v.z) / (square * square) * brdf->alpha_x * brdf->alpha_y;
}

static const double gauss_nodes[] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
static const double gauss_weights[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};

/* The integral of the density over [low, high] of one azimuth. */
static double integrate_smooth(const graze_brdf *brdf, density_function *density, graze_vec3 v, double low, double high,
                               double azimuth) {
    double sum = 0, step = (high - low) / ceil((high - low) / .4);
    if (!(low < high))
        return 0;
    for (int i = 0; low + step * (i + .5) < high; ++i)
        for (int k = 0; k < 4; ++k) {
            double r = low + step * (i + gauss_nodes[k]);
            sum += gauss_weights[k] * step * r * slope_density(brdf, density, v, r, azimuth);
        }
    return sum;
}

/* The same, as far as the horizon is. Where the partner's horizon is, the paired sampling's density has a kink. */
static double integrate_ray(const graze_brdf *brdf, density_function *density, graze_vec3 v, double low, double high,
                            double azimuth) {
    double edge = fmin(high, horizon(brdf, v, azimuth));
    double kink = fmax(low, fmin(edge, horizon(brdf, v, azimuth + pi)));
    return integrate_smooth(brdf, density, v, low, kink, azimuth) +
           integrate_smooth(brdf, density, v, kink, edge, azimuth);
}

/* An azimuth of slopes across the view's plane: beside it, at grazing angles, the horizon leaps. */
static double azimuth_across(const graze_brdf *brdf, graze_vec3 v) {
    return atan2(-v.x * brdf->alpha_x, v.y * brdf->alpha_y);
}

/* The integral over azimuths of rings [low, high], by a rule that crowds at both ends. */
static double integrate_sector(const graze_brdf *brdf, density_function *density, graze_vec3 v, double low, double high,
                               double from, double to, int steps) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        double s = (i + .5) / steps, a = pow(s, 4), b = pow(1 - s, 4), ab = a + b;
        double slope = 4 * pow(s * (1 - s), 3) / (ab * ab); /* of a/(a + b) */
        sum += slope / steps * (to - from) * integrate_ray(brdf, density, v, low, high, from + (to - from) * a / ab);
    }
    return sum;
}

static void expected_masses(double *mass, const graze_brdf *brdf, density_function *density, graze_vec3 v) {
    enum { STEPS = 14 };
    const double width = 2 * pi / SECTORS;
    double total = 0;
    for (int bin = 0; bin < BINS - 1; ++bin) {
        double low = ring_edge(bin / SECTORS), high = ring_edge(bin / SECTORS + 1), from = width * (bin % SECTORS);
        /* how far into the sector it is to the next leap */
        double leap = fmod(azimuth_across(brdf, v) - from + 4 * pi, pi), middle = from + fmin(leap, width);
        mass[bin] = integrate_sector(brdf, density, v, low, high, from, middle, STEPS) +
                    integrate_sector(brdf, density, v, low, high, middle, from + width, STEPS);
        total += mass[bin];
    }
    mass[BINS - 1] = 1 - total;
}

static int bin_of(const graze_brdf *brdf, const graze_brdf_sample *sample, graze_vec3 v) {
    if (!(sample->density > 0))
        return BINS - 1;
    double hz = sample->l.z + v.z;
    double x = (sample->l.x + v.x) / hz / brdf->alpha_x, y = (sample->l.y + v.y) / hz / brdf->alpha_y;
    int ring = (int)(RINGS * (1 - exp(-(x * x + y * y))));
    int sector = (int)((atan2(y, x) / (2 * pi) + 1) * SECTORS) % SECTORS;
    return (ring < RINGS ? ring : RINGS - 1) * SECTORS + sector;
}

/* The probability that samples are as far as this from the density, or farther. Bins that expect fewer than 5 are put
 * together. */
static double p_value(const sampler *tested, const graze_brdf *brdf, graze_vec3 v, uint64_t seed) {
    double mass[BINS], chi_square = 0, small_mass = 0;
    int found[BINS] = {0}, small_found = 0, terms = 0;
    expected_masses(mass, brdf, tested->density, v);
    for (int i = 0; i < SAMPLES; ++i) {
        graze_brdf_sample sample = tested->sample(brdf, v, &seed);
        ++found[bin_of(brdf, &sample, v)];
    }
    for (int bin = 0; bin < BINS; ++bin) {
        double expected = mass[bin] * SAMPLES;
        if (expected < 5) {
            small_mass += mass[bin];
            small_found += found[bin];
            continue;
        }
        chi_square += (found[bin] - expected) * (found[bin] - expected) / expected;
        ++terms;
    }
    double expected = small_mass * SAMPLES;
    if (expected >= 5) {
        chi_square += (small_found - expected) * (small_found - expected) / expected;
        ++terms;
    } else if (small_found > 25) { /* 5 expected: never */
        return 0;
    }
    return chi_square_p_value(chi_square, terms - 1);
}

static const double roughness_pairs[][2] = {{.05, .05}, {.3, .3}, {1, 1}, {.02, .3}, {.8, .1}, {1e-4, 2e-4}};
static const double views[][2] = {{0, 0},    {30, 0},  {45, 70},   {60, 90},       {75, 20},
                                  {85, 135}, {89, 33}, {89.9, 60}, {89.99999, 10}, {90 - 1e-11, 80}};
enum {
    ROUGHNESS_PAIRS = sizeof roughness_pairs / sizeof *roughness_pairs,
    VIEWS = sizeof views / sizeof *views,
    CONFIGURATIONS = ROUGHNESS_PAIRS * VIEWS,
};

static graze_brdf configured_brdf(int i) {
    const double *alpha = roughness_pairs[i % ROUGHNESS_PAIRS];
    return (graze_brdf){GRAZE_BRDF_GMD, alpha[0], alpha[1]};
}

static graze_vec3 configured_view(int i) {
    return from_degrees(views[i / ROUGHNESS_PAIRS][0], views[i / ROUGHNESS_PAIRS][1]);
}

static void chi_square(const sampler *tested) {
    const double significance = .01, each = 1 - pow(1 - significance, 1. / CONFIGURATIONS); /* Sidak */
    for (int i = 0; i < CONFIGURATIONS; ++i) {
        graze_brdf brdf = configured_brdf(i);
        graze_vec3 v = configured_view(i);
        double p = p_value(tested, &brdf, v, 1000 + (uint64_t)i);
        if (!(p > each))
            fail_msg("%s sampling, alpha %g %g, view %g %g degrees: p = %g", tested->name, brdf.alpha_x, brdf.alpha_y,
                     views[i / ROUGHNESS_PAIRS][0], views[i / ROUGHNESS_PAIRS][1], p);
    }
}

static void ward_samples_follow_their_density(void **state) {
    (void)state;
    chi_square(&samplers[0]);
}

static void paired_samples_follow_their_density(void **state) {
    (void)state;
    chi_square(&samplers[1]);
}

/* P(lz > 0) from slopes alone: 1 - exp(-R^2) of each azimuth, put as a density so that the same rule integrates it. For
 * pairs, the larger R of p and -p counts. */
static double accepted_share(const graze_brdf *brdf, graze_vec3 v, int pair) {
    enum { STEPS = 4000 };
    double sum = 0, across = azimuth_across(brdf, v);
    for (int half = 0; half < 2; ++half)
        for (int i = 0; i < STEPS; ++i) {
            double s = (i + .5) / STEPS, a = pow(s, 4), b = pow(1 - s, 4), ab = a + b;
            double azimuth = across + pi * (half + a / ab), edge = horizon(brdf, v, azimuth);
            if (pair)
                edge = fmax(edge, horizon(brdf, v, azimuth + pi));
            sum -= 4 * pow(s * (1 - s), 3) / (ab * ab) * expm1(-edge * edge);
        }
    return sum / STEPS / 2;
}

static void densities_integrate_to_what_is_accepted(void **state) {
    (void)state;
    for (int i = 0; i < CONFIGURATIONS; ++i)
        for (int k = 0; k < 2; ++k) {
            graze_brdf brdf = configured_brdf(i);
            graze_vec3 v = configured_view(i);
            double across = azimuth_across(&brdf, v), sum = 0;
            for (int half = 0; half < 2; ++half)
                sum += integrate_sector(&brdf, samplers[k].density, v, 0, 6, across + pi * half,
                                        across + pi * (half + 1), 100);
            double share = accepted_share(&brdf, v, k), error = sum - share;
            if (!(fabs(error) < 1e-6))
                fail_msg("%s density, alpha %g %g, view %g %g: %g more than %g", samplers[k].name, brdf.alpha_x,
                         brdf.alpha_y, views[i / ROUGHNESS_PAIRS][0], views[i / ROUGHNESS_PAIRS][1], error, share);
        }
}

/* (32): at grazing angles Ward's sampling rejects half of all, the paired one next to nothing. */
static void half_is_rejected_at_grazing_angles(void **state) {
    (void)state;
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .1, .1};
    graze_vec3 v = direction(1e-150, 1);
    uint64_t seed = 9;
    int ward = 0, pair = 0;
    for (int i = 0; i < 40000; ++i) {
        ward += draw_ward(&brdf, v, &seed).weight > 0;
        pair += draw_pair(&brdf, v, &seed).weight > 0;
    }
    assert_true(abs(ward - 20000) < 500); /* five standard deviations */
    assert_int_equal(pair, 40000);
}

/* The table of standard deviations in the section on paired sampling. */
static void pairs_have_less_variance(void **state) {
    (void)state;
    const double expected[][3] = {{60, .135, .032}, {89, .83, .075}, {89.9, .96, .047}};
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .1, .1};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k) {
            enum { COUNT = 200000 };
            graze_vec3 v = from_degrees(expected[i][0], 0);
            double sum = 0, squares = 0;
            uint64_t seed = 10;
            for (int n = 0; n < COUNT; ++n) {
                double weight = samplers[k].sample(&brdf, v, &seed).weight;
                sum += weight;
                squares += weight * weight;
            }
            double deviation = sqrt(squares / COUNT - sum / COUNT * (sum / COUNT));
            assert_true(fabs(deviation / expected[i][k + 1] - 1) < .02);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ward_samples_follow_their_density),
        cmocka_unit_test(paired_samples_follow_their_density),
        cmocka_unit_test(densities_integrate_to_what_is_accepted),
        cmocka_unit_test(half_is_rejected_at_grazing_angles),
        cmocka_unit_test(pairs_have_less_variance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
