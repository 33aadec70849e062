/* The reflectance models of brdf.h over arrays, one lobe a call, as fast as the processor can: the widest vector
 * instructions it has are chosen at run time (x86-64: AVX-512, AVX2 with FMA, or neither; elsewhere whatever the
 * compiler makes of plain C).
 *
 * In double precision each element is, to the last bit, what the function of brdf.h for one pair gives: whatever the
 * length, the alignment and the processor. In float each element lies within the bounds below of the true value for the
 * floats given, again with the same bits everywhere; what is too large for a float is FLT_MAX. They hold for cosines
 * down to 1e-30 and are in units in the last place of a float, which below the normal floats is 2^-149; for speed,
 * values (but not densities and weights) below the normal floats may also be 0:
 *
 *   function                                             bound   measured
 *   graze_brdf_value_float_batch                         2.95    2.62
 *       of values below 2^-124                           3.31    2.99
 *   the densities                                        0.501   0.501
 *   the weights                                          0.501   0.501
 *
 * Arrays hold one component each. Output arrays must not overlap any other array. Directions, domains, meaning and
 * errors are those of brdf.h; samples in float are those in double for the floats given, rounded, and rejected where
 * that makes l.z 0. No function here can fail, allocates, or keeps state. */
#ifndef GRAZE_BRDF_BATCH_H
#define GRAZE_BRDF_BATCH_H

#include <stddef.h>

#include "graze/brdf.h"
#include "graze/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Directions, or any vectors: component arrays of the same length. */
typedef struct graze_vec3_arrays {
    const double *x, *y, *z;
} graze_vec3_arrays;

typedef struct graze_vec3_float_arrays {
    const float *x, *y, *z;
} graze_vec3_float_arrays;

/* Where samples go: see graze_brdf_sample. */
typedef struct graze_brdf_sample_arrays {
    double *x, *y, *z; /* of l */
    double *density, *weight;
} graze_brdf_sample_arrays;

typedef struct graze_brdf_sample_float_arrays {
    float *x, *y, *z;
    float *density, *weight;
} graze_brdf_sample_float_arrays;

/* One result for each of `count` pairs of directions: see graze_brdf_value and so on. */
GRAZE_API void graze_brdf_value_batch(const graze_brdf *, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                      double *result);
GRAZE_API void graze_brdf_ward_density_batch(const graze_brdf *, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                             double *result);
GRAZE_API void graze_brdf_ward_weight_batch(const graze_brdf *, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                            double *result);
GRAZE_API void graze_brdf_pair_density_batch(const graze_brdf *, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                             double *result);
GRAZE_API void graze_brdf_pair_weight_batch(const graze_brdf *, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                            double *result);

/* One sample for each of `count` viewers, with the random numbers s, t (and u) in [0,1): see graze_brdf_sample_ward and
 * graze_brdf_sample_pair. */
GRAZE_API void graze_brdf_sample_ward_batch(const graze_brdf *, size_t count, graze_vec3_arrays v, const double *s,
                                            const double *t, graze_brdf_sample_arrays result);
GRAZE_API void graze_brdf_sample_pair_batch(const graze_brdf *, size_t count, graze_vec3_arrays v, const double *s,
                                            const double *t, const double *u, graze_brdf_sample_arrays result);

/* The same in single precision. */
GRAZE_API void graze_brdf_value_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays l,
                                            graze_vec3_float_arrays v, float *result);
GRAZE_API void graze_brdf_ward_density_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays l,
                                                   graze_vec3_float_arrays v, float *result);
GRAZE_API void graze_brdf_ward_weight_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays l,
                                                  graze_vec3_float_arrays v, float *result);
GRAZE_API void graze_brdf_pair_density_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays l,
                                                   graze_vec3_float_arrays v, float *result);
GRAZE_API void graze_brdf_pair_weight_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays l,
                                                  graze_vec3_float_arrays v, float *result);
GRAZE_API void graze_brdf_sample_ward_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays v,
                                                  const float *s, const float *t,
                                                  graze_brdf_sample_float_arrays result);
GRAZE_API void graze_brdf_sample_pair_float_batch(const graze_brdf *, size_t count, graze_vec3_float_arrays v,
                                                  const float *s, const float *t, const float *u,
                                                  graze_brdf_sample_float_arrays result);

#ifdef __cplusplus
}
#endif

#endif
