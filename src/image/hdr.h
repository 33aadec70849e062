/* Radiance HDR, in: what its reader's parts share. */
#ifndef IMAGE_HDR_H
#define IMAGE_HDR_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/report.h"
#include "image/color.h"
#include "image/image.h"

/* A stream of bytes that knows where it is. */
typedef struct image_source {
    FILE *in;
    const char *name; /* for messages */
    const graze_report *report;
    uint64_t offset; /* of the next byte */
    size_t next, count;
    unsigned char buffer[65536];
} image_source;

/* The next byte, or EOF at the end or a failing read. */
int image_source_byte(image_source *);

typedef struct image_hdr_header {
    bool xyz;           /* FORMAT=32-bit_rle_xyze */
    bool has_primaries; /* PRIMARIES= was there */
    image_primaries primaries;
    double exposure;          /* product of all EXPOSURE= */
    double correction[3];     /* product of all COLORCORR= */
    double pixel_aspect;      /* product of all PIXASPECT= */
    char *view;               /* all VIEW= in a row, or null */
    char *command, *software; /* the last of each, or null */
    /* The resolution line: scanlines run along the fast axis. */
    int width, height;
    bool columns; /* scanlines are columns */
    bool right_to_left, bottom_to_top;
} image_hdr_header;

/* Reads up to and with the resolution line. In any case, release the header with image_hdr_header_free. */
graze_status image_hdr_read_header(image_hdr_header *, image_source *);
void image_hdr_header_free(image_hdr_header *);

/* Reads a picture that begins with "#?". */
graze_status image_read_hdr(image **, FILE *in, const char *name, const graze_report *);

#endif
