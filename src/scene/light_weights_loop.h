/* The loop over a group's entries, for the instruction set that is in force where this is included.
 *
 * With d the distance and A the area, of a light that is small beside its distance a part A cos cos' / (pi d^2) of the
 * irradiance that it could give arrives; and the lobe (17) reflects f cos cos' A / d^2 of its radiance, where f is
 * taken at its middle, for a roughness that has its angular size added: in the slope plane, where the lobe is Gaussian,
 * that is nearly the lobe's mean over the light, and never much less. Neither is more than 1.
 *
 * Every operation is one of IEEE 754 on a single entry, and sums are made lane by lane: so all instruction sets give
 * the same bits. */
#ifndef SCENE_LIGHT_WEIGHTS_LOOP_H
#define SCENE_LIGHT_WEIGHTS_LOOP_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/angle.h"
#include "scene/light_weights.h"

#define LIGHT_INLINE static inline __attribute__((always_inline))

/* The part of the choices that is made evenly among all that are candidates, should a weight be much too small. */
#define EVEN_PART 0.005f

LIGHT_INLINE float float_max(float a, float b) {
    return a > b ? a : b;
}

LIGHT_INLINE float float_min(float a, float b) {
    return a < b ? a : b;
}

/* 2^x to 3e-6, for x <= 0; not less than 2^-100. */
LIGHT_INLINE float power_of_two(float x) {
    const float shift = 0x1.8p23f + 127;
    x = float_max(x, -100);
    float shifted = x + shift, f = x - (shifted - shift);
    uint32_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits <<= 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    return power * (1 + f * (0.6931472f + f * (0.2402265f + f * (0.0555041f + f * (0.0096181f + f * 0.0013333f)))));
}

typedef struct entry_place {
    float to_x, to_y, to_z; /* to the middle, in the shading frame */
    float height;           /* of the point over the entry's plane */
    float distance2;
} entry_place;

/* A difference of coordinates is exact, or nearly: so points next to a small light in a large scene see it right. */
LIGHT_INLINE entry_place place_of(const light_entries *e, size_t i, const light_weights_input *in) {
    float x = (float)(e->x[i] - in->px), y = (float)(e->y[i] - in->py), z = (float)(e->z[i] - in->pz);
    return (entry_place){
        .to_x = in->xx * x + in->xy * y + in->xz * z,
        .to_y = in->yx * x + in->yy * y + in->yz * z,
        .to_z = in->nx * x + in->ny * y + in->nz * z,
        .height = -(e->ax[i] * x + e->ay[i] * y + e->az[i] * z),
        .distance2 = float_max(x * x + y * y + z * z, LIGHT_LEAST * LIGHT_LEAST),
    };
}

LIGHT_INLINE float dot3(const float *a, float r, float g, float b) {
    return a[0] * r + a[1] * g + a[2] * b;
}

/* Where two quotients are wanted, 1/a and 1/b are made of 1/(ab): quotients cost most here. */
LIGHT_INLINE float weight_of(const light_entries *e, size_t i, const light_weights_input *in, bool has_lobe,
                             bool has_glows, bool is_group) {
    const float per_pi = (float)(1 / PI), log2_e = 1.44269504f;
    entry_place p = place_of(e, i, in);
    float distance = sqrtf(p.distance2), square = p.distance2 + e->core[i], per_both = 1 / (distance * square);
    float per_distance = per_both * square, per_square = per_both * distance, radius = e->radius[i];

    /* Above the horizon all of the light counts; across it, about the part that is above. */
    float above = p.to_z + radius, low = float_min(p.to_z, radius), part = low + radius;
    float height = part * part * e->quarter_per_radius[i] + (p.to_z - low);
    float cosine = float_min(height * per_distance, 1);

    /* The cosine at the light, for the normal that is turned most towards the point. In the plane, and near the light,
     * rounding shall not decide. */
    float slack = distance < radius ? 1e-6f : 0;
    float facing = p.height * per_distance + 2 * e->all_around[i],
          in_front = p.height + slack * radius + e->all_around[i];
    if (is_group) {
        float sine = sqrtf(float_max(1 - facing * facing, 0)), cone = e->cosine[i];
        float turned = facing * cone + sine * e->sine[i];
        facing = facing >= cone ? 1 : turned;
        in_front = facing * distance + 1.001f * radius;
    }
    float light_cosine = float_min(float_max(facing, 0.02f * radius * per_distance), 1);

    float projected = cosine * light_cosine * e->area[i] * per_square;
    float from_diffuse = dot3(in->diffuse, e->red[i], e->green[i], e->blue[i]);
    if (has_glows)
        from_diffuse += dot3(in->ambient_diffuse, e->ambient_red[i], e->ambient_green[i], e->ambient_blue[i]);
    float weight = from_diffuse * float_min(projected * per_pi, 1), brightness = from_diffuse;
    if (has_lobe) {
        /* With the height of h taken out of slopes and roughness. */
        float hx = p.to_x * per_distance + in->vx, hy = p.to_y * per_distance + in->vy;
        float hz = float_max(cosine + in->vz, 1e-4f), hx2 = hx * hx, hy2 = hy * hy, hz2 = hz * hz;
        float seen = float_min(e->spread[i] * per_distance * per_distance, 1e3f), widening = seen + 4 * seen * seen;
        float a2 = in->alpha_x2 * hz2 + widening, b2 = in->alpha_y2 * hz2 + widening, ab = sqrtf(a2 * b2);
        float per_all = 1 / (ab * hz2), per_ab = per_all * hz2;
        float slope2 = (hx2 * b2 + hy2 * a2) * (per_ab * per_ab);
        float value = (hx2 + hy2 + hz2) * (per_all * per_pi) * power_of_two(-log2_e * slope2);
        float from_glossy = dot3(in->glossy, e->red[i], e->green[i], e->blue[i]);
        if (has_glows)
            from_glossy += dot3(in->ambient_glossy, e->ambient_red[i], e->ambient_green[i], e->ambient_blue[i]);
        weight += from_glossy * float_min(value * projected, 1);
        brightness += from_glossy;
    }
    float least = float_min(float_min(above + 1e-6f * distance, in_front), brightness);
    weight = float_max(weight, 1e-30f);
    return least > 0 ? weight : 0;
}

