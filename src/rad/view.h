/* Radiance's views: `-vtv -vp 0 0 0 -vd 0 1 0 ...`, from options, view files and picture headers, to rays. */
#ifndef RAD_VIEW_H
#define RAD_VIEW_H

#include <stdbool.h>
#include <stddef.h>

#include "base/report.h"
#include "base/vector.h"

typedef struct rad_view {
    char type; /* v perspective, l parallel, c cylindrical, h hemispherical, a angular fisheye, s planisphere */
    vec3 point, direction, up;
    double horizontal, vertical; /* -vh -vv: degrees; for type l: lengths */
    double shift, lift;          /* -vs -vl: in units of the picture's size */
    double fore, aft;            /* clipping distances; aft 0: none */
    /* Filled by rad_view_prepare: */
    vec3 axis;                           /* unit viewing direction */
    vec3 right, above;                   /* of the picture, scaled for the view's type */
    double right_squared, above_squared; /* extents squared, for the aspect */
} rad_view;

rad_view rad_view_default(void);

/* Takes the view option at words[0] (-vt? -vp -vd -vu -vh -vv -vs -vl -vo -va, not -vf), puts into *used the number of
 * words, or 0 where words[0] is no view option. */
graze_status rad_view_option(rad_view *, int count, const char *const *words, int *used, const place *where,
                             const graze_report *);
/* Takes the view options of a line as stands in view files and picture headers: one that begins with VIEW= or the name
 * of a program that takes views. *found: whether it is one and has any. An error, which leaves the view as it was, are
 * view options with wrong words, and behind VIEW= other words and no words at all. */
graze_status rad_view_take_line(rad_view *, const char *line, bool *found, const place *where, const graze_report *);
/* -vf: the last view found in a view file or picture header. What is wrong there is passed over, as in Radiance, unless
 * nothing else is found. */
graze_status rad_view_read(rad_view *, const char *file, const graze_report *);
/* Checks the parameters and computes what rays need. Must come before the functions below. */
graze_status rad_view_prepare(rad_view *, const place *where, const graze_report *);
/* Height over width of a picture with square pixels. */
double rad_view_aspect(const rad_view *);
/* The ray through (x, y) in [0,1]^2, from the lower left. Gives the largest distance (aft - fore, or 0: none) in
 * *limit. False: this point of the picture shows nothing (the corners of a fisheye). */
bool rad_view_ray(const rad_view *, double x, double y, vec3 *origin, vec3 *direction, double *limit);
/* The whole view as options, with Radiance's digits, as stands behind `VIEW=` (with a leading blank). */
void rad_view_print(const rad_view *, char *buffer, size_t size);
/* Fits the largest picture of the view's aspect into *width x *height for pixels `pixel_aspect` (height over width; 0:
 * keep the size and put the resulting aspect there), as rpict's -x -y -pa do, but never without a pixel. */
void rad_view_fit(const rad_view *, double *pixel_aspect, int *width, int *height);

#endif
