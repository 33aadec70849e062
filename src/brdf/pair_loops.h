/* The kernels for one pair of directions and over arrays of them: to be compiled once for each instruction set. */
#ifndef BRDF_PAIR_LOOPS_H
#define BRDF_PAIR_LOOPS_H

#include <stddef.h>

#include "brdf/odd_pair.h"
#include "brdf/pair_kernels.h"
#include "graze/brdf_batch.h"

typedef double pair_kernel(graze_brdf_model, const lobe_constants *, graze_vec3 l, graze_vec3 v);
typedef double odd_pair_function(const graze_brdf *, graze_vec3 l, graze_vec3 v);

/* After so many pairs, those outside the kernel's domain are looked after. */
enum { PAIR_BLOCK = 256 };

BRDF_INLINE double evaluate_pair(pair_kernel *kernel, odd_pair_function *odd, graze_brdf_model model,
                                 const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    const lobe_constants k = lobe_constants_of(brdf);
    double result = kernel(model, &k, l, v);
    return result >= 0 ? result : odd(brdf, l, v);
}

/* `model` is a constant, brdf->model. */
BRDF_INLINE void evaluate_pairs(pair_kernel *kernel, odd_pair_function *odd, graze_brdf_model model,
                                const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,
                                double *restrict result) {
    const lobe_constants k = lobe_constants_of(brdf);
    for (size_t start = 0; start < count; start += PAIR_BLOCK) {
        size_t end = count - start < PAIR_BLOCK ? count : start + PAIR_BLOCK;
        for (size_t i = start; i < end; ++i)
            result[i] = kernel(model, &k, (graze_vec3){l.x[i], l.y[i], l.z[i]}, (graze_vec3){v.x[i], v.y[i], v.z[i]});
        uint64_t all_bits = 0; /* the highest is the sign of outside_domain */
        for (size_t i = start; i < end; ++i)
            all_bits |= brdf_bits(result[i]);
        if (all_bits >> 63 == 0)
            continue;
        for (size_t i = start; i < end; ++i)
            if (result[i] < 0)
                result[i] = odd(brdf, (graze_vec3){l.x[i], l.y[i], l.z[i]}, (graze_vec3){v.x[i], v.y[i], v.z[i]});
    }
}

/* The functions `name` and `name`_batch of a kernel that depends on the model. */
#define BRDF_DEFINE_FOR_MODELS(name)                                                                                   \
    static double name(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {                                           \
        switch (brdf->model) {                                                                                         \
        case GRAZE_BRDF_GMD:                                                                                           \
            return evaluate_pair(name##_kernel, brdf_odd_##name, GRAZE_BRDF_GMD, brdf, l, v);                          \
        case GRAZE_BRDF_WARD:                                                                                          \
            return evaluate_pair(name##_kernel, brdf_odd_##name, GRAZE_BRDF_WARD, brdf, l, v);                         \
        case GRAZE_BRDF_WARD_DUER:                                                                                     \
            return evaluate_pair(name##_kernel, brdf_odd_##name, GRAZE_BRDF_WARD_DUER, brdf, l, v);                    \
        default:                                                                                                       \
            return evaluate_pair(name##_kernel, brdf_odd_##name, GRAZE_BRDF_WARD_NEUMANN, brdf, l, v);                 \
        }                                                                                                              \
    }                                                                                                                  \
    static void name##_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,           \
                             double *result) {                                                                         \
        switch (brdf->model) {                                                                                         \
        case GRAZE_BRDF_GMD:                                                                                           \
            evaluate_pairs(name##_kernel, brdf_odd_##name, GRAZE_BRDF_GMD, brdf, count, l, v, result);                 \
            break;                                                                                                     \
        case GRAZE_BRDF_WARD:                                                                                          \
            evaluate_pairs(name##_kernel, brdf_odd_##name, GRAZE_BRDF_WARD, brdf, count, l, v, result);                \
            break;                                                                                                     \
        case GRAZE_BRDF_WARD_DUER:                                                                                     \
            evaluate_pairs(name##_kernel, brdf_odd_##name, GRAZE_BRDF_WARD_DUER, brdf, count, l, v, result);           \
            break;                                                                                                     \
        default:                                                                                                       \
            evaluate_pairs(name##_kernel, brdf_odd_##name, GRAZE_BRDF_WARD_NEUMANN, brdf, count, l, v, result);        \
        }                                                                                                              \
    }

/* The same for a kernel that does not. */
#define BRDF_DEFINE_FOR_ALL(name)                                                                                      \
    static double name(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {                                           \
        return evaluate_pair(name##_kernel, brdf_odd_##name, GRAZE_BRDF_GMD, brdf, l, v);                              \
    }                                                                                                                  \
    static void name##_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays l, graze_vec3_arrays v,           \
                             double *result) {                                                                         \
        evaluate_pairs(name##_kernel, brdf_odd_##name, GRAZE_BRDF_GMD, brdf, count, l, v, result);                     \
    }

BRDF_DEFINE_FOR_MODELS(value)
BRDF_DEFINE_FOR_MODELS(ward_weight)
BRDF_DEFINE_FOR_MODELS(pair_weight)
BRDF_DEFINE_FOR_ALL(ward_density)
BRDF_DEFINE_FOR_ALL(pair_density)

#endif
