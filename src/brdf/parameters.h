/* What callers give, brought into its range. */
#ifndef BRDF_PARAMETERS_H
#define BRDF_PARAMETERS_H

#include <stdbool.h>

#include "brdf/arithmetic.h"
#include "graze/brdf.h"

BRDF_INLINE bool roughness_is_in_range(double alpha) {
    return alpha >= GRAZE_ROUGHNESS_MIN && alpha <= GRAZE_ROUGHNESS_MAX;
}

/* The nearest roughness in its range; the least for what is no number. */
BRDF_INLINE double roughness_in_range(double alpha) {
    alpha = alpha > GRAZE_ROUGHNESS_MIN ? alpha : GRAZE_ROUGHNESS_MIN;
    return alpha < GRAZE_ROUGHNESS_MAX ? alpha : GRAZE_ROUGHNESS_MAX;
}

/* Of the roughness alone. */
BRDF_INLINE bool brdf_is_in_range(const graze_brdf *brdf) {
    return roughness_is_in_range(brdf->alpha_x) && roughness_is_in_range(brdf->alpha_y);
}

/* What is no model is Ward-Neumann; so it is in all switches of this folder. */
BRDF_INLINE graze_brdf_model model_in_range(graze_brdf_model model) {
    switch (model) {
    case GRAZE_BRDF_GMD:
    case GRAZE_BRDF_WARD:
    case GRAZE_BRDF_WARD_DUER:
    case GRAZE_BRDF_WARD_NEUMANN:
        return model;
    }
    return GRAZE_BRDF_WARD_NEUMANN;
}

BRDF_INLINE graze_brdf brdf_in_range(const graze_brdf *brdf) {
    return (graze_brdf){model_in_range(brdf->model), roughness_in_range(brdf->alpha_x),
                        roughness_in_range(brdf->alpha_y)};
}

/* Numbers outside [0,1) become the nearest number inside, what is no number 0. */
BRDF_INLINE double into_unit_interval(double s) {
    const double last = 1 - 0x1p-53;
    s = s > 0 ? s : 0;
    return s < last ? s : last;
}

#endif
