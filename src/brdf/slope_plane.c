/* Means over facet slopes: their coordinates, and the outer one of two integrals. */
#include "brdf/slope_plane.h"

#include <math.h>

#include "brdf/constants.h"

void brdf_slope_plane_prepare(brdf_slope_plane *plane, const graze_brdf *brdf, graze_vec3 v) {
    double ax = brdf->alpha_x, ay = brdf->alpha_y;
    double x = ax * v.x, y = ay * v.y, length = hypot(x, y);
    double cosine = length > 0 ? x / length : 1, sine = length > 0 ? y / length : 0;
    plane->aa = ax * cosine * (ax * cosine) + ay * sine * (ay * sine);
    plane->ab = (ay - ax) * (ay + ax) * cosine * sine;
    plane->bb = ax * sine * (ax * sine) + ay * cosine * (ay * cosine);
    plane->narrowing = ax * ay / plane->bb * (ax * ay);
    plane->lean = length / v.z;
    plane->all_in_reach = plane->lean + hypot(plane->lean, fmax(ax, ay)) < 1 / brdf_farthest_slope;
}

brdf_ellipse brdf_ellipse_above_surface(const brdf_slope_plane *plane) {
    return (brdf_ellipse){1, 2 * plane->lean};
}

brdf_ellipse brdf_ellipse_above_mirror(const brdf_slope_plane *plane) {
    return (brdf_ellipse){0, plane->lean};
}

brdf_chord brdf_ellipse_chord(const brdf_slope_plane *plane, brdf_ellipse ellipse, double a) {
    double square = (ellipse.level + ellipse.slant * a - plane->narrowing * a * a) / plane->bb;
    return (brdf_chord){-plane->ab / plane->bb * a, sqrt(fmax(square, 0))};
}

/* Where the ellipse's border crosses b = across. */
static void add_crossings(brdf_points *points, const brdf_slope_plane *plane, brdf_ellipse ellipse, double across) {
    double half = plane->ab * across - ellipse.slant / 2, rest = plane->bb * across * across - ellipse.level;
    double square = half * half - plane->aa * rest;
    if (!(square > 0))
        return;
    double sum = -(half + copysign(sqrt(square), half));
    brdf_points_add(points, sum / plane->aa);
    brdf_points_add(points, rest / sum);
}

/* The least and the largest a of the ellipse, which holds a = b = 0 or touches it, and where it gets out of reach. */
static void add_border(brdf_points *points, const brdf_slope_plane *plane, brdf_ellipse ellipse) {
    double half = ellipse.slant / 2, root = hypot(half, sqrt(plane->narrowing * ellipse.level));
    brdf_points_add(points, -ellipse.level / (half + root));
    brdf_points_add(points, (half + root) / plane->narrowing);
    add_crossings(points, plane, ellipse, -brdf_farthest_slope);
    add_crossings(points, plane, ellipse, brdf_farthest_slope);
}

typedef struct weighted {
    brdf_integrand *across;
    const void *context;
} weighted;

static double weigh(const void *context, double a) {
    const weighted *w = context;
    return exp(-a * a) * w->across(w->context, a);
}

/* The trapezoid rule, which does so well with a Gaussian times what is smooth everywhere. */
static double sum_of_all(const weighted *w) {
    const double step = .5;
    double sum = 0;
    for (int i = -10; i <= 10; ++i)
        sum += weigh(w, step * i);
    return step * sum;
}

double brdf_slope_mean(const brdf_slope_plane *plane, brdf_integrand *across, const void *context,
                       const brdf_ellipse *kink) {
    weighted w = {across, context};
    if (plane->all_in_reach && !kink)
        return sum_of_all(&w) / brdf_pi;
    brdf_points points = brdf_no_points;
    add_border(&points, plane, brdf_ellipse_above_surface(plane));
    double low = fmax(points.at[0], -brdf_farthest_slope),
           high = fmin(points.at[points.count - 1], brdf_farthest_slope);
    /* next to the horizon, within some 1/lean of 0 the weight (15) rises from 0 to almost 2 */
    brdf_points_add(&points, 1 / sqrt(plane->lean));
    if (kink)
        add_border(&points, plane, *kink);
    return brdf_integrate(weigh, &w, low, high, &points, BRDF_ENDS_ROOTS) / brdf_pi;
}
