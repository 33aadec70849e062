/* Arithmetic on graze_vec3 and graze_rgb. */
#ifndef BASE_VECTOR_H
#define BASE_VECTOR_H

#include <math.h>

#include "graze/vector.h"

typedef graze_vec3 vec3;
typedef graze_rgb rgb;

static inline vec3 vec3_make(double x, double y, double z) {
    return (vec3){x, y, z};
}
static inline vec3 vec3_add(vec3 a, vec3 b) {
    return (vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline vec3 vec3_subtract(vec3 a, vec3 b) {
    return (vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline vec3 vec3_scale(double s, vec3 a) {
    return (vec3){s * a.x, s * a.y, s * a.z};
}
/* a + s b */
static inline vec3 vec3_add_scaled(vec3 a, double s, vec3 b) {
    return (vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline vec3 vec3_negate(vec3 a) {
    return (vec3){-a.x, -a.y, -a.z};
}
static inline double vec3_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline vec3 vec3_cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline int vec3_is_same(vec3 a, vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
static inline double vec3_length(vec3 a) {
    return sqrt(vec3_dot(a, a));
}
/* a / |a|; the null vector where a is null. Beware |a|^2 overflowing or underflowing: |a| in 1e-150 .. 1e150. */
static inline vec3 vec3_normalize(vec3 a) {
    double length = vec3_length(a);
    return length > 0 ? vec3_scale(1 / length, a) : (vec3){0, 0, 0};
}
/* The larger and the smaller of two numbers, of which `b` counts where one is not a number: one instruction, where
 * fmax and fmin are calls. */
static inline double double_max(double a, double b) {
    return a > b ? a : b;
}
static inline double double_min(double a, double b) {
    return a < b ? a : b;
}
/* The same for each component: the corners of the box around two. */
static inline vec3 vec3_min(vec3 a, vec3 b) {
    return (vec3){double_min(a.x, b.x), double_min(a.y, b.y), double_min(a.z, b.z)};
}
static inline vec3 vec3_max(vec3 a, vec3 b) {
    return (vec3){double_max(a.x, b.x), double_max(a.y, b.y), double_max(a.z, b.z)};
}
static inline double vec3_max_abs(vec3 a) {
    return double_max(fabs(a.x), double_max(fabs(a.y), double_max(fabs(a.z), 0)));
}
/* |a| for components of any finite size. */
static inline double vec3_safe_length(vec3 a) {
    double most = vec3_max_abs(a);
    return most > 0 ? most * vec3_length((vec3){a.x / most, a.y / most, a.z / most}) : 0;
}
/* a / |a| for components of any finite size; the null vector where a is null or not finite. */
static inline vec3 vec3_safe_normalize(vec3 a) {
    double length2 = vec3_dot(a, a);
    /* As nearly always: faster, and as exact. */
    if (length2 > 1e-250 && length2 < 1e250)
        return vec3_scale(1 / sqrt(length2), a);
    double most = vec3_max_abs(a);
    return most > 0 ? vec3_normalize((vec3){a.x / most, a.y / most, a.z / most}) : (vec3){0, 0, 0};
}

/* A unit vector at right angles to a unit vector. */
static inline vec3 vec3_perpendicular(vec3 a) {
    return vec3_normalize(fabs(a.x) < fabs(a.z) ? (vec3){0, a.z, -a.y} : (vec3){-a.y, a.x, 0});
}

/* An orthonormal, right-handed frame: x cross y = z. */
typedef struct frame {
    vec3 x, y, z;
} frame;
/* Some frame with the given unit vector as its z axis. */
frame frame_around(vec3 z);
static inline vec3 frame_to_local(const frame *f, vec3 v) {
    return (vec3){vec3_dot(v, f->x), vec3_dot(v, f->y), vec3_dot(v, f->z)};
}
static inline vec3 frame_to_world(const frame *f, vec3 v) {
    return vec3_add_scaled(vec3_add_scaled(vec3_scale(v.x, f->x), v.y, f->y), v.z, f->z);
}

static inline rgb rgb_gray(double s) {
    return (rgb){s, s, s};
}
static inline rgb rgb_add(rgb a, rgb b) {
    return (rgb){a.r + b.r, a.g + b.g, a.b + b.b};
}
static inline rgb rgb_multiply(rgb a, rgb b) {
    return (rgb){a.r * b.r, a.g * b.g, a.b * b.b};
}
/* Which share of `whole` a part of it is: 0 of nothing. */
static inline double double_share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}
static inline rgb rgb_share(rgb part, rgb whole) {
    return (rgb){double_share(part.r, whole.r), double_share(part.g, whole.g), double_share(part.b, whole.b)};
}
static inline rgb rgb_scale(double s, rgb a) {
    return (rgb){s * a.r, s * a.g, s * a.b};
}
static inline rgb rgb_power(rgb a, double exponent) {
    double r = pow(a.r, exponent);
    return (rgb){r, a.g == a.r ? r : pow(a.g, exponent), a.b == a.r ? r : pow(a.b, exponent)};
}
/* a + s b */
static inline rgb rgb_add_scaled(rgb a, double s, rgb b) {
    return (rgb){a.r + s * b.r, a.g + s * b.g, a.b + s * b.b};
}
static inline double rgb_max(rgb a) {
    return double_max(a.r, double_max(a.g, a.b));
}
static inline double rgb_min(rgb a) {
    return double_min(a.r, double_min(a.g, a.b));
}
static inline int rgb_is_black(rgb a) {
    return a.r == 0 && a.g == 0 && a.b == 0;
}
/* The photopic brightness of Radiance's primaries (.640 .330 .290 .600 .150 .060, white 1/3 1/3); times 179 lm/W it is
 * luminance in cd/m^2. */
static inline double rgb_brightness(rgb a) {
    return 0.265074126 * a.r + 0.670114631 * a.g + 0.064811243 * a.b;
}

#endif
