/* Answers whose lobe is too large for a number, though they themselves may not be. */
#ifndef TOOLS_BRDFEVAL_OVERFLOW_H
#define TOOLS_BRDFEVAL_OVERFLOW_H

#include "base/vector.h"
#include "tools/brdfeval/evaluation.h"

/* The number of one channel that a field of `eval` with a scaling has for this pair of directions, at most DBL_MAX. */
double overflow_answer(const evaluation *, const answer_field *, int channel, vec3 l, vec3 v);

#endif
