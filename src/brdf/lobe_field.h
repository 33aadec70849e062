/* A field in the slope plane of which the lobe is the curl.
 *
 * In the coordinates (a, b) of slope_plane.h, a lobe's reflectance is exp(-a^2 - b^2) w/pi with the weight (15)
 *
 *     w = 2 - (1 + tau^2)/(1 + lean a),      tau^2 = aa a^2 + 2 ab a b + bb b^2
 *
 * of which b has an antiderivative: with g = exp(-a^2 - b^2) and G that of g,
 *
 *     A(a, b) = (2 - (1 + aa a^2) r) G + ab a r g - bb r (G - b g)/2,      r = 1/(1 + lean a)
 *
 * The integral of w g over a region is that of A da along its outline, but for the sign. G is, for `base` 0, 1, -1, the
 * integral from 0, infinity, or minus infinity; it ought to begin on the region's side, since it cancels elsewhere. */
#ifndef BRDF_LOBE_FIELD_H
#define BRDF_LOBE_FIELD_H

#include "brdf/slope_plane.h"

typedef struct brdf_lobe_field {
    brdf_slope_plane plane;
    graze_vec3 v;
    double a_of_x, a_of_y, b_of_x, b_of_y; /* from slopes to coordinates */
    double base;
} brdf_lobe_field;

#endif
