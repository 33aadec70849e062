/* Pictures in memory. */
#include "image/image.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static int allocate_channels(image *picture, const char *const *names) {
    static const char *const rgb_names[3] = {"R", "G", "B"};
    size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (int c = 0; c < picture->channel_count; c++) {
        picture->channel_names[c] = strdup(c < 3 ? rgb_names[c] : names[c]);
        picture->channels[c] = calloc(pixels, sizeof(float));
        if (!picture->channel_names[c] || !picture->channels[c])
            return 0;
    }
    return 1;
}

image *image_create(int width, int height, int channel_count, const char *const *channel_names) {
    if (width < 1 || height < 1 || channel_count < 3 || (size_t)width > SIZE_MAX / sizeof(float) / (size_t)height)
        return NULL;
    image *picture = calloc(1, sizeof *picture);
    if (!picture)
        return NULL;
    picture->width = width;
    picture->height = height;
    picture->channel_count = channel_count;
    picture->pixel_aspect = 1;
    picture->pixel_scale[0] = picture->pixel_scale[1] = picture->pixel_scale[2] = 1;
    picture->channel_names = calloc((size_t)channel_count, sizeof *picture->channel_names);
    picture->channels = calloc((size_t)channel_count, sizeof *picture->channels);
    if (!picture->channel_names || !picture->channels || !allocate_channels(picture, channel_names)) {
        image_destroy(picture);
        return NULL;
    }
    return picture;
}

void image_destroy(image *picture) {
    if (!picture)
        return;
    for (int c = 0; c < picture->channel_count; c++) {
        if (picture->channel_names)
            free(picture->channel_names[c]);
        if (picture->channels)
            free(picture->channels[c]);
    }
    free(picture->channel_names);
    free(picture->channels);
    free(picture->text);
    free(picture);
}

float *image_channel(const image *picture, const char *name) {
    for (int c = 0; c < picture->channel_count; c++)
        if (!strcmp(picture->channel_names[c], name))
            return picture->channels[c];
    return NULL;
}

int image_keep_texts(image *picture, const char *view, const char *command, const char *software) {
    const char *texts[3] = {view, command, software};
    const char **targets[3] = {&picture->view, &picture->command, &picture->software};
    size_t size = 1;
    for (int i = 0; i < 3; i++)
        size += texts[i] ? strlen(texts[i]) + 1 : 0;
    char *text = malloc(size);
    if (!text)
        return 0;
    char *next = text;
    for (int i = 0; i < 3; i++) {
        size_t length = texts[i] ? strlen(texts[i]) + 1 : 0;
        *targets[i] = texts[i] ? memcpy(next, texts[i], length) : NULL;
        next += length;
    }
    free(picture->text);
    picture->text = text;
    return 1;
}
