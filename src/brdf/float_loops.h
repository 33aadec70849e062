/* Values in single precision, over arrays: to be compiled once for each instruction set.
 *
 * Floats are evaluated in double precision, where their squares and quotients neither over- nor underflow and what is
 * lost is nothing: no more than 2^-50 of a factor, and 2^-42 of E, whose exponent matters up to 700 at most. Only the
 * power of two between 2^-1/2 and 2^1/2, a polynomial of which there is most to do, is left to floats. So, with
 * E = 2^(n + f),
 *
 *     value = g p(f),   g = factor x 2^(n - 1),   p(f) = 2 x 2^f
 *
 * In units of 2^-24 of the value, and where they hurt most, which is for f = -1/2 and a value just below a power of
 * two: g is off by .708 for its rounding; p by .708 for its sum, .354 for each of the two roundings under that, .174
 * for f's, .051 for the approximation, .101 for the rest; and half an ulp for the product makes 2.95 ulp.
 *
 * For values below 2^-124.5, g may be below the normal floats, where its rounding is off by more: by 2^-150, or, for
 * f = 1/2 and a value just below 2^-125, by 1.415. The others are then .708, .177 twice, .174, .051, .1, and .5 for the
 * product: 3.31 ulp.
 *
 * Values below the normal floats become 0 where g is below `least`: all below 2^-127.04, some up to 2^-126.04; the
 * others are within the bound. Tails are full of them, and one takes a processor as long as a hundred others. */
#ifndef BRDF_FLOAT_LOOPS_H
#define BRDF_FLOAT_LOOPS_H

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "brdf/blocks.h"
#include "brdf/constants.h"
#include "brdf/elementary.h"
#include "brdf/models.h"
#include "graze/brdf_batch.h"

/* For r = s/hz^2, E = 2^((x hx^2 + y hy^2) r), and (17) is h.h r^2 E. */
typedef struct float_lobe {
    double s, x, y;
    double quarter; /* 1/(4 pi ax ay) */
} float_lobe;

BRDF_INLINE float_lobe float_lobe_of(const graze_brdf *brdf) {
    const double log2_e = 0x1.71547652b82fep+0;
    double ax = brdf->alpha_x, ay = brdf->alpha_y, pi_alphas = brdf_pi * (ax * ay), s = 1 / sqrt(pi_alphas);
    return (float_lobe){s, -log2_e / (ax * ax * s), -log2_e / (ay * ay * s), .25 / pi_alphas};
}

/* The value but for E. */
BRDF_INLINE double float_factor(graze_brdf_model model, const float_lobe *k, double square, double r, double lz,
                                double vz) {
    switch (model) {
    case GRAZE_BRDF_GMD: /* (17) */
        return square * (r * r);
    case GRAZE_BRDF_WARD: /* (4) */
        return k->quarter / sqrt(lz * vz);
    case GRAZE_BRDF_WARD_DUER: /* (5) */
        return k->quarter / (lz * vz);
    case GRAZE_BRDF_WARD_NEUMANN:; /* and what is no model */
    }
    return k->quarter / (lz > vz ? lz : vz);
}

/* f and g of all pairs. */
BRDF_INLINE void float_parts(graze_brdf_model model, const float_lobe *k, size_t count, graze_vec3_float_arrays l,
                             graze_vec3_float_arrays v, float *restrict f, float *restrict g) {
    const double shift = 0x1.8p52 + 1022; /* puts the biased exponent of 2^(n - 1) into the low bits */
    const double least = 0x1.6p-128;      /* g of a normal value is 2^-127.5 or more, as p is 2^1.5 at most */
    for (size_t i = 0; i < count; ++i) {
        double lz = l.z[i], vz = v.z[i];
        double hx = (double)l.x[i] + v.x[i], hy = (double)l.y[i] + v.y[i], hz = lz + vz;
        double hx2 = hx * hx, hy2 = hy * hy, hz2 = hz * hz;
        double r = k->s / hz2;
        double exponent = (hx2 * k->x + hy2 * k->y) * r;
        double shifted = exponent + shift;
        shifted = shifted > 0x1.8p52 ? shifted : 0x1.8p52; /* 2^-1023 becomes 0, and so does the value */
        f[i] = (float)(exponent - (shifted - shift));
        double factor = float_factor(model, k, (hx2 + hy2) + hz2, r, lz, vz);
        factor *= brdf_from_bits(brdf_bits(shifted) << 52);
        g[i] = (float)(factor >= least ? factor : 0);
    }
}

/* The coefficients of p were found by search among floats, from a weighted fit to 2 x 2^f: they leave a relative error
 * of 2^-28.3. */
BRDF_INLINE void float_products(size_t count, const float *restrict lz, const float *restrict vz,
                                const float *restrict f, const float *restrict g, float *restrict result) {
    for (size_t i = 0; i < count; ++i) {
        float x = f[i];
        float high = 0x1.c6af7cp-4f + x * (0x1.3b2de0p-6f + x * (0x1.5f0830p-9f + x * 0x1.416b5ap-12f));
        float p = 2 + x * (0x1.62e430p+0f + x * (0x1.ebfbdcp-2f + x * high));
        float value = p * g[i];
        value = value < FLT_MAX ? value : FLT_MAX;
        result[i] = ((lz[i] > 0) & (vz[i] > 0) & (g[i] > 0)) ? value : 0;
    }
}

BRDF_INLINE void float_values(graze_brdf_model model, const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                              graze_vec3_float_arrays v, float *result) {
    const float_lobe k = float_lobe_of(brdf);
    float f[BRDF_BLOCK], g[BRDF_BLOCK];
    for (size_t start = 0; start < count; start += BRDF_BLOCK) {
        size_t length = block_length(start, count);
        graze_vec3_float_arrays block_l = {l.x + start, l.y + start, l.z + start};
        graze_vec3_float_arrays block_v = {v.x + start, v.y + start, v.z + start};
        float_parts(model, &k, length, block_l, block_v, f, g);
        float_products(length, block_l.z, block_v.z, f, g, result + start);
    }
}

static void value_float_batch(const graze_brdf *brdf, size_t count, graze_vec3_float_arrays l,
                              graze_vec3_float_arrays v, float *result) {
    BRDF_WITH_CONSTANT_MODEL(brdf->model, float_values(model, brdf, count, l, v, result); return );
}

#endif
