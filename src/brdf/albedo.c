/* Directional albedo, and the share of Ward's samples that is accepted. Those of the new model and the latter are means
 * over slopes of which one of two integrals is known. */
#include "brdf/albedo.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "brdf/parameters.h"

static const double half_root_pi = 0x1.c5bf891b4ef6bp-1;

/* The integral of exp(-b^2) over a chord. */
static double gaussian_of_chord(brdf_chord chord) {
    return half_root_pi * (erf(chord.middle + chord.half) - erf(chord.middle - chord.half));
}

/* The integral of exp(-b^2) (half^2 - (b - middle)^2) over a chord, by Gauss's eight points for a short one, on which
 * all that follows would cancel. */
static double cap_of_chord(brdf_chord chord) {
    static const double nodes[] = {0.960289856497536232, 0.796666477413626740, 0.525532409916328986,
                                   0.183434642495649805};
    static const double weights[] = {0.101228536290376259, 0.222381034453374471, 0.313706645877887287,
                                     0.362683783378361983};
    double low = chord.middle - chord.half, high = chord.middle + chord.half, sum = 0;
    if (chord.half > .25) {
        double ends = high * exp(-low * low) - low * exp(-high * high);
        return ends / 2 - (low * high + .5) * gaussian_of_chord(chord);
    }
    for (int i = 0; i < 4; ++i) {
        double x = nodes[i] * chord.half, left = chord.middle - x, right = chord.middle + x;
        sum += weights[i] * (1 - nodes[i] * nodes[i]) * (exp(-left * left) + exp(-right * right));
    }
    return sum * chord.half * chord.half * chord.half;
}

static brdf_chord chord_above_surface(const brdf_slope_plane *plane, double a) {
    return brdf_ellipse_chord(plane, brdf_ellipse_above_surface(plane), a);
}

/* The weight of the new model (15) is (1 + 2 lean a - tau^2)/(1 + lean a): in b a parabola that is 0 where l is on the
 * horizon. */
static double new_model_across(const void *context, double a) {
    const brdf_slope_plane *plane = context;
    return plane->bb / (1 + plane->lean * a) * cap_of_chord(chord_above_surface(plane, a));
}

static double accepted_across(const void *context, double a) {
    return gaussian_of_chord(chord_above_surface(context, a));
}

/* A smaller cosine is nothing beside any roughness: but for what Ward's and Ward-Duer's divide by it, 1/sqrt(vz) and
 * 1/vz, all is the same there. */
static const double least_cosine = 1e-30;

/* Gives v the length 1, and at least that cosine. Returns the square root of how many times smaller its own is, 1 or
 * more: the number itself may be too large. Returns 0 where v is not above the surface or not finite. */
static double normalize(graze_vec3 *v) {
    if (!(isfinite(v->x) && isfinite(v->y) && isfinite(v->z) && v->z > 0))
        return 0;
    int exponent;
    frexp(fmax(fmax(fabs(v->x), fabs(v->y)), v->z), &exponent);
    double x = ldexp(v->x, -exponent), y = ldexp(v->y, -exponent), z = ldexp(v->z, -exponent);
    double length = hypot(hypot(x, y), z);
    double half = ldexp(length / 2, exponent); /* of v's own length, which may be too large */
    double root = sqrt(2 * least_cosine) * sqrt(half) / sqrt(v->z);
    *v = (graze_vec3){x / length, y / length, fmax(z / length, least_cosine)};
    return fmax(root, 1);
}

double graze_brdf_albedo(const graze_brdf *brdf, graze_vec3 v) {
    double root = normalize(&v);
    if (root == 0)
        return 0;
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_slope_plane plane;
    brdf_slope_plane_prepare(&plane, &in_range, v);
    if (brdf->model == GRAZE_BRDF_GMD)
        return fmin(brdf_slope_mean(&plane, new_model_across, &plane, NULL), 1);
    double albedo = brdf_albedo_over_directions_suits(&in_range, &plane)
                        ? brdf_albedo_over_directions(&in_range, v)
                        : brdf_albedo_over_slopes(in_range.model, &plane, v.z);
    if (brdf->model == GRAZE_BRDF_WARD)
        albedo *= root;
    if (brdf->model == GRAZE_BRDF_WARD_DUER)
        albedo *= root * root;
    return fmin(albedo, DBL_MAX);
}

double graze_brdf_ward_acceptance(const graze_brdf *brdf, graze_vec3 v) {
    if (normalize(&v) == 0)
        return 0;
    const graze_brdf in_range = brdf_in_range(brdf);
    brdf_slope_plane plane;
    brdf_slope_plane_prepare(&plane, &in_range, v);
    return fmin(brdf_slope_mean(&plane, accepted_across, &plane, NULL), 1);
}
