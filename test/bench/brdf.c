/* What the reflectance models cost, beside the exponentials of glibc's libmvec and an ordinary program of Eq. 17.
 *
 * Run by `make bench`. All contenders take turns in one process, many times; a time is the median of a contender's
 * turns. Goals are ratios of such medians, in which the machine's speed cancels out. */
#include <math.h>
#include <stdio.h>

#include "bench/exponentials.h"
#include "bench/pairs.h"
#include "bench/turns.h"
#include "brdf/kernels.h"
#include "graze/brdf.h"
#include "graze/brdf_batch.h"

static const graze_brdf lobe = {GRAZE_BRDF_GMD, .1, .2};

static graze_vec3 direction(const pairs *p, int first, size_t i) {
    return (graze_vec3){p->numbers[first][i], p->numbers[first + 1][i], p->numbers[first + 2][i]};
}

static graze_vec3_arrays directions(const pairs *p, int first) {
    return (graze_vec3_arrays){p->numbers[first], p->numbers[first + 1], p->numbers[first + 2]};
}

static graze_vec3_float_arrays float_directions(const pairs *p, int first) {
    return (graze_vec3_float_arrays){p->floats[first], p->floats[first + 1], p->floats[first + 2]};
}

/* --- One pair a call --------------------------------------------------------------------------------------------- */

/* Eq. 17 as one writes it down. */
static double naive_value(const graze_brdf *b, graze_vec3 l, graze_vec3 v) {
    if (l.z <= 0 || v.z <= 0)
        return 0;
    double hx = l.x + v.x, hy = l.y + v.y, hz = l.z + v.z;
    double x = hx / b->alpha_x, y = hy / b->alpha_y;
    return exp(-(x * x + y * y) / (hz * hz)) * (hx * hx + hy * hy + hz * hz) /
           (pi * b->alpha_x * b->alpha_y * (hz * hz) * (hz * hz));
}

typedef double value_function(const graze_brdf *, graze_vec3 l, graze_vec3 v);

/* Through a pointer that the compiler cannot see through: called, as from another file. */
static void evaluate(const pairs *p, value_function *volatile hidden) {
    value_function *f = hidden;
    for (size_t i = 0; i < p->count; i++)
        p->results[0][i] = f(&lobe, direction(p, 0, i), direction(p, 3, i));
}
static void naive(const pairs *p) {
    evaluate(p, naive_value);
}
static void value(const pairs *p) {
    evaluate(p, graze_brdf_value);
}
static void ward_density(const pairs *p) {
    evaluate(p, graze_brdf_ward_density);
}
static void ward_weight(const pairs *p) {
    evaluate(p, graze_brdf_ward_weight);
}
static void pair_density(const pairs *p) {
    evaluate(p, graze_brdf_pair_density);
}
static void pair_weight(const pairs *p) {
    evaluate(p, graze_brdf_pair_weight);
}

static void store(const pairs *p, size_t i, graze_brdf_sample sample) {
    const double numbers[] = {sample.l.x, sample.l.y, sample.l.z, sample.density, sample.weight};
    for (int k = 0; k < 5; k++)
        p->results[k][i] = numbers[k];
}
static void sample_ward(const pairs *p) {
    for (size_t i = 0; i < p->count; i++)
        store(p, i, graze_brdf_sample_ward(&lobe, direction(p, 3, i), p->numbers[6][i], p->numbers[7][i]));
}
static void sample_pair(const pairs *p) {
    for (size_t i = 0; i < p->count; i++)
        store(p, i,
              graze_brdf_sample_pair(&lobe, direction(p, 3, i), p->numbers[6][i], p->numbers[7][i], p->numbers[8][i]));
}

/* --- Batches ------------------------------------------------------------------------------------------------------ */

static void evaluate_batch(const pairs *p, brdf_batch_function *f) {
    f(&lobe, p->count, directions(p, 0), directions(p, 3), p->results[0]);
}
static void value_batch(const pairs *p) {
    evaluate_batch(p, graze_brdf_value_batch);
}
static void ward_density_batch(const pairs *p) {
    evaluate_batch(p, graze_brdf_ward_density_batch);
}
static void ward_weight_batch(const pairs *p) {
    evaluate_batch(p, graze_brdf_ward_weight_batch);
}
static void pair_density_batch(const pairs *p) {
    evaluate_batch(p, graze_brdf_pair_density_batch);
}
static void pair_weight_batch(const pairs *p) {
    evaluate_batch(p, graze_brdf_pair_weight_batch);
}
static graze_brdf_sample_arrays samples(const pairs *p) {
    return (graze_brdf_sample_arrays){p->results[0], p->results[1], p->results[2], p->results[3], p->results[4]};
}
static void sample_ward_batch(const pairs *p) {
    graze_brdf_sample_ward_batch(&lobe, p->count, directions(p, 3), p->numbers[6], p->numbers[7], samples(p));
}
static void sample_pair_batch(const pairs *p) {
    graze_brdf_sample_pair_batch(&lobe, p->count, directions(p, 3), p->numbers[6], p->numbers[7], p->numbers[8],
                                 samples(p));
}

