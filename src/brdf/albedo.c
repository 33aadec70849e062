/* Directional albedo: the expectation of Ward's sampling weight over slopes, by quadrature.
 *
 * A slope p = r (ax cos phi, ay sin phi) has the density exp(-r^2) r/pi in (r, phi). With P = |p|/r, and T = q/(r vz)
 * the slope's part along the view, the reflected direction has
 *
 *     lz/vz = (1 + 2rT - r^2 P^2)/(1 + r^2 P^2),   hz/vz = 2 (1 + rT)/(1 + r^2 P^2)
 *
 * and is above the surface for r < R = (T + sqrt(T^2 + P^2))/P^2. Slopes p and -p, with T and -T, are taken together:
 * their sum is smooth where each by itself changes within an angle of 1/tan(theta). Singularities (roots of lz at R,
 * boundary layers at T = 0) all lie at ends of intervals, where the double-exponential rule wants them. */
#include <float.h>
#include <math.h>

#include "graze/brdf.h"

static const double pi = 0x1.921fb54442d18p+1;
static const double farthest = 7; /* exp(-49) is nothing */

enum { NODES_HALF = 105, NODES = 2 * NODES_HALF + 1 };

/* Double-exponential (tanh-sinh) rule for [0,1]. Distances from either end are exact, however small. */
typedef struct quadrature {
    double from_low[NODES], from_high[NODES], weight[NODES];
} quadrature;

static void quadrature_prepare(quadrature *rule) {
    const double step = 1. / 32;
    for (int i = 0; i < NODES; ++i) {
        double x = step * (i - NODES_HALF), y = pi * sinh(x);
        rule->from_low[i] = 1 / (1 + exp(-y));
        rule->from_high[i] = 1 / (1 + exp(y));
        rule->weight[i] = step * pi * cosh(x) * rule->from_low[i] * rule->from_high[i];
    }
}

/* One azimuth of slopes on one side. */
typedef struct ray_of_slopes {
    graze_brdf_model model;
    double vz;
    double along;  /* T */
    double square; /* P^2 */
} ray_of_slopes;

/* Value x cosine / density (8), (15) for the slope r, from (1 + r^2 P^2) lz/vz. */
static double weight_at(const ray_of_slopes *ray, double r, double scaled_cosine) {
    double half = 1 + r * ray->along, square = 1 + r * r * ray->square;
    double ratio = scaled_cosine / square; /* lz/vz */
    switch (ray->model) {
    case GRAZE_BRDF_GMD:
        return scaled_cosine / half;
    case GRAZE_BRDF_WARD:
        return ray->vz * sqrt(ratio) * half / square / square;
    case GRAZE_BRDF_WARD_DUER:
        return half / square / square;
    default:
        return ray->vz * fmin(ratio, 1) * half / square / square;
    }
}

/* The integral of r exp(-r^2) w over [low, high]. Where high is the horizon R, lz is a product with the distance from
 * it. */
static double integrate_interval(const ray_of_slopes *ray, const quadrature *rule, double low, double high,
                                 double horizon) {
    double sum = 0, length = high - low;
    for (int i = 0; i < NODES; ++i) {
        double r = low + length * rule->from_low[i];
        double scaled_cosine = high < horizon ? 1 + 2 * r * ray->along - r * r * ray->square
                                              : length * rule->from_high[i] * (r * ray->square + 1 / horizon);
        sum += rule->weight[i] * r * exp(-r * r) * weight_at(ray, r, scaled_cosine);
    }
    return sum * length;
}

static double integrate_ray(const ray_of_slopes *ray, const quadrature *rule) {
    double root = hypot(ray->along, sqrt(ray->square));
    double horizon = ray->along >= 0 ? (ray->along + root) / ray->square : 1 / (root - ray->along);
    double end = fmin(horizon, farthest);
    double mirror = ray->along / ray->square; /* lz = vz: the kink of Ward-Neumann's maximum */
    if (ray->model == GRAZE_BRDF_WARD_NEUMANN && mirror > 0 && mirror < end)
        return integrate_interval(ray, rule, 0, mirror, horizon) + integrate_interval(ray, rule, mirror, end, horizon);
    return integrate_interval(ray, rule, 0, end, horizon);
}

double graze_brdf_albedo(const graze_brdf *brdf, graze_vec3 v) {
    if (!(v.z > 0))
        return 0;
    double x = brdf->alpha_x * v.x, y = brdf->alpha_y * v.y;
    double steepest = fmin(hypot(x, y) / v.z, 1e300), start = atan2(y, x) - pi / 2;
    quadrature rule;
    quadrature_prepare(&rule);

    /* Half a turn from T = 0 to T = 0, in up to three intervals between which the azimuth crosses an axis. */
    double first_axis = ceil(start / (pi / 2)) * (pi / 2) - start;
    double ends[] = {0, first_axis, first_axis + pi / 2, pi};
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        double length = ends[k + 1] - ends[k];
        if (!(length > 0))
            continue;
        for (int i = 0; i < NODES; ++i) {
            double turn = ends[k] + length * rule.from_low[i], left = (pi - ends[k + 1]) + length * rule.from_high[i];
            double c = brdf->alpha_x * cos(start + turn), s = brdf->alpha_y * sin(start + turn);
            ray_of_slopes ray = {brdf->model, v.z, steepest * sin(fmin(turn, left)), c * c + s * s};
            double up = integrate_ray(&ray, &rule);
            ray.along = -ray.along;
            sum += rule.weight[i] * length * (up + integrate_ray(&ray, &rule));
        }
    }
    double albedo = sum / pi;
    return brdf->model == GRAZE_BRDF_GMD ? fmin(albedo, 1) : fmin(albedo, DBL_MAX);
}