/* The part of a spotlight's light that its focus leaves, or 0 where the point is outside of its cone. */
LIGHT_INLINE float spot_part(const light_entries *e, size_t i, const light_weights_input *in) {
    float x = (float)(e->x[i] - in->px), y = (float)(e->y[i] - in->py), z = (float)(e->z[i] - in->pz);
    float distance = sqrtf(float_max(x * x + y * y + z * z, LIGHT_LEAST * LIGHT_LEAST)), per_distance = 1 / distance;
    float aim = -(e->spot_x[i] * x + e->spot_y[i] * y + e->spot_z[i] * z) * per_distance;
    float aim_sine = sqrtf(float_max(1 - aim * aim, 0));
    float reach_sine = float_min(e->radius[i] * per_distance, 1), reach = sqrtf(1 - reach_sine * reach_sine);
    float nearest = aim >= reach ? 1 : aim * reach + aim_sine * reach_sine;
    float part = distance / (distance + e->spot_focus[i]);
    return nearest > e->spot_cosine[i] - 1e-5f ? float_max(part * part, 1e-30f) : 0;
}

LIGHT_INLINE void fill(const light_entries *e, size_t first, size_t count, const light_weights_input *in,
                       float *restrict weights, bool has_lobe, bool has_glows, bool is_group) {
    const light_weights_input k = *in;
    for (size_t i = 0; i < count; i++)
        weights[i] = weight_of(e, first + i, &k, has_lobe, has_glows, is_group);
}

static void weigh_lights(light_entries e, bool has_glows, size_t first, size_t count, const light_weights_input *in,
                         float *restrict weights) {
    if (in->has_lobe && has_glows)
        fill(&e, first, count, in, weights, true, true, false);
    else if (in->has_lobe)
        fill(&e, first, count, in, weights, true, false, false);
    else if (has_glows)
        fill(&e, first, count, in, weights, false, true, false);
    else
        fill(&e, first, count, in, weights, false, false, false);
}

static void weigh_groups(light_entries e, size_t first, size_t count, const light_weights_input *in,
                         float *restrict weights) {
    if (in->has_lobe)
        fill(&e, first, count, in, weights, true, true, true);
    else
        fill(&e, first, count, in, weights, false, true, true);
}

static void weigh_spots(light_entries e, size_t first, size_t count, const light_weights_input *in,
                        float *restrict weights) {
    const light_weights_input k = *in;
    for (size_t i = 0; i < count; i++) {
        float part = spot_part(&e, first + i, &k), weight = float_max(weights[i] * part, 1e-30f);
        weights[i] = float_min(weights[i], part) > 0 ? weight : 0;
    }
}

LIGHT_INLINE void weigh_blocks(const light_tree *tree, const light_group *group, size_t block, size_t blocks,
                               const light_weights_input *in, light_weights *w) {
    size_t start = block * LIGHT_LANES, first = group->first + start, count = blocks * LIGHT_LANES;
    if (!group->of_lights)
        weigh_groups(tree->entries, first, count, in, w->of + start);
    else
        weigh_lights(tree->entries, tree->has_glows, first, count, in, w->of + start);
    if (group->of_lights && tree->has_spots)
        weigh_spots(tree->entries, first, count, in, w->of + start);
}

LIGHT_INLINE void weigh(const light_tree *tree, const light_group *group, const light_weights_input *in,
                        light_weights *w) {
    float sums[LIGHT_LANES] = {0};
    int32_t counts[LIGHT_LANES] = {0};
    size_t near_blocks = (size_t)(group->blocks - group->far_blocks);
    weigh_blocks(tree, group, 0, near_blocks, in, w);
    if (group->far_blocks > 0) {
        light_weights_input anywhere = *in;
        anywhere.px = anywhere.py = anywhere.pz = 0;
        weigh_blocks(tree, group, near_blocks, (size_t)group->far_blocks, &anywhere, w);
    }
    for (int block = 0; block < group->blocks; block++)
        for (int lane = 0; lane < LIGHT_LANES; lane++) {
            float weight = w->of[block * LIGHT_LANES + lane];
            sums[lane] += weight;
            counts[lane] += weight > 0;
        }
    float sum = 0;
    w->candidates = 0;
    for (int lane = 0; lane < LIGHT_LANES; lane++) {
        sum += sums[lane];
        w->candidates += counts[lane];
    }
    float even = w->candidates > 0 ? EVEN_PART * sum / (float)w->candidates : 0;
    double lanes[LIGHT_LANES] = {0};
    for (int block = 0; block < group->blocks; block++)
        for (int lane = 0; lane < LIGHT_LANES; lane++) {
            float *weight = &w->of[block * LIGHT_LANES + lane];
            *weight = *weight > 0 ? *weight + even : 0;
            lanes[lane] += (double)*weight;
        }
    w->total = 0;
    for (int lane = 0; lane < LIGHT_LANES; lane++) {
        w->lanes[lane] = lanes[lane];
        w->total += lanes[lane];
    }
}

#endif
