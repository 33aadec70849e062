/* Intersection by brute force in long double, sharing nothing with src/geometry: each surface's own equation, every
 * surface asked. */
#ifndef TEST_GEOMETRY_ORACLE_H
#define TEST_GEOMETRY_ORACLE_H

#include <math.h>

#include "geometry/geometry.h"

typedef struct exact3 {
    long double x, y, z;
} exact3;

/* A crossing, and how far from anything that would make it vanish (an edge, a rim, a tangent), as a length. */
typedef struct oracle_crossing {
    long double distance, margin;
    int surface;
    bool front;
} oracle_crossing;

static inline exact3 exact(vec3 a) {
    return (exact3){a.x, a.y, a.z};
}
static inline exact3 exact_add(exact3 a, long double s, exact3 b) {
    return (exact3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline long double exact_dot(exact3 a, exact3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline exact3 exact_cross(exact3 a, exact3 b) {
    return (exact3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline long double exact_length(exact3 a) {
    return sqrtl(exact_dot(a, a));
}

/* Even-odd in the plane after dropping the normal's largest coordinate. `margin`: distance to the outline. */
static inline bool oracle_in_polygon(const shape *s, exact3 p, long double *margin) {
    exact3 n = exact(s->polygon.normal);
    int drop = fabsl(n.x) > fabsl(n.y) ? 0 : 1;
    if (fabsl(n.z) > fabsl(drop ? n.y : n.x))
        drop = 2;
    bool inside = false;
    *margin = INFINITY;
    uint32_t count = s->polygon.vertex_count;
    for (uint32_t i = 0, j = count - 1; i < count; j = i++) {
        exact3 a = exact_add(exact(s->polygon.vertices[i]), -1, p), b = exact_add(exact(s->polygon.vertices[j]), -1, p);
        long double ax = drop == 0 ? a.y : a.x, ay = drop == 2 ? a.y : a.z;
        long double bx = drop == 0 ? b.y : b.x, by = drop == 2 ? b.y : b.z;
        if ((ay > 0) != (by > 0) && ax - ay * (bx - ax) / (by - ay) > 0)
            inside = !inside;
        exact3 edge = exact_add(b, -1, a);
        long double length2 = exact_dot(edge, edge);
        long double t = length2 > 0 ? -exact_dot(a, edge) / length2 : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        *margin = fminl(*margin, exact_length(exact_add(a, t, edge)));
    }
    return inside;
}

static inline int oracle_flat(const shape *s, exact3 o, exact3 d, oracle_crossing *out) {
    bool polygon = s->kind == SHAPE_POLYGON;
    exact3 n = exact(polygon ? s->polygon.normal : s->ring.normal);
    long double slope = exact_dot(n, d);
    exact3 c;
    if (polygon) { /* the mean vertex, not as the shape has it */
        c = (exact3){0, 0, 0};
        for (uint32_t i = 0; i < s->polygon.vertex_count; i++)
            c = exact_add(c, 1.0L / s->polygon.vertex_count, exact(s->polygon.vertices[i]));
    } else {
        c = exact(s->ring.center);
    }
    long double t = exact_dot(n, exact_add(c, -1, o)) / slope;
    if (!isfinite(t))
        return 0;
    exact3 p = exact_add(o, t, d);
    long double margin;
    bool inside;
    if (polygon) {
        inside = oracle_in_polygon(s, p, &margin);
    } else {
        long double r = exact_length(exact_add(p, -1, c));
        inside = r >= s->ring.r0 && r <= s->ring.r1;
        margin = fminl(fabsl(r - s->ring.r0), fabsl(r - s->ring.r1));
    }
    *out = (oracle_crossing){.distance = t, .margin = margin * fabsl(slope), .front = slope < 0};
    return inside;
}

/* Both quadrics by one equation: radius r0 + k z at height z over p0; a sphere is what has no axis. */
static inline int oracle_curved(const shape *s, exact3 o, exact3 d, oracle_crossing out[2]) {
    bool sphere = s->kind == SHAPE_SPHERE;
    exact3 base = exact(sphere ? s->sphere.center : s->cone.p0), axis = {0, 0, 0};
    long double length = 0, k = 0, r0 = sphere ? s->sphere.radius : s->cone.r0;
    if (!sphere) {
        axis = exact_add(exact(s->cone.p1), -1, base);
        length = exact_length(axis);
        axis = exact_add((exact3){0, 0, 0}, 1 / length, axis);
        k = (s->cone.r1 - (long double)s->cone.r0) / length;
    }
    exact3 w = exact_add(o, -1, base);
    /* From the point nearest to the base, lest the squares grow. */
    long double near = -exact_dot(w, d) / exact_dot(d, d);
    w = exact_add(w, near, d);
    long double dz = exact_dot(d, axis), wz = exact_dot(w, axis);
    exact3 dr = exact_add(d, -dz, axis), wr = exact_add(w, -wz, axis);
    long double r = r0 + k * wz;
    long double a = exact_dot(dr, dr) - k * k * dz * dz, b = exact_dot(dr, wr) - k * dz * r,
                c = exact_dot(wr, wr) - r * r;
    long double discriminant = b * b - a * c;
    if (discriminant < 0)
        return 0;
    int count = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        long double root = sign * sqrtl(discriminant);
        long double t = (b < 0) == (root > 0) ? (root - b) / a : c / (-root - b);
        if (!isfinite(t))
            continue;
        exact3 p = exact_add(w, t, d);
        long double z = exact_dot(p, axis), margin = sphere ? INFINITY : fminl(fabsl(z), fabsl(z - length));
        if (!sphere && (z < 0 || z > length))
            continue;
        exact3 normal = exact_add(p, -z - k * (r0 + k * z), axis);
        long double slope = exact_dot(normal, d) / exact_length(normal);
        /* A tangent vanishes when displaced by its sagitta. */
        margin = fminl(margin * fabsl(slope), slope * slope * (r0 + k * z));
        out[count++] = (oracle_crossing){.distance = t + near, .margin = margin, .front = (slope < 0) != s->inward};
    }
    return count;
}

/* All crossings of a surface with the line. */
static inline int oracle_crossings(const shape *s, exact3 o, exact3 d, oracle_crossing out[2]) {
    return s->kind == SHAPE_POLYGON || s->kind == SHAPE_RING ? oracle_flat(s, o, d, out) : oracle_curved(s, o, d, out);
}

/* The nearest crossing, of surfaces that do not coincide. On the surface that
 * the ray leaves, flat ones are not hit and curved ones not at the crossing nearest to the origin. */
static inline oracle_crossing oracle_nearest(const shape *shapes, int count, const geometry_ray *ray) {
    oracle_crossing nearest = {.distance = INFINITY, .surface = -1};
    exact3 o = exact(ray->origin), d = exact(ray->direction);
    for (int i = 0; i < count; i++) {
        oracle_crossing found[2];
        int n = oracle_crossings(&shapes[i], o, d, found), skip = -1;
        if (i == ray->from && (shapes[i].kind == SHAPE_POLYGON || shapes[i].kind == SHAPE_RING))
            continue;
        if (i == ray->from && n)
            skip = n == 2 && fabsl(found[1].distance) < fabsl(found[0].distance);
        for (int k = 0; k < n; k++) {
            found[k].surface = i;
            if (k == skip || found[k].distance <= 0 || found[k].distance > ray->far)
                continue;
            if (found[k].distance < nearest.distance)
                nearest = found[k];
        }
    }
    return nearest;
}

#endif
