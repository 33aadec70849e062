/* Pairs of directions that are hard on a reflectance model, in kinds; from a seed, the same everywhere. */
#ifndef ACCURACY_PAIRS_H
#define ACCURACY_PAIRS_H

#include "brdf/common.h"

enum { PAIRS = 16 }; /* to a lobe */

typedef struct pair_group {
    double alpha_x, alpha_y;
    double least; /* cosine */
    graze_vec3 l[PAIRS], v[PAIRS];
} pair_group;

typedef struct pair_kind {
    const char *name;
    void (*draw_roughness)(uint64_t *seed, pair_group *);
    void (*draw_pair)(uint64_t *seed, const pair_group *, graze_vec3 *l, graze_vec3 *v);
} pair_kind;

static inline int pairs_pick(uint64_t *seed, int count) {
    return (int)(draw(seed) * count);
}

static inline double pairs_sign(uint64_t *seed) {
    return draw(seed) < .5 ? -1 : 1;
}

static inline double pairs_turn(uint64_t *seed) {
    return draw_between(seed, 0, 2 * pi);
}

/* So many units in the last place away. */
static inline double pairs_nudged(uint64_t *seed, double x, int most) {
    for (int n = pairs_pick(seed, most + 1), up = draw(seed) < .5; n > 0; --n)
        x = nextafter(x, up ? HUGE_VAL : -HUGE_VAL);
    return x;
}

static inline void pairs_exchange(uint64_t *seed, graze_vec3 *l, graze_vec3 *v) {
    if (draw(seed) < .5) {
        graze_vec3 a = *l;
        *l = *v;
        *v = a;
    }
}

/* --- Roughness ---------------------------------------------------------------------------------------------------- */

static inline void pairs_any_roughness(uint64_t *seed, pair_group *g) {
    g->alpha_x = draw_power(seed, GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX);
    g->alpha_y = draw(seed) < .4 ? g->alpha_x : draw_power(seed, GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX);
}

/* The least, the largest, and one beside the other. */
static inline void pairs_extreme_roughness(uint64_t *seed, pair_group *g) {
    const double ends[] = {GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX};
    g->alpha_x = draw(seed) < .8 ? ends[pairs_pick(seed, 2)] : draw_power(seed, 1e-6, 10);
    g->alpha_y = draw(seed) < .8 ? ends[pairs_pick(seed, 2)] : draw_power(seed, 1e-6, 10);
}

/* Few bits. */
static inline void pairs_round_roughness(uint64_t *seed, pair_group *g) {
    const double some[] = {0x1p-19, 0x1p-10, .0625, .125, .25, .375, .5, 1, 1.5, 2, 4, 8};
    g->alpha_x = some[pairs_pick(seed, 12)];
    g->alpha_y = draw(seed) < .5 ? g->alpha_x : some[pairs_pick(seed, 12)];
}

/* --- Pairs -------------------------------------------------------------------------------------------------------- */

static inline graze_vec3 pairs_above(uint64_t *seed) {
    double cosine = 1 - draw(seed);
    return direction(cosine, pairs_turn(seed));
}

static inline void pairs_random(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    (void)g;
    *l = pairs_above(seed);
    *v = pairs_above(seed);
}

/* v reflected about a slope r times the roughness; false if that is below the surface. */
static inline bool pairs_reflect(const pair_group *g, graze_vec3 v, double r, double azimuth, graze_vec3 *l) {
    double x = g->alpha_x * r * cos(azimuth), y = g->alpha_y * r * sin(azimuth);
    double square = 1 + x * x + y * y, q = v.x * x + v.y * y, scale = 2 * (q + v.z) / square;
    *l = (graze_vec3){scale * x - v.x, scale * y - v.y, (v.z * (2 - square) + 2 * q) / square};
    return l->z >= g->least;
}

static inline void pairs_at_distance(uint64_t *seed, const pair_group *g, double low, double high, double least,
                                     graze_vec3 *l, graze_vec3 *v) {
    for (int i = 0; i < 1000; ++i) { /* large slopes are never above the surface; fewer are tried then */
        *v = draw(seed) < .5 ? pairs_above(seed) : direction(draw_power(seed, least, 1), pairs_turn(seed));
        if (v->z >= g->least &&
            pairs_reflect(g, *v, draw_between(seed, low, high) * (i < 20 ? 1 : draw(seed)), pairs_turn(seed), l))
            break;
    }
    pairs_exchange(seed, l, v);
}

static inline void pairs_centred(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    pairs_at_distance(seed, g, 0, 2, .01, l, v);
}

/* Exponents of E to 745, where a factor of 1 before it leaves nothing. */
static inline void pairs_tail(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    pairs_at_distance(seed, g, 2, 27.3, .01, l, v);
}

static inline void pairs_grazing_centred(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    pairs_at_distance(seed, g, 0, 3, g->least, l, v);
}

