/* The inside of a picture under way. */
#ifndef PICTURE_STATE_H
#define PICTURE_STATE_H

#include "picture/film.h"
#include "picture/order.h"
#include "picture/shared_light.h"
#include "picture/survey.h"
#include "trace/irradiance_cache.h"

struct rendering {
    picture_settings settings;
    graze_trace_settings trace; /* with the picture's floor, once it is known */
    atomic_bool floor_known;
    const graze_scene *scene;
    film film;
    shared_light *shared;    /* null: none */
    irradiance_cache *cache; /* null: none */
    picture_survey survey;
    order order;
    atomic_bool stopped;
    atomic_size_t finished, unconverged;
    atomic_ullong paths, error; /* sums; of errors in units of 2^-32, each at most LARGEST_ERROR */
};

/* Counts a finished pixel. */
void picture_count(rendering *, size_t at);

#endif
