/* What is wrong with the numbers of a record. */
#ifndef TOOLS_BRDFEVAL_VALIDATE_H
#define TOOLS_BRDFEVAL_VALIDATE_H

#include <stdbool.h>

#include "base/vector.h"
#include "tools/brdfeval/evaluation.h"

/* Directions whose length is off by more, which no rounding explains, are normalised. */
#define VALIDATE_LENGTH_TOLERANCE 1e-6

/* The largest angle in degrees, either way round. */
#define VALIDATE_ANGLE_MAX 360

/* All give false, with what is wrong in `message` (of RECORD_MESSAGE_SIZE), where a record cannot be answered. */

/* Number `which` of a record has to be finite. */
bool validate_number(double value, int which, char *message);

/* Direction `which` must not be zero; it is normalised where its length is off. */
bool validate_direction(vec3 *, const evaluation *, int which, char *message);

/* Theta and phi of direction `which`, in degrees, have to be within a turn. */
bool validate_angles(double theta, double phi, const evaluation *, int which, char *message);

/* Random number `which` has to be in [0,1). */
bool validate_random_number(double value, int which, char *message);

#endif
