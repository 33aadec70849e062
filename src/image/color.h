/* Colours of pictures in other primaries, brought to Radiance's. */
#ifndef IMAGE_COLOR_H
#define IMAGE_COLOR_H

#include <stdbool.h>
#include <stddef.h>

#include "base/vector.h"

/* Chromaticities x, y of red, green, blue and white. */
typedef struct image_primaries {
    double red[2], green[2], blue[2], white[2];
} image_primaries;

extern const image_primaries image_radiance_primaries;

typedef struct image_color_matrix {
    double m[3][3];
} image_color_matrix;

/* RGB in the given primaries to RGB in Radiance's: white becomes white (adapted as by Radiance, through the "sharp"
 * sensors). False for primaries that span no colours. */
bool image_color_from_primaries(image_color_matrix *, const image_primaries *);
/* The other way round. */
bool image_color_to_primaries(image_color_matrix *, const image_primaries *);
/* CIE XYZ, with Y in the unit of brightness, to Radiance's RGB, and back. */
image_color_matrix image_color_from_xyz(void);
image_color_matrix image_color_to_xyz(void);

/* Radiance's lm/W: luminance in cd/m^2 = 179 x brightness. */
#define IMAGE_LUMINOUS_EFFICACY 179.0

/* A pixel's value as the eye gets it: nothing of NaN and negative values, and so much of the largest ones that sums and
 * exposures of them stay in a double's range. */
static inline double image_visible(double value) {
    return value > 0 ? fmin(value, 1e30) : 0;
}
/* The brightness of what the eye gets of pixel `i` of the planes R, G, B. */
static inline double image_visible_brightness(float *const *channels, size_t i) {
    return rgb_brightness(
        (rgb){image_visible(channels[0][i]), image_visible(channels[1][i]), image_visible(channels[2][i])});
}
/* The same of either sign. */
static inline double image_bounded(double value) {
    return image_visible(value) - image_visible(-value);
}
/* The pixel's brightness, 0 at least. Negative channels count: a colour beyond the primaries has its luminance only
 * with them. */
static inline double image_brightness(float *const *channels, size_t i) {
    rgb c = {image_bounded(channels[0][i]), image_bounded(channels[1][i]), image_bounded(channels[2][i])};
    return fmax(rgb_brightness(c), 0);
}

/* 8-bit sRGB's transfer function: linear 0 .. 1 to encoded 0 .. 1, and back. */
double image_srgb_encode(double linear);
double image_srgb_decode(double encoded);

#endif