static void evaluate_float_batch(const pairs *p, brdf_float_batch_function *f) {
    f(&lobe, p->count, float_directions(p, 0), float_directions(p, 3), p->float_results[0]);
}
static void value_float_batch(const pairs *p) {
    evaluate_float_batch(p, graze_brdf_value_float_batch);
}
static void pair_density_float_batch(const pairs *p) {
    evaluate_float_batch(p, graze_brdf_pair_density_float_batch);
}
static void sample_pair_float_batch(const pairs *p) {
    const graze_brdf_sample_float_arrays result = {p->float_results[0], p->float_results[1], p->float_results[2],
                                                   p->float_results[3], p->float_results[4]};
    graze_brdf_sample_pair_float_batch(&lobe, p->count, float_directions(p, 3), p->floats[6], p->floats[7],
                                       p->floats[8], result);
}

/* --- Integrals ---------------------------------------------------------------------------------------------------- */

static const double angles[] = {0, 35, 60, 75, 85, 89};
enum { ANGLES = sizeof angles / sizeof *angles };
static volatile double sink; /* keeps results from being optimised away */

typedef double integral_function(const graze_brdf *, graze_vec3 v);

static double mean_albedo(const graze_brdf *b, graze_vec3 v) {
    (void)v;
    return graze_brdf_mean_albedo(b);
}

/* Microseconds a call, over all angles; the median of some turns. */
static double time_integral(const graze_brdf *b, integral_function *f) {
    enum { TIMES = 9 };
    double times[TIMES];
    for (int turn = 0; turn < TIMES; turn++) {
        double start = turns_now();
        for (int i = 0; i < ANGLES; i++) {
            double theta = angles[i] * pi / 180;
            sink = f(b, (graze_vec3){sin(theta) * .8, sin(theta) * .6, cos(theta)});
        }
        times[turn] = (turns_now() - start) / ANGLES * 1e-3;
    }
    qsort(times, TIMES, sizeof *times, turns_compare);
    return times[TIMES / 2];
}

static void measure_integrals(void) {
    static const char *const names[] = {"gmd", "ward", "ward-duer", "ward-neumann"};
    static const double roughness[][2] = {{.1, .1}, {.1, .2}, {.01, .5}};
    printf("integrals: microseconds a call, over %d angles\n", ANGLES);
    printf("  %-24s %12s %12s %12s\n", "", "albedo", "mean albedo", "acceptance");
    for (int model = 0; model < 4; model++)
        for (int i = 0; i < 3; i++) {
            graze_brdf b = {(graze_brdf_model)model, roughness[i][0], roughness[i][1]};
            printf("  %-12s %4g x %-4g  %12.1f %12.1f %12.1f\n", names[model], b.alpha_x, b.alpha_y,
                   time_integral(&b, graze_brdf_albedo), time_integral(&b, mean_albedo),
                   time_integral(&b, graze_brdf_ward_acceptance));
        }
}

int main(void) {
    contender contenders[] = {
#ifdef HAVE_LIBMVEC
        {.name = "libmvec expf", .run = libmvec_expf},
        {.name = "value, float batch", .run = value_float_batch, .beside = "libmvec expf", .goal = 4},
        {.name = "libmvec exp", .run = libmvec_exp},
        {.name = "value, batch", .run = value_batch, .beside = "libmvec exp", .goal = 6},
#else
        {.name = "value, float batch", .run = value_float_batch},
        {.name = "value, batch", .run = value_batch},
#endif
        {.name = "naive value", .run = naive},
        {.name = "value", .run = value, .beside = "naive value", .goal = 4},
        {.name = "Ward density", .run = ward_density, .beside = "naive value"},
        {.name = "Ward density, batch", .run = ward_density_batch, .beside = "Ward density"},
        {.name = "Ward weight", .run = ward_weight, .beside = "naive value"},
        {.name = "Ward weight, batch", .run = ward_weight_batch, .beside = "Ward weight"},
        {.name = "pair density", .run = pair_density, .beside = "naive value"},
        {.name = "pair density, batch", .run = pair_density_batch, .beside = "pair density"},
        {.name = "pair density, float batch", .run = pair_density_float_batch, .beside = "pair density"},
        {.name = "pair weight", .run = pair_weight, .beside = "naive value"},
        {.name = "pair weight, batch", .run = pair_weight_batch, .beside = "pair weight"},
        {.name = "Ward sample", .run = sample_ward, .beside = "naive value"},
        {.name = "Ward sample, batch", .run = sample_ward_batch, .beside = "Ward sample"},
        {.name = "pair sample", .run = sample_pair, .beside = "naive value"},
        {.name = "pair sample, batch", .run = sample_pair_batch, .beside = "pair sample"},
        {.name = "pair sample, float batch", .run = sample_pair_float_batch, .beside = "pair sample"},
    };
    enum { COUNT = sizeof contenders / sizeof *contenders };
    static const size_t sizes[] = {4096, 1 << 18}; /* what fits a core's cache, and what does not */
    printf("reflectance of a pair of directions, alpha .1 x .2, one thread, %s\n", brdf_kernels_best()->name);
    for (int i = 0; i < 2; i++) {
        pairs p = pairs_make(sizes[i]);
        turns_measure(contenders, COUNT, &p);
        printf("arrays of %zu, medians of %d turns\n", sizes[i], TURNS);
        turns_print(contenders, COUNT);
        pairs_free(&p);
    }
    measure_integrals();
    return 0;
}
