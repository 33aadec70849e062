/* What the diffuse term reflects of a whole light: Lambert's formula, half the mean height of the outline's normals. */
#include <math.h>
#include <stdbool.h>

#include "brdf/constants.h"
#include "brdf/gauss.h"
#include "brdf/outline.h"
#include "graze/brdf_light.h"

/* Sixteen of Gauss's points do for an arc that turns by so much, squared, in radians. */
static const double longest_turn = .4;

/* An arc is cut in halves no more often than so. */
static const int deepest = 20;

/* Squared tangents up to this, that of 15 degrees and a little more, are small enough for the series. */
static const double small_tangent2 = .0725;

/* Two numbers, reckoned with at once. */
typedef double pair __attribute__((vector_size(2 * sizeof(double))));

/* atan(t) / t for the square of t, by the series, whose rest is below 2^-54. */
static inline pair arc_tangent_over(pair t2) {
    pair x = -t2, x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    pair low = (1 + x * (1. / 3)) + x2 * (1. / 5 + x * (1. / 7));
    pair middle = (1. / 9 + x * (1. / 11)) + x2 * (1. / 13 + x * (1. / 15));
    pair high = (1. / 17 + x * (1. / 19)) + x2 * (1. / 21 + x * (1. / 23));
    pair last = 1. / 25 + x * (1. / 27);
    return (low + x4 * middle) + x8 * (high + x4 * last);
}

/* The angle that an edge spans times the height of the unit normal of its plane. With n = p x q and c = p.q the tangent
 * of half the angle is |n| / (h + c), h^2 = n^2 + c^2. */
static inline double along_edge(graze_vec3 p, graze_vec3 q) {
    graze_vec3 n = {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    double sine2 = n.x * n.x + n.y * n.y + n.z * n.z, cosine = p.x * q.x + p.y * q.y + p.z * q.z;
    double whole = sqrt(sine2 + cosine * cosine) + cosine;
    if (cosine > 0 && sine2 <= small_tangent2 * whole * whole)
        return 2 * n.z / whole * arc_tangent_over((pair){sine2 / (whole * whole), 0})[0];
    double sine = sqrt(sine2);
    return sine > 0 ? n.z / sine * atan2(sine, cosine) : 0;
}

static void add_edge(void *context, graze_vec3 p, graze_vec3 q) {
    double *sum = context;
    *sum += along_edge(p, q);
}

static graze_vec3 arc_at(const brdf_arc *arc, double u) {
    double s = 1 - u, begin = s * s, middle = 2 * u * s, end = u * u;
    const graze_vec3 *c = arc->c;
    return (graze_vec3){begin * c[0].x + middle * c[1].x + end * c[2].x,
                        begin * c[0].y + middle * c[1].y + end * c[2].y,
                        begin * c[0].z + middle * c[1].z + end * c[2].z};
}

/* Of x and y. */
static graze_vec3 arc_derivative(const brdf_arc *arc, double u) {
    double s = 1 - u;
    const graze_vec3 *c = arc->c;
    return (graze_vec3){.x = 2 * (s * (c[1].x - c[0].x) + u * (c[2].x - c[1].x)),
                        .y = 2 * (s * (c[1].y - c[0].y) + u * (c[2].y - c[1].y))};
}

/* The same in quadrature, by Gauss's points: the height of e x de/|e|^2. */
static double height_along_arc(const brdf_arc *arc) {
    enum { POINTS = 16 };
    const double *points = &brdf_gauss_points[brdf_gauss_rule(POINTS)];
    const double *weights = &brdf_gauss_weights[brdf_gauss_rule(POINTS)];
    double sum = 0;
    for (int i = 0; i < POINTS; ++i) {
        graze_vec3 e = arc_at(arc, points[i]), d = arc_derivative(arc, points[i]);
        sum += weights[i] * (e.x * d.y - e.y * d.x) / (e.x * e.x + e.y * e.y + e.z * e.z);
    }
    return sum;
}

static double integrate(const brdf_arc *arc, int depth) {
    if (depth >= deepest || !(brdf_turn_of_arc(arc) > longest_turn))
        return height_along_arc(arc);
    brdf_arc first, second;
    brdf_halve_arc(arc, &first, &second);
    return integrate(&first, depth + 1) + integrate(&second, depth + 1);
}

static void add_arc(void *context, const brdf_arc *arc) {
    double *sum = context;
    *sum += integrate(arc, 0);
}

static double reflected(double sum) {
    double result = fabs(sum) / (2 * brdf_pi);
    return result > 0 ? fmin(result, 1) : 0;
}

static bool is_above(const graze_vec3 *corners, size_t count) {
    for (size_t i = 0; i < count; ++i)
        if (!(corners[i].z > 0))
            return false;
    return true;
}

/* Adds what the edges from a to b and from b to c are along_edge. False where one is too long for the series. */
static inline bool along_two_edges(graze_vec3 a, graze_vec3 b, graze_vec3 c, pair *sum) {
    const pair px = {a.x, b.x}, py = {a.y, b.y}, pz = {a.z, b.z};
    const pair qx = {b.x, c.x}, qy = {b.y, c.y}, qz = {b.z, c.z};
    const pair nx = py * qz - pz * qy, ny = pz * qx - px * qz, nz = px * qy - py * qx;
    const pair sine2 = nx * nx + ny * ny + nz * nz, cosine = px * qx + py * qy + pz * qz;
    const pair length2 = sine2 + cosine * cosine, length = {sqrt(length2[0]), sqrt(length2[1])};
    const pair whole = length + cosine, scale = 1 / whole, tangent2 = sine2 * scale * scale;
    if (!(cosine[0] > 0 && cosine[1] > 0 && tangent2[0] <= small_tangent2 && tangent2[1] <= small_tangent2))
        return false;
    *sum += 2 * nz * scale * arc_tangent_over(tangent2);
    return true;
}

double graze_diffuse_polygon(const graze_vec3 *corners, size_t count) {
    double sum = 0;
    pair sums = {0, 0};
    if (count == 4 && is_above(corners, count) && along_two_edges(corners[0], corners[1], corners[2], &sums) &&
        along_two_edges(corners[2], corners[3], corners[0], &sums))
        return reflected(sums[0] + sums[1]);
    if (count >= 3 && is_above(corners, count))
        for (size_t i = 0; i < count; ++i)
            sum += along_edge(corners[i > 0 ? i - 1 : count - 1], corners[i]);
    else if (count >= 3)
        brdf_outline_of_polygon(corners, count, &(brdf_outline_visitor){add_edge, add_arc, &sum});
    return reflected(sum);
}

double graze_diffuse_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second) {
    double sum = 0;
    brdf_outline_of_ellipse(center, first, second, &(brdf_outline_visitor){add_edge, add_arc, &sum});
    return reflected(sum);
}
