/* Planes of floats, and a state for each pixel. */
#include "picture/film.h"

#include <stdlib.h>

#include "base/number.h"

/* Layers come in this order; a picture has the first few of them, or all. */
static const char *const color_names[] = {"R", "G", "B", "depth.Z"};
static const char *const layer_names[] = {
    "R",        "G",        "B",        "standard_error.R", "standard_error.G", "standard_error.B", "samples.Y",
    "depth.Z",  "normal.X", "normal.Y", "normal.Z",         "albedo.R",         "albedo.G",         "albedo.B",
    "direct.R", "direct.G", "direct.B", "indirect.R",       "indirect.G",       "indirect.B",
};

static void find_three(float *planes[3], const image *picture, const char *const names[3]) {
    for (int i = 0; i < 3; i++)
        planes[i] = image_channel(picture, names[i]);
}

static void find_planes(film_planes *p, const image *picture) {
    static const char *const value[] = {"R", "G", "B"};
    static const char *const error[] = {"standard_error.R", "standard_error.G", "standard_error.B"};
    static const char *const normal[] = {"normal.X", "normal.Y", "normal.Z"};
    static const char *const albedo[] = {"albedo.R", "albedo.G", "albedo.B"};
    static const char *const direct[] = {"direct.R", "direct.G", "direct.B"};
    static const char *const indirect[] = {"indirect.R", "indirect.G", "indirect.B"};
    find_three(p->value, picture, value);
    find_three(p->error, picture, error);
    find_three(p->normal, picture, normal);
    find_three(p->albedo, picture, albedo);
    find_three(p->direct, picture, direct);
    find_three(p->indirect, picture, indirect);
    p->samples = image_channel(picture, "samples.Y");
    p->depth = image_channel(picture, "depth.Z");
}

static int channel_count(picture_content content) {
    if (content == PICTURE_LAYERS)
        return (int)(sizeof layer_names / sizeof *layer_names);
    return content == PICTURE_DEPTH ? 4 : 3;
}

double film_bytes(int width, int height, picture_content content) {
    film f;
    size_t pixel = (size_t)channel_count(content) * sizeof(float) + sizeof *f.reached + sizeof *f.states;
    return (double)pixel * width * height;
}

bool film_create(film *f, int width, int height, picture_content content) {
    *f = (film){0};
    f->image =
        image_create(width, height, channel_count(content), content == PICTURE_LAYERS ? layer_names : color_names);
    if (!f->image)
        return false;
    size_t count = (size_t)width * (size_t)height;
    f->reached = calloc(count, sizeof *f->reached);
    f->states = malloc(count * sizeof *f->states);
    if (!f->reached || !f->states) {
        film_free(f);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        atomic_init(&f->states[i], FILM_MISSING);
    find_planes(&f->planes, f->image);
    return true;
}

void film_free(film *f) {
    image_destroy(f->image);
    free(f->reached);
    free((void *)f->states);
    *f = (film){0};
}

static void store_rgb(float *const plane[3], size_t at, rgb value) {
    plane[0][at] = number_to_float(value.r);
    plane[1][at] = number_to_float(value.g);
    plane[2][at] = number_to_float(value.b);
}

/* What is left of the whole; rounding makes nothing negative of it. */
static rgb rest(rgb whole, rgb part) {
    return (rgb){fmax(whole.r - part.r, 0), fmax(whole.g - part.g, 0), fmax(whole.b - part.b, 0)};
}

void film_finish(film *f, size_t at, const film_pixel *pixel) {
    const film_planes *p = &f->planes;
    store_rgb(p->value, at, pixel->answer.value);
    f->reached[at] = number_to_float(pixel->reached);
    if (p->depth)
        p->depth[at] = number_to_float(pixel->depth);
    if (p->error[0]) {
        store_rgb(p->error, at, pixel->answer.standard_error);
        store_rgb(p->normal, at, (rgb){pixel->normal.x, pixel->normal.y, pixel->normal.z});
        store_rgb(p->albedo, at, pixel->albedo);
        rgb direct = rest(pixel->answer.value, pixel->indirect);
        store_rgb(p->direct, at, direct);
        store_rgb(p->indirect, at, rest(pixel->answer.value, direct));
        p->samples[at] = number_to_float(pixel->answer.samples);
    }
    film_state state = pixel->answer.converged ? FILM_FINISHED : FILM_UNCONVERGED;
    atomic_store_explicit(&f->states[at], (unsigned char)state, memory_order_release);
}
