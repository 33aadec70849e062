/* The samplers, for one sample and over arrays: to be compiled once for each instruction set. */
#ifndef BRDF_SAMPLE_LOOPS_H
#define BRDF_SAMPLE_LOOPS_H

#include <stddef.h>

#include "brdf/float_block.h"
#include "brdf/sample_kernel.h"
#include "graze/brdf_batch.h"

/* The loops, with the model a constant in each. Arguments that do not overlap let them be vector code. */
#define BRDF_SAMPLE_ARRAYS                                                                                             \
    const double *restrict vx, const double *restrict vy, const double *restrict vz, double *restrict x,               \
        double *restrict y, double *restrict z, double *restrict density, double *restrict weight

#define BRDF_SAMPLE_STORE(i, sample)                                                                                   \
    do {                                                                                                               \
        graze_brdf_sample made = sample;                                                                               \
        x[i] = made.l.x;                                                                                               \
        y[i] = made.l.y;                                                                                               \
        z[i] = made.l.z;                                                                                               \
        density[i] = made.density;                                                                                     \
        weight[i] = made.weight;                                                                                       \
    } while (0)

BRDF_INLINE void brdf_sample_ward_loop(graze_brdf_model model, graze_brdf brdf, size_t count, const double *restrict s,
                                       const double *restrict t, BRDF_SAMPLE_ARRAYS) {
    for (size_t i = 0; i < count; ++i)
        BRDF_SAMPLE_STORE(i, brdf_sample_ward_kernel(model, &brdf, (graze_vec3){vx[i], vy[i], vz[i]}, s[i], t[i]));
}

BRDF_INLINE void brdf_sample_pair_loop(graze_brdf_model model, graze_brdf brdf, size_t count, const double *restrict s,
                                       const double *restrict t, const double *restrict u, BRDF_SAMPLE_ARRAYS) {
    for (size_t i = 0; i < count; ++i)
        BRDF_SAMPLE_STORE(i,
                          brdf_sample_pair_kernel(model, &brdf, (graze_vec3){vx[i], vy[i], vz[i]}, s[i], t[i], u[i]));
}

#define BRDF_SAMPLE_LOOP(kind, ...)                                                                                    \
    brdf_sample_##kind##_loop(__VA_ARGS__, v.x, v.y, v.z, result.x, result.y, result.z, result.density, result.weight)

static void brdf_sample_ward_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                                   const double *t, graze_brdf_sample_arrays result) {
    switch (brdf->model) {
    case GRAZE_BRDF_GMD:
        BRDF_SAMPLE_LOOP(ward, GRAZE_BRDF_GMD, *brdf, count, s, t);
        break;
    case GRAZE_BRDF_WARD:
        BRDF_SAMPLE_LOOP(ward, GRAZE_BRDF_WARD, *brdf, count, s, t);
        break;
    case GRAZE_BRDF_WARD_DUER:
        BRDF_SAMPLE_LOOP(ward, GRAZE_BRDF_WARD_DUER, *brdf, count, s, t);
        break;
    default:
        BRDF_SAMPLE_LOOP(ward, GRAZE_BRDF_WARD_NEUMANN, *brdf, count, s, t);
    }
}

static void brdf_sample_pair_batch(const graze_brdf *brdf, size_t count, graze_vec3_arrays v, const double *s,
                                   const double *t, const double *u, graze_brdf_sample_arrays result) {
    switch (brdf->model) {
    case GRAZE_BRDF_GMD:
        BRDF_SAMPLE_LOOP(pair, GRAZE_BRDF_GMD, *brdf, count, s, t, u);
        break;
    case GRAZE_BRDF_WARD:
        BRDF_SAMPLE_LOOP(pair, GRAZE_BRDF_WARD, *brdf, count, s, t, u);
        break;
    case GRAZE_BRDF_WARD_DUER:
        BRDF_SAMPLE_LOOP(pair, GRAZE_BRDF_WARD_DUER, *brdf, count, s, t, u);
        break;
    default:
        BRDF_SAMPLE_LOOP(pair, GRAZE_BRDF_WARD_NEUMANN, *brdf, count, s, t, u);
    }
}

/* In single precision: as in double precision, with arguments widened and results rounded. */
typedef struct brdf_sample_block {
    double vx[FLOAT_BLOCK], vy[FLOAT_BLOCK], vz[FLOAT_BLOCK], s[FLOAT_BLOCK], t[FLOAT_BLOCK], u[FLOAT_BLOCK];
    double x[FLOAT_BLOCK], y[FLOAT_BLOCK], z[FLOAT_BLOCK], density[FLOAT_BLOCK], weight[FLOAT_BLOCK];
} brdf_sample_block;

BRDF_INLINE void brdf_widen_arguments(brdf_sample_block *block, size_t from, size_t length, graze_vec3_float_arrays v,
                                      const float *s, const float *t) {
    float_block_widen(block->vx, v.x + from, length);
    float_block_widen(block->vy, v.y + from, length);
    float_block_widen(block->vz, v.z + from, length);
    float_block_widen(block->s, s + from, length);
    float_block_widen(block->t, t + from, length);
}

BRDF_INLINE void brdf_round_samples(graze_brdf_sample_float_arrays result, size_t from, size_t length,
                                    const brdf_sample_block *block) {
    float_block_round(result.x + from, block->x, length);
    float_block_round(result.y + from, block->y, length);
    float_block_round(result.z + from, block->z, length);
    float_block_round(result.density + from, block->density, length);
    float_block_round(result.weight + from, block->weight, length);
}

static void brdf_sample_ward_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v,
                                         const float *s, const float *t, graze_brdf_sample_float_arrays result) {
    brdf_sample_block block;
    const graze_vec3_arrays view = {block.vx, block.vy, block.vz};
    const graze_brdf_sample_arrays samples = {block.x, block.y, block.z, block.density, block.weight};
    for (size_t from = 0; from < count; from += FLOAT_BLOCK) {
        size_t length = float_block_length(from, count);
        brdf_widen_arguments(&block, from, length, v, s, t);
        brdf_sample_ward_batch(brdf, length, view, block.s, block.t, samples);
        brdf_round_samples(result, from, length, &block);
    }
}

static void brdf_sample_pair_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays v,
                                         const float *s, const float *t, const float *u,
                                         graze_brdf_sample_float_arrays result) {
    brdf_sample_block block;
    const graze_vec3_arrays view = {block.vx, block.vy, block.vz};
    const graze_brdf_sample_arrays samples = {block.x, block.y, block.z, block.density, block.weight};
    for (size_t from = 0; from < count; from += FLOAT_BLOCK) {
        size_t length = float_block_length(from, count);
        brdf_widen_arguments(&block, from, length, v, s, t);
        float_block_widen(block.u, u + from, length);
        brdf_sample_pair_batch(brdf, length, view, block.s, block.t, block.u, samples);
        brdf_round_samples(result, from, length, &block);
    }
}

static graze_brdf_sample brdf_sample_ward(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    return brdf_sample_ward_kernel(brdf->model, brdf, v, s, t);
}

static graze_brdf_sample brdf_sample_pair(const graze_brdf *brdf, graze_vec3 v, double s, double t, double u) {
    return brdf_sample_pair_kernel(brdf->model, brdf, v, s, t, u);
}

#endif
