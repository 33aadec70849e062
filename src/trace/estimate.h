/* Means with a standard error that low-discrepancy points do not fool.
 *
 * The points of one scrambled sequence are not independent, so the scatter of their values says little of their mean's
 * error. But cut into blocks of 2^j points they are nets of the same kind and of equal distribution, at every j; how
 * the means of neighbouring blocks differ tells how the error falls with the length of a block, and that leads on to
 * the whole. Two long sequences then do, scrambled independently, where the scatter of many short ones would cost much
 * of what low-discrepancy points are good for. */
#ifndef TRACE_ESTIMATE_H
#define TRACE_ESTIMATE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vector.h"
#include "graze/trace.h"
#include "trace/path.h"
#include "trace/sampler.h"

/* What a sample's value depends on besides its question. */
typedef enum estimate_luck {
    ESTIMATE_EXACT,  /* nothing: all samples are equal */
    ESTIMATE_PLACE,  /* on random numbers that chose where to look, as in a pixel, but not on what is seen there */
    ESTIMATE_NOISY,  /* on random numbers */
    ESTIMATE_SEARCH, /* on random numbers that must be lucky to find some of the light */
} estimate_luck;

/* Draws one sample. */
typedef void estimate_sample(void *user, sampler *, path_sample *, estimate_luck *luck);

/* Takes samples until the settings' error or number of samples is reached. `stream` tells estimates apart. */
void estimate(const graze_trace_settings *, uint64_t stream, estimate_sample *, void *user, graze_answer *);

/* Means of what samples tell besides (trace/path.h), each sample counted as much as it is in the value. */
typedef struct estimate_parts {
    rgb indirect, albedo;
} estimate_parts;

/* Whether places have an edge among them that a few samples may all miss: a part of them, no more than 1/`samples`,
 * that looks different by more than its size makes up for, if differences of `allowed` in the mean do not matter. */
typedef bool estimate_has_edge(void *user, uint32_t samples, double allowed);

/* What else there may be to an estimate. */
typedef struct estimate_extras {
    uint32_t least; /* no error is believed before so many samples are taken: as others, such as neighbours in a
                       picture, tell will be needed */
    estimate_has_edge
        *has_edge;         /* is asked before samples that only differ by their places are believed; null: never */
    estimate_parts *parts; /* null: not wanted */
} estimate_extras;

void estimate_with_extras(const graze_trace_settings *, uint64_t stream, const estimate_extras *, estimate_sample *,
                          void *user, graze_answer *);

#endif
