/* Radiance HDR, in: scanlines flat, in the old run-length encoding or in the new one, in any of the eight orientations.
 */
#include "image/hdr.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "image/rgbe.h"

int image_source_byte(image_source *source) {
    if (source->next == source->count) {
        source->next = 0;
        source->count = fread(source->buffer, 1, sizeof source->buffer, source->in);
        if (source->count == 0)
            return EOF;
    }
    source->offset++;
    return source->buffer[source->next++];
}

/* Pixels in the file's order. Memory grows with what the file delivers, not with what its header promises. */
typedef struct pixel_store {
    unsigned char *rgbe;
    size_t count, capacity, total; /* in pixels; `total` is what there will be */
    image_source *source;
    int scanline;          /* from 1 */
    size_t scanline_begin; /* its first pixel */
    size_t scanline_length;
} pixel_store;

static graze_status pixel_error(const pixel_store *store, const char *text) {
    const image_source *source = store->source;
    place where = {.file = source->name};
    if (ferror(source->in))
        return report_system_error(source->report, &where, "scanline %d: cannot read", store->scanline);
    return report_error(source->report, &where, "scanline %d, byte %" PRIu64 ": %s", store->scanline, source->offset,
                        text);
}

static graze_status cut_short(const pixel_store *store) {
    return pixel_error(store, "the file ends before the picture does");
}

/* Room for `more` pixels behind those there are. */
static graze_status reserve(pixel_store *store, size_t more) {
    size_t needed = store->count + more;
    if (needed <= store->capacity)
        return GRAZE_OK;
    size_t capacity = 2 * store->capacity > needed ? 2 * store->capacity : needed;
    if (capacity > store->total)
        capacity = store->total;
    unsigned char *rgbe = capacity <= SIZE_MAX / 4 ? realloc(store->rgbe, 4 * capacity) : NULL;
    if (!rgbe)
        return report_out_of_memory(store->source->report);
    store->rgbe = rgbe;
    store->capacity = capacity;
    return GRAZE_OK;
}

static size_t missing(const pixel_store *store) {
    return store->scanline_begin + store->scanline_length - store->count;
}

static bool read_pixel(image_source *source, unsigned char pixel[4]) {
    for (int i = 0; i < 4; i++) {
        int byte = image_source_byte(source);
        if (byte == EOF)
            return false;
        pixel[i] = (unsigned char)byte;
    }
    return true;
}

static graze_status append_pixels(pixel_store *store, const unsigned char pixel[4], size_t count) {
    graze_status status = reserve(store, count);
    if (status != GRAZE_OK)
        return status;
    for (; count > 0; count--)
        memcpy(store->rgbe + 4 * store->count++, pixel, 4);
    return GRAZE_OK;
}

/* The old encoding, of which flat pixels are the special case without runs: 1 1 1 n repeats the pixel before n times;
 * one directly behind another counts in units 256 times as large. `pixel` is the scanline's first. */
static graze_status read_old_scanline(pixel_store *store, unsigned char pixel[4]) {
    graze_status status = append_pixels(store, pixel, 1);
    int shift = 0;
    while (status == GRAZE_OK && missing(store) > 0) {
        unsigned char next[4];
        if (!read_pixel(store->source, next))
            return cut_short(store);
        if (next[0] != 1 || next[1] != 1 || next[2] != 1) {
            memcpy(pixel, next, 4);
            status = append_pixels(store, pixel, 1);
            shift = 0;
            continue;
        }
        if (shift > 24 || (uint64_t)next[3] << shift > missing(store))
            return pixel_error(store, "a run goes beyond the end of the scanline");
        status = append_pixels(store, pixel, (size_t)next[3] << shift);
        shift += 8;
    }
    return status;
}

/* One of the four planes of a scanline in the new encoding. */
static graze_status read_new_plane(pixel_store *store, unsigned char *plane) {
    size_t x = 0;
    while (x < store->scanline_length) {
        int code = image_source_byte(store->source);
        if (code == EOF)
            return cut_short(store);
        bool is_run = code > 128;
        size_t length = (size_t)(is_run ? code - 128 : code);
        if (length == 0)
            return pixel_error(store, "a run of no length");
        if (length > store->scanline_length - x)
            return pixel_error(store, "a run goes beyond the end of the scanline");
        int byte = 0;
        for (size_t i = 0; i < length; i++) {
            if ((!is_run || i == 0) && (byte = image_source_byte(store->source)) == EOF)
                return cut_short(store);
            plane[4 * x++] = (unsigned char)byte;
        }
    }
    return GRAZE_OK;
}

