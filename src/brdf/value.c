/* Values, densities and weights: for one pair of directions, and over arrays. */
#include <float.h>

#include "brdf/kernels.h"

double graze_brdf_value(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->value(brdf, l, v);
}

double graze_brdf_ward_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->ward_density(brdf, l, v);
}

double graze_brdf_ward_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->ward_weight(brdf, l, v);
}

double graze_brdf_pair_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->pair_density(brdf, l, v);
}

double graze_brdf_pair_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->pair_weight(brdf, l, v);
}

void graze_brdf_value_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                            double *result) {
    brdf_kernels_best()->value_batch(brdf, count, l, v, result);
}

void graze_brdf_ward_density_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                   double *result) {
    brdf_kernels_best()->ward_density_batch(brdf, count, l, v, result);
}

void graze_brdf_ward_weight_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                  double *result) {
    brdf_kernels_best()->ward_weight_batch(brdf, count, l, v, result);
}

void graze_brdf_pair_density_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                   double *result) {
    brdf_kernels_best()->pair_density_batch(brdf, count, l, v, result);
}

void graze_brdf_pair_weight_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                  double *result) {
    brdf_kernels_best()->pair_weight_batch(brdf, count, l, v, result);
}
