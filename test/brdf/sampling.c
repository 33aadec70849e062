/* Samplers against their densities: chi-square tests that notice a density off by 1%, mean weights against the albedo,
 * and the integral of the density as the share of accepted samples. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "brdf/common.h"
#include "graze/brdf_batch.h"

typedef double density_function(const graze_brdf *, graze_vec3, graze_vec3);

/* --- Samplers, many samples at a time ----------------------------------------------------------------------------- */

enum { CHUNK = 1024 };

typedef struct samples {
    double s[CHUNK], t[CHUNK], u[CHUNK], x[CHUNK], y[CHUNK], z[CHUNK], density[CHUNK], weight[CHUNK];
} samples;

typedef void draw_function(const graze_brdf *, graze_vec3 v, samples *);

typedef struct sampler {
    const char *name;
    draw_function *draw;
    density_function *density;
    bool is_pair, is_float;
} sampler;

static void fill(double *array, double x) {
    for (int i = 0; i < CHUNK; ++i)
        array[i] = x;
}

static void draw_double(const graze_brdf *brdf, graze_vec3 v, samples *a, bool is_pair) {
    double x[CHUNK], y[CHUNK], z[CHUNK];
    graze_vec3_arrays views = {x, y, z};
    graze_brdf_sample_arrays result = {a->x, a->y, a->z, a->density, a->weight};
    fill(x, v.x);
    fill(y, v.y);
    fill(z, v.z);
    if (is_pair)
        graze_brdf_sample_pair_batch(brdf, CHUNK, views, a->s, a->t, a->u, result);
    else
        graze_brdf_sample_ward_batch(brdf, CHUNK, views, a->s, a->t, result);
}

static void narrow(const double *from, float *to) {
    for (int i = 0; i < CHUNK; ++i)
        to[i] = fminf((float)from[i], 1 - 0x1p-24f);
}

static void widen(const float *from, double *to) {
    for (int i = 0; i < CHUNK; ++i)
        to[i] = (double)from[i];
}

static void draw_float(const graze_brdf *brdf, graze_vec3 v, samples *a, bool is_pair) {
    float x[CHUNK], y[CHUNK], z[CHUNK], s[CHUNK], t[CHUNK], u[CHUNK];
    float lx[CHUNK], ly[CHUNK], lz[CHUNK], density[CHUNK], weight[CHUNK];
    graze_vec3_float_arrays views = {x, y, z};
    graze_brdf_sample_float_arrays result = {lx, ly, lz, density, weight};
    for (int i = 0; i < CHUNK; ++i)
        x[i] = (float)v.x, y[i] = (float)v.y, z[i] = (float)v.z;
    narrow(a->s, s);
    narrow(a->t, t);
    narrow(a->u, u);
    if (is_pair)
        graze_brdf_sample_pair_float_batch(brdf, CHUNK, views, s, t, u, result);
    else
        graze_brdf_sample_ward_float_batch(brdf, CHUNK, views, s, t, result);
    widen(lx, a->x);
    widen(ly, a->y);
    widen(lz, a->z);
    widen(density, a->density);
    widen(weight, a->weight);
}

static void draw_ward(const graze_brdf *brdf, graze_vec3 v, samples *a) {
    draw_double(brdf, v, a, false);
}
static void draw_pair(const graze_brdf *brdf, graze_vec3 v, samples *a) {
    draw_double(brdf, v, a, true);
}
static void draw_ward_float(const graze_brdf *brdf, graze_vec3 v, samples *a) {
    draw_float(brdf, v, a, false);
}
static void draw_pair_float(const graze_brdf *brdf, graze_vec3 v, samples *a) {
    draw_float(brdf, v, a, true);
}

static const sampler ward = {"Ward", draw_ward, graze_brdf_ward_density, false, false};
static const sampler paired = {"paired", draw_pair, graze_brdf_pair_density, true, false};
static const sampler ward_float = {"Ward, float", draw_ward_float, graze_brdf_ward_density, false, true};
static const sampler paired_float = {"paired, float", draw_pair_float, graze_brdf_pair_density, true, true};

/* s within [low, high), t and u within [0,1): two drawn numbers are enough for three, and one if u is not needed. */
static void draw_numbers(samples *a, double low, double high, bool with_u, uint64_t *seed) {
    for (int i = 0; i < CHUNK; ++i) {
        double both = draw(seed) * 0x1p26, floored = (double)(int)both;
        a->s[i] = low + (high - low) * (both - floored);
        a->t[i] = floored * 0x1p-26;
        a->u[i] = with_u ? draw(seed) : 0;
    }
}