static graze_status read_new_scanline(pixel_store *store) {
    graze_status status = reserve(store, store->scanline_length);
    for (int plane = 0; plane < 4 && status == GRAZE_OK; plane++)
        status = read_new_plane(store, store->rgbe + 4 * store->count + plane);
    store->count += store->scanline_length;
    return status;
}

static graze_status read_scanline(pixel_store *store) {
    unsigned char first[4];
    if (!read_pixel(store->source, first))
        return cut_short(store);
    /* A pixel proper has a component of 128 or more, so 2 2 and a small byte cannot begin one. */
    if (first[0] != 2 || first[1] != 2 || first[2] >= 128)
        return read_old_scanline(store, first);
    if ((size_t)(first[2] << 8 | first[3]) != store->scanline_length)
        return pixel_error(store, "the scanline's length is not the picture's");
    return read_new_scanline(store);
}

static graze_status read_scanlines(pixel_store *store, const image_hdr_header *header) {
    int scanlines = header->columns ? header->width : header->height;
    store->scanline_length = (size_t)(header->columns ? header->height : header->width);
    store->total = store->scanline_length * (size_t)scanlines;
    for (store->scanline = 1; store->scanline <= scanlines; store->scanline++) {
        store->scanline_begin = store->count;
        graze_status status = read_scanline(store);
        if (status != GRAZE_OK)
            return status;
    }
    return GRAZE_OK;
}

/* What a pixel's components are multiplied by to get radiance in Radiance's primaries. */
static bool color_transform(const image_hdr_header *header, image_color_matrix *matrix) {
    *matrix = (image_color_matrix){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (header->xyz)
        *matrix = image_color_from_xyz();
    else if (header->has_primaries && !image_color_from_primaries(matrix, &header->primaries))
        return false;
    /* XYZE pictures hold luminance in cd/m^2. */
    double unit = header->xyz ? 1 / IMAGE_LUMINOUS_EFFICACY : 1;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            matrix->m[i][j] *= unit / (header->exposure * header->correction[j]);
    return true;
}

/* The place in memory of the file's n-th pixel. */
static size_t pixel_index(const image_hdr_header *header, size_t n) {
    size_t width = (size_t)header->width, height = (size_t)header->height;
    size_t x = header->columns ? n / height : n % width;
    size_t y = header->columns ? n % height : n / width;
    if (header->right_to_left)
        x = width - 1 - x;
    if (header->bottom_to_top)
        y = height - 1 - y;
    return y * width + x;
}

static void decode_pixels(image *picture, const image_hdr_header *header, const image_color_matrix *matrix,
                          const unsigned char *rgbe) {
    size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t n = 0; n < count; n++) {
        double v[3];
        image_rgbe_decode(rgbe + 4 * n, v);
        size_t i = pixel_index(header, n);
        for (int c = 0; c < 3; c++) {
            double value = matrix->m[c][0] * v[0] + matrix->m[c][1] * v[1] + matrix->m[c][2] * v[2];
            picture->channels[c][i] = number_to_float(value);
        }
    }
}

static graze_status finish(image **result, const image_hdr_header *header, const pixel_store *store) {
    const image_source *source = store->source;
    image_color_matrix matrix;
    if (!color_transform(header, &matrix))
        return report_error(source->report, &(place){.file = source->name}, "its PRIMARIES span no colours");
    image *picture = image_create(header->width, header->height, 3, NULL);
    if (!picture || !image_keep_texts(picture, header->view, header->command, header->software)) {
        image_destroy(picture);
        return report_out_of_memory(source->report);
    }
    picture->pixel_aspect = header->pixel_aspect;
    for (int c = 0; c < 3; c++)
        picture->pixel_scale[c] = header->exposure * header->correction[c];
    decode_pixels(picture, header, &matrix, store->rgbe);
    *result = picture;
    return GRAZE_OK;
}

graze_status image_read_hdr(image **result, FILE *in, const char *name, const graze_report *report) {
    *result = NULL;
    image_source *source = malloc(sizeof *source);
    if (!source)
        return report_out_of_memory(report);
    source->in = in;
    source->name = name;
    source->report = report;
    source->offset = 0;
    source->next = source->count = 0;
    image_hdr_header header;
    pixel_store store = {.source = source};
    graze_status status = image_hdr_read_header(&header, source);
    if (status == GRAZE_OK)
        status = read_scanlines(&store, &header);
    if (status == GRAZE_OK)
        status = finish(result, &header, &store);
    image_hdr_header_free(&header);
    free(store.rgbe);
    free(source);
    return status;
}
