/* Directional albedo, and the share of Ward's samples that is accepted. Those of the new model and the latter are means
 * over slopes of which one of two integrals is known. */
#include "brdf/albedo.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

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

/* False where v is not above the surface, or absurd. */
static bool normalize(graze_vec3 *v) {
    double length = hypot(hypot(v->x, v->y), v->z);
    if (!(v->z > 0 && length <= DBL_MAX))
        return false;
    *v = (graze_vec3){v->x / length, v->y / length, v->z / length};
    return v->z > 0;
}

double graze_brdf_albedo(const graze_brdf *brdf, graze_vec3 v) {
    if (!normalize(&v))
        return 0;
    brdf_slope_plane plane;
    brdf_slope_plane_prepare(&plane, brdf, v);
    if (brdf->model == GRAZE_BRDF_GMD)
        return fmin(brdf_slope_mean(&plane, new_model_across, &plane, NULL), 1);
    double albedo = brdf_albedo_over_directions_suits(brdf, &plane) ? brdf_albedo_over_directions(brdf, v)
                                                                    : brdf_albedo_over_slopes(brdf->model, &plane, v.z);
    return fmin(albedo, DBL_MAX);
}

double graze_brdf_ward_acceptance(const graze_brdf *brdf, graze_vec3 v) {
    if (!normalize(&v))
        return 0;
    brdf_slope_plane plane;
    brdf_slope_plane_prepare(&plane, brdf, v);
    return fmin(brdf_slope_mean(&plane, accepted_across, &plane, NULL), 1);
}
