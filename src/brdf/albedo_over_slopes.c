/* Directional albedo as the mean of Ward's sampling weight (8), (15) over facet slopes. */
#include <math.h>
#include <stddef.h>

#include "brdf/albedo.h"
#include "brdf/constants.h"

/* What is wanted, and a line of the slope plane at one a. */
typedef struct slope_line {
    graze_brdf_model model;
    const brdf_slope_plane *plane;
    double half;                      /* 1 + lean a = hz (1 + tau^2)/(2 vz) */
    double square, linear, quadratic; /* 1 + tau^2 as a polynomial in b */
    double low, high;                 /* between them, l is above the surface */
} slope_line;

static slope_line line_at(const slope_line *any, double a) {
    const brdf_slope_plane *plane = any->plane;
    brdf_chord chord = brdf_ellipse_chord(plane, brdf_ellipse_above_surface(plane), a);
    return (slope_line){any->model,        plane,     1 + plane->lean * a,       1 + plane->aa * a * a,
                        2 * plane->ab * a, plane->bb, chord.middle - chord.half, chord.middle + chord.half};
}

/* The weight over vz, but for Ward-Duer, which has none; 0 where l is below the surface. */
static double weight_at(const slope_line *line, double b) {
    double square = line->square + b * (line->linear + b * line->quadratic);
    /* lz/vz: as a product, no noise next to the horizon keeps the quadrature from converging */
    double ratio = line->quadratic * fmax((b - line->low) * (line->high - b), 0) / square;
    double weight = line->half / (square * square);
    switch (line->model) {
    case GRAZE_BRDF_WARD:
        return weight * sqrt(ratio);
    case GRAZE_BRDF_WARD_DUER:
        return weight;
    case GRAZE_BRDF_GMD: /* is not asked for */
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    return weight * fmin(ratio, 1);
}

static double weigh(const void *context, double b) {
    return exp(-b * b) * weight_at(context, b);
}

/* The trapezoid rule, where the weight is smooth on all of the line. */
static double sum_of_line(const slope_line *line, double step) {
    double sum = weight_at(line, 0);
    for (int i = 1; step * i <= brdf_farthest_slope; ++i) {
        double b = step * i;
        sum += exp(-b * b) * (weight_at(line, b) + weight_at(line, -b));
    }
    return step * sum;
}

static double coarse_across(const void *context, double a) {
    slope_line line = line_at(context, a);
    return sum_of_line(&line, .5);
}

/* The line's poles are at (1 + tau^2) = 0, bb (b - middle)^2 = -1 - narrowing a^2. */
static bool poles_are_far(const brdf_slope_plane *plane, double a, double distance) {
    return 1 + plane->narrowing * a * a > plane->bb * distance * distance;
}

static double across(const void *context, double a) {
    slope_line line = line_at(context, a);
    const brdf_slope_plane *plane = line.plane;
    double low = fmax(line.low, -brdf_farthest_slope), high = fmin(line.high, brdf_farthest_slope);
    bool smooth = low == -brdf_farthest_slope && high == brdf_farthest_slope;
    brdf_points points = brdf_no_points;
    if (line.model == GRAZE_BRDF_WARD_NEUMANN) {
        brdf_chord kink = brdf_ellipse_chord(plane, brdf_ellipse_above_mirror(plane), a);
        double begin = kink.middle - kink.half, end = kink.middle + kink.half;
        smooth = smooth && (kink.half == 0 || (fabs(begin) > brdf_farthest_slope && fabs(end) > brdf_farthest_slope));
        brdf_points_add(&points, begin);
        brdf_points_add(&points, end);
    }
    if (smooth && poles_are_far(plane, a, 1.5))
        return sum_of_line(&line, poles_are_far(plane, a, 3) ? .5 : .25);
    brdf_ends ends = line.model == GRAZE_BRDF_WARD ? BRDF_ENDS_ROOTS : BRDF_ENDS_SMOOTH;
    return brdf_integrate(weigh, &line, low, high, &points, ends);
}

double brdf_albedo_over_slopes(graze_brdf_model model, const brdf_slope_plane *plane, double vz) {
    slope_line any = {.model = model, .plane = plane};
    switch (model) {
    case GRAZE_BRDF_WARD:
        return vz * brdf_slope_mean(plane, plane->all_in_reach ? coarse_across : across, &any, NULL);
    case GRAZE_BRDF_WARD_DUER:
        return brdf_slope_mean(plane, plane->all_in_reach ? coarse_across : across, &any, NULL);
    case GRAZE_BRDF_GMD:
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    brdf_ellipse kink = brdf_ellipse_above_mirror(plane);
    return vz * brdf_slope_mean(plane, across, &any, plane->lean > 0 ? &kink : NULL);
}
