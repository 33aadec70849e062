/* A field in the slope plane of which the lobe is the curl.
 *
 * In the coordinates (a, b) of slope_plane.h, a lobe's reflectance is exp(-a^2 - b^2) w/pi with the weight (15)
 *
 *     w = 2 - (1 + tau^2)/(1 + lean a),      tau^2 = aa a^2 + 2 ab a b + bb b^2
 *
 * of which b has an antiderivative: with g = exp(-a^2 - b^2) and G its integral over b from infinity,
 *
 *     F(a, b) = (2 - (1 + aa a^2) r) G + ab a r g - bb r (G - b g)/2,      r = 1/(1 + lean a)
 *
 * The integral of w g over a region is that of F da along its outline, but for the sign. That F vanishes for large b
 * matters for lights there, which are dim: from elsewhere, G would cancel; so it begins on the light's side.
 *
 * A direction e of length d has the slope (e + d v)/(e.z + d v.z), thus a = A/C and b = B/C with A, B and C linear in e
 * and d. On a great circle between unit vectors p and q,
 *
 *     e = (1-u)^2 p + 2 u (1-u) m + u^2 q,      d = (1-u)^2 + 2 u (1-u) m.p + u^2,
 *
 * m being the unit vector halfway: A, B and C are quadratic polynomials. */
#ifndef BRDF_LOBE_FIELD_H
#define BRDF_LOBE_FIELD_H

#include <stdbool.h>

/* (a, b, 1) times C, of e with d = 0, and what d adds; and whether b is to be replaced by -b: 1 or -1. */
typedef struct brdf_lobe_field {
    double lean, aa, ab, bb;
    double a_of_x, a_of_y, a_of_d;
    double b_of_x, b_of_y, b_of_d;
    double c_of_d;
    double side;
} brdf_lobe_field;

/* Part of an outline for so many of Gauss's points, a multiple of 4. With polynomials p[0] + p[1] u + p[2] u^2: for an
 * edge A, B, C and A'C - AC', for an arc x, y, z of e and nothing. */
typedef struct brdf_piece {
    int points;
    bool is_edge;
    double polynomials[4][3];
} brdf_piece;

enum { BRDF_MOST_PIECES = 8, BRDF_MOST_GAUSS_POINTS = 16 };

#endif
