/* Radiance's pixels. */
#include "image/rgbe.h"

#include <math.h>
#include <string.h>

enum { EXPONENT_BIAS = 128, MANTISSA_BITS = 8 };

/* The supremum of what is encodable is 2^127; the comparison is false for NaN. */
static double encodable(float value) {
    static const double largest = 255.5 / 256 * 0x1p127;
    return value > 0 ? fmin(value, largest) : 0;
}

void image_rgbe_encode(const float rgb[3], unsigned char rgbe[4]) {
    double v[3] = {encodable(rgb[0]), encodable(rgb[1]), encodable(rgb[2])};
    double largest = fmax(v[0], fmax(v[1], v[2]));
    if (largest <= 1e-32) {
        memset(rgbe, 0, 4);
        return;
    }
    int exponent;
    frexp(largest, &exponent);
    double scale = ldexp(1, MANTISSA_BITS - exponent);
    for (int c = 0; c < 3; c++)
        rgbe[c] = (unsigned char)(v[c] * scale);
    rgbe[3] = (unsigned char)(exponent + EXPONENT_BIAS);
}

void image_rgbe_decode(const unsigned char rgbe[4], double rgb[3]) {
    double scale = rgbe[3] ? ldexp(1, rgbe[3] - EXPONENT_BIAS - MANTISSA_BITS) : 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = (rgbe[c] + 0.5) * scale;
}
