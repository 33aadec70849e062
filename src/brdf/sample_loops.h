/* The samplers, for one sample and for arrays of them: to be compiled once for each instruction set. */
#ifndef BRDF_SAMPLE_LOOPS_H
#define BRDF_SAMPLE_LOOPS_H

#include <stddef.h>

#include "brdf/models.h"
#include "brdf/sample_kernels.h"
#include "graze/brdf_batch.h"

typedef graze_brdf_sample sample_kernel(graze_brdf_model, const graze_brdf *, graze_vec3 v, double s, double t,
                                        double u);

BRDF_INLINE void store_sample(graze_brdf_sample sample, double *x, double *y, double *z, double *density,
                              double *weight) {
    *x = sample.l.x;
    *y = sample.l.y;
    *z = sample.l.z;
    *density = sample.density;
    *weight = sample.weight;
}

/* `model` is brdf.model, as a constant. That no result overlaps another array lets the loop be vector code. */
BRDF_INLINE void draw_samples(sample_kernel *kernel, graze_brdf_model model, graze_brdf brdf, size_t count,
                              graze_vec3_arrays v, const double *s, const double *t, const double *u,
                              double *restrict x, double *restrict y, double *restrict z, double *restrict density,
                              double *restrict weight) {
    for (size_t i = 0; i < count; ++i)
        store_sample(kernel(model, &brdf, (graze_vec3){v.x[i], v.y[i], v.z[i]}, s[i], t[i], u[i]), x + i, y + i, z + i,
                     density + i, weight + i);
}

static graze_brdf_sample sample_ward(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    return sample_ward_kernel(brdf->model, brdf, v, s, t, 0);
}

static graze_brdf_sample sample_pair(const graze_brdf *brdf, graze_vec3 v, double s, double t, double u) {
    return sample_pair_kernel(brdf->model, brdf, v, s, t, u);
}

static void sample_ward_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                              const double *t, graze_brdf_sample_arrays to) {
    BRDF_WITH_CONSTANT_MODEL(brdf->model, draw_samples(sample_ward_kernel, model, *brdf, count, v, s, t, t, to.x, to.y,
                                                       to.z, to.density, to.weight);
                             return );
}

static void sample_pair_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                              const double *t, const double *u, graze_brdf_sample_arrays to) {
    BRDF_WITH_CONSTANT_MODEL(brdf->model, draw_samples(sample_pair_kernel, model, *brdf, count, v, s, t, u, to.x, to.y,
                                                       to.z, to.density, to.weight);
                             return );
}

#endif
