/* Radiance's estimate of Fresnel reflection, which it gives to mirrors only. */
#ifndef MATERIAL_FRESNEL_H
#define MATERIAL_FRESNEL_H

#include <math.h>

/* Below this specularity Radiance takes the material to be unpolished and leaves the estimate out (its "1.8 percent").
 */
#define MATERIAL_FRESNEL_THRESHOLD 0.017999

/* The additional share of light that is reflected at this cosine of incidence (0 .. 1): e^(-5.85 cos), moved down so as
 * to end at 0 for normal incidence, where Radiance's rounded constant would give -2e-12. */
static inline double material_fresnel(double cosine) {
    return fmax(0, exp(-5.85 * cosine) - 0.00287989916);
}

/* Schlick's approximation, for ashik2. */
static inline double material_schlick(double cosine) {
    double part = fmax(1 - cosine, 0), square = part * part;
    return square * square * part;
}

#endif
