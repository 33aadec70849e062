/* Cutting outlines at the horizon. */
#include "brdf/outline.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

static graze_vec3 sum(double s, graze_vec3 a, double t, graze_vec3 b) {
    return (graze_vec3){s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

static graze_vec3 middle_of(graze_vec3 a, graze_vec3 b) {
    return sum(.5, a, .5, b);
}

graze_vec3 brdf_middle_of_arc(const brdf_arc *arc) {
    return middle_of(middle_of(arc->c[0], arc->c[1]), middle_of(arc->c[1], arc->c[2]));
}

/* De Casteljau's halves. */
void brdf_halve_arc(const brdf_arc *arc, brdf_arc *first, brdf_arc *second) {
    const graze_vec3 *c = arc->c;
    graze_vec3 begin = middle_of(c[0], c[1]), end = middle_of(c[1], c[2]), middle = middle_of(begin, end);
    *first = (brdf_arc){{c[0], begin, middle}};
    *second = (brdf_arc){{middle, end, c[2]}};
}

static double dot(graze_vec3 a, graze_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double square_of_product(graze_vec3 a, graze_vec3 b) {
    graze_vec3 n = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return dot(n, n);
}

double brdf_turn_of_arc(const brdf_arc *arc) {
    const graze_vec3 *c = arc->c;
    if (dot(c[0], c[1]) < 0 || dot(c[1], c[2]) < 0 || dot(c[0], c[2]) < 0)
        return DBL_MAX;
    graze_vec3 middle = brdf_middle_of_arc(arc), bend = sum(1, sum(1, c[0], -2, c[1]), 1, c[2]);
    double square = fmin(dot(middle, middle), fmin(dot(c[0], c[0]), dot(c[2], c[2])));
    double speed = fmax(square_of_product(c[0], c[1]), square_of_product(c[1], c[2])) / (square * square);
    return 4 * speed + sqrt(square_of_product(middle, bend)) / square;
}

static graze_vec3 normalize(graze_vec3 e) {
    double per_distance = 1 / sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
    return (graze_vec3){e.x * per_distance, e.y * per_distance, e.z * per_distance};
}

/* Where the line between two points, one of them not above the surface, crosses the horizon. */
static graze_vec3 crossing(graze_vec3 above, graze_vec3 below) {
    graze_vec3 e = sum(-below.z, above, above.z, below);
    e.z = 0;
    return e;
}

/* A chain of edges as it grows. */
typedef struct chain {
    const brdf_outline_visitor *visitor;
    bool begun;
    graze_vec3 first, last;
} chain;

static void add_corner(chain *c, graze_vec3 corner) {
    graze_vec3 e = normalize(corner);
    if (c->begun)
        c->visitor->edge(c->visitor->context, c->last, e);
    else
        c->first = e;
    c->begun = true;
    c->last = e;
}

/* Corners that are above, and crossings; two crossings on end are joined along the horizon. */
void brdf_outline_of_polygon(const graze_vec3 *corners, size_t count, const brdf_outline_visitor *visitor) {
    chain c = {.visitor = visitor};
    graze_vec3 before = corners[count - 1];
    for (size_t i = 0; i < count; ++i) {
        graze_vec3 corner = corners[i];
        bool above = corner.z > 0, was_above = before.z > 0;
        if (above != was_above)
            add_corner(&c, above ? crossing(corner, before) : crossing(before, corner));
        if (above)
            add_corner(&c, corner);
        before = corner;
    }
    if (c.begun)
        visitor->edge(visitor->context, c.last, c.first);
}

/* Sines and cosines of angle and half of it, for angles in 0 .. pi. */
typedef struct angle {
    double cosine, sine;
} angle;

static angle half_of(double cosine) {
    return (angle){sqrt((1 + cosine) / 2), sqrt((1 - cosine) / 2)};
}

/* With h the angle from the ellipse's highest point to the horizon, or pi, arcs are h/2 long, about -3/4 h, -1/4 h,
 * 1/4 h, 3/4 h. */
void brdf_outline_of_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second,
                             const brdf_outline_visitor *visitor) {
    double rise = sqrt(first.z * first.z + second.z * second.z);
    if (!(center.z + rise > 0))
        return;
    bool whole = center.z >= rise;
    double cosine = rise > 0 ? first.z / rise : 1, sine = rise > 0 ? second.z / rise : 0;
    graze_vec3 up = sum(cosine, first, sine, second), aside = sum(cosine, second, -sine, first);
    angle half = half_of(whole ? -1 : -center.z / rise), quarter = half_of(half.cosine);
    angle beyond = {half.cosine * quarter.cosine - half.sine * quarter.sine,
                    half.sine * quarter.cosine + half.cosine * quarter.sine};
    angle end = {half.cosine * half.cosine - half.sine * half.sine, 2 * half.sine * half.cosine};
    const angle middles[] = {{beyond.cosine, -beyond.sine}, {quarter.cosine, -quarter.sine}, quarter, beyond};
    const angle ends[] = {{end.cosine, -end.sine}, {half.cosine, -half.sine}, {1, 0}, half, end};
    enum { ARCS = 4 };
    graze_vec3 corners[ARCS + 1];
    for (int i = 0; i <= ARCS; ++i)
        corners[i] = sum(1, center, 1, sum(ends[i].cosine, up, ends[i].sine, aside));
    if (!whole)
        corners[0].z = corners[ARCS].z = 0;
    for (int i = 0; i < ARCS; ++i) {
        graze_vec3 middle = sum(quarter.cosine, center, 1, sum(middles[i].cosine, up, middles[i].sine, aside));
        visitor->arc(visitor->context, &(brdf_arc){{corners[i], middle, corners[i + 1]}});
    }
    if (!whole)
        visitor->edge(visitor->context, normalize(corners[ARCS]), normalize(corners[0]));
}
