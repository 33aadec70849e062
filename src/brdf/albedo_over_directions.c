/* Directional albedo as an integral over directions l: around each circle of equal lz the Gaussian is smooth, and
 * horizon and kinks are at ends of the integral over lz.
 *
 * With h = l + v, value x lz is E/(4 pi ax ay) times sqrt(lz/vz) (4), 1/vz (5) or min(lz/vz, 1) (Ward-Neumann). The
 * slopes of a circle are a circle again, with centre sin(theta_v)/hz away from 0 and of radius sin(theta_l)/hz. */
#include <math.h>

#include "brdf/albedo.h"
#include "brdf/constants.h"

static const double arc_step = .55; /* for the trapezoid rule: an error of exp(-(pi/.55)^2) */

typedef struct circles {
    graze_brdf_model model;
    double vz, sine;      /* of the viewer's angle */
    double aa, ab, bb;    /* E = exp(-(aa a^2 + 2 ab a b + bb b^2)) of a slope, a along the view, b across */
    double reach, finest; /* slopes beyond reach do not matter, those nearer than finest are much the same */
} circles;

/* E of a slope, and of that on the other side of the view. */
static double sum_of_mirrored(const circles *c, double along, double across) {
    double even = c->aa * along * along + c->bb * across * across, odd = 2 * c->ab * along * across;
    if (even - fabs(odd) > brdf_farthest_slope * brdf_farthest_slope)
        return 0;
    return odd == 0 ? 2 * exp(-even) : exp(-(even + odd)) + exp(-(even - odd));
}

/* The integral of E over the azimuth, from the slope nearest to 0 on the circle to both sides. */
static double integrate_circle(const circles *c, double lz) {
    double hz = lz + c->vz, sine = sqrt(fmax((1 - lz) * (1 + lz), 0));
    double centre = c->sine / hz, radius = sine / hz;
    double nearest = c->sine + sine > .5 ? (lz - c->vz) / (c->sine + sine) : centre - radius;
    double room = fmax((c->reach - nearest) * (c->reach + nearest), 0), extent = 4 * centre * radius;
    double end = extent > room ? 2 * asin(sqrt(room / extent)) : brdf_pi;
    int count = 12 + (int)(end * radius / c->finest);
    double step = end / count, turn_x = cos(step / 2), turn_y = sin(step / 2);
    double x = 1, y = 0; /* cosine and sine of half the azimuth */
    double sum = exp(-c->aa * nearest * nearest);
    for (int i = 1; i <= count; ++i) {
        double turned = x * turn_x - y * turn_y;
        y = x * turn_y + y * turn_x;
        x = turned;
        double along = nearest + 2 * radius * y * y, across = 2 * radius * x * y;
        double value = sum_of_mirrored(c, along, across);
        sum += i < count ? value : value / 2;
    }
    return step * sum;
}

static double weigh(const void *context, double lz) {
    const circles *c = context;
    double integral = integrate_circle(c, lz);
    switch (c->model) {
    case GRAZE_BRDF_WARD:
        return integral * sqrt(lz);
    case GRAZE_BRDF_WARD_DUER:
        return integral;
    case GRAZE_BRDF_GMD: /* is not asked for */
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    return integral * fmin(lz / c->vz, 1);
}

/* Not for lobes so narrow beside another roughness that circles take too many steps, nor so narrow next to normal
 * incidence that lz hardly differs. */
bool brdf_albedo_over_directions_suits(const graze_brdf *brdf, const brdf_slope_plane *plane) {
    double narrower = fmin(brdf->alpha_x, brdf->alpha_y), wider = fmax(brdf->alpha_x, brdf->alpha_y);
    if (plane->all_in_reach && (brdf->model != GRAZE_BRDF_WARD_NEUMANN || plane->lean < 1e-5))
        return false;
    return wider <= 12 * narrower;
}

double brdf_albedo_over_directions(const graze_brdf *brdf, graze_vec3 v) {
    double ax = brdf->alpha_x, ay = brdf->alpha_y, vz = v.z;
    double sine = hypot(v.x, v.y), x = sine > 0 ? v.x / sine : 1, y = sine > 0 ? v.y / sine : 0;
    double reach = brdf_farthest_slope * fmax(ax, ay), square = 1 + reach * reach;
    double ab = x * y * (1 / (ay * ay) - 1 / (ax * ax));
    circles c = {brdf->model, vz,
                 sine,        x / ax * (x / ax) + y / ay * (y / ay),
                 ab,          y / ax * (y / ax) + x / ay * (x / ay),
                 reach,       arc_step * fmin(ax, ay)};
    /* lz of the slopes at the ends of reach, along the view */
    double low = fmax((vz * (1 - reach * reach) - 2 * reach * sine) / square, 0);
    double high = reach * (1 + vz) < sine ? (vz * (1 - reach * reach) + 2 * reach * sine) / square : 1;
    brdf_points points = brdf_no_points;
    brdf_points_add(&points, vz);
    brdf_ends ends = brdf->model == GRAZE_BRDF_WARD ? BRDF_ENDS_ROOTS : BRDF_ENDS_SMOOTH;
    double integral = brdf_integrate(weigh, &c, low, high, &points, ends) / (4 * brdf_pi) / ax / ay;
    switch (brdf->model) {
    case GRAZE_BRDF_WARD:
        return integral / sqrt(vz);
    case GRAZE_BRDF_WARD_DUER:
        return integral / vz;
    case GRAZE_BRDF_GMD:
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    return integral;
}
