/* What the tests of src/material share: random numbers, and the reflectance typed anew from Radiance's documents. */
#ifndef TEST_MATERIAL_SUPPORT_H
#define TEST_MATERIAL_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/vector.h"
#include "graze/material.h"

#define SUPPORT_PI 3.14159265358979323846264338327950288L

/* SplitMix64: a fixed sequence for each seed. */
typedef struct generator {
    uint64_t state;
} generator;

static inline double uniform(generator *g) {
    uint64_t z = g->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static inline vec3 random_direction(generator *g) {
    double z = 2 * uniform(g) - 1, angle = 2 * (double)SUPPORT_PI * uniform(g), r = sqrt(1 - z * z);
    return vec3_normalize(vec3_make(r * cos(angle), r * sin(angle), z));
}

/* A direction at `cosine` from n, n and the result turned at random. */
static inline vec3 direction_at(generator *g, vec3 n, double cosine) {
    vec3 t = vec3_normalize(vec3_cross(n, random_direction(g)));
    t = vec3_normalize(vec3_add_scaled(t, -vec3_dot(t, n), n));
    return vec3_normalize(vec3_add_scaled(vec3_scale(sqrt(1 - cosine * cosine), t), cosine, n));
}

/* A surface of this material, turned at random and seen under this cosine. */
static inline graze_surface prepare(const graze_material *m, generator *g, double cosine) {
    graze_surface s;
    vec3 n = random_direction(g);
    graze_surface_prepare(&s, m, n, direction_at(g, n, cosine), NULL);
    return s;
}

static inline graze_surface_sample draw(const graze_surface *s, graze_lobe lobe, generator *g) {
    double r0 = uniform(g), r1 = uniform(g), r2 = uniform(g);
    return graze_surface_sample_lobe(s, lobe, r0, r1, r2);
}

static inline double channel(rgb a, int index) {
    return index == 0 ? a.r : index == 1 ? a.g : a.b;
}

static inline graze_material material_make(graze_material_kind kind, rgb color, double specularity, double u,
                                           double v) {
    return (graze_material){
        .kind = kind, .color = color, .specularity = specularity, .roughness_u = u, .roughness_v = v};
}

/* ---- The reference: long double, by scalar products in world space, no shading frame for the diffuse part. ---- */

typedef struct wide {
    long double x, y, z;
} wide;

static inline wide widen(vec3 a) {
    return (wide){a.x, a.y, a.z};
}
static inline long double wide_dot(wide a, wide b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline wide wide_cross(wide a, wide b) {
    return (wide){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline wide wide_normalize(wide a) {
    long double d = sqrtl(wide_dot(a, a));
    return (wide){a.x / d, a.y / d, a.z / d};
}

/* BRDF of an oriented rough material in one channel: diffuse and specular part apart. */
static inline void reference_value(const graze_material *m, long double color, vec3 normal, vec3 l, vec3 view,
                                   long double *diffuse, long double *specular) {
    wide n = wide_normalize(widen(normal)), o = wide_normalize(widen(view)), i = wide_normalize(widen(l));
    *diffuse = *specular = 0;
    if (wide_dot(i, n) <= 0)
        return;
    *diffuse = color * (1 - (long double)m->specularity) / SUPPORT_PI;
    if (wide_dot(o, n) <= 0)
        return;
    wide v = wide_normalize(wide_cross(n, widen(m->orientation))), u = wide_cross(v, n);
    wide h = {i.x + o.x, i.y + o.y, i.z + o.z};
    long double hu = wide_dot(h, u) / m->roughness_u, hv = wide_dot(h, v) / m->roughness_v, hn = wide_dot(h, n);
    long double gauss = expl(-(hu * hu + hv * hv) / (hn * hn));
    long double lobe = gauss * wide_dot(h, h) / (SUPPORT_PI * m->roughness_u * m->roughness_v * powl(hn, 4));
    *specular = (m->kind == GRAZE_METAL ? color : 1) * m->specularity * lobe;
}

static inline void assert_close_relative(double value, long double expected, double tolerance) {
    if (!(fabsl(value - expected) <= tolerance * fabsl(expected)))
        fail_msg("%.17g is not %.20Lg to %g", value, expected, tolerance);
}

static inline void assert_rgb(rgb value, double r, double g, double b, double tolerance) {
    assert_close_relative(value.r, r, tolerance);
    assert_close_relative(value.g, g, tolerance);
    assert_close_relative(value.b, b, tolerance);
}

static inline void assert_unit(vec3 a) {
    assert_close_relative(vec3_length(a), 1, 1e-12);
}

static inline void assert_finite_nonnegative(rgb a) {
    if (!(isfinite(a.r) && isfinite(a.g) && isfinite(a.b) && a.r >= 0 && a.g >= 0 && a.b >= 0))
        fail_msg("(%g %g %g) is not a finite, non-negative colour", a.r, a.g, a.b);
}

#endif
