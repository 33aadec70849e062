/* The field's integral along parts of an outline: to be compiled once for each instruction set. */
#ifndef BRDF_FIELD_LOOPS_H
#define BRDF_FIELD_LOOPS_H

#include <math.h>

#include "brdf/constants.h"
#include "brdf/elementary.h"
#include "brdf/gauss.h"
#include "brdf/lobe_field.h"

/* exp(x) for x <= 0 to 1.1e-12; less than e^-60 is e^-60. A polynomial through Chebyshev's points. */
BRDF_INLINE double field_exp(double x) {
    const double log2_e = 0x1.71547652b82fep+0, round_to_integer = 0x1.8p52;
    x = x > -60 ? x : -60;
    double shifted = x * log2_e + round_to_integer, n = shifted - round_to_integer;
    double r = (x - n * brdf_ln2_hi) - n * brdf_ln2_lo, r2 = r * r, r4 = r2 * r2;
    double low = (1 + r * 0x1.ffffffffd382fp-1) + r2 * (0x1.fffffffff71b2p-2 + r * 0x1.555555a279c87p-3);
    double high =
        (0x1.555555742d965p-5 + r * 0x1.1110809f385f6p-7) + r2 * (0x1.6c164de86dafdp-10 + r * 0x1.a1aa939e677aep-13);
    return (low + r4 * (high + r4 * 0x1.a15a600528a0fp-16)) * brdf_from_bits((brdf_bits(shifted) + 1023) << 52);
}

/* exp(y^2) erfc(y) for y >= 0 to 2e-12, where s = 1.4 (y - 3)/(y + 3) + 0.4 goes from -1 to 1; beyond, for y > 7.5
 * where exp(-y^2) makes it nothing, that of 7.5. A polynomial through Chebyshev's points. */
BRDF_INLINE double field_erfcx(double s) {
    s = s < 1 ? s : 1;
    double s2 = s * s, s4 = s2 * s2;
    double low =
        (0x1.2f65fc060f7b1p-2 + s * -0x1.75ad2bb78e46cp-2) + s2 * (0x1.b21b951b6d18cp-3 + s * -0x1.7ab1172a94605p-4);
    double middle =
        (0x1.d8e49251832bap-6 + s * -0x1.6a0ff26764728p-8) + s2 * (0x1.a0e686eadc47cp-13 + s * 0x1.901b840ff18dep-13);
    double high = (-0x1.044bedb3434fbp-15 + s * -0x1.e55e4313d25d4p-18) +
                  s2 * (0x1.0571db8e36eeep-19 + s * 0x1.ab6a9fe5b3765p-22);
    double highest = (-0x1.d2001f3e97c62p-24 + s * -0x1.9366d3387ab31p-26) + s2 * 0x1.39d9a07456226p-28;
    return low + s4 * (middle + s4 * (high + s4 * highest));
}

/* Numbers at Gauss's points: A, B, C, and A'C - AC' times the weight. */
enum { FIELD_POINTS = BRDF_MOST_PIECES * BRDF_MOST_GAUSS_POINTS };
typedef struct field_points {
    double a[FIELD_POINTS], b[FIELD_POINTS], c[FIELD_POINTS], change[FIELD_POINTS];
} field_points;

BRDF_INLINE double polynomial_at(const double *p, double u) {
    return p[0] + u * (p[1] + u * p[2]);
}

BRDF_INLINE double polynomial_derivative(const double *p, double u) {
    return p[1] + 2 * u * p[2];
}

BRDF_INLINE void put_edge(const brdf_piece *piece, const double *u, const double *weight, double *restrict a,
                          double *restrict b, double *restrict c, double *restrict change) {
    const brdf_piece p = *piece;
    for (int i = 0; i < p.points; ++i) {
        a[i] = polynomial_at(p.polynomials[0], u[i]);
        b[i] = polynomial_at(p.polynomials[1], u[i]);
        c[i] = polynomial_at(p.polynomials[2], u[i]);
        change[i] = weight[i] * polynomial_at(p.polynomials[3], u[i]);
    }
}

