/* Colours of pictures in other primaries, brought to Radiance's. */
#ifndef IMAGE_COLOR_H
#define IMAGE_COLOR_H

#include <stdbool.h>

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
/* CIE XYZ, with Y in the unit of brightness, to Radiance's RGB. */
image_color_matrix image_color_from_xyz(void);

/* 8-bit sRGB's transfer function: linear 0 .. 1 to encoded 0 .. 1, and back. */
double image_srgb_encode(double linear);
double image_srgb_decode(double encoded);

#endif
