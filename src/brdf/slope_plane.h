/* The plane of facet slopes as the viewer sees it, over which albedos are means.
 *
 * A slope (ax X, ay Y) has the density exp(-X^2 - Y^2)/pi in (X, Y). That plane is turned so that the slope's part
 * along the view, q of (26), depends on the first coordinate alone. With coordinates (a, b), of the same density,
 *
 *     q/vz = lean a,     tau^2 = aa a^2 + 2 ab a b + bb b^2,     lz/vz = 2 (1 + lean a)/(1 + tau^2) - 1
 *
 * so that lz > 0, and lz > vz, are the insides of ellipses. */
#ifndef BRDF_SLOPE_PLANE_H
#define BRDF_SLOPE_PLANE_H

#include <stdbool.h>

#include "brdf/quadrature.h"
#include "graze/brdf.h"

typedef struct brdf_slope_plane {
    double lean;
    double aa, ab, bb;
    double narrowing;  /* aa - ab^2/bb = (ax ay)^2/bb */
    bool all_in_reach; /* every slope within the farthest gives an l above the surface */
} brdf_slope_plane;

/* For v of length 1 with v.z > 0; powers of 1/v.z must remain within range. */
void brdf_slope_plane_prepare(brdf_slope_plane *, const graze_brdf *, graze_vec3 v);

/* The inside of an ellipse: tau^2 < level + slant a. */
typedef struct brdf_ellipse {
    double level, slant;
} brdf_ellipse;

/* lz > 0; lz > vz */
brdf_ellipse brdf_ellipse_above_surface(const brdf_slope_plane *);
brdf_ellipse brdf_ellipse_above_mirror(const brdf_slope_plane *);

/* The b inside the ellipse at some a: middle - half .. middle + half. */
typedef struct brdf_chord {
    double middle, half;
} brdf_chord;
brdf_chord brdf_ellipse_chord(const brdf_slope_plane *, brdf_ellipse, double a);

/* The mean over all slopes, 0 those that give an l below the surface, of a function whose integral over b, with
 * exp(-b^2), is `across` at each a. That is not smooth where `kink`, if not null, begins, ends or gets out of reach. */
double brdf_slope_mean(const brdf_slope_plane *, brdf_integrand *across, const void *context, const brdf_ellipse *kink);

#endif
