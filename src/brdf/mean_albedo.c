/* Mean albedo of the hemisphere.
 *
 * The integral over v and l of value x lz x vz can be taken over the facet's normal and the directions about it
 * instead. The inner integral is known for every model, and depends on the slope only: with tan(delta) = tau it leaves
 *
 *     new model      1 - tau^2 asinh(1/tau)/sqrt(1 + tau^2)
 *     Ward           (2/3) cos^5(delta)
 *     Ward-Duer      cos^4(delta)
 *     Ward-Neumann   (2/3) cos^4(delta) (1 - 2 delta/pi)
 *
 * of which the mean albedo is the mean over slopes, whose density is exp(-X^2 - Y^2)/pi for the slope (ax X, ay Y). */
#include <math.h>

#include "brdf/constants.h"
#include "brdf/parameters.h"
#include "brdf/quadrature.h"
#include "graze/brdf.h"

typedef struct slope_mean {
    graze_brdf_model model;
    double narrower, wider; /* roughness */
    double tan2;            /* what the coordinate of the outer integral adds to tau^2 */
} slope_mean;

static double mean_of_slope(graze_brdf_model model, double tan2) {
    double square = 1 + tan2, tangent = sqrt(tan2);
    switch (model) {
    case GRAZE_BRDF_GMD:
        return 1 - tan2 * asinh(1 / tangent) / sqrt(square);
    case GRAZE_BRDF_WARD:
        return 2. / 3 / (square * square * sqrt(square));
    case GRAZE_BRDF_WARD_DUER:
        return 1 / (square * square);
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    return 4 / (3 * brdf_pi) * atan(1 / tangent) / (square * square);
}

static double along_radius(const void *context, double r) {
    const slope_mean *m = context;
    return brdf_pi / 2 * r * exp(-r * r) * mean_of_slope(m->model, m->wider * r * (m->wider * r));
}

static double along_narrower(const void *context, double x) {
    const slope_mean *m = context;
    return exp(-x * x) * mean_of_slope(m->model, m->tan2 + m->narrower * x * (m->narrower * x));
}

static double along_wider(const void *context, double y) {
    slope_mean m = *(const slope_mean *)context;
    m.tan2 = m.wider * y * (m.wider * y);
    return exp(-y * y) * brdf_integrate(along_narrower, &m, 0, brdf_farthest_slope, &brdf_no_points, BRDF_ENDS_ROOTS);
}

double graze_brdf_mean_albedo(const graze_brdf *brdf) {
    const graze_brdf in_range = brdf_in_range(brdf);
    double narrower = fmin(in_range.alpha_x, in_range.alpha_y), wider = fmax(in_range.alpha_x, in_range.alpha_y);
    const slope_mean mean = {.model = brdf->model, .narrower = narrower, .wider = wider};
    brdf_integrand *integrand = narrower < wider ? along_wider : along_radius;
    double integral = brdf_integrate(integrand, &mean, 0, brdf_farthest_slope, &brdf_no_points, BRDF_ENDS_ROOTS);
    return fmin(4 / brdf_pi * integral, 1);
}
