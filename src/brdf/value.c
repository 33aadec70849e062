/* The four reflectance functions. */
#include "brdf/lobe.h"

double graze_brdf_value(const graze_brdf *brdf, graze_vec3 l, graze_vec3 v) {
    brdf_lobe lobe;
    if (!brdf_lobe_prepare(&lobe, brdf, l, v))
        return 0;
    if (brdf->model == GRAZE_BRDF_GMD) { /* (17), with h.h = hz^2 (1 + tau^2) */
        split_number denominator = split_multiply(lobe.pi_alphas, split_multiply(lobe.hz, lobe.hz));
        return brdf_lobe_finish(&lobe, lobe.square, denominator, 2 * lobe.pair.scale);
    }
    brdf_scaled cosines = brdf_cosine_factor(brdf->model, l.z, v.z);
    split_number denominator = split_multiply(lobe.pi_alphas, split_make(cosines.number.hi, cosines.number.lo));
    return brdf_lobe_finish(&lobe, (split_number){1, 0}, denominator, -2 - cosines.power);
}
