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

/* The trapezoid rule with every stride-th of the b = i/4, where the weight is smooth on all of the line. */
static double sum_of_line(const slope_line *line, int stride) {
    enum { LAST = 21 };
    static const double gaussian[LAST + 1] = {1,
                                              0x1.e0fabfbc702a4p-1,
                                              0x1.8ebef9eac820bp-1,
                                              0x1.23ba930c1568bp-1,
                                              0x1.78b56362cef38p-2,
                                              0x1.ad48bc25771c7p-3,
                                              0x1.afb718e8457f7p-4,
                                              0x1.7f251ab1af77bp-5,
                                              0x1.2c155b8213cf4p-6,
                                              0x1.9ed300c108a17p-8,
                                              0x1.fa0e9586aebc7p-10,
                                              0x1.1068222437d65p-11,
                                              0x1.02cf22526545ap-13,
                                              0x1.b1fea4fbb871ap-16,
                                              0x1.411fb0da07713p-18,
                                              0x1.a3604afdb0929p-21,
                                              0x1.e355bbaee85cbp-24,
                                              0x1.eb97d4afc3bd3p-27,
                                              0x1.b93de1e27ca3bp-30,
                                              0x1.5d82c26ce1c09p-33,
                                              0x1.e8a37a45fc32ep-37,
                                              0x1.2d7026e60ab5ep-40};
    double sum = weight_at(line, 0);
    for (int i = stride; i <= LAST; i += stride)
        sum += gaussian[i] * (weight_at(line, .25 * i) + weight_at(line, -.25 * i));
    return .25 * stride * sum;
}

static double coarse_across(const void *context, double a) {
    slope_line line = line_at(context, a);
    return sum_of_line(&line, 2);
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
    brdf_points points = {0, {0}};
    if (line.model == GRAZE_BRDF_WARD_NEUMANN) {
        brdf_chord kink = brdf_ellipse_chord(plane, brdf_ellipse_above_mirror(plane), a);
        double begin = kink.middle - kink.half, end = kink.middle + kink.half;
        smooth = smooth && (kink.half == 0 || (fabs(begin) > brdf_farthest_slope && fabs(end) > brdf_farthest_slope));
        brdf_points_add(&points, begin);
        brdf_points_add(&points, end);
    }
    if (smooth && poles_are_far(plane, a, 1.5))
        return sum_of_line(&line, poles_are_far(plane, a, 3) ? 2 : 1);
    brdf_points_add(&points, 0);
    brdf_points_add(&points, (line.low + line.high) / 2);
    brdf_ends ends = line.model == GRAZE_BRDF_WARD ? BRDF_ENDS_ROOTS : BRDF_ENDS_SMOOTH;
    return brdf_integrate(weigh, &line, low, high, &points, ends);
}

double brdf_albedo_over_slopes(graze_brdf_model model, const brdf_slope_plane *plane, double vz) {
    slope_line any = {model, plane, 0, 0, 0, 0, 0, 0};
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
