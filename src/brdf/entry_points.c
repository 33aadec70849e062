/* The public functions that are no more than what the table for this processor has. */
#include "brdf/kernels.h"
#include "brdf/parameters.h"

/* For one pair or sample, bringing the roughness into its range always, as for arrays, would take a tenth more time:
 * only a lobe that is out of it is copied. */

double graze_brdf_value(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    if (!brdf_is_in_range(brdf)) {
        const graze_brdf in_range = brdf_in_range(brdf);
        return graze_brdf_value(&in_range, l, v);
    }
    return brdf_kernels_best()->value(brdf, l, v);
}

double graze_brdf_ward_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    if (!brdf_is_in_range(brdf)) {
        const graze_brdf in_range = brdf_in_range(brdf);
        return graze_brdf_ward_density(&in_range, l, v);
    }
    return brdf_kernels_best()->ward_density(brdf, l, v);
}

double graze_brdf_ward_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->ward_weight(brdf, l, v);
}

double graze_brdf_pair_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    if (!brdf_is_in_range(brdf)) {
        const graze_brdf in_range = brdf_in_range(brdf);
        return graze_brdf_pair_density(&in_range, l, v);
    }
    return brdf_kernels_best()->pair_density(brdf, l, v);
}

double graze_brdf_pair_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    return brdf_kernels_best()->pair_weight(brdf, l, v);
}

void graze_brdf_value_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                            double *result) {
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_kernels_best()->value_batch(&in_range, count, l, v, result);
}

void graze_brdf_ward_density_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                   double *result) {
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_kernels_best()->ward_density_batch(&in_range, count, l, v, result);
}

void graze_brdf_ward_weight_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                  double *result) {
    brdf_kernels_best()->ward_weight_batch(brdf, count, l, v, result);
}

void graze_brdf_pair_density_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                   double *result) {
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_kernels_best()->pair_density_batch(&in_range, count, l, v, result);
}

void graze_brdf_pair_weight_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                  double *result) {
    brdf_kernels_best()->pair_weight_batch(brdf, count, l, v, result);
}

void graze_brdf_value_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                                  graze_vec3_float_arrays v, float *result) {
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_kernels_best()->value_float_batch(&in_range, count, l, v, result);
}

graze_brdf_sample graze_brdf_sample_ward(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    if (!brdf_is_in_range(brdf)) {
        const graze_brdf in_range = brdf_in_range(brdf);
        return graze_brdf_sample_ward(&in_range, v, s, t);
    }
    return brdf_kernels_best()->sample_ward(brdf, v, s, t);
}

graze_brdf_sample graze_brdf_sample_pair(const graze_brdf *brdf, graze_vec3 v, double s, double t, double u) {
    if (!brdf_is_in_range(brdf)) {
        const graze_brdf in_range = brdf_in_range(brdf);
        return graze_brdf_sample_pair(&in_range, v, s, t, u);
    }
    return brdf_kernels_best()->sample_pair(brdf, v, s, t, u);
}

void graze_brdf_sample_ward_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                                  const double *t, graze_brdf_sample_arrays result) {
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_kernels_best()->sample_ward_batch(&in_range, count, v, s, t, result);
}

void graze_brdf_sample_pair_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                                  const double *t, const double *u, graze_brdf_sample_arrays result) {
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_kernels_best()->sample_pair_batch(&in_range, count, v, s, t, u, result);
}
