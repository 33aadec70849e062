/* A picture from a file, of whatever format. */
#include "image/image.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/number.h"
#include "image/color.h"
#include "image/formats.h"
#include "image/hdr.h"
#include "image/module.h"

/* Which of the file's channels each of the picture's is. */
typedef struct channel_map {
    int count;
    int *source;        /* `count` numbers of the file's channels */
    const char **names; /* `count` names */
} channel_map;

static int find_channel(const image_oiio *module, const image_oiio_reader *reader, int channels, const char *name) {
    for (int c = 0; c < channels; c++)
        if (!strcmp(module->channel_name(reader, c), name))
            return c;
    return -1;
}

/* The file's channels for R, G and B: those of that name, or gray, or a lone channel, three times. */
static bool find_rgb(const image_oiio *module, const image_oiio_reader *reader, int channels, int rgb_source[3]) {
    rgb_source[0] = find_channel(module, reader, channels, "R");
    rgb_source[1] = find_channel(module, reader, channels, "G");
    rgb_source[2] = find_channel(module, reader, channels, "B");
    if (rgb_source[0] >= 0 && rgb_source[1] >= 0 && rgb_source[2] >= 0)
        return true;
    int gray = channels == 1 ? 0 : find_channel(module, reader, channels, "Y");
    rgb_source[0] = rgb_source[1] = rgb_source[2] = gray;
    return gray >= 0;
}

static void map_channels(channel_map *map, const image_oiio *module, const image_oiio_reader *reader, int channels,
                         const int rgb_source[3]) {
    static const char *const rgb_names[3] = {"R", "G", "B"};
    for (map->count = 0; map->count < 3; map->count++) {
        map->source[map->count] = rgb_source[map->count];
        map->names[map->count] = rgb_names[map->count];
    }
    for (int c = 0; c < channels; c++)
        if (c != rgb_source[0] && c != rgb_source[1] && c != rgb_source[2]) {
            map->source[map->count] = c;
            map->names[map->count++] = module->channel_name(reader, c);
        }
}

/* A value of R, G or B, in any case finite. */
static float radiance_of(float value, bool is_srgb) {
    double linear = is_srgb ? image_srgb_decode(value) : value;
    return isnan(linear) ? 0 : number_to_float(linear);
}

static void copy_pixels(image *picture, const int *source, const float *pixels, int channels, bool is_srgb) {
    size_t count = (size_t)picture->width * (size_t)picture->height;
    for (int c = 0; c < picture->channel_count; c++) {
        const float *from = pixels + source[c];
        float *plane = picture->channels[c];
        for (size_t i = 0; i < count; i++, from += channels)
            plane[i] = c < 3 ? radiance_of(*from, is_srgb) : *from;
    }
}

static image *make_picture(const image_oiio *module, image_oiio_reader *reader, int width, int height,
                           const channel_map *map) {
    image_oiio_header header = module->header(reader);
    image *picture = image_create(width, height, map->count, map->names);
    if (!picture || !image_keep_texts(picture, header.view, header.command, header.software)) {
        image_destroy(picture);
        return NULL;
    }
    picture->pixel_aspect = header.pixel_aspect;
    return picture;
}

static graze_status read_opened(image **result, const image_oiio *module, image_oiio_reader *reader, int width,
                                int height, int channels, const char *file, const graze_report *report) {
    int rgb_source[3];
    if (width < 1 || height < 1 || !find_rgb(module, reader, channels, rgb_source))
        return report_error(report, &(place){.file = file}, "the picture has no channels R, G and B, nor gray");
    char message[1024];
    const float *pixels = module->read(reader, message, sizeof message);
    if (!pixels)
        return report_error(report, &(place){.file = file}, "cannot read the picture: %s", message);
    /* Gray counts three times. */
    size_t room = (size_t)channels + 3;
    channel_map map = {.source = malloc(room * sizeof(int)), .names = malloc(room * sizeof(char *))};
    if (map.source && map.names) {
        map_channels(&map, module, reader, channels, rgb_source);
        *result = make_picture(module, reader, width, height, &map);
    }
    if (*result)
        copy_pixels(*result, map.source, pixels, channels, module->is_srgb(reader));
    free(map.source);
    free(map.names);
    return *result ? GRAZE_OK : report_out_of_memory(report);
}

static graze_status read_through_module(image **result, const char *file, const graze_report *report) {
    const image_oiio *module;
    graze_status status = image_module_open(&module, file, report);
    if (status != GRAZE_OK)
        return status;
    int width, height, channels;
    char message[1024];
    image_oiio_reader *reader = module->open(file, &width, &height, &channels, message, sizeof message);
    if (!reader)
        return report_error(report, &(place){.file = file}, "cannot read the picture: %s", message);
    status = read_opened(result, module, reader, width, height, channels, file, report);
    module->close(reader);
    return status;
}

static bool is_regular(FILE *in) {
    struct stat status;
    return fstat(fileno(in), &status) == 0 && S_ISREG(status.st_mode);
}

graze_status image_read(image **result, const char *file, const graze_report *report) {
    place where = {.file = file};
    *result = NULL;
    FILE *in = fopen(file, "rb");
    if (!in)
        return report_file_error(report, &where, "cannot be opened");
    int first = getc(in);
    graze_status status = GRAZE_OK;
    if (first == EOF)
        status = ferror(in) ? report_file_error(report, &where, "cannot be read")
                            : report_error(report, &where, "the file is empty");
    else if (first == '#' || image_format_of(file) == IMAGE_FORMAT_HDR) {
        ungetc(first, in);
        status = image_read_hdr(result, in, file, report);
    } else if (!is_regular(in)) {
        /* OpenImageIO would open it a second time, and wait for another writer. */
        status = report_error(report, &where, "only Radiance HDR can be read from a pipe");
    }
    fclose(in);
    if (status == GRAZE_OK && !*result)
        status = read_through_module(result, file, report);
    return status;
}
