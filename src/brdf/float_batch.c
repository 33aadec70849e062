/* Densities and weights over arrays in single precision: those in double precision, rounded once more. */
#include "brdf/float_block.h"
#include "brdf/kernels.h"

static void evaluate_blocks(brdf_batch_function *evaluate, const graze_brdf *brdf, size_t count,
                            graze_vec3_float_arrays l, graze_vec3_float_arrays v, float *result) {
    double wide[6][FLOAT_BLOCK], wide_result[FLOAT_BLOCK];
    const graze_vec3_arrays wide_l = {wide[0], wide[1], wide[2]}, wide_v = {wide[3], wide[4], wide[5]};
    const float *narrow[6] = {l.x, l.y, l.z, v.x, v.y, v.z};
    for (size_t start = 0; start < count; start += FLOAT_BLOCK) {
        size_t length = float_block_length(start, count);
        for (int k = 0; k < 6; ++k)
            float_block_widen(wide[k], narrow[k] + start, length);
        evaluate(brdf, length, wide_l, wide_v, wide_result);
        float_block_round(result + start, wide_result, length);
    }
}

void graze_brdf_value_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                  graze_vec3_float_arrays v, float *result) {
    brdf_kernels_best()->value_float_batch(brdf, count, l, v, result);
}

void graze_brdf_ward_density_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                         graze_vec3_float_arrays v, float *result) {
    evaluate_blocks(brdf_kernels_best()->ward_density_batch, brdf, count, l, v, result);
}

void graze_brdf_ward_weight_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                        graze_vec3_float_arrays v, float *result) {
    evaluate_blocks(brdf_kernels_best()->ward_weight_batch, brdf, count, l, v, result);
}

void graze_brdf_pair_density_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                         graze_vec3_float_arrays v, float *result) {
    evaluate_blocks(brdf_kernels_best()->pair_density_batch, brdf, count, l, v, result);
}

void graze_brdf_pair_weight_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                        graze_vec3_float_arrays v, float *result) {
    evaluate_blocks(brdf_kernels_best()->pair_weight_batch, brdf, count, l, v, result);
}