/* l = (-vx, -vy, vz), or nearly. */
static inline void pairs_mirror(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    *v = direction(draw(seed) < .5 ? draw(seed) : draw_power(seed, g->least, 1), pairs_turn(seed));
    if (!(v->z >= g->least))
        v->z = g->least;
    *l = mirror_of(*v);
    if (draw(seed) < .25)
        l->z = pairs_nudged(seed, l->z, 4);
    if (draw(seed) < .25)
        l->x = pairs_nudged(seed, l->x, 4);
    if (!(l->z >= g->least))
        l->z = g->least;
}

/* One next to the horizon, opposite the other, which stands as high as the lobe reaches. */
static inline void pairs_one_grazing(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    double azimuth = draw(seed) < .3 ? 0 : draw(seed) < .3 ? pi / 2 : pairs_turn(seed), r = draw_between(seed, 0, 27);
    double alpha = hypot(g->alpha_x * cos(azimuth), g->alpha_y * sin(azimuth)); /* roughly */
    double height = fmin(2 * atan(alpha * r), 1.55);
    double reach = hypot(g->alpha_x * sin(azimuth), g->alpha_y * cos(azimuth));
    *v = direction(fmax(sin(height), 2 * g->least), azimuth);
    *l = direction(draw_power(seed, g->least, fmax(1e-3 * v->z, 2 * g->least)),
                   azimuth + pi + fmin(reach, 1) * v->z * draw_between(seed, -4, 4));
    pairs_exchange(seed, l, v);
}

static inline void pairs_both_grazing(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    double azimuth = pairs_turn(seed), cosine = draw_power(seed, g->least, 1);
    double other =
        draw(seed) < .5 ? fmax(fmin(cosine * draw_power(seed, .01, 100), 1), g->least) : draw_power(seed, g->least, 1);
    *v = direction(cosine, azimuth);
    *l = direction(other, azimuth + (draw(seed) < .2 ? 0 : pi));
    if (draw(seed) < .5)
        *l = (graze_vec3){-v->x, -v->y, other};
}

/* Both next to the horizon and nearly opposite: h is tiny, the factor before E huge, and exponents to 2200 matter. */
static inline void pairs_grazing_tail(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    double cosine = draw_power(seed, g->least * 1000, 1e-3), other = cosine * draw_between(seed, .001, 1);
    double x = cosine * draw(seed), far = draw(seed) < .3 ? 47 : 27.3;
    *v = (graze_vec3){x, 1, cosine};
    *l = (graze_vec3){g->alpha_x * (cosine + other) * draw_between(seed, -far, far) - x, -1, other};
    pairs_exchange(seed, l, v);
}

/* The slope is nearly 1 and l just above the surface: 1 - tau^2, and W with it, nearly vanish. Or the slope is 1 across
 * the plane of v: both candidates are at the horizon, and W is about 2 lz/vz, however small that is. */
static inline void pairs_vanishing(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    double cosine = draw_power(seed, fmax(1e-10, 1e3 * g->least), 1), turn = pairs_turn(seed);
    if (draw(seed) < .3) {
        double sine = sqrt((1 - cosine) * (1 + cosine)), x = cos(turn), y = sin(turn);
        if (draw(seed) < .7) {
            x = pairs_sign(seed);
            y = 0;
        }
        *v = (graze_vec3){-sine * y, sine * x, cosine};
        *l = (graze_vec3){cosine * x + sine * y, cosine * y - sine * x,
                          cosine * draw_power(seed, g->least / cosine, 1e-3)};
        if (draw(seed) < .3)
            l->x = pairs_nudged(seed, l->x, 2);
        return;
    }
    double low = fmax(cosine * draw_power(seed, 1e-12, .5), g->least), hz = cosine + low;
    double slope = draw(seed) < .5 ? 1 - draw_power(seed, 1e-15, .1) : draw_between(seed, .8, 1.02);
    *v = direction(cosine, 0);
    *l = (graze_vec3){hz * slope * cos(turn) - v->x, hz * slope * sin(turn) - v->y, low};
}

/* Where an implementation may go from one way of reckoning to another: powers of two and of the cosines, equal
 * cosines, slopes of 1, round exponents and odd halves of ln 2. */
