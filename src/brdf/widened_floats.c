/* Densities, weights and samples over arrays in single precision: those in double precision, rounded once more. */
#include "brdf/blocks.h"
#include "brdf/kernels.h"
#include "brdf/parameters.h"

static void evaluate_blocks(const brdf_kernels *kernels, brdf_batch_function *evaluate, const graze_brdf *brdf,
                            size_t count, graze_vec3_float_arrays l, graze_vec3_float_arrays v, float *result) {
    const float *const given[] = {l.x, l.y, l.z, v.x, v.y, v.z};
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_block arguments, results;
    double(*a)[BRDF_BLOCK] = arguments.numbers;
    for (size_t start = 0; start < count; start += BRDF_BLOCK) {
        size_t length = block_length(start, count);
        kernels->widen(&arguments, given, 6, start, length);
        evaluate(&in_range, length, (graze_vec3_arrays){a[0], a[1], a[2]}, (graze_vec3_arrays){a[3], a[4], a[5]},
                 results.numbers[0]);
        kernels->narrow(&result, &results, 1, start, length);
    }
}

void graze_brdf_ward_density_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                         graze_vec3_float_arrays v, float *result) {
    const brdf_kernels *kernels = brdf_kernels_best();
    evaluate_blocks(kernels, kernels->ward_density_batch, brdf, count, l, v, result);
}

void graze_brdf_ward_weight_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                        graze_vec3_float_arrays v, float *result) {
    const brdf_kernels *kernels = brdf_kernels_best();
    evaluate_blocks(kernels, kernels->ward_weight_batch, brdf, count, l, v, result);
}

void graze_brdf_pair_density_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                         graze_vec3_float_arrays v, float *result) {
    const brdf_kernels *kernels = brdf_kernels_best();
    evaluate_blocks(kernels, kernels->pair_density_batch, brdf, count, l, v, result);
}

void graze_brdf_pair_weight_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                        graze_vec3_float_arrays v, float *result) {
    const brdf_kernels *kernels = brdf_kernels_best();
    evaluate_blocks(kernels, kernels->pair_weight_batch, brdf, count, l, v, result);
}

/* What is above the surface by less than any float is rejected, as l.z = 0 is. */
static void reject_horizontal(graze_brdf_sample_float_arrays samples, size_t start, size_t length) {
    for (size_t i = start; i < start + length; ++i)
        if (!(samples.z[i] > 0))
            samples.density[i] = samples.weight[i] = 0;
}

/* Samples of pairs; of Ward where u is null. */
static void sample_blocks(const brdf_kernels *kernels, const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v,
                          const float *s, const float *t, const float *u, graze_brdf_sample_float_arrays result) {
    const float *const given[] = {v.x, v.y, v.z, s, t, u};
    float *const wanted[] = {result.x, result.y, result.z, result.density, result.weight};
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_block arguments, results;
    double(*a)[BRDF_BLOCK] = arguments.numbers, (*r)[BRDF_BLOCK] = results.numbers;
    const graze_vec3_arrays view = {a[0], a[1], a[2]};
    const graze_brdf_sample_arrays samples = {r[0], r[1], r[2], r[3], r[4]};
    for (size_t start = 0; start < count; start += BRDF_BLOCK) {
        size_t length = block_length(start, count);
        kernels->widen(&arguments, given, u ? 6 : 5, start, length);
        if (u)
            kernels->sample_pair_batch(&in_range, length, view, a[3], a[4], a[5], samples);
        else
            kernels->sample_ward_batch(&in_range, length, view, a[3], a[4], samples);
        kernels->narrow(wanted, &results, 5, start, length);
        reject_horizontal(result, start, length);
    }
}

void graze_brdf_sample_ward_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v, const float *s,
                                        const float *t, graze_brdf_sample_float_arrays result) {
    sample_blocks(brdf_kernels_best(), brdf, count, v, s, t, NULL, result);
}

void graze_brdf_sample_pair_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v, const float *s,
                                        const float *t, const float *u, graze_brdf_sample_float_arrays result) {
    sample_blocks(brdf_kernels_best(), brdf, count, v, s, t, u, result);
}
