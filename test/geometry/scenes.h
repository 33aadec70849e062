/* Scenes that the tests of src/geometry share. */
#ifndef TEST_GEOMETRY_SCENES_H
#define TEST_GEOMETRY_SCENES_H

#include "geometry/geometry.h"
#include "geometry/make.h"

static inline shape quadrangle(vec3 a, vec3 b, vec3 c, vec3 d) {
    return make_polygon(4, (vec3[]){a, b, c, d});
}

static inline shape triangle(vec3 a, vec3 b, vec3 c) {
    return make_polygon(3, (vec3[]){a, b, c});
}

static inline geometry_ray ray_from(vec3 origin, vec3 direction, int64_t from) {
    return (geometry_ray){origin, vec3_normalize(direction), GEOMETRY_FAR, from};
}

#define ZOO_POLYGONS 40
#define ZOO_CURVED   40
#define ZOO          (ZOO_POLYGONS + ZOO_CURVED)

/* Polygons with holes, spheres, cylinders, cones and rings all through one another. */
static inline void roll_zoo(dice *d, shape *shapes, double scale, vec3 at) {
    for (int i = 0; i < ZOO_POLYGONS; i++) {
        double x[OUTLINE_LIMIT], y[OUTLINE_LIMIT];
        uint32_t n = i % 3 ? 3 : roll_outline(d, x, y);
        vec3 origin = vec3_add(at, roll_in_cube(d, scale)), v[OUTLINE_LIMIT];
        frame f = frame_around(roll_direction(d));
        for (uint32_t k = 0; k < n; k++) {
            if (n == 3)
                v[k] = vec3_add(origin, roll_in_cube(d, 0.5 * scale));
            else
                v[k] = vec3_add_scaled(vec3_add_scaled(origin, 0.5 * scale * x[k], f.x), 0.5 * scale * y[k], f.y);
        }
        shapes[i] = make_polygon(n, v);
    }
    for (int i = 0; i < ZOO_CURVED; i++) {
        vec3 p0 = vec3_add(at, roll_in_cube(d, scale)), p1 = vec3_add(p0, roll_in_cube(d, 0.5 * scale));
        double r = scale * roll_between(d, 0.01, 0.3);
        shape *s = &shapes[ZOO_POLYGONS + i];
        if (i % 4 == 0)
            *s = make_sphere(p0, r);
        else if (i % 4 == 1)
            *s = make_cone(p0, p1, r, r);
        else if (i % 4 == 2)
            *s = make_cone(p0, p1, r, i % 8 == 2 ? 0 : 2 * r);
        else
            *s = make_ring(p0, vec3_subtract(p1, p0), 0.3 * r, 1.5 * r);
        s->inward = i % 4 != 3 && i % 16 >= 8;
    }
}

/* A box of divided faces, normals outward: 12 n^2 triangles. */
static inline size_t make_box(shape *shapes, vec3 lower, double edge, int n) {
    size_t count = 0;
    for (int face = 0; face < 6; face++)
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                vec3 corner[4];
                for (int k = 0; k < 4; k++) {
                    double u = edge * (i + (k == 1 || k == 2)) / n, v = edge * (j + (k >= 2)) / n;
                    double w = face & 1 ? edge : 0;
                    vec3 at = face / 2 == 0   ? vec3_make(w, u, v)
                              : face / 2 == 1 ? vec3_make(v, w, u)
                                              : vec3_make(u, v, w);
                    corner[face & 1 ? k : 3 - k] = vec3_add(lower, at);
                }
                shapes[count++] = triangle(corner[0], corner[1], corner[2]);
                shapes[count++] = triangle(corner[0], corner[2], corner[3]);
            }
    return count;
}

static inline vec3 globe_point(vec3 center, double radius, int i, int j, int n) {
    if (i == 0 || i == n)
        return vec3_add(center, vec3_make(0, 0, i ? -radius : radius));
    double theta = PI * i / n, phi = 2 * PI * (j % (2 * n)) / (2 * n);
    return vec3_add(center,
                    vec3_make(radius * sin(theta) * cos(phi), radius * sin(theta) * sin(phi), radius * cos(theta)));
}

/* A globe of triangles with shared corners. */
static inline size_t make_globe(shape *shapes, vec3 center, double radius, int n) {
    size_t count = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < 2 * n; j++) {
            vec3 a = globe_point(center, radius, i, j, n), b = globe_point(center, radius, i + 1, j, n);
            vec3 c = globe_point(center, radius, i + 1, j + 1, n), e = globe_point(center, radius, i, j + 1, n);
            if (i < n - 1)
                shapes[count++] = triangle(a, b, c);
            if (i > 0)
                shapes[count++] = triangle(a, c, e);
        }
    return count;
}

#endif
