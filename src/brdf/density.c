/* Densities per unit solid angle of the two samplings, and the weights of their samples. */
#include "brdf/lobe.h"

/* tau^2 = (hx^2 + hy^2)/hz^2 as number x 2^power, whatever its size. */
static brdf_scaled squared_slope(const brdf_pair *pair) {
    double_double x = pair->hx, y = pair->hy;
    double larger = fmax(fabs(x.hi), fabs(y.hi));
    int power = 0;
    if (larger > 0x1p100) { /* h was scaled up */
        frexp(larger, &power);
        x = (double_double){ldexp(x.hi, -power), ldexp(x.lo, -power)};
        y = (double_double){ldexp(y.hi, -power), ldexp(y.lo, -power)};
    }
    double_double sum = dd_add(dd_square(x), dd_square(y));
    return (brdf_scaled){dd_divide(sum, dd_square(pair->hz)), 2 * power};
}

/* The paired sampling's W. Of the two candidates that l and its slope's negative give, l's share is w/2 = lz/hz, its
 * partner's (vz u - 2q)/(2 (vz - q)) where that is positive. Here v.h = h.h/2, which unit vectors obey, gives
 * 2q = lz - vz + tau^2 hz: v's rounded x and y would tell nothing about q at grazing angles. */
static double_double mean_weight_of_pair(const brdf_pair *pair) {
    double_double own_share = dd_divide((double_double){pair->lz, 0}, pair->hz);
    if (!(fabs(pair->hx.hi) < pair->hz.hi && fabs(pair->hy.hi) < pair->hz.hi))
        return own_share; /* tau > 1: only one of them can be above the surface */
    double_double tan2 = squared_slope(pair).number;
    double_double u = dd_subtract((double_double){1, 0}, tan2);
    double_double twice_q = dd_add(exact_sum(pair->lz, -pair->vz), dd_multiply(tan2, pair->hz));
    double_double partner = dd_subtract(dd_multiply_double(u, pair->vz), twice_q);
    if (!(partner.hi > 0))
        return own_share;
    double_double divisor = dd_subtract((double_double){2 * pair->vz, 0}, twice_q);
    return dd_add(own_share, dd_divide(partner, divisor));
}

/* pdf = E (1 + tau^2)/(2 pi ax ay hz) */
double graze_brdf_ward_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_lobe lobe;
    if (!brdf_lobe_prepare(&lobe, brdf, l, v))
        return 0;
    return brdf_lobe_finish(&lobe, lobe.square, split_multiply(lobe.pi_alphas, lobe.hz), lobe.pair.scale - 1);
}

/* pdf w/W = f_new lz/W */
double graze_brdf_pair_density(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_lobe lobe;
    if (!brdf_lobe_prepare(&lobe, brdf, l, v))
        return 0;
    double_double weight = mean_weight_of_pair(&lobe.pair);
    split_number numerator = split_multiply(lobe.square, split_make(lobe.pair.lz, 0));
    split_number denominator = split_multiply(lobe.pi_alphas, split_multiply(lobe.hz, lobe.hz));
    denominator = split_multiply(denominator, split_make(weight.hi, weight.lo));
    return brdf_lobe_finish(&lobe, numerator, denominator, lobe.pair.scale);
}

/* share x f_model/f_new = share x hz^2/(4 C (1 + tau^2)) for a model other than the new one */
static double weight_of_model(const graze_brdf *brdf, const brdf_pair *pair, double_double share) {
    brdf_scaled square = squared_slope(pair);
    if (square.power == 0) /* else tau^2 is so large that 1 is nothing beside it */
        square.number = dd_add((double_double){1, 0}, square.number);
    brdf_scaled cosines = brdf_cosine_factor(brdf->model, pair->lz, pair->vz);
    double_double numerator = dd_multiply(share, dd_square(pair->hz));
    double_double weight = dd_divide(dd_divide(numerator, square.number), cosines.number);
    /* hz^2 is homogeneous of degree 2 in the scaled cosines; so is C for Ward-Duer, but of degree 1 for the others. */
    int degree = brdf->model == GRAZE_BRDF_WARD_DUER ? 0 : 1;
    return brdf_scale(weight.hi, -2 - square.power - cosines.power - degree * pair->scale);
}

double graze_brdf_ward_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_pair pair;
    if (!brdf_pair_prepare(&pair, l, v))
        return 0;
    double_double weight = dd_divide((double_double){2 * pair.lz, 0}, pair.hz); /* (15) */
    return brdf->model == GRAZE_BRDF_GMD ? weight.hi : weight_of_model(brdf, &pair, weight);
}

double graze_brdf_pair_weight(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_pair pair;
    if (!brdf_pair_prepare(&pair, l, v))
        return 0;
    double_double weight = mean_weight_of_pair(&pair);
    return brdf->model == GRAZE_BRDF_GMD ? fmin(weight.hi, 1) : weight_of_model(brdf, &pair, weight);
}
