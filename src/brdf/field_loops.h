/* The field's integral along an arc: to be compiled once for each instruction set. */
#ifndef BRDF_FIELD_LOOPS_H
#define BRDF_FIELD_LOOPS_H

#include <math.h>

#include "brdf/constants.h"
#include "brdf/elementary.h"
#include "brdf/lobe_field.h"
#include "brdf/outline.h"

/* exp(x) for x <= 0 to 1e-12; less than e^-60 is e^-60. */
BRDF_INLINE double field_exp(double x) {
    const double log2_e = 0x1.71547652b82fep+0, round_to_integer = 0x1.8p52;
    x = x > -60 ? x : -60;
    double shifted = x * log2_e + round_to_integer, n = shifted - round_to_integer;
    double r = (x - n * brdf_ln2_hi) - n * brdf_ln2_lo, r2 = r * r, r4 = r2 * r2;
    double low = (1 + r) + r2 * (.5 + r * (1. / 6));
    double high = (1. / 24 + r * (1. / 120)) + r2 * (1. / 720 + r * (1. / 5040));
    double highest = 1. / 40320 + r * (1. / 362880) + r2 * (1. / 3628800);
    return (low + r4 * (high + r4 * highest)) * brdf_from_bits((brdf_bits(shifted) + 1023) << 52);
}

/* exp(y^2) erfc(y) for y >= 0 to 2e-12; beyond 7.5, where exp(-y^2) makes it nothing, that of 7.5. A polynomial in
 * s = 1.4 (y - 3)/(y + 3) + 0.4, which goes from -1 to 1, through Chebyshev's points. */
BRDF_INLINE double field_erfcx(double y) {
    y = y < 7.5 ? y : 7.5;
    double s = 1.4 * ((y - 3) / (y + 3)) + .4, s2 = s * s, s4 = s2 * s2;
    double low =
        (0x1.2f65fc060f7b1p-2 + s * -0x1.75ad2bb78e46cp-2) + s2 * (0x1.b21b951b6d18cp-3 + s * -0x1.7ab1172a94605p-4);
    double middle =
        (0x1.d8e49251832bap-6 + s * -0x1.6a0ff26764728p-8) + s2 * (0x1.a0e686eadc47cp-13 + s * 0x1.901b840ff18dep-13);
    double high = (-0x1.044bedb3434fbp-15 + s * -0x1.e55e4313d25d4p-18) +
                  s2 * (0x1.0571db8e36eeep-19 + s * 0x1.ab6a9fe5b3765p-22);
    double highest = (-0x1.d2001f3e97c62p-24 + s * -0x1.9366d3387ab31p-26) + s2 * 0x1.39d9a07456226p-28;
    return low + s4 * (middle + s4 * (high + s4 * highest));
}

BRDF_INLINE double field_at(const brdf_lobe_field *f, double a, double b) {
    const double half_root_pi = 0x1.c5bf891b4ef6bp-1;
    const brdf_slope_plane *p = &f->plane;
    double along = field_exp(-a * a), g = field_exp(-a * a - b * b), side = b < 0 ? -1 : 1, r = 1 / (1 + p->lean * a);
    double whole = half_root_pi * ((side - f->base) * along - side * (g * field_erfcx(fabs(b))));
    return (2 - (1 + p->aa * a * a) * r) * whole + p->ab * a * r * g - p->bb * r * (.5 * (whole - b * g));
}

/* The integral of A da from u = `from` to `to` by Gauss's eight points. With e the arc's point and |e| its distance,
 * the half vector's slope is (e + |e| v)/(e.z + |e| v.z). */
static double field_along_arc(const brdf_lobe_field *f, const brdf_arc *arc, double from, double to) {
    double a[BRDF_GAUSS_POINTS], b[BRDF_GAUSS_POINTS], change[BRDF_GAUSS_POINTS], part[BRDF_GAUSS_POINTS];
    graze_vec3 v = f->v;
    for (int i = 0; i < BRDF_GAUSS_POINTS; ++i) {
        double u = from + (to - from) * brdf_gauss_points[i];
        graze_vec3 e = brdf_arc_at(arc, u), d = brdf_arc_derivative(arc, u);
        double distance = sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
        double d_distance = (e.x * d.x + e.y * d.y + e.z * d.z) / distance;
        double per_height = 1 / (e.z + distance * v.z), d_height = d.z + d_distance * v.z;
        double x = (e.x + distance * v.x) * per_height, y = (e.y + distance * v.y) * per_height;
        double dx = (d.x + d_distance * v.x - x * d_height) * per_height;
        double dy = (d.y + d_distance * v.y - y * d_height) * per_height;
        a[i] = f->a_of_x * x + f->a_of_y * y;
        b[i] = f->b_of_x * x + f->b_of_y * y;
        change[i] = f->a_of_x * dx + f->a_of_y * dy;
    }
    for (int i = 0; i < BRDF_GAUSS_POINTS; ++i)
        part[i] = brdf_gauss_weights[i] * field_at(f, a[i], b[i]) * change[i];
    double sum = 0;
    for (int i = 0; i < BRDF_GAUSS_POINTS; ++i)
        sum += part[i];
    return (to - from) * sum;
}

#endif
