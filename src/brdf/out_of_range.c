/* Pairs outside the range of pair_kernels.h: powers of two are taken out of them, and the same arithmetic serves. */
#include "brdf/out_of_range.h"

#include <float.h>
#include <stdbool.h>

#include "brdf/pair_kernels.h"

/* exp(-3750) is 2^-5410; the largest factor before it, with the least roughness and cosine there is, is 2^4333. */
static const double out_of_range_limit = 3750;

/* tau^2/100 is at most the exponent */
static const double steepest_slope = 1024;

/* A pair scaled by 2^scale, so that hz is in [1/2, 1], or, for denormal cosines, at least 2^-74. */
typedef struct scaled_pair {
    graze_vec3 l, v;
    int scale;
} scaled_pair;

/* What pair_kernels.h makes of such a pair. */
typedef struct scaled_lobe {
    scaled_pair pair;
    lobe_constants constants;
    half_vector h;
    lobe_terms terms;
} scaled_lobe;

/* x 2^power; DBL_MAX where that is too large. Exponents far beyond the limit can make x negative, though what is left
 * of it then is -0: the sum makes 0 of that. */
static double scale_result(double x, double power) {
    double scaled = ldexp(x, (int)power) + 0.0;
    return scaled <= DBL_MAX ? scaled : DBL_MAX;
}

static graze_vec3 scale_vector(graze_vec3 a, int power) {
    return (graze_vec3){ldexp(a.x, power), ldexp(a.y, power), ldexp(a.z, power)};
}

/* False where nothing is reflected: a cosine too large for a double. */
static bool prepare_pair(scaled_pair *pair, graze_vec3 l, graze_vec3 v) {
    double hz = l.z + v.z;
    if (!(hz <= DBL_MAX))
        return false;
    int power;
    frexp(hz, &power);
    pair->scale = power < -1000 ? 1000 : -power; /* hx and hy remain finite */
    pair->l = scale_vector(l, pair->scale);
    pair->v = scale_vector(v, pair->scale);
    return true;
}

/* The same, but false as well where E is nothing in double precision whatever it is multiplied by. */
static bool prepare_lobe(scaled_lobe *lobe, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    if (!prepare_pair(&lobe->pair, l, v))
        return false;
    l = lobe->pair.l;
    v = lobe->pair.v;
    double bound = steepest_slope * (l.z + v.z);
    if (!(fabs(l.x + v.x) < bound && fabs(l.y + v.y) < bound))
        return false;
    lobe->constants = lobe_constants_of(brdf);
    lobe->h = half_vector_of(l, v);
    lobe->terms = lobe_terms_of(&lobe->constants, &lobe->h);
    return true;
}

static double finish_gmd(const scaled_lobe *lobe, double_double factor, int power) {
    double correction = gmd_correction(&lobe->constants, &lobe->terms);
    powered_number f = times_gaussian(factor, correction, &lobe->terms, out_of_range_limit);
    return scale_result(f.number, f.power + power);
}

static int normalise_product(double *lz, double *vz) {
    int power, power_of_v;
    *lz = frexp(*lz, &power);
    *vz = frexp(*vz, &power_of_v);
    return power + power_of_v;
}

/* Takes powers of two out of the cosines: C of the old ones is C of the new ones, which are about 1, x 2^result. */
static int normalise_cosines(graze_brdf_model model, double *lz, double *vz) {
    int power;
    switch (model) {
    case GRAZE_BRDF_WARD:
        power = normalise_product(lz, vz);
        *lz = power % 2 != 0 ? 2 * *lz : *lz;
        return (power - (power % 2 != 0)) / 2;
    case GRAZE_BRDF_WARD_DUER:
        return normalise_product(lz, vz);
    case GRAZE_BRDF_GMD: /* has no C */
    case GRAZE_BRDF_WARD_NEUMANN:
        break;
    }
    frexp(fmax(*lz, *vz), &power);
    *lz = ldexp(*lz, -power);
    *vz = ldexp(*vz, -power);
    return power;
}

double brdf_out_of_range_value(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    scaled_lobe lobe;
    if (!prepare_lobe(&lobe, brdf, l, v))
        return 0;
    if (brdf->model == GRAZE_BRDF_GMD)
        return finish_gmd(&lobe, gmd_factor(&lobe.h, &lobe.terms), 2 * lobe.pair.scale);
    double lz = l.z, vz = v.z;
    int power = normalise_cosines(brdf->model, &lz, &vz);
    double_double factor = dd_divide(lobe.constants.quarter, cosine_factor(brdf->model, lz, vz));
    powered_number f = times_gaussian(factor, 0, &lobe.terms, out_of_range_limit);
    return scale_result(f.number, f.power - power);
}

double brdf_out_of_range_ward_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    scaled_lobe lobe;
    if (!prepare_lobe(&lobe, brdf, l, v))
        return 0;
    return finish_gmd(&lobe, ward_density_factor(&lobe.h, &lobe.terms), lobe.pair.scale);
}

double brdf_out_of_range_pair_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    scaled_lobe lobe;
    if (!prepare_lobe(&lobe, brdf, l, v))
        return 0;
    double_double weight = brdf_out_of_range_mean_weight(lobe.pair.l, lobe.pair.v);
    double_double factor = pair_density_factor(&lobe.h, &lobe.terms, lobe.pair.l.z, weight);
    return finish_gmd(&lobe, factor, lobe.pair.scale);
}

/* weight x f_model/f_new. h may be very long compared with hz: h.h needs a power of two of its own. */
static double scaled_weight_of_model(const graze_brdf *brdf, const scaled_pair *pair, double_double weight,
                                     graze_vec3 l, graze_vec3 v) {
    double longest = fabs(pair->l.x + pair->v.x) + fabs(pair->l.y + pair->v.y) + 1;
    if (!(longest <= DBL_MAX))
        return 0;
    int length;
    frexp(longest, &length);
    half_vector h = half_vector_of(scale_vector(pair->l, -length), scale_vector(pair->v, -length));
    h.z2 = loose_square(exact_positive_sum(pair->l.z, pair->v.z));
    double lz = l.z, vz = v.z;
    int power = normalise_cosines(brdf->model, &lz, &vz);
    return scale_result(weight_of_model(brdf->model, weight, &h, lz, vz), -2 * (pair->scale + length) - power);
}

double brdf_out_of_range_ward_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    scaled_pair pair;
    if (!prepare_pair(&pair, l, v))
        return 0;
    double_double hz = exact_positive_sum(pair.l.z, pair.v.z);
    double_double weight = dd_divide((double_double){2 * pair.l.z, 0}, hz);
    return brdf->model == GRAZE_BRDF_GMD ? weight.hi : scaled_weight_of_model(brdf, &pair, weight, l, v);
}

double brdf_out_of_range_pair_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    scaled_pair pair;
    if (!prepare_pair(&pair, l, v))
        return 0;
    double_double weight = brdf_out_of_range_mean_weight(pair.l, pair.v);
    return brdf->model == GRAZE_BRDF_GMD ? weight.hi : scaled_weight_of_model(brdf, &pair, weight, l, v);
}
