/* One picture in memory, many formats on disk. */
#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/report.h"
#include "base/vector.h"

/* Named planes of floats, rows from top to bottom. The first three are always R, G, B: radiance in W/sr/m^2 in
 * Radiance's primaries. Others are layers with EXR's names: "standard_error.R", "depth.Z", "normal.X". */
typedef struct image {
    int width, height;
    int channel_count;
    char **channel_names;
    float **channels;        /* channel_count planes of width * height */
    double pixel_aspect;     /* height over width of a pixel, 1 for square */
    double pixel_scale[3];   /* what R, G, B were in the file read for each 1 here: Radiance HDR's EXPOSURE and
                                COLORCORR; else 1 */
    const char *view;        /* as behind `VIEW=`, or null */
    const char *command;     /* the command line that made it, or null */
    const char *software;    /* "Graze 0.1.0", or null */
    bool xyz;                /* for image_write_hdr: R, G, B are CIE's X, Y, Z, with Y in cd/m^2 */
    const double *primaries; /* for image_write_hdr: x and y of R, G, B and white; null: Radiance's */
    int frame;               /* its number in a sequence, 0 where it is in none */
    double display_exposure; /* factor that image_expose applies; 0: chosen by the picture */
    char *text;              /* what view, command and software of a picture read lie in; null for ours */
} image;

/* All planes zero, view, command and software null. The first three names are R, G, B whatever is given:
 * `channel_names` may be null for three channels. Null when out of memory, or for a size below 1 x 1. */
image *image_create(int width, int height, int channel_count, const char *const *channel_names);
void image_destroy(image *); /* null is let pass */
/* Gives the picture copies of these texts, each of which may be null. 0 when out of memory. */
int image_keep_texts(image *, const char *view, const char *command, const char *software);
/* The plane of that name, or null. */
float *image_channel(const image *, const char *name);

/* Writes Radiance HDR (32-bit_rle_rgbe) with its header to the stream; `name` stands in messages. NaN and negative
 * values become 0, what is too large becomes the largest value the format holds. */
graze_status image_write_hdr(const image *, FILE *, const char *name, const graze_report *);
/* Writes the file in the format of its suffix: .hdr and .pic as above; .exr with all layers, float, Radiance's
 * primaries as chromaticities, whiteLuminance 179, exposure 1 (values are radiance), view, command, software and frame
 * as attributes; all others 8 bits a
 * channel through OpenImageIO, exposed as image_expose does. The file appears whole or not at all (written under
 * another name, then renamed); a failing write is a system error and leaves nothing behind. What is no regular file (a
 * pipe, /dev/stdout, /dev/null) is written to directly; without a suffix it gets Radiance HDR. */
graze_status image_write(const image *, const char *file, const graze_report *);
/* Whether image_write will know the format of the file's suffix and may write there, checked before a long rendering: a
 * file that is there must be one that the user may write. */
graze_status image_check_writable(const char *file, const graze_report *);
/* Whether that format has room for so large a picture: an input error if not, which image_write gives as well. */
graze_status image_check_size(const char *file, int width, int height, const graze_report *);
/* Reads HDR itself, in any orientation and also from a pipe, XYZE and foreign primaries converted to Radiance's;
 * everything else through OpenImageIO: channels as named in the file (one channel: gray to R, G, B), values of pictures
 * that are sRGB made linear; what is not finite in R, G, B becomes 0 (NaN) or the largest float. Colours beyond
 * Radiance's primaries have negative channels, so that the others still add up to their luminance; image_expose and
 * image_write_hdr take them for 0. */
graze_status image_read(image **, const char *file, const graze_report *);

/* 8-bit sRGB for people: linear values times `display_exposure` or, where that is 0, an exposure that puts the
 * picture's log-average brightness at 0.18, what is brighter than half of white compressed by the logarithm, up to the
 * picture's brightest, negative values like 0; 3 * width * height bytes. */
void image_expose(const image *, unsigned char *bytes);

/* Draws lines of equal luminance (cd/m^2 = 179 x brightness) over the exposed picture: `per_decade` levels a factor of
 * ten (the paper's Figures 2 and 8), each level in a colour of its own; a legend of the levels at the left. Levels run
 * over the picture's own range, at most four decades down from its maximum. */
graze_status image_write_contours(const image *, const char *file, int per_decade, const graze_report *);

#endif