/* --- Where slopes are ----------------------------------------------------------------------------------------------
 */

/* The distance in units of the roughness at which slopes of this azimuth send v below the surface. */
static double horizon(const graze_brdf *brdf, graze_vec3 v, double azimuth) {
    double x = brdf->alpha_x * cos(azimuth), y = brdf->alpha_y * sin(azimuth);
    double q = v.x * x + v.y * y, square = (x * x + y * y) * v.z;
    /* vz (1 - tau^2) + 2q = 0 for tau^2 = r^2 (x^2 + y^2) */
    double root = sqrt(q * q + square * v.z);
    return q >= 0 ? (q + root) / square : v.z / (root - q);
}

/* An azimuth of slopes across the view's plane: beside it, at grazing angles, the horizon leaps. */
static double azimuth_across(const graze_brdf *brdf, graze_vec3 v) {
    return atan2(-v.x * brdf->alpha_x, v.y * brdf->alpha_y);
}

/* Slopes from further out are always rejected. */
static double farthest_horizon(const graze_brdf *brdf, graze_vec3 v) {
    double farthest = 0;
    for (int i = 0; i < 720; ++i)
        farthest = fmax(farthest, horizon(brdf, v, i * pi / 360));
    return farthest * 1.02;
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
    double largest = .4 / fmax(1, fmax(brdf->alpha_x, brdf->alpha_y)); /* W bends where the slope is about 1 */
    double sum = 0, step = (high - low) / ceil((high - low) / largest);
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

/* The integral over azimuths of rings [low, high], by a rule that crowds at both ends. */
static double integrate_sector(const graze_brdf *brdf, density_function *density, graze_vec3 v, double low, double high,
                               double from, double to, int steps) {
    double sum = 0;
    if (!(from < to))
        return 0;
    for (int i = 0; i < steps; ++i) {
        double s = (i + .5) / steps, a = pow(s, 4), b = pow(1 - s, 4), ab = a + b;
        double slope = 4 * pow(s * (1 - s), 3) / (ab * ab); /* of a/(a + b) */
        sum += slope / steps * (to - from) * integrate_ray(brdf, density, v, low, high, from + (to - from) * a / ab);
    }
    return sum;
}

/* P(lz > 0) from slopes alone: 1 - exp(-R^2) of each azimuth, put as a density so that the same rule integrates it. For
 * pairs, the larger R of p and -p counts. */
static double accepted_share(const graze_brdf *brdf, graze_vec3 v, bool pair) {
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

/* How far inside a circle of slopes the horizon is. */
static double horizon_within(const graze_brdf *brdf, graze_vec3 v, double azimuth, double radius) {
    return radius - horizon(brdf, v, azimuth);
}

/* From 0 to 1, crowded at both ends. */
static double crowded(double s) {
    return pow(s, 4) / (pow(s, 4) + pow(1 - s, 4));
}

/* Where between two azimuths the horizon (of slopes turned by `turn`) crosses a circle: appends them. */
static int find_crossings(const graze_brdf *brdf, graze_vec3 v, double from, double to, double turn, double radius,
                          double *where, int count, int most) {
    enum { STEPS = 24 };
    double before = from;
    for (int i = 1; i <= STEPS; ++i) {
        double low = before, high = from + (to - from) * crowded((double)i / STEPS);
        bool inside = horizon_within(brdf, v, low + turn, radius) > 0;
        before = high;
        if (count == most || (horizon_within(brdf, v, high + turn, radius) > 0) == inside)
            continue;
        for (int k = 0; k < 50; ++k) {
            double middle = (low + high) / 2;
            *((horizon_within(brdf, v, middle + turn, radius) > 0) == inside ? &low : &high) = middle;
        }
        where[count++] = low;
    }
    return count;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The same for any sector within a quarter of the plane. Leaps are made ends, and where a horizon crosses an edge; the
 * axes, where the horizon of very different roughnesses has its peaks, should be ends as well. */
static double integrate_cell(const graze_brdf *brdf, density_function *density, graze_vec3 v, double low, double high,
                             double from, double to, int steps) {
    enum { MOST = 32 };
    double leap = fmin(fmod(azimuth_across(brdf, v) - from + 4 * pi, pi) + from, to), sum = 0;
    double ends[MOST + 3] = {from, leap, to};
    int count = 3;
    for (int k = 0; k < 8; ++k)
        count = find_crossings(brdf, v, k & 1 ? from : leap, k & 1 ? leap : to, k & 2 ? 0 : pi, k & 4 ? low : high,
                               ends, count, MOST);
    qsort(ends, (size_t)count, sizeof *ends, compare_numbers);
    for (int i = 0; i + 1 < count; ++i)
        sum += integrate_sector(brdf, density, v, low, high, ends[i], ends[i + 1], steps);
    return sum;
}

/* --- The chi-square test --------------------------------------------------------------------------------------------
 */

/* Cells in the scaled slope (hx/hz/ax, hy/hz/ay): rings of equal probability but for the horizon, and sectors. The last
 * cell is for rejected samples. */
enum { RINGS = 3, SECTORS = 8, CELLS = RINGS * SECTORS + 1 };

/* With so many accepted samples, a density that is 1% too large for one half of them and too small for the other adds
 * 120 to chi-square, whose mean is 24 and whose bound 65: it is missed once in 4,000 times. */
static double accepted_samples(const sampler *tested) {
    return is_short_run() || tested->is_float ? 5e4 : 1.2e6;
}

typedef struct experiment {
    graze_brdf brdf;
    graze_vec3 v;
    double s_end;                /* larger s are always rejected, and not drawn */
    double squared_edges[RINGS]; /* of rings: their outer radii; the last one's is that of s_end, or 6.5 */
    double mass[CELLS];          /* expected, for s below s_end */
    long found[CELLS], count;
    double albedo, excess, squared_excess; /* sums of what weights are above the albedo */
} experiment;

static void expect(experiment *e, density_function *density, bool pair) {
    enum { STEPS = 14 };
    const double width = 2 * pi / SECTORS;
    double low = 0, sum = 0;
    for (int ring = 0; ring < RINGS; ++ring) {
        double high = fmin(sqrt(e->squared_edges[ring]), 6.5);
        for (int sector = 0; sector < SECTORS; ++sector) {
            double from = width * sector, to = width * (sector + 1);
            double mass = integrate_cell(&e->brdf, density, e->v, low, high, from, to, STEPS) / e->s_end;
            sum += e->mass[ring * SECTORS + sector] = mass;
        }
        low = high;
    }
    e->mass[CELLS - 1] = fmax(1 - accepted_share(&e->brdf, e->v, pair) / e->s_end, 0);
    assert_true(fabs(sum + e->mass[CELLS - 1] - 1) < 1e-4); /* a thousandth of what chance does to it all */
}

/* Eighths of a turn, counted from the x axis; without branches, which no processor could foresee. */
static int sector_of(double x, double y) {
    static const int sectors[8] = {0, 3, 7, 4, 1, 2, 6, 5};
    return sectors[(x < 0) + 2 * (y < 0) + 4 * (fabs(y) >= fabs(x))];
}

static void count_samples(experiment *e, const samples *a) {
    double over_x = 1 / e->brdf.alpha_x, over_y = 1 / e->brdf.alpha_y, sum = 0, squares = 0;
    for (int i = 0; i < CHUNK; ++i) {
        double hz = a->z[i] + e->v.z, x = (a->x[i] + e->v.x) * over_x, y = (a->y[i] + e->v.y) * over_y;
        double square = x * x + y * y, hz2 = hz * hz, excess = a->weight[i] * e->s_end - e->albedo;
        int ring = 0, accepted = a->density[i] > 0;
        for (int k = 0; k < RINGS - 1; ++k)
            ring += square >= e->squared_edges[k] * hz2;
        ++e->found[CELLS - 1 + accepted * (ring * SECTORS + sector_of(x, y) - (CELLS - 1))];
        sum += excess;
        squares += excess * excess;
    }
    e->excess += sum;
    e->squared_excess += squares;
    e->count += CHUNK;
}

/* The probability that samples are as far as this from the density, or farther. Cells that expect fewer than 5 are put
 * together. `excess` makes the expected density that much larger in cells that hold half of the accepted samples, and
 * smaller in the others. */
static double p_value(const experiment *e, double excess) {
    double chi_square = 0, accepted = 0, first_half = 0, small_mass = 0;
    long small_found = 0;
    int terms = 0, first_cells = 0;
    for (int cell = 0; cell < CELLS - 1; ++cell)
        accepted += e->mass[cell];
    while (first_half < accepted / 2)
        first_half += e->mass[first_cells++];
    for (int cell = 0; cell < CELLS; ++cell) {
        double change = cell == CELLS - 1    ? 0
                        : cell < first_cells ? excess
                                             : -excess * first_half / (accepted - first_half);
        double expected = e->mass[cell] * (double)e->count * (1 + change);
        if (expected < 5) {
            small_mass += e->mass[cell];
            small_found += e->found[cell];
            continue;
        }
        double difference = (double)e->found[cell] - expected;
        chi_square += difference * difference / expected;
        ++terms;
    }
    double expected = small_mass * (double)e->count;
    if (expected >= 5) {
        chi_square += ((double)small_found - expected) * ((double)small_found - expected) / expected;
        ++terms;
    } else if (small_found > 25) { /* 5 expected: never */
        return 0;
    }
    return chi_square_p_value(chi_square, terms - 1);
}

static experiment experiment_of(const sampler *tested, const graze_brdf *brdf, graze_vec3 v, uint64_t seed) {
    experiment e = {.brdf = *brdf, .v = v};
    if (tested->is_float)
        e.v = (graze_vec3){(float)v.x, (float)v.y, (float)v.z};
    e.albedo = graze_brdf_albedo(brdf, e.v);
    double farthest = farthest_horizon(brdf, e.v);
    e.s_end = farthest < 1 ? -expm1(-farthest * farthest) : 1;
    for (int ring = 0; ring < RINGS; ++ring)
        e.squared_edges[ring] = -log1p(-e.s_end * (ring + 1) / RINGS);
    expect(&e, tested->density, tested->is_pair);

    samples a;
    while ((double)e.count * (1 - e.mass[CELLS - 1]) < accepted_samples(tested)) {
        draw_numbers(&a, 0, e.s_end, tested->is_pair, &seed);
        tested->draw(brdf, e.v, &a);
        count_samples(&e, &a);
    }
    if (e.s_end < 1) { /* what is left out is rejected */
        draw_numbers(&a, e.s_end, 1, tested->is_pair, &seed);
        tested->draw(brdf, e.v, &a);
        for (int i = 0; i < CHUNK; ++i)
            assert_true(a.density[i] == 0 && a.weight[i] == 0);
    }
    return e;
}

static const double roughness_pairs[][2] = {{.05, .05}, {.1, .1},     {.3, .3},     {1, 1},    {2, 2},   {5, 5},
                                            {10, 10},   {1e-4, 1e-4}, {1e-4, 2e-4}, {.02, .3}, {.8, .1}, {.002, .0005},
                                            {1e-3, .5}, {3, .2},      {.5, 6},      {4, .05}};
static const double views[][2] = {{0, 0},         {30, 0},         {45, 70},        {60, 90},    {75, 20},
                                  {85, 135},      {89, 33},        {89.9, 60},      {89.9, 171}, {89.99, 300},
                                  {89.99999, 10}, {90 - 1e-9, 80}, {90 - 1e-11, 80}};
enum {
    ROUGHNESS_PAIRS = sizeof roughness_pairs / sizeof *roughness_pairs,
    VIEWS = sizeof views / sizeof *views,
    CONFIGURATIONS = ROUGHNESS_PAIRS * VIEWS,
};
_Static_assert((int)CONFIGURATIONS >= 200, "the number promised");

static graze_brdf configured_brdf(int i) {
    const double *alpha = roughness_pairs[i % ROUGHNESS_PAIRS];
    return (graze_brdf){GRAZE_BRDF_GMD, alpha[0], alpha[1]};
}

static graze_vec3 configured_view(int i) {
    return from_degrees(views[i / ROUGHNESS_PAIRS][0], views[i / ROUGHNESS_PAIRS][1]);
}

static void fail_at(const sampler *tested, int i, const char *what, double p) {
    const double *alpha = roughness_pairs[i % ROUGHNESS_PAIRS], *view = views[i / ROUGHNESS_PAIRS];
    fail_msg("%s sampling, alpha %g %g, view %g %g degrees: %s, p = %g", tested->name, alpha[0], alpha[1], view[0],
             view[1], what, p);
}

/* E[weight] is the albedo. The paired sampling's weights of the other models have no variance to go by. */
static double albedo_p_value(const experiment *e) {
    double count = (double)e->count, error = e->excess / count;
    double deviation = sqrt((e->squared_excess / count - error * error) / count);
    double rare = 2 * e->albedo / count; /* what differs once among all samples shows in no deviation */
    return erfc(fabs(error) / (deviation + rare) / sqrt(2));
}

/* Whether slopes can be told from directions in float. */
static bool can_be_told(const graze_brdf *brdf, graze_vec3 v) {
    double alpha = fmin(brdf->alpha_x, brdf->alpha_y);
    return alpha * fmax(alpha, v.z) > 5e-5;
}

/* All configurations, at a significance of 1% for all of them together. */
static void chi_square(const sampler *tested) {
    const double significance = .01, each = 1 - pow(1 - significance, 1. / CONFIGURATIONS); /* Sidak */
    for (int i = 0; i < CONFIGURATIONS; i += is_short_run() ? 13 : 1) {
        graze_brdf brdf = configured_brdf(i);
        if (!tested->is_pair)
            brdf.model = (graze_brdf_model)((i + i / ROUGHNESS_PAIRS) % 4);
        if (tested->is_float && !can_be_told(&brdf, configured_view(i)))
            continue;
        experiment e = experiment_of(tested, &brdf, configured_view(i), 2000 + (uint64_t)i);
        double p = p_value(&e, 0), with_error = p_value(&e, .01), of_albedo = albedo_p_value(&e);
        if (!(p > each))
            fail_at(tested, i, "samples do not follow the density", p);
        if (!(with_error < each) && accepted_samples(tested) > 1e6)
            fail_at(tested, i, "a density off by 1% would not be noticed", with_error);
        if (!(of_albedo > each))
            fail_at(tested, i, "the mean weight is not the albedo", of_albedo);
    }
}

static void ward_samples_follow_their_density(void **state) {
    (void)state;
    chi_square(&ward);
}

static void paired_samples_follow_their_density(void **state) {
    (void)state;
    chi_square(&paired);
}

static void float_samples_follow_the_density(void **state) {
    (void)state;
    chi_square(&ward_float);
    chi_square(&paired_float);
}

static void densities_integrate_to_what_is_accepted(void **state) {
    (void)state;
    const sampler *tested[] = {&ward, &paired};
    for (int i = 0; i < CONFIGURATIONS; i += is_short_run() ? 13 : 1)
        for (int k = 0; k < 2; ++k) {
            graze_brdf brdf = configured_brdf(i);
            graze_vec3 v = configured_view(i);
            double sum = 0;
            for (int quarter = 0; quarter < 4; ++quarter)
                sum +=
                    integrate_cell(&brdf, tested[k]->density, v, 0, 6, pi / 2 * quarter, pi / 2 * (quarter + 1), 100);
            double share = accepted_share(&brdf, v, k), error = sum - share;
            if (k == 0 && !(fabs(graze_brdf_ward_acceptance(&brdf, v) - share) < 1e-7))
                fail_at(tested[k], i, "the acceptance is another", share);
            if (!(fabs(error) < 1e-6))
                fail_at(tested[k], i, "the density's integral is not the share of accepted samples", error);
        }
}

/* --- The diffuse term ------------------------------------------------------------------------------------------------
 */

enum { LEVELS = 8, DIFFUSE_CELLS = LEVELS * SECTORS };

/* The density's integral over lz within [low, high] and an eighth of a turn: Gauss' rule is exact for what is linear.
 */
static double diffuse_mass(graze_vec3 v, double low, double high) {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += gauss_weights[k] * graze_diffuse_density(direction(low + (high - low) * gauss_nodes[k], 1), v);
    return sum * (high - low) * 2 * pi / SECTORS;
}

/* Cells of equal probability: levels of lz^2, and sectors. */
static void diffuse_samples_follow_their_density(void **state) {
    (void)state;
    const int count = is_short_run() ? 50000 : 4000000;
    graze_vec3 v = from_degrees(40, 70);
    uint64_t seed = 20;
    double chi_square = 0, with_error = 0, total = 0;
    int found[DIFFUSE_CELLS] = {0};
    for (int i = 0; i < count; ++i) {
        double s = draw(&seed), t = draw(&seed);
        graze_vec3 l = graze_diffuse_sample(v, s, t).l;
        int level = (int)(l.z * l.z * LEVELS);
        ++found[(level < LEVELS ? level : LEVELS - 1) * SECTORS + sector_of(l.x, l.y)];
    }
    for (int cell = 0; cell < DIFFUSE_CELLS; ++cell) {
        double level = cell / SECTORS;
        double mass = diffuse_mass(v, sqrt(level / LEVELS), sqrt((level + 1) / LEVELS)), expected = mass * count;
        chi_square += (found[cell] - expected) * (found[cell] - expected) / expected;
        expected *= cell < DIFFUSE_CELLS / 2 ? 1.01 : .99;
        with_error += (found[cell] - expected) * (found[cell] - expected) / expected;
        total += mass;
    }
    assert_true(fabs(total - 1) < 1e-12);
    assert_true(chi_square_p_value(chi_square, DIFFUSE_CELLS - 1) > .01);
    assert_true(is_short_run() || chi_square_p_value(with_error, DIFFUSE_CELLS - 1) < 1e-6);
}

/* Whatever the view is, as long as it is above the surface. */
static void diffuse_samples_do_not_know_the_view(void **state) {
    (void)state;
    uint64_t seed = 21;
    for (int i = 0; i < 300; ++i) {
        double s = draw(&seed), t = draw(&seed);
        graze_vec3 v = direction(draw_power(&seed, 1e-150, 1), draw_between(&seed, 0, 2 * pi));
        graze_brdf_sample a = graze_diffuse_sample(v, s, t), b = graze_diffuse_sample((graze_vec3){0, 0, 1}, s, t);
        assert_true(a.l.x == b.l.x && a.l.y == b.l.y && a.l.z == b.l.z && a.weight == 1 && b.weight == 1);
        assert_true(fabs(a.density / graze_diffuse_density(a.l, v) - 1) < 1e-15 && a.density == b.density);
        v.z = -v.z;
        a = graze_diffuse_sample(v, s, t);
        assert_true(a.weight == 0 && a.density == 0 && graze_diffuse_density(a.l, v) == 0);
    }
}

/* --- Others ----------------------------------------------------------------------------------------------------------
 */

/* (32): at grazing angles Ward's sampling rejects half of all, the paired one next to nothing. */
static void half_is_rejected_at_grazing_angles(void **state) {
    (void)state;
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .1, .1};
    graze_vec3 v = direction(1e-150, 1);
    uint64_t seed = 9;
    samples a;
    int accepted[2] = {0, 0}, count = 0;
    for (; count < 40 * CHUNK; count += CHUNK)
        for (int pair = 0; pair < 2; ++pair) {
            draw_numbers(&a, 0, 1, pair, &seed);
            (pair ? draw_pair : draw_ward)(&brdf, v, &a);
            for (int i = 0; i < CHUNK; ++i)
                accepted[pair] += a.weight[i] > 0;
        }
    assert_true(abs(accepted[0] - count / 2) < 500); /* five standard deviations */
    assert_int_equal(accepted[1], count);
}

/* The table of standard deviations in the section on paired sampling. */
static void pairs_have_less_variance(void **state) {
    (void)state;
    const double expected[][3] = {{60, .135, .032}, {89, .83, .075}, {89.9, .96, .047}};
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .1, .1};
    for (int i = 0; i < 3; ++i)
        for (int pair = 0; pair < 2; ++pair) {
            enum { COUNT = 200 * CHUNK };
            double sum = 0, squares = 0;
            uint64_t seed = 10;
            samples a;
            for (int n = 0; n < COUNT; n += CHUNK) {
                draw_numbers(&a, 0, 1, pair, &seed);
                (pair ? draw_pair : draw_ward)(&brdf, from_degrees(expected[i][0], 0), &a);
                for (int k = 0; k < CHUNK; ++k) {
                    sum += a.weight[k];
                    squares += a.weight[k] * a.weight[k];
                }
            }
            double deviation = sqrt(squares / COUNT - sum / COUNT * (sum / COUNT));
            assert_true(fabs(deviation / expected[i][pair + 1] - 1) < .02);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ward_samples_follow_their_density),
        cmocka_unit_test(paired_samples_follow_their_density),
        cmocka_unit_test(float_samples_follow_the_density),
        cmocka_unit_test(densities_integrate_to_what_is_accepted),
        cmocka_unit_test(diffuse_samples_follow_their_density),
        cmocka_unit_test(diffuse_samples_do_not_know_the_view),
        cmocka_unit_test(half_is_rejected_at_grazing_angles),
        cmocka_unit_test(pairs_have_less_variance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
