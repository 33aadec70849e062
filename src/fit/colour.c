/* Spectra, XYZ and RGB reflectances become Radiance's RGB. */
#include "fit/colour.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool names_end_in(const fit_channel_name *channels, const char letters[4]) {
    for (size_t k = 0; k < 3; k++) {
        const char *name = channels[k].text;
        size_t length = strlen(name);
        if (length == 0 || lower(name[length - 1]) != letters[k])
            return false;
    }
    return true;
}

static bool names_are_colours(const fit_channel_name *channels) {
    return strcmp(channels[0].text, "red") == 0 && strcmp(channels[1].text, "green") == 0 &&
           strcmp(channels[2].text, "blue") == 0;
}

static bool is_spectrum(const fit_channel_name *channels, size_t count) {
    size_t visible = 0;
    for (size_t k = 0; k < count; k++) {
        if (!(channels[k].wavelength > (k ? channels[k - 1].wavelength : 0)))
            return false;
        visible += channels[k].wavelength >= 380 && channels[k].wavelength <= 780;
    }
    return visible >= 3;
}

fit_colour_kind fit_colour_kind_of(const fit_channel_name *channels, size_t count) {
    if (is_spectrum(channels, count))
        return FIT_COLOUR_SPECTRUM;
    if (count != 3)
        return FIT_COLOUR_GREY;
    if (names_are_colours(channels) || names_end_in(channels, "rgb"))
        return FIT_COLOUR_RGB;
    return names_end_in(channels, "xyz") ? FIT_COLOUR_XYZ : FIT_COLOUR_GREY;
}

/* From the primaries (.640 .330) (.290 .600) (.150 .060) and the white (1/3 1/3). */
static rgb from_xyz(const double xyz[3]) {
    return (rgb){2.5653128430 * xyz[0] - 1.1668496158 * xyz[1] - .3984632272 * xyz[2],
                 -1.0221081721 * xyz[0] + 1.9782866167 * xyz[1] + .0438215555 * xyz[2],
                 .0747243773 * xyz[0] - .2519395672 * xyz[1] + 1.1772151899 * xyz[2]};
}

/* A bell with a width on either side, given by its inverse. */
static double bell(double wavelength, double middle, double left, double right) {
    double t = (wavelength - middle) * (wavelength < middle ? left : right);
    return exp(-.5 * t * t);
}

/* CIE 1931 colour matching functions, as sums of bells: C. Wyman, P.-P. Sloan, P. Shirley, "Simple Analytic
 * Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013. */
static void matching_functions(double w, double xyz[3]) {
    xyz[0] =
        .362 * bell(w, 442, .0624, .0374) + 1.056 * bell(w, 599.8, .0264, .0323) - .065 * bell(w, 501.1, .0490, .0382);
    xyz[1] = .821 * bell(w, 568.8, .0213, .0247) + .286 * bell(w, 530.9, .0613, .0322);
    xyz[2] = 1.217 * bell(w, 437, .0845, .0278) + .681 * bell(w, 459, .0385, .0725);
}

/* Equal energy at all wavelengths: a reflectance of 1 is white, and X = Y = Z = 1. */
static rgb from_spectrum(const fit_channel_name *channels, size_t count, double (*value)(const void *, size_t),
                         const void *user) {
    double sums[3] = {0}, whites[3] = {0};
    for (size_t k = 0; k < count; k++) {
        double low = channels[k ? k - 1 : k].wavelength, high = channels[k + 1 < count ? k + 1 : k].wavelength, xyz[3];
        matching_functions(channels[k].wavelength, xyz);
        for (int c = 0; c < 3; c++) {
            sums[c] += value(user, k) * xyz[c] * (high - low);
            whites[c] += xyz[c] * (high - low);
        }
    }
    for (int c = 0; c < 3; c++)
        sums[c] /= whites[c];
    return from_xyz(sums);
}

graze_rgb fit_colour(fit_colour_kind kind, const fit_channel_name *channels, size_t count,
                     double (*value)(const void *, size_t), const void *user) {
    rgb colour = {0, 0, 0};
    switch (kind) {
    case FIT_COLOUR_RGB:
        colour = (rgb){value(user, 0), value(user, 1), value(user, 2)};
        break;
    case FIT_COLOUR_XYZ:
        colour = from_xyz((const double[]){value(user, 0), value(user, 1), value(user, 2)});
        break;
    case FIT_COLOUR_SPECTRUM:
        colour = from_spectrum(channels, count, value, user);
        break;
    case FIT_COLOUR_GREY:
        for (size_t k = 0; k < count; k++)
            colour = rgb_add(colour, rgb_gray(value(user, k) / (double)count));
        break;
    }
    return (rgb){fmax(colour.r, 0), fmax(colour.g, 0), fmax(colour.b, 0)};
}

const char *fit_colour_text(fit_colour_kind kind) {
    static const char *const texts[] = {"grey: the mean of the channels", "RGB", "XYZ, as Radiance's RGB",
                                        "the spectrum, under light of equal energy, as Radiance's RGB"};
    return texts[kind];
}