BRDF_INLINE void put_arc(const brdf_lobe_field *f, const brdf_piece *piece, const double *u, const double *weight,
                         double *restrict a, double *restrict b, double *restrict c, double *restrict change) {
    const brdf_piece p = *piece;
    for (int i = 0; i < p.points; ++i) {
        double x = polynomial_at(p.polynomials[0], u[i]), dx = polynomial_derivative(p.polynomials[0], u[i]);
        double y = polynomial_at(p.polynomials[1], u[i]), dy = polynomial_derivative(p.polynomials[1], u[i]);
        double z = polynomial_at(p.polynomials[2], u[i]), dz = polynomial_derivative(p.polynomials[2], u[i]);
        double d = sqrt(x * x + y * y + z * z), dd = (x * dx + y * dy + z * dz) / d;
        a[i] = f->a_of_x * x + f->a_of_y * y + f->a_of_d * d;
        b[i] = f->b_of_x * x + f->b_of_y * y + f->b_of_d * d;
        c[i] = z + f->c_of_d * d;
        double da = f->a_of_x * dx + f->a_of_y * dy + f->a_of_d * dd, dc = dz + f->c_of_d * dd;
        change[i] = weight[i] * (da * c[i] - a[i] * dc);
    }
}

/* F times the change of a. One division does for all. */
BRDF_INLINE double field_at(const brdf_lobe_field *f, double numerator_a, double numerator_b, double c, double change) {
    const double half_root_pi = 0x1.c5bf891b4ef6bp-1;
    double divisor = c + f->lean * numerator_a, distant = fabs(numerator_b) + 3 * c, nearer = c * distant;
    double inverse = 1 / (nearer * divisor), per_c = inverse * (distant * divisor), r = c * (inverse * nearer);
    double a = numerator_a * per_c, b = f->side * numerator_b * per_c;
    double s = 1.4 * ((fabs(numerator_b) - 3 * c) * (inverse * (c * divisor))) + .4;
    double along = field_exp(-a * a), g = field_exp(-a * a - b * b), tail = g * field_erfcx(s);
    double whole = -half_root_pi * (b < 0 ? 2 * along - tail : tail);
    double field =
        (2 - (1 + f->aa * a * a) * r) * whole + f->side * f->ab * a * r * g - f->bb * r * (.5 * (whole - b * g));
    return field * (change * (per_c * per_c));
}

/* Points that add nothing, up to a multiple of `lanes`. */
static int fill_up(field_points *points, int used, int lanes) {
    for (; used % lanes != 0; ++used) {
        points->a[used] = points->b[used] = points->change[used] = 0;
        points->c[used] = 1;
    }
    return used;
}

/* In eight sums, whatever the instruction set. */
static double field_along_pieces(const brdf_lobe_field *field, const brdf_piece *pieces, int count) {
    enum { LANES = 8 };
    field_points points;
    int used = 0;
    for (int i = 0; i < count; ++i) {
        const double *u = &brdf_gauss_points[brdf_gauss_rule(pieces[i].points)];
        const double *weight = &brdf_gauss_weights[brdf_gauss_rule(pieces[i].points)];
        double *a = &points.a[used], *b = &points.b[used], *c = &points.c[used], *change = &points.change[used];
        if (pieces[i].is_edge)
            put_edge(&pieces[i], u, weight, a, b, c, change);
        else
            put_arc(field, &pieces[i], u, weight, a, b, c, change);
        used += pieces[i].points;
    }
    used = fill_up(&points, used, LANES);
    double sums[LANES] = {0};
    const brdf_lobe_field f = *field;
    for (int i = 0; i < used; i += LANES)
        for (int k = 0; k < LANES; ++k)
            sums[k] += field_at(&f, points.a[i + k], points.b[i + k], points.c[i + k], points.change[i + k]);
    return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

#endif
