/* What the diffuse term reflects of a whole light: Lambert's formula, half the mean height of the outline's normals. */
#include <math.h>
#include <stdbool.h>

#include "brdf/constants.h"
#include "brdf/outline.h"
#include "graze/brdf_light.h"

/* Gauss's points do for so long a piece of an arc, in radians; and so much longer may one of its halves be. */
static const double longest_piece = .7, shortest_uneven_piece = .07, uneven = 2;
static const int deepest = 10; /* times a piece is cut in two */

/* For a straight arc the angle that it spans times the height of the normal of its plane. */
static void add_straight(void *context, const brdf_arc *arc, double from, double to) {
    double *sum = context;
    graze_vec3 p = brdf_arc_at(arc, from), q = brdf_arc_at(arc, to);
    graze_vec3 n = {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    double sine = sqrt(n.x * n.x + n.y * n.y + n.z * n.z), cosine = p.x * q.x + p.y * q.y + p.z * q.z;
    if (sine > 0)
        *sum += n.z / sine * atan2(sine, cosine);
}

/* The same in quadrature, by Gauss's points: the height of e x de/|e|^2. */
static double height_along_arc(const brdf_arc *arc, double from, double to) {
    double sum = 0;
    for (int i = 0; i < BRDF_GAUSS_POINTS; ++i) {
        double u = from + (to - from) * brdf_gauss_points[i];
        graze_vec3 e = brdf_arc_at(arc, u), d = brdf_arc_derivative(arc, u);
        sum += brdf_gauss_weights[i] * (e.x * d.y - e.y * d.x) / (e.x * e.x + e.y * e.y + e.z * e.z);
    }
    return (to - from) * sum;
}

static double angle_between(graze_vec3 p, graze_vec3 q) {
    double x = p.y * q.z - p.z * q.y, y = p.z * q.x - p.x * q.z, z = p.x * q.y - p.y * q.x;
    return atan2(sqrt(x * x + y * y + z * z), p.x * q.x + p.y * q.y + p.z * q.z);
}

static double integrate(const brdf_arc *arc, double from, double to, int depth) {
    double half = (from + to) / 2;
    graze_vec3 p = brdf_arc_at(arc, from), middle = brdf_arc_at(arc, half), q = brdf_arc_at(arc, to);
    double first = angle_between(p, middle), second = angle_between(middle, q), length = first + second;
    bool is_uneven = fmax(first, second) > uneven * fmin(first, second);
    if (depth < deepest && (length > longest_piece || (is_uneven && length > shortest_uneven_piece)))
        return integrate(arc, from, half, depth + 1) + integrate(arc, half, to, depth + 1);
    return height_along_arc(arc, from, to);
}

static void add_any(void *context, const brdf_arc *arc, double from, double to) {
    double *sum = context;
    bool is_straight = arc->quadratic.x == 0 && arc->quadratic.y == 0 && arc->quadratic.z == 0;
    if (is_straight)
        add_straight(context, arc, from, to);
    else
        *sum += integrate(arc, from, to, 0);
}

static double reflect(const brdf_outline *outline, brdf_arc_visitor *add) {
    double sum = 0;
    brdf_outline_visit(outline, add, &sum);
    double result = fabs(sum) / (2 * brdf_pi);
    return result > 0 ? fmin(result, 1) : 0;
}

double graze_diffuse_polygon(const graze_vec3 *corners, size_t count) {
    const brdf_outline outline = {.corners = corners, .count = count};
    return count < 3 ? 0 : reflect(&outline, add_straight);
}

double graze_diffuse_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second) {
    const brdf_outline outline = {.center = center, .first = first, .second = second};
    return reflect(&outline, add_any);
}
