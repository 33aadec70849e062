/* From a view to a finished picture. */
#ifndef PICTURE_PICTURE_H
#define PICTURE_PICTURE_H

#include <stdbool.h>

#include "graze/trace.h"
#include "image/image.h"
#include "rad/view.h"

typedef struct picture_settings {
    rad_view view;       /* prepared */
    int width, height;   /* in pixels */
    double pixel_aspect; /* height over width of a pixel */
    double jitter;       /* -pj: the part of a pixel's width and height that its samples spread over, 0 .. 1 */
    bool layers;         /* also compute the layers below */
    int threads;
    bool progress; /* draw a progress bar on a terminal */
} picture_settings;

/* The floor of the error, as a part of the picture's mean. */
#define PICTURE_FLOOR 0.1

/* Renders the picture: each pixel is the mean radiance over its area, to the trace settings' error, where the floor is
 * the larger of theirs and PICTURE_FLOOR x the picture's mean (estimated beforehand from a sparse grid of pixels).
 * Channels R G B, and with `layers` also standard_error.R .G .B, samples.Y (paths taken), depth.Z (distance along the
 * ray through the pixel's centre) and normal.X .Y .Z (of the surface there, on the viewer's side). The bytes do not
 * depend on the number of threads. *unconverged counts the pixels that reached the settings' sample_limit first. */
graze_status picture_render(image **, const graze_scene *, const graze_trace_settings *, const picture_settings *,
                            size_t *unconverged, const graze_report *);

#endif
