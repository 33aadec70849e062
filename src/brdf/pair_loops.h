/* Values, densities and weights of one pair of directions and of arrays of them: to be compiled once for each
 * instruction set. */
#ifndef BRDF_PAIR_LOOPS_H
#define BRDF_PAIR_LOOPS_H

#include <stddef.h>

#include "brdf/blocks.h"
#include "brdf/models.h"
#include "brdf/out_of_range.h"
#include "brdf/pair_kernels.h"
#include "graze/brdf_batch.h"

typedef double pair_kernel(graze_brdf_model, const lobe_constants *, graze_vec3 l, graze_vec3 v);
typedef double out_of_range_function(const graze_brdf *, graze_vec3 l, graze_vec3 v);

/* `model` is brdf->model, as a constant. */
BRDF_INLINE double evaluate_pair(pair_kernel *kernel, out_of_range_function *out_of_range, graze_brdf_model model,
                                 const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    const lobe_constants k = lobe_constants_of(brdf);
    double result = kernel(model, &k, l, v);
    return result >= 0 ? result : out_of_range(brdf, l, v);
}

/* After each block, pairs outside the kernel's domain are looked after. */
BRDF_INLINE void evaluate_pairs(pair_kernel *kernel, out_of_range_function *out_of_range, graze_brdf_model model,
                                const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                double *restrict result) {
    const lobe_constants k = lobe_constants_of(brdf);
    for (size_t start = 0; start < count; start += BRDF_BLOCK) {
        size_t end = start + block_length(start, count);
        for (size_t i = start; i < end; ++i)
            result[i] = kernel(model, &k, (graze_vec3){l.x[i], l.y[i], l.z[i]}, (graze_vec3){v.x[i], v.y[i], v.z[i]});
        uint64_t all_bits = 0; /* the highest is the sign of outside_domain */
        for (size_t i = start; i < end; ++i)
            all_bits |= brdf_bits(result[i]);
        if (all_bits >> 63 == 0)
            continue;
        for (size_t i = start; i < end; ++i)
            if (result[i] < 0)
                result[i] =
                    out_of_range(brdf, (graze_vec3){l.x[i], l.y[i], l.z[i]}, (graze_vec3){v.x[i], v.y[i], v.z[i]});
    }
}

/* The functions `name` and `name`_batch of a kernel. */
#define BRDF_DEFINE_FOR_MODELS(name)                                                                                   \
    static double name(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {                                           \
        BRDF_WITH_CONSTANT_MODEL(brdf->model,                                                                          \
                                 return evaluate_pair(name##_kernel, brdf_out_of_range_##name, model, brdf, l, v));    \
    }                                                                                                                  \
    static void name##_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,           \
                             double *result) {                                                                         \
        BRDF_WITH_CONSTANT_MODEL(                                                                                      \
            brdf->model, evaluate_pairs(name##_kernel, brdf_out_of_range_##name, model, brdf, count, l, v, result);    \
            return );                                                                                                  \
    }

/* The same for densities, which are those of every model. */
#define BRDF_DEFINE_FOR_ALL(name)                                                                                      \
    static double name(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {                                           \
        return evaluate_pair(name##_kernel, brdf_out_of_range_##name, GRAZE_BRDF_GMD, brdf, l, v);                     \
    }                                                                                                                  \
    static void name##_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,           \
                             double *result) {                                                                         \
        evaluate_pairs(name##_kernel, brdf_out_of_range_##name, GRAZE_BRDF_GMD, brdf, count, l, v, result);            \
    }

BRDF_DEFINE_FOR_MODELS(value)
BRDF_DEFINE_FOR_MODELS(ward_weight)
BRDF_DEFINE_FOR_MODELS(pair_weight)
BRDF_DEFINE_FOR_ALL(ward_density)
BRDF_DEFINE_FOR_ALL(pair_density)

#endif
