/* The functions of pair_kernels.h for pairs outside the ordinary domain: next to the horizon, of absurd length, not
 * finite, or with a W of which almost all cancels. Both directions have to be above the surface. */
#ifndef BRDF_OUT_OF_RANGE_H
#define BRDF_OUT_OF_RANGE_H

#include "brdf/double_double.h"
#include "graze/brdf.h"

double brdf_out_of_range_value(const graze_brdf *, graze_vec3 l, graze_vec3 v);
double brdf_out_of_range_ward_density(const graze_brdf *, graze_vec3 l, graze_vec3 v);
double brdf_out_of_range_ward_weight(const graze_brdf *, graze_vec3 l, graze_vec3 v);
double brdf_out_of_range_pair_density(const graze_brdf *, graze_vec3 l, graze_vec3 v);
double brdf_out_of_range_pair_weight(const graze_brdf *, graze_vec3 l, graze_vec3 v);

/* The paired sampling's W of a pair scaled so that hz is about 1, however much of it cancels. */
double_double brdf_out_of_range_mean_weight(graze_vec3 l, graze_vec3 v);

#endif
