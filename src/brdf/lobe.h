/* What all models share: the half vector h = l + v, its slopes, and the Gaussian factor E of them, so exactly that the
 * functions built on them are good to the last bits. */
#ifndef BRDF_LOBE_H
#define BRDF_LOBE_H

#include <stdbool.h>

#include "brdf/double_double.h"
#include "graze/brdf.h"

/* A pair of directions above the surface, scaled by 2^scale so that powers of cosines neither over- nor underflow.
 * `scale` is 0 but next to the horizon. */
typedef struct brdf_pair {
    double_double hx, hy, hz; /* hz within 2^-75 .. 2^400 */
    double lz, vz;
    int scale;
} brdf_pair;

/* The lobe at a pair. E = exp(-exponent); slopes are at most 64 times the roughness. */
typedef struct brdf_lobe {
    brdf_pair pair;
    double_double exponent; /* (hx/ax)^2 + (hy/ay)^2 over hz^2 */
    split_number square;    /* h.h/hz^2 = 1 + tau^2 */
    split_number hz;        /* scaled as in the pair */
    split_number pi_alphas; /* pi ax ay */
} brdf_lobe;

/* number x 2^power */
typedef struct brdf_scaled {
    double_double number;
    int power;
} brdf_scaled;

/* False where nothing is reflected: a direction not above the surface, or not a number, or of absurd length. */
bool brdf_pair_prepare(brdf_pair *, graze_vec3 l, graze_vec3 v);

/* The same, but false as well where E is nothing in double precision whatever it is multiplied by. */
bool brdf_lobe_prepare(brdf_lobe *, const graze_brdf *, graze_vec3 l, graze_vec3 v);

/* numerator/denominator x E x 2^power, rounded nearly once; DBL_MAX where that is too large. */
double brdf_lobe_finish(const brdf_lobe *, split_number numerator, split_number denominator, int power);

/* What a model other than GMD divides by: its value is E/(4 pi ax ay C), and C is sqrt(lz vz) (4), lz vz (5) or
 * max(lz, vz) (Ward-Neumann). */
brdf_scaled brdf_cosine_factor(graze_brdf_model, double lz, double vz);

/* x 2^power; DBL_MAX where that is too large. */
double brdf_scale(double x, int power);

#endif