static inline void pairs_switch(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    const double exponents[] = {64, 87.3, 88.7, 103.3, 104, 128, 256, 512, 690.7, 708.4, 709.8, 744.4, 745.2};
    const int powers[] = {-20, -26,  -27,  -30,  -40,  -52,  -53,  -63,  -64,  -75,
                          -80, -100, -120, -126, -150, -200, -256, -300, -400, -480};
    double turn = pairs_turn(seed);
    switch (pairs_pick(seed, 5)) {
    case 0: /* a power of two for one cosine or both */
        pairs_grazing_tail(seed, g, l, v);
        double power = draw(seed) < .5 ? powers[pairs_pick(seed, 20)] : floor(draw_between(seed, log2(g->least), 0));
        double cosine = fmax(pairs_nudged(seed, exp2(power), 3), g->least);
        double other = draw(seed) < .5 ? l->z * (cosine / v->z) : pairs_nudged(seed, exp2(power), 3);
        if (draw(seed) < .3)
            other = fmax(exp2(power) - fmin(cosine, exp2(power) / 2), g->least); /* hz is the power */
        l->x = (l->x + v->x) / (l->z + v->z) * (cosine + other) - v->x;
        l->z = fmax(other, g->least);
        v->z = cosine;
        return;
    case 1: /* equal cosines, or nearly; h along an axis or not */
        *v = direction(fmax(draw(seed), g->least), turn);
        double aside = g->alpha_x * 2 * v->z * draw_between(seed, -6, 6);
        *l = (graze_vec3){aside - v->x, draw(seed) < .5 ? -v->y : g->alpha_y * aside / g->alpha_x - v->y,
                          pairs_nudged(seed, v->z, 3)};
        return;
    case 2: /* a slope of 1 along an axis, or nearly */
        *v = direction(draw_power(seed, g->least, 1), turn);
        *l = (graze_vec3){pairs_nudged(seed, pairs_sign(seed) * 2 * v->z - v->x, 3), -v->y, v->z};
        if (draw(seed) < .5)
            *l = (graze_vec3){-v->x, l->x + v->x - v->y, v->z};
        return;
    case 3: { /* one exponent of E */
        double exponent = draw(seed) < .5 ? exponents[pairs_pick(seed, 13)]
                                          : (floor(draw_between(seed, 0, 1074)) + (draw(seed) < .5 ? .5 : 0)) * log(2);
        double r = sqrt(exponent) * (1 + pairs_sign(seed) * draw_power(seed, 1e-16, 1e-3)), share = draw(seed);
        double z = draw_power(seed, g->least, .5), hz = 2 * z;
        double x = g->alpha_x * r * (share < .3 ? 1 : cos(turn)) * hz,
               y = g->alpha_y * r * (share < .3 ? 0 : sin(turn)) * hz;
        *v = (graze_vec3){x / 2, y / 2, z};
        *l = *v;
        if (draw(seed) < .5) {
            double along = draw(seed) * sqrt(1 - z * z);
            v->x += along;
            l->x -= along;
        }
        return;
    }
    default: /* W's two cases meet: 2 vz - lz = tau^2 (lz + 2 vz) */
        *v = direction(draw_power(seed, g->least, 1), turn);
        double ratio = draw(seed) < .5 ? draw(seed) * 2 : draw_power(seed, 1e-20, 2),
               tau = sqrt((2 - ratio) / (2 + ratio));
        tau *= 1 + pairs_sign(seed) * (draw(seed) < .3 ? 0 : draw_power(seed, 1e-16, .1));
        double low = fmax(v->z * ratio, g->least), h = tau * (v->z + low), way = pairs_turn(seed);
        *l = (graze_vec3){h * cos(way) - v->x, h * sin(way) - v->y, low};
    }
}

/* Few bits, so that sums are exact and results are numbers, or halfway between two. */
static inline double pairs_few_bits(uint64_t *seed) {
    return ldexp(floor(draw_between(seed, 1, draw(seed) < .5 ? 9 : 1025)), -3 - pairs_pick(seed, 8));
}
static inline void pairs_ties(uint64_t *seed, const pair_group *g, graze_vec3 *l, graze_vec3 *v) {
    (void)g;
    *v = (graze_vec3){pairs_sign(seed) * pairs_few_bits(seed), pairs_few_bits(seed), pairs_few_bits(seed)};
    *l = (graze_vec3){pairs_few_bits(seed), pairs_sign(seed) * pairs_few_bits(seed), pairs_few_bits(seed)};
    if (draw(seed) < .5) {
        l->x = -v->x;
        l->y = -v->y;
    }
    if (draw(seed) < .2)
        l->z = v->z;
}

static const pair_kind pair_kinds[] = {
    {"random", pairs_any_roughness, pairs_random},
    {"centred", pairs_any_roughness, pairs_centred},
    {"tail", pairs_any_roughness, pairs_tail},
    {"mirror", pairs_any_roughness, pairs_mirror},
    {"one grazing", pairs_any_roughness, pairs_one_grazing},
    {"both grazing", pairs_any_roughness, pairs_both_grazing},
    {"grazing, centred", pairs_any_roughness, pairs_grazing_centred},
    {"grazing, tail", pairs_any_roughness, pairs_grazing_tail},
    {"extreme, centred", pairs_extreme_roughness, pairs_centred},
    {"extreme, tail", pairs_extreme_roughness, pairs_tail},
    {"extreme, grazing", pairs_extreme_roughness, pairs_grazing_tail},
    {"vanishing W", pairs_any_roughness, pairs_vanishing},
    {"switch points", pairs_any_roughness, pairs_switch},
    {"ties", pairs_round_roughness, pairs_ties},
};
enum { PAIR_KINDS = sizeof pair_kinds / sizeof *pair_kinds };

/* A lobe and its pairs. Cosines are `least` or more. */
static inline void pairs_draw(uint64_t *seed, const pair_kind *kind, double least, pair_group *g) {
    g->least = least;
    kind->draw_roughness(seed, g);
    for (int i = 0; i < PAIRS; ++i) {
        kind->draw_pair(seed, g, &g->l[i], &g->v[i]);
        g->l[i].z = fmax(g->l[i].z, least);
        g->v[i].z = fmax(g->v[i].z, least);
    }
}

#endif
