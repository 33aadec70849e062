/* The switch over the models that makes the model a constant, for functions that are compiled once for each. */
#ifndef BRDF_MODELS_H
#define BRDF_MODELS_H

#include "graze/brdf.h"

/* Does `work`, in which `model` is a constant, for the model that `which` is; `work` ends with a return. What is no
 * model counts as Ward-Neumann, here as in all switches of this folder: those have no `default:`, so that compilers
 * point out each that lacks a new model. */
#define BRDF_WITH_CONSTANT_MODEL(which, work)                                                                          \
    switch (which) {                                                                                                   \
    case GRAZE_BRDF_GMD: {                                                                                             \
        const graze_brdf_model model = GRAZE_BRDF_GMD;                                                                 \
        work;                                                                                                          \
    }                                                                                                                  \
    case GRAZE_BRDF_WARD: {                                                                                            \
        const graze_brdf_model model = GRAZE_BRDF_WARD;                                                                \
        work;                                                                                                          \
    }                                                                                                                  \
    case GRAZE_BRDF_WARD_DUER: {                                                                                       \
        const graze_brdf_model model = GRAZE_BRDF_WARD_DUER;                                                           \
        work;                                                                                                          \
    }                                                                                                                  \
    case GRAZE_BRDF_WARD_NEUMANN:                                                                                      \
        break;                                                                                                         \
    }                                                                                                                  \
    const graze_brdf_model model = GRAZE_BRDF_WARD_NEUMANN;                                                            \
    work

#endif
