/* Which format a file's suffix means. */
#ifndef IMAGE_FORMATS_H
#define IMAGE_FORMATS_H

#include "image/image.h"

typedef enum image_format {
    IMAGE_FORMAT_HDR,
    IMAGE_FORMAT_EXR,
    IMAGE_FORMAT_OTHER, /* OpenImageIO's to know */
} image_format;

image_format image_format_of(const char *file);

/* Writes 3 * width * height bytes of sRGB through OpenImageIO, with the header of `picture`; the file appears whole or
 * not at all. */
graze_status image_write_bytes(const image *picture, int width, int height, const unsigned char *bytes,
                               const char *file, const graze_report *);

#endif
