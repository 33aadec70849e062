/* Directions from angles. */
#ifndef TOOLS_BRDFEVAL_DIRECTION_H
#define TOOLS_BRDFEVAL_DIRECTION_H

#include "base/vector.h"

/* An angle in degrees, with its sine and cosine: exact at multiples of 90 degrees. */
typedef struct direction_angle {
    double degrees, sine, cosine;
} direction_angle;
direction_angle direction_angle_of(double degrees);

/* theta from the normal, phi from x towards y. */
vec3 direction_from_angles(direction_angle theta, direction_angle phi);

#endif
