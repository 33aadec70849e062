/* OpenEXR, out. */
#ifndef IMAGE_EXR_H
#define IMAGE_EXR_H

#include "image/image.h"

/* All channels as 32-bit floats, bit by bit, compressed without loss. `name` stands in messages for `path`. */
graze_status image_write_exr(const image *, const char *path, const char *name, const graze_report *);

#endif
