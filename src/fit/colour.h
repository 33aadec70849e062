/* Channels as colours. */
#ifndef FIT_COLOUR_H
#define FIT_COLOUR_H

#include "fit/measurements.h"
#include "graze/vector.h"

typedef enum fit_colour_kind {
    FIT_COLOUR_GREY,     /* the channels' mean */
    FIT_COLOUR_RGB,      /* three channels whose names end in R G B, or are red green blue */
    FIT_COLOUR_XYZ,      /* three channels whose names end in X Y Z */
    FIT_COLOUR_SPECTRUM, /* wavelengths, rising, three or more of them between 380 and 780 nm */
} fit_colour_kind;

fit_colour_kind fit_colour_kind_of(const fit_channel_name *channels, size_t count);

/* The colour, for Radiance's primaries and equal-energy white, of a reflectance that is value(user, k) in channel k;
 * never negative. */
graze_rgb fit_colour(fit_colour_kind, const fit_channel_name *channels, size_t count,
                     double (*value)(const void *user, size_t channel), const void *user);

const char *fit_colour_text(fit_colour_kind);

#endif
