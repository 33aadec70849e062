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

/* As estimate, with the parts, too (which may be null). No error is believed before `least` samples are taken: so many
 * as others, such as neighbours in a picture, tell will be needed. */
void estimate_with_parts(const graze_trace_settings *, uint64_t stream, uint32_t least, estimate_sample *, void *user,
                         graze_answer *, estimate_parts *);

#endif
