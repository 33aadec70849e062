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
    float *memory; /* of all */
} pyramid;

static size_t level_size(const level *l) {
    return (size_t)l->width * (size_t)l->height;
}

/* All zero. False when out of memory. */
static bool pyramid_create(pyramid *p, int width, int height) {
    size_t total = (size_t)width * (size_t)height;
    p->count = 1;
    p->levels[0] = (level){.width = width, .height = height};
    while (p->levels[p->count - 1].width > 1 || p->levels[p->count - 1].height > 1) {
        const level *fine = &p->levels[p->count - 1];
        p->levels[p->count] = (level){.width = (fine->width + 1) / 2, .height = (fine->height + 1) / 2};
        total += level_size(&p->levels[p->count++]);
    }
    float *next = p->memory = calloc(4 * total, sizeof *next);
    if (!p->memory)
        return false;
    for (int k = 0; k < p->count; k++) {
        level *l = &p->levels[k];
        l->counts = next;
        for (int c = 0; c < 3; c++)
            l->sums[c] = next + (size_t)(c + 1) * level_size(l);
        next += 4 * level_size(l);
    }
    return true;
}

static void fill_first(level *l, const film *f) {
    for (size_t i = 0; i < level_size(l); i++) {
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

static void build(pyramid *p, const film *f) {
    fill_first(&p->levels[0], f);
    for (int k = 1; k < p->count; k++)
        add_up(&p->levels[k], &p->levels[k - 1]);
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
    const image *from = p->film.image;
    pyramid squares;
    *out = NULL;
    if (!pyramid_create(&squares, from->width, from->height))
        return report_out_of_memory(report);
    build(&squares, &p->film);
    image *shown = image_create(from->width, from->height, 3, NULL);
    if (shown) {
        shown->pixel_aspect = from->pixel_aspect;
        fill(shown, &squares);
    }
    free(squares.memory);
    *out = shown;
    return shown ? GRAZE_OK : report_out_of_memory(report);
}
