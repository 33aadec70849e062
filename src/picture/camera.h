/* Where the rays of a pixel begin and go: the view, the lens, the shutter. */
#ifndef PICTURE_CAMERA_H
#define PICTURE_CAMERA_H

#include "picture/picture.h"

/* A moment and a place that a ray is taken at. */
typedef struct camera_sample {
    double x, y;    /* in the pixel, from its lower left corner, 0 .. 1 */
    double lens[2]; /* uniform numbers in [0,1) for a point of the lens */
    double time;    /* from the middle of the exposure, -0.5 .. 0.5 */
} camera_sample;

/* The pixel's centre through the middle of the lens, at the middle of the exposure. */
extern const camera_sample camera_center;

/* The ray of the pixel. False where the view has none. */
bool camera_ray(const picture_settings *, int column, int row, const camera_sample *, graze_ray *);

#endif
