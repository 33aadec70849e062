/* The pixels of a picture under way, and which of them are finished.
 *
 * A pixel is written once, by one thread, and then said to be finished; who has seen that may read it at any time. */
#ifndef PICTURE_FILM_H
#define PICTURE_FILM_H

#include <stdatomic.h>

#include "picture/picture.h"

typedef enum film_state {
    FILM_MISSING,
    FILM_FINISHED,
    FILM_UNCONVERGED, /* finished at the limit of samples */
} film_state;

/* The planes by meaning; null where the picture has none of these. */
typedef struct film_planes {
    float *value[3], *error[3], *samples, *depth, *normal[3], *albedo[3], *direct[3], *indirect[3];
} film_planes;

typedef struct film {
    image *image;
    film_planes planes;
    float *reached;       /* standard error of each pixel, as a part of its value or of the floor */
    atomic_uchar *states; /* film_state of each pixel */
} film;

/* What there is to know of a pixel. */
typedef struct film_pixel {
    graze_answer answer;
    double reached;
    double depth;
    vec3 normal;
    rgb albedo, indirect;
} film_pixel;

/* Null pointers, or all of it. False when out of memory. */
bool film_create(film *, int width, int height, picture_content);
/* How much memory that takes. */
double film_bytes(int width, int height, picture_content);
void film_free(film *);

/* Writes the pixel and says that it is finished. */
void film_finish(film *, size_t at, const film_pixel *);

static inline film_state film_state_of(const film *f, size_t at) {
    return (film_state)atomic_load_explicit(&f->states[at], memory_order_acquire);
}

#endif
