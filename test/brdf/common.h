/* What the tests of src/brdf share: numbers drawn with a fixed seed, directions, and the chi-square distribution. */
#ifndef TEST_BRDF_COMMON_H
#define TEST_BRDF_COMMON_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "graze/brdf.h"

static const double pi = 3.14159265358979323846;

/* Many runs of the tests, or slow ones: `make mutation`, `make coverage`, `make asan`. They take fewer random numbers.
 */
static inline bool is_short_run(void) {
    return getenv("GRAZE_SHORT") != NULL || getenv("GRAZE_SANITIZED") != NULL;
}

/* splitmix64 */
static inline double draw(uint64_t *seed) {
    uint64_t z = *seed += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline double draw_between(uint64_t *seed, double low, double high) {
    return low + (high - low) * draw(seed);
}

/* 10^x with x uniform */
static inline double draw_power(uint64_t *seed, double low, double high) {
    return pow(10, draw_between(seed, log10(low), log10(high)));
}

static inline graze_vec3 direction(double cosine, double azimuth) {
    double sine = sqrt((1 - cosine) * (1 + cosine));
    return (graze_vec3){sine * cos(azimuth), sine * sin(azimuth), cosine};
}

static inline graze_vec3 from_degrees(double theta, double phi) {
    return direction(cos(theta * pi / 180), phi * pi / 180);
}

static inline double dot(graze_vec3 a, graze_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline graze_vec3 mirror_of(graze_vec3 v) {
    return (graze_vec3){-v.x, -v.y, v.z};
}

/* Q(a, x), the regularised upper incomplete gamma function. */
static inline double upper_gamma(double a, double x) {
    double front = exp(-x + a * log(x) - lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int n = 1; n < 10000 && term > 1e-16 * sum; ++n)
            sum += term *= x / (a + n);
        return 1 - front * sum;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d; /* Lentz */
    for (int n = 1; n < 10000; ++n) {
        double an = -n * (n - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        fraction *= c * d;
        if (fabs(c * d - 1) < 1e-15)
            break;
    }
    return front * fraction;
}

/* The probability that a chi-square number of so many degrees of freedom is at least x. */
static inline double chi_square_p_value(double x, int degrees) {
    return x > 0 ? upper_gamma(degrees / 2., x / 2) : 1;
}

#endif
