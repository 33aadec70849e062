/* Radiance HDR, out: text header, resolution, scanlines run-length encoded plane by plane. */
#include "image/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "image/rgbe.h"

/* Scanlines of these lengths are encoded, others are flat, as Radiance writes them. */
enum { SHORTEST_ENCODED = 17, LONGEST_ENCODED = 32767 };
enum { SHORTEST_RUN = 4, LONGEST_RUN = 127, LONGEST_LITERAL = 128 };

/* One header line, nothing in which can end it early. */
static void write_line(FILE *out, const char *name, const char *text) {
    fputs(name, out);
    for (const char *c = text; *c; c++)
        putc((unsigned char)*c < 0x20 || *c == 0x7f ? ' ' : *c, out);
    putc('\n', out);
}

static const char *skip_blanks(const char *text) {
    return text + strspn(text, " \t");
}

static void write_primaries(const double primaries[8], FILE *out) {
    fputs("PRIMARIES=", out);
    for (int i = 0; i < 8; i++) {
        char number[NUMBER_TEXT_SIZE];
        number_print(number, 6, primaries[i]);
        fprintf(out, " %s", number);
    }
    putc('\n', out);
}

static void write_header(const image *picture, FILE *out) {
    fputs("#?RADIANCE\n", out);
    if (picture->command && *skip_blanks(picture->command))
        write_line(out, "", skip_blanks(picture->command));
    if (picture->software)
        write_line(out, "SOFTWARE= ", skip_blanks(picture->software));
    if (picture->frame > 0)
        fprintf(out, "FRAME=%d\n", picture->frame);
    if (picture->view)
        write_line(out, "VIEW= ", skip_blanks(picture->view));
    if (picture->pixel_aspect < 0.995 || picture->pixel_aspect > 1.005) {
        char number[NUMBER_TEXT_SIZE];
        number_print(number, 6, picture->pixel_aspect);
        write_line(out, "PIXASPECT= ", number);
    }
    if (picture->primaries && !picture->xyz)
        write_primaries(picture->primaries, out);
    fprintf(out, "FORMAT=32-bit_rle_%s\n\n", picture->xyz ? "xyze" : "rgbe");
    fprintf(out, "-Y %8d +X %8d\n", picture->height, picture->width);
}

/* How many of the bytes from `first` on are alike, at most LONGEST_RUN. Bytes of one plane lie four apart. */
static int run_length(const unsigned char *plane, int first, int width) {
    int length = 1;
    while (length < LONGEST_RUN && first + length < width && plane[4 * (first + length)] == plane[4 * first])
        length++;
    return length;
}

static size_t encode_plane(const unsigned char *plane, int width, unsigned char *out) {
    size_t size = 0;
    for (int x = 0; x < width;) {
        int run = run_length(plane, x, width);
        if (run >= SHORTEST_RUN) {
            out[size++] = (unsigned char)(128 + run);
            out[size++] = plane[4 * x];
            x += run;
            continue;
        }
        int end = x;
        do
            end += run;
        while (end < width && end - x < LONGEST_LITERAL && (run = run_length(plane, end, width)) < SHORTEST_RUN);
        if (end - x > LONGEST_LITERAL)
            end = x + LONGEST_LITERAL;
        out[size++] = (unsigned char)(end - x);
        for (; x < end; x++)
            out[size++] = plane[4 * x];
    }
    return size;
}

static size_t encode_scanline(const unsigned char *rgbe, int width, unsigned char *out) {
    if (width < SHORTEST_ENCODED || width > LONGEST_ENCODED) {
        memcpy(out, rgbe, 4 * (size_t)width);
        return 4 * (size_t)width;
    }
    size_t size = 0;
    out[size++] = 2;
    out[size++] = 2;
    out[size++] = (unsigned char)(width >> 8);
    out[size++] = (unsigned char)(width & 255);
    for (int plane = 0; plane < 4; plane++)
        size += encode_plane(rgbe + plane, width, out + size);
    return size;
}

static void write_scanlines(const image *picture, FILE *out, unsigned char *rgbe, unsigned char *encoded) {
    for (int y = 0; y < picture->height && !ferror(out); y++) {
        for (int x = 0; x < picture->width; x++) {
            size_t i = (size_t)y * (size_t)picture->width + (size_t)x;
            float color[3] = {picture->channels[0][i], picture->channels[1][i], picture->channels[2][i]};
            image_rgbe_encode(color, rgbe + 4 * (size_t)x);
        }
        size_t size = encode_scanline(rgbe, picture->width, encoded);
        fwrite(encoded, 1, size, out);
    }
}

graze_status image_write_hdr(const image *picture, FILE *out, const char *name, const graze_report *report) {
    size_t width = (size_t)picture->width;
    unsigned char *rgbe = malloc(4 * width);
    unsigned char *encoded = malloc(4 * (width + width / LONGEST_LITERAL + 2));
    graze_status status = GRAZE_OK;
    if (!rgbe || !encoded) {
        status = report_out_of_memory(report);
    } else {
        errno = 0;
        write_header(picture, out);
        write_scanlines(picture, out, rgbe, encoded);
        if (ferror(out) || fflush(out) != 0)
            status = report_system_error(report, &(place){.file = name}, "cannot write the picture");
    }
    free(rgbe);
    free(encoded);
    return status;
}
