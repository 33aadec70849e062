/* The half vector, the Gaussian of its slopes, and what keeps powers of cosines within range. */
#include "brdf/lobe.h"

#include <float.h>

static const double small_cosine = 0x1p-40; /* any power of it here, times the least roughness squared, is no problem */
static const double large_cosine = 0x1p400;

/* exp(-64^2) is 1e-1779; the largest factor before it, with the least roughness and cosine there is, is 1e1304. */
static const double largest_scaled_slope = 64;

/* Takes the power of two out of a cosine next to the horizon: *z x 2^result is the old *z. */
static int take_power(double *z) {
    int power = 0;
    if (*z < small_cosine)
        *z = frexp(*z, &power);
    return power;
}

static graze_vec3 scaled_vector(graze_vec3 a, int power) {
    return (graze_vec3){ldexp(a.x, power), ldexp(a.y, power), ldexp(a.z, power)};
}

bool brdf_pair_prepare(brdf_pair *pair, graze_vec3 l, graze_vec3 v) {
    if (!(l.z > 0 && v.z > 0))
        return false;
    double hz = l.z + v.z;
    if (!(hz < large_cosine))
        return false;
    pair->scale = -take_power(&hz);
    if (pair->scale > 1000) /* for denormal cosines, so that hx and hy remain finite */
        pair->scale = 1000;
    if (pair->scale != 0) {
        l = scaled_vector(l, pair->scale);
        v = scaled_vector(v, pair->scale);
    }
    pair->lz = l.z;
    pair->vz = v.z;
    pair->hx = exact_sum(l.x, v.x);
    pair->hy = exact_sum(l.y, v.y);
    pair->hz = exact_sum(l.z, v.z);
    return true;
}

/* a/alpha, for a slope. */
static split_number over_roughness(split_number a, double alpha) {
    return split_divide(a, split_make(alpha, 0), 1 / alpha);
}

bool brdf_lobe_prepare(brdf_lobe *lobe, const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_pair *pair = &lobe->pair;
    if (!brdf_pair_prepare(pair, l, v))
        return false;
    /* Slopes steeper than any roughness brings into reach: what follows might leave double's range. */
    double bound = 16 * largest_scaled_slope * pair->hz.hi;
    if (!(fabs(pair->hx.hi) < bound && fabs(pair->hy.hi) < bound))
        return false;
    double reciprocal = 1 / pair->hz.hi;
    lobe->hz = split_make(pair->hz.hi, pair->hz.lo);
    split_number slope_x = split_divide(split_make(pair->hx.hi, pair->hx.lo), lobe->hz, reciprocal);
    split_number slope_y = split_divide(split_make(pair->hy.hi, pair->hy.lo), lobe->hz, reciprocal);
    split_number x = over_roughness(slope_x, brdf->alpha_x), y = over_roughness(slope_y, brdf->alpha_y);
    if (!(fabs(x.head) <= largest_scaled_slope && fabs(y.head) <= largest_scaled_slope))
        return false;

    double_double heads = exact_sum(x.head * x.head, y.head * y.head);
    lobe->exponent = exact_ordered_sum(heads.hi, heads.lo + (split_square_tail(x) + split_square_tail(y)));

    heads = exact_sum(slope_x.head * slope_x.head, slope_y.head * slope_y.head);
    double_double square = exact_sum(1, heads.hi);
    square.lo += heads.lo + (split_square_tail(slope_x) + split_square_tail(slope_y));
    lobe->square = split_make(square.hi, square.lo);

    split_number pi = split_make(0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53);
    lobe->pi_alphas = split_multiply(pi, split_multiply(split_make(brdf->alpha_x, 0), split_make(brdf->alpha_y, 0)));
    return true;
}

double brdf_lobe_finish(const brdf_lobe *lobe, split_number numerator, split_number denominator, int power) {
    split_number factor = split_divide(numerator, denominator, 1 / split_round(denominator));
    double_double exponent = lobe->exponent;
    if (exponent.hi > 256 || power != 0) { /* a product might underflow: take a power of two out */
        const double ln2_hi = 0x1.62e42fefap-1, ln2_lo = 0x1.cf79abc9e3b3ap-40; /* 35 bits: n x ln2_hi is exact */
        double n = rint(exponent.hi / (ln2_hi + ln2_lo));
        exponent = exact_sum(exponent.hi - n * ln2_hi, exponent.lo - n * ln2_lo);
        power -= (int)n;
    }
    /* exp(-hi - lo) = exp(-hi) (1 - lo) */
    double gaussian = exp(-exponent.hi), gaussian_head = upper_bits(gaussian);
    double corrections = factor.tail - split_round(factor) * exponent.lo;
    double rest = (gaussian - gaussian_head) * factor.head + gaussian * corrections;
    return brdf_scale(gaussian_head * factor.head + rest, power);
}

brdf_scaled brdf_cosine_factor(graze_brdf_model model, double lz, double vz) {
    int power;
    switch (model) {
    case GRAZE_BRDF_WARD:
        power = take_power(&lz) + take_power(&vz);
        if (power % 2 != 0) {
            lz *= 2;
            --power;
        }
        return (brdf_scaled){dd_sqrt(exact_product(lz, vz)), power / 2};
    case GRAZE_BRDF_WARD_DUER:
        power = take_power(&lz) + take_power(&vz);
        return (brdf_scaled){exact_product(lz, vz), power};
    default: /* Ward-Neumann */
        return (brdf_scaled){{fmax(lz, vz), 0}, 0};
    }
}

double brdf_scale(double x, int power) {
    double scaled = power == 0 ? x : ldexp(x, power);
    return scaled <= DBL_MAX ? scaled : DBL_MAX;
}
