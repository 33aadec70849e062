/* What both halves of an estimate have found, and how wrong it may be. */
#ifndef TRACE_ESTIMATE_ERROR_H
#define TRACE_ESTIMATE_ERROR_H

#include "trace/estimate_half.h"
#include "trace/evidence.h"

/* What has happened in none of n samples that are few, and like independent ones, may yet happen in so many of n. */
#define ESTIMATE_UNSEEN_FEW 3.0
/* Of nothing but zeros, which where lights are sampled means shadow, so many are taken before they are believed. */
#define ESTIMATE_ZEROS_BELIEVED 512u

/* What a half has found. */
typedef struct estimate_finding {
    rgb mean;
    evidence evidence;
} estimate_finding;

estimate_finding estimate_finding_of(const estimate_half *, const estimate_half *other);

/* The value, its error and the number of samples. */
void estimate_summarize(const graze_trace_settings *, const estimate_half[ESTIMATE_HALVES],
                        const estimate_finding[ESTIMATE_HALVES], graze_answer *);

/* How much each half counts: by its number of samples where that is as good as the other's; where the numbers were
 * decided to be different, as much as the other, since its number depends on what the other found. */
void estimate_share_halves(const estimate_half[ESTIMATE_HALVES], double share[ESTIMATE_HALVES]);

/* Radiance is not negative, though controls are, and few samples of much noise may leave more of them than of light:
 * the value nearest to what was found is then 0, and nearer to the truth whatever that is. */
static inline rgb estimate_not_negative(rgb mean) {
    return (rgb){double_max(mean.r, 0), double_max(mean.g, 0), double_max(mean.b, 0)};
}

/* The standard error of a value of this variance. */
rgb estimate_with_known_error(rgb variance, rgb value, bool integrated);

/* What is missing of a mean of `count` samples, as it was found by `taken`, if next to nothing was found of what gloss
 * is expected to reflect of small lights: all of that, but the less, the more peaks of it should have been met; and
 * more, where what is expected is known by a few points alone. */
double estimate_unseen_gloss(const path_rare *sum, double taken, double count);

/* What is missing of a mean of `count` samples, if a half has found nothing of the sky beside the windows that it looks
 * through: an opening there would be met about once in all of them. */
double estimate_unseen_sky(const estimate_half *, double count);

#endif
