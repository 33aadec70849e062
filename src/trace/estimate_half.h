/* One half of an estimate's samples. */
#ifndef TRACE_ESTIMATE_HALF_H
#define TRACE_ESTIMATE_HALF_H

#include "trace/estimate.h"

/* A half keeps the sums of so many blocks of 2^j samples in a row; when they are full, j grows by 1. */
#define ESTIMATE_BLOCKS 16

/* One half of the samples: a sequence of its own. Whatever is decided about a half's samples - how many there are, how
 * much of a control is added - is decided by what the other half has found. Decisions then do not depend on the samples
 * that they are about, and neither the mean nor its error is led astray: an answer that stopped when it looked good
 * enough to itself would be biased towards what looks good. */
typedef struct estimate_half {
    uint64_t key;
    uint32_t taken;
    int level;          /* a block has 2^level samples */
    estimate_luck luck; /* the worst of any sample */
    int control_count;
    path_rare rare;          /* sums */
    const path_unmet *unmet; /* as in path_sample */
    bool integrated;         /* whether light was integrated in any sample */
    bool with_parts;
    bool cached;
    estimate_parts parts;                            /* sums */
    rgb known_error;                                 /* sum of the errors of what was known beforehand */
    rgb told[IRRADIANCE_PARTS];                      /* sums */
    double lit[PATH_CONTROLS], whole[PATH_CONTROLS]; /* sums of the controls' */
    rgb sum[ESTIMATE_BLOCKS];                        /* those after the last block begun are not set */
    rgb difference[ESTIMATE_BLOCKS][PATH_CONTROLS];
} estimate_half;

enum { ESTIMATE_HALVES = 2 };

static inline void estimate_add_rare(path_rare *sum, const path_rare *rare) {
    sum->expected += rare->expected;
    sum->squares += rare->squares;
    sum->found += rare->found;
    sum->times += rare->times;
    sum->by_mirrors = sum->by_mirrors || rare->by_mirrors;
}

/* Before its first sample. */
void estimate_half_begin(estimate_half *, uint64_t key, bool with_parts);

/* Takes one sample, whose luck it returns; or so many that there are `goal` of them. */
estimate_luck estimate_half_take(estimate_half *, estimate_sample *, void *user);
void estimate_half_take_until(estimate_half *, uint32_t goal, estimate_sample *, void *user);

#endif
