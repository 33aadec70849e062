/* The elementary functions that the samplers need, without branches, so that compilers make vector code of them: the
 * logarithm of 1 - s, and the sine and cosine of a number of turns. No result depends on whether there is a fused
 * multiply-add. Errors in units in the last place, "tested" being what the tests hold them to, "measured" the largest
 * found against MPFR:
 *
 *   function                    tested   measured
 *   brdf_minus_log_remainder    1       0.96
 *   brdf_turn: sine             0.9     0.84
 *   brdf_turn: cosine           0.9     0.83 */
#ifndef BRDF_ELEMENTARY_H
#define BRDF_ELEMENTARY_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "brdf/constants.h"
#include "brdf/double_double.h"

BRDF_INLINE uint64_t brdf_bits(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

BRDF_INLINE double brdf_from_bits(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* -log(1 - s) for s in [0, 1 - 2^-53], where remainder is 1 - s rounded. With 1 - s = (1 + x) 2^-n and 1 + x between
 * sqrt(1/2) and sqrt(2), it is n log 2 - log(1 + x). The logarithm is that of fdlibm: for a = x/(2 + x),
 * log(1 + x) = 2 artanh(a) = x - a (x - R) with R = 2 (a^2/3 + a^4/5 + ...), here a polynomial that leaves a relative
 * error of 2^-59.5. */
BRDF_INLINE double brdf_minus_log_remainder(double s, double remainder) {
    const uint64_t sqrt2_bits = 0x3ff6a09e667f3bcd, two_to_52_bits = 0x4330000000000000;
    uint64_t bits = brdf_bits(remainder), shift = (sqrt2_bits - bits) >> 52;
    double n = brdf_from_bits(shift | two_to_52_bits) - 0x1p52;
    double lost = (1 - remainder) - s; /* in rounding 1 - s, exactly; not 0 only for s < 1/2, where n is 0 or 1 */
    double x = (brdf_from_bits(bits + (shift << 52)) - 1) + (1 + n) * lost; /* exact: -s for n = 0 */

    double a = x / (2 + x), z = a * a, z2 = z * z;
    double low =
        (0x1.5555555555592p-1 + z * 0x1.999999997ff63p-2) + z2 * (0x1.24924941db48dp-2 + z * 0x1.c71c521a193c9p-3);
    double high = (0x1.74663ba36132dp-3 + z * 0x1.39a20ba19ba95p-3) + z2 * 0x1.2f0251a805322p-3;
    double rest = a * (x - z * (low + z2 * z2 * high));

    double sum = n * brdf_ln2_hi - x, error = (n * brdf_ln2_hi - sum) - x;
    return sum + (error + (rest + n * brdf_ln2_lo));
}

typedef struct brdf_sine_cosine {
    double sine, cosine;
} brdf_sine_cosine;

/* sin(2 pi t) and cos(2 pi t) for t in [0, 1]; exact where t is a multiple of 1/4. With k the nearest whole number to
 * 4t, what remains, d = t - k/4, is exact and at most 1/8. With z = d^2, P and R polynomials,
 *
 *     sin(2 pi d) = d (2 pi + z P(z)),      cos(2 pi d) = 1 - 2 pi^2 z + z^2 R(z)
 *
 * to relative errors of 2^-57.9 and 2^-63.9. Of either, the leading term is the exact product of d's upper bits, and
 * only a small remainder is subject to further roundings. */
BRDF_INLINE brdf_sine_cosine brdf_turn(double t) {
    const double round_to_integer = 0x1.8p52;
    double k = (4 * t + round_to_integer) - round_to_integer;
    double d = t - .25 * k, head = upper_bits(d), tail = d - head;
    double z = d * d, z2 = z * z;

    const double two_pi_hi = 0x1.921fb5p+2, two_pi_lo = 0x1.110b4611a6263p-24;
    double p =
        ((-0x1.4abbce625be46p+5 + z * 0x1.466bc67758c4cp+6) + z2 * (-0x1.32d2cce31bf06p+6 + z * 0x1.5078300347734p+5)) +
        z2 * z2 * (-0x1.e3008fadf5d1cp+3 + z * 0x1.e3fbe42b276cbp+1);
    double s = head * two_pi_hi + (d * (two_pi_lo + z * p) + tail * two_pi_hi);

    const double two_pi2_less_16 = 0x1.de9e64df22ef3p+1;
    double r =
        ((0x1.03c1f081b5abcp+6 + z * -0x1.55d3c7e3ca609p+6) + z2 * (0x1.e1f506850a7b8p+5 + z * -0x1.a6d1eda0472e3p+4)) +
        z2 * z2 * (0x1.f9cd09bc065d4p+2 + z * -0x1.b29adb807670fp+0);
    double sixteenth = 16 * (head * head), most = 1 - sixteenth; /* 16 z up to what the tail adds */
    double c = most + (((1 - most) - sixteenth) + (z2 * r - z * two_pi2_less_16 - 16 * (tail * (d + head))));

    double even = fabs(fabs(k - 2) - 1), sine = even > .5 ? s : c, cosine = even > .5 ? c : s;
    return (brdf_sine_cosine){fabs(k - 2.5) < 1 ? -sine : sine, fabs(k - 1.5) < 1 ? -cosine : cosine};
}

#endif
