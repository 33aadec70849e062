/* Drawing pixels, and writing what was drawn. */
#include "image/canvas.h"

#include <stdlib.h>
#include <string.h>

#include "image/color.h"
#include "image/formats.h"

bool image_canvas_create(image_canvas *canvas, int width, int height) {
    *canvas = (image_canvas){width, height, calloc((size_t)width * (size_t)height, 3)};
    return canvas->bytes;
}

void image_canvas_free(image_canvas *canvas) {
    free(canvas->bytes);
    *canvas = (image_canvas){0, 0, NULL};
}

static unsigned char *pixel_at(const image_canvas *canvas, int x, int y) {
    return canvas->bytes + 3 * ((size_t)y * (size_t)canvas->width + (size_t)x);
}

void image_fill(image_canvas *canvas, int x, int y, int width, int height, const unsigned char color[3]) {
    for (int row = y < 0 ? 0 : y; row < y + height && row < canvas->height; row++)
        for (int column = x < 0 ? 0 : x; column < x + width && column < canvas->width; column++)
            memcpy(pixel_at(canvas, column, row), color, 3);
}

void image_blend(image_canvas *canvas, int x, int y, double cover, const unsigned char color[3]) {
    if (x < 0 || y < 0 || x >= canvas->width || y >= canvas->height)
        return;
    unsigned char *pixel = pixel_at(canvas, x, y);
    for (int c = 0; c < 3; c++)
        pixel[c] = (unsigned char)(pixel[c] + cover * (color[c] - pixel[c]) + 0.5);
}

bool image_draw_backdrop(image_canvas *canvas, int left, const image *picture, int zoom) {
    unsigned char *bytes = malloc(3 * (size_t)picture->width * (size_t)picture->height);
    if (!bytes)
        return false;
    image_expose(picture, bytes);
    int right = picture->width * zoom, bottom = picture->height * zoom;
    for (int y = 0; y < bottom && y < canvas->height; y++)
        for (int x = left < 0 ? -left : 0; x < right && left + x < canvas->width; x++) {
            size_t i = (size_t)(y / zoom) * (size_t)picture->width + (size_t)(x / zoom);
            unsigned char *pixel = pixel_at(canvas, left + x, y);
            for (size_t c = 0; c < 3; c++)
                pixel[c] = (unsigned char)(bytes[3 * i + c] * 3 / 4);
        }
    free(bytes);
    return true;
}

static image *linear_picture(const image_canvas *canvas, const image *header) {
    image *picture = image_create(canvas->width, canvas->height, 3, NULL);
    if (!picture)
        return NULL;
    size_t count = (size_t)canvas->width * (size_t)canvas->height;
    for (size_t i = 0; i < 3 * count; i++)
        picture->channels[i % 3][i / 3] = (float)image_srgb_decode(canvas->bytes[i] / 255.);
    picture->pixel_aspect = header->pixel_aspect;
    picture->command = header->command;
    picture->software = header->software;
    return picture;
}

graze_status image_canvas_write(const image_canvas *canvas, const image *header, const char *file,
                                const graze_report *report) {
    if (image_format_of(file) == IMAGE_FORMAT_OTHER)
        return image_write_bytes(header, canvas->width, canvas->height, canvas->bytes, file, report);
    image *drawing = linear_picture(canvas, header);
    if (!drawing)
        return report_out_of_memory(report);
    graze_status status = image_write(drawing, file, report);
    image_destroy(drawing);
    return status;
}

graze_status image_canvas_write_hdr(const image_canvas *canvas, const image *header, FILE *out, const char *name,
                                    const graze_report *report) {
    image *drawing = linear_picture(canvas, header);
    if (!drawing)
        return report_out_of_memory(report);
    graze_status status = image_write_hdr(drawing, out, name, report);
    image_destroy(drawing);
    return status;
}
