/* How the errors of means fall with the number of samples, as the samples tell. */
#ifndef TRACE_EVIDENCE_H
#define TRACE_EVIDENCE_H

#include <stdint.h>

#include "base/vector.h"

/* How the variance of the mean of 2^j samples in a row may fall: as 2^-j, as that of independent samples does, or as
 * 4^-j, as it does along edges and better of what is smooth. Beyond that nothing is taken for granted. In units of one
 * sample's variance. */
typedef struct laws {
    double slow, fast;
} laws;

/* Of the mean of n samples. */
laws laws_of_mean(uint32_t n);

/* Of half the difference of two blocks of 2^level samples that make up one: the variance of a block less that of both
 * together. */
laws laws_of_difference(int level);

/* What has been seen of the variance: squares over what each law expects of them. Begins as zeros. */
typedef struct evidence {
    double freedom; /* of how many squares */
    rgb slow, fast;
    double odds; /* log2 of how much likelier the sizes of the squares are by the fast law, but for its own sum */
} evidence;

void evidence_add(evidence *, laws expected, double freedom, rgb squares);
evidence evidence_joined(const evidence *, const evidence *);

/* The variance of what has the variance `wanted` in units of one sample's; so much larger that 1.96 of its roots bound
 * 95% of all errors. */
rgb evidence_variance(const evidence *, laws wanted);

/* (t/1.96)^2, where t bounds 95% of Student's distribution: within 2% from 1 degree of freedom on. Of less than that
 * hardly anything is known. */
double evidence_widening(double freedom);

#endif
