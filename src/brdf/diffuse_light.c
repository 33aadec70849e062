/* What the diffuse term reflects of a whole light: Lambert's formula, half the mean height of the outline's normals. */
#include <math.h>
#include <stdbool.h>

#include "brdf/constants.h"
#include "brdf/gauss.h"
#include "brdf/kernels.h"
#include "brdf/outline.h"
#include "graze/brdf_light.h"

/* Sixteen of Gauss's points do for an arc that turns by so much, squared, in radians. */
static const double longest_turn = .4;

/* An arc is cut in halves no more often than so. */
static const int deepest = 20;

typedef double numbers;
#include "brdf/arc_tangent.h"

/* The angle that an edge spans times the height of the unit normal of its plane. With n = p x q and c = p.q the tangent
 * of half the angle is |n| / (h + c), h^2 = n^2 + c^2. */
static inline double along_edge(graze_vec3 p, graze_vec3 q) {
    graze_vec3 n = {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    double sine2 = n.x * n.x + n.y * n.y + n.z * n.z, cosine = p.x * q.x + p.y * q.y + p.z * q.z;
    double whole = sqrt(sine2 + cosine * cosine) + cosine;
    if (cosine > 0 && sine2 <= BRDF_SMALL_TANGENT2 * whole * whole)
        return 2 * n.z / whole * arc_tangent_over(sine2 / (whole * whole));
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

static double along_edges(const graze_vec3 *corners, size_t count) {
    double sum = 0;
    if (count >= 3 && is_above(corners, count))
        for (size_t i = 0; i < count; ++i)
            sum += along_edge(corners[i > 0 ? i - 1 : count - 1], corners[i]);
    else if (count >= 3)
        brdf_outline_of_polygon(corners, count, &(brdf_outline_visitor){add_edge, add_arc, &sum});
    return sum;
}

/* A vector in a frame whose third axis is the normal. */
static graze_vec3 turned(graze_vec3 v, graze_vec3 normal) {
    double sign = copysign(1, normal.z), a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
    graze_vec3 x = {1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    graze_vec3 y = {b, sign + normal.y * normal.y * a, -normal.y};
    return (graze_vec3){v.x * x.x + v.y * x.y + v.z * x.z, v.x * y.x + v.y * y.y + v.z * y.z,
                        v.x * normal.x + v.y * normal.y + v.z * normal.z};
}

double graze_diffuse_polygon(const graze_vec3 *corners, size_t count) {
    double sum;
    if (count == 4 && brdf_kernels_best()->panel((graze_vec3){0, 0, 0}, (graze_vec3){0, 0, 1}, corners, &sum))
        return reflected(sum);
    return reflected(along_edges(corners, count));
}

double graze_diffuse_quadrangle(graze_vec3 point, graze_vec3 normal, const graze_vec3 corners[4]) {
    double sum;
    if (brdf_kernels_best()->panel(point, normal, corners, &sum))
        return reflected(sum);
    graze_vec3 seen[4];
    for (int i = 0; i < 4; ++i) {
        graze_vec3 from = {corners[i].x - point.x, corners[i].y - point.y, corners[i].z - point.z};
        seen[i] = turned(from, normal);
    }
    return reflected(along_edges(seen, 4));
}

double graze_diffuse_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second) {
    double sum = 0;
    brdf_outline_of_ellipse(center, first, second, &(brdf_outline_visitor){add_edge, add_arc, &sum});
    return reflected(sum);
}
