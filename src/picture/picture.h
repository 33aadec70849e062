/* From a view to a finished picture. */
#ifndef PICTURE_PICTURE_H
#define PICTURE_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "graze/trace.h"
#include "image/image.h"
#include "rad/view.h"

/* What is computed of each pixel. */
typedef enum picture_content {
    PICTURE_COLOR,  /* R G B */
    PICTURE_DEPTH,  /* and depth.Z: distance along the ray through the pixel's centre; 1e10 where it meets nothing, 0
                       where the view has no ray */
    PICTURE_LAYERS, /* and standard_error.R .G .B; samples.Y (paths taken); normal.X .Y .Z (of the surface at that
                       distance, on the viewer's side); albedo.R .G .B (of what is seen: diffuse and specular
                       reflectance; 0 of lights and of nothing; 1 of surfaces with -i); direct.R .G .B (light that
                       comes from lights by one reflection, or none, by mirrors before that or not); indirect.R .G .B
                       (all other: the value is the sum of both) */
} picture_content;

typedef struct picture_settings {
    rad_view view;       /* prepared */
    rad_view previous;   /* the same, of the frame before: where motion comes from; used if `shutter` is not 0 */
    int width, height;   /* in pixels */
    double pixel_aspect; /* height over width of a pixel */
    double jitter;       /* -pj: the part of a pixel's width and height that its samples spread over, 0 .. 1 */
    double aperture;     /* -pd: the lens's diameter; it is focused at the view direction's length; 0: a pinhole */
    double shutter;      /* -pm: the part of the time from frame to frame that it is open for, around the frame's own */
    int spacing;        /* -ps: of the pixels that are computed first, 1 .. 16; the others follow from coarse to fine */
    bool without_cache; /* no path ends in the irradiance cache, where that would be of use */
    picture_content content;
    int threads;
} picture_settings;

/* The floor of the error, as a part of the picture's mean. */
#define PICTURE_FLOOR 0.1

/* A picture under way. Its bytes depend on neither the number of threads, nor `spacing`, nor interruptions. */
typedef struct rendering rendering;

/* A black picture, nothing of which is finished. The scene must outlive it. */
graze_status picture_begin(rendering **, const graze_scene *, const graze_trace_settings *, const picture_settings *,
                           const graze_report *);
void picture_destroy(rendering *); /* null is let pass */

/* Renders what is not finished. Each pixel is the mean radiance over its area, to the trace settings' error, where the
 * floor is the larger of theirs and PICTURE_FLOOR x the picture's mean (estimated beforehand from a sparse grid of
 * pixels). Returns when all is finished, or soon after picture_stop. */
graze_status picture_render(rendering *, const graze_report *);

/* The following may be called from any thread while picture_render runs in another. */

/* Lets picture_render end once the pixels that it is at are finished. */
void picture_stop(rendering *);

typedef struct picture_progress {
    size_t finished, total; /* pixels */
    size_t unconverged;     /* of the finished: those that reached sample_limit before the error asked for */
    uint64_t paths;         /* taken for them, since picture_begin */
    double error;           /* the mean of their standard errors, each as a part of its value or of the floor */
} picture_progress;

picture_progress picture_look(const rendering *);

/* The picture as it stands: R G B, pixels to come filled in from those around them. */
graze_status picture_preview(const rendering *, image **, const graze_report *);

/* The picture itself, which remains the rendering's; not while it is going on. */
image *picture_image(rendering *);

#endif
