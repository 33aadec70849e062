/* Lambert's formula for four corners, several edges at once: half the mean height of the normals of the planes through
 * the point and the edges, each times the angle that its edge spans. */
#ifndef BRDF_PANEL_KERNELS_H
#define BRDF_PANEL_KERNELS_H

#include <math.h>
#include <stdint.h>

#include "brdf/kernels.h"

/* Where there is fma() vectors hold four numbers, or more. */
#ifdef BRDF_FMA
enum { PANEL_LANES = 4 };
#define PANEL_ALL(f) ((f)[0] & (f)[1] & (f)[2] & (f)[3])
#else
enum { PANEL_LANES = 2 };
#define PANEL_ALL(f) ((f)[0] & (f)[1])
#endif

typedef double numbers __attribute__((vector_size(PANEL_LANES * sizeof(double))));
typedef int64_t panel_flags __attribute__((vector_size(PANEL_LANES * sizeof(int64_t))));

#include "brdf/arc_tangent.h"

#define PANEL_INLINE static inline __attribute__((always_inline))

typedef struct numbers3 {
    numbers x, y, z;
} numbers3;

PANEL_INLINE numbers panel_dot(numbers3 a, numbers3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The next PANEL_LANES of four corners, as seen from the point; and the ones behind each of these, around the panel. */
#ifdef BRDF_FMA
PANEL_INLINE numbers3 panel_corners(graze_vec3 point, const graze_vec3 *c, int from) {
    (void)from;
    return (numbers3){(numbers){c[0].x, c[1].x, c[2].x, c[3].x} - point.x,
                      (numbers){c[0].y, c[1].y, c[2].y, c[3].y} - point.y,
                      (numbers){c[0].z, c[1].z, c[2].z, c[3].z} - point.z};
}

PANEL_INLINE numbers panel_turn(numbers a) {
    return (numbers){a[1], a[2], a[3], a[0]};
}

PANEL_INLINE numbers3 panel_next_corners(graze_vec3 point, const graze_vec3 *c, int from, numbers3 corners) {
    (void)point, (void)c, (void)from;
    return (numbers3){panel_turn(corners.x), panel_turn(corners.y), panel_turn(corners.z)};
}
#else
PANEL_INLINE numbers3 panel_corners(graze_vec3 point, const graze_vec3 *c, int from) {
    const graze_vec3 *a = &c[from % 4], *b = &c[(from + 1) % 4];
    return (numbers3){(numbers){a->x, b->x} - point.x, (numbers){a->y, b->y} - point.y,
                      (numbers){a->z, b->z} - point.z};
}

PANEL_INLINE numbers3 panel_next_corners(graze_vec3 point, const graze_vec3 *c, int from, numbers3 corners) {
    (void)corners;
    return panel_corners(point, c, from + 1);
}
#endif

PANEL_INLINE numbers panel_sqrt(numbers a) {
    for (int i = 0; i < PANEL_LANES; ++i)
        a[i] = sqrt(a[i]);
    return a;
}

/* With n = p x q and c = p.q of an edge from p to q the tangent of half its angle is |n| / (h + c), h^2 = n^2 + c^2. */
static bool panel(graze_vec3 point, graze_vec3 normal, const graze_vec3 *corners, double *sum) {
    const numbers none = {0};
    const numbers3 up = {none + normal.x, none + normal.y, none + normal.z};
    double edges[4];
    for (int k = 0; k < 4; k += PANEL_LANES) {
        const numbers3 p = panel_corners(point, corners, k), q = panel_next_corners(point, corners, k, p);
        const numbers3 n = {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
        const numbers n2 = panel_dot(n, n), c = panel_dot(p, q), h = panel_sqrt(n2 + c * c), scale = 1 / (h + c);
        const numbers tangent2 = n2 * scale * scale;
        const panel_flags fit =
            (panel_flags)(panel_dot(p, up) > 0) & (panel_flags)(c > 0) & (panel_flags)(tangent2 <= BRDF_SMALL_TANGENT2);
        if (!PANEL_ALL(fit))
            return false;
        const numbers edge = 2 * scale * panel_dot(n, up) * arc_tangent_over(tangent2);
        for (int i = 0; i < PANEL_LANES; ++i)
            edges[k + i] = edge[i];
    }
    *sum = (edges[0] + edges[2]) + (edges[1] + edges[3]);
    return true;
}

#endif
