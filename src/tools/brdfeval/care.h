/* Records that a block cannot take as they are. */
#ifndef TOOLS_BRDFEVAL_CARE_H
#define TOOLS_BRDFEVAL_CARE_H

#include <stdbool.h>

#include "base/vector.h"
#include "tools/brdfeval/evaluation.h"

/* Lengths that are off by more are no rounding errors. */
#define CARE_LENGTH_TOLERANCE 1e-6

/* Direction number `which` of a record: normalised where its length is off. False, with the reason, where it is zero.
 */
bool care_direction(vec3 *, const evaluation *, int which, char *trouble);

/* Random number `which`: false, with the reason, where it is not in [0,1). */
bool care_random_number(double value, int which, char *trouble);

#endif
