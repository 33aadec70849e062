/* Two ways to the directional albedo of a model other than the new one, whose own is a simpler integral. */
#ifndef BRDF_ALBEDO_H
#define BRDF_ALBEDO_H

#include "brdf/slope_plane.h"

/* Over facet slopes: any roughness, at some hundred microseconds, or a few where all slopes are in reach. */
double brdf_albedo_over_slopes(graze_brdf_model, const brdf_slope_plane *, double vz);

/* Over directions l: ten times as fast where the two roughnesses are within a small factor. */
bool brdf_albedo_over_directions_suits(const graze_brdf *, const brdf_slope_plane *);
double brdf_albedo_over_directions(const graze_brdf *, graze_vec3 v);

#endif
