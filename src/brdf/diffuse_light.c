/* What the diffuse term reflects of a whole light: Lambert's formula, half the mean height of the outline's normals. */
#include <math.h>

#include "brdf/constants.h"
#include "brdf/gauss.h"
#include "brdf/outline.h"
#include "graze/brdf_light.h"

/* Sixteen of Gauss's points do for an arc that turns by so much, squared, in radians. */
static const double longest_turn = .4;

/* An arc is cut in halves no more often than so. */
static const int deepest = 20;

/* The angle that an edge spans times the height of the normal of its plane. */
static void add_edge(void *context, graze_vec3 p, graze_vec3 q) {
    double *sum = context;
    graze_vec3 n = {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    double sine = sqrt(n.x * n.x + n.y * n.y + n.z * n.z), cosine = p.x * q.x + p.y * q.y + p.z * q.z;
    if (sine > 0)
        *sum += n.z / sine * atan2(sine, cosine);
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

double graze_diffuse_polygon(const graze_vec3 *corners, size_t count) {
    double sum = 0;
    if (count >= 3)
        brdf_outline_of_polygon(corners, count, &(brdf_outline_visitor){add_edge, add_arc, &sum});
    return reflected(sum);
}

double graze_diffuse_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second) {
    double sum = 0;
    brdf_outline_of_ellipse(center, first, second, &(brdf_outline_visitor){add_edge, add_arc, &sum});
    return reflected(sum);
}
