/* Ward's sampling and the paired sampling of directions: for one sample, and over arrays. */
#include "brdf/kernels.h"

graze_brdf_sample graze_brdf_sample_ward(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    return brdf_kernels_best()->sample_ward(brdf, v, s, t);
}

graze_brdf_sample graze_brdf_sample_pair(const graze_brdf *brdf, graze_vec3 v, double s, double t, double u) {
    return brdf_kernels_best()->sample_pair(brdf, v, s, t, u);
}

void graze_brdf_sample_ward_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                                  const double *t, graze_brdf_sample_arrays result) {
    brdf_kernels_best()->sample_ward_batch(brdf, count, v, s, t, result);
}

void graze_brdf_sample_pair_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                                  const double *t, const double *u, graze_brdf_sample_arrays result) {
    brdf_kernels_best()->sample_pair_batch(brdf, count, v, s, t, u, result);
}

void graze_brdf_sample_ward_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v, const float *s,
                                        const float *t, graze_brdf_sample_float_arrays result) {
    brdf_kernels_best()->sample_ward_float_batch(brdf, count, v, s, t, result);
}

void graze_brdf_sample_pair_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v, const float *s,
                                        const float *t, const float *u, graze_brdf_sample_float_arrays result) {
    brdf_kernels_best()->sample_pair_float_batch(brdf, count, v, s, t, u, result);
}
