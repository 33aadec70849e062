/* A picture half done, for people: what is missing is filled in. */
#include <stdlib.h>

#include "base/number.h"
#include "picture/film.h"
#include "picture/state.h"

/* The sums over squares of 2^level pixels a side, and of how many pixels these sums are. */
typedef struct level {
    int width, height;
    float *sums[3], *counts;
} level;

/* 2^20 pixels a side is the most. */
enum { LEVELS_MOST = 24 };

typedef struct pyramid {
    level levels[LEVELS_MOST];
    int count;
} pyramid;

static void pyramid_free(pyramid *p) {
    for (int k = 0; k < p->count; k++)
        free(p->levels[k].counts);
}

static bool add_level(pyramid *p, int width, int height) {
    size_t count = (size_t)width * (size_t)height;
    float *memory = calloc(4 * count, sizeof *memory);
    if (!memory)
        return false;
    p->levels[p->count++] = (level){width, height, {memory + count, memory + 2 * count, memory + 3 * count}, memory};
    return true;
}

static void fill_first(level *l, const film *f) {
    size_t count = (size_t)l->width * (size_t)l->height;
    for (size_t i = 0; i < count; i++) {
        if (film_state_of(f, i) == FILM_MISSING)
            continue;
        l->counts[i] = 1;
        for (int c = 0; c < 3; c++)
            l->sums[c][i] = f->planes.value[c][i];
    }
}

static void add_up(level *coarse, const level *fine) {
    for (int y = 0; y < fine->height; y++)
        for (int x = 0; x < fine->width; x++) {
            size_t from = (size_t)y * (size_t)fine->width + (size_t)x;
            size_t to = (size_t)(y / 2) * (size_t)coarse->width + (size_t)(x / 2);
            coarse->counts[to] += fine->counts[from];
            for (int c = 0; c < 3; c++)
                coarse->sums[c][to] += fine->sums[c][from];
        }
}

static bool build(pyramid *p, const film *f) {
    p->count = 0;
    if (!add_level(p, f->image->width, f->image->height))
        return false;
    fill_first(&p->levels[0], f);
    while (p->levels[p->count - 1].width > 1 || p->levels[p->count - 1].height > 1) {
        const level *fine = &p->levels[p->count - 1];
        if (!add_level(p, (fine->width + 1) / 2, (fine->height + 1) / 2))
            return false;
        add_up(&p->levels[p->count - 1], fine);
    }
    return true;
}

/* A pixel is the mean of what is finished in the smallest of the squares around it that have anything. */
static void fill(image *out, const pyramid *p) {
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            size_t at = (size_t)y * (size_t)out->width + (size_t)x;
            for (int k = 0; k < p->count; k++) {
                const level *l = &p->levels[k];
                size_t i = (size_t)(y >> k) * (size_t)l->width + (size_t)(x >> k);
                if (l->counts[i] == 0)
                    continue;
                for (int c = 0; c < 3; c++)
                    out->channels[c][at] = number_to_float((double)l->sums[c][i] / (double)l->counts[i]);
                break;
            }
        }
}

graze_status picture_preview(const rendering *p, image **out, const graze_report *report) {
    pyramid squares;
    const image *from = p->film.image;
    *out = image_create(from->width, from->height, 3, NULL);
    bool good = build(&squares, &p->film);
    if (good && *out) {
        (*out)->pixel_aspect = from->pixel_aspect;
        fill(*out, &squares);
    }
    pyramid_free(&squares);
    if (good && *out)
        return GRAZE_OK;
    image_destroy(*out);
    *out = NULL;
    return report_out_of_memory(report);
}
