/* Rusinkiewicz's coordinates: the half vector, and the incident direction as seen from it. */
#ifndef FIT_HALF_DIFFERENCE_H
#define FIT_HALF_DIFFERENCE_H

#include "graze/vector.h"

/* The two directions of a half vector (theta_h, phi_h) and a difference (theta_d, phi_d), in radians: the difference
 * is turned by theta_h about y, then by phi_h about z; the other direction is its reflection about the half vector. */
void fit_from_half_difference(const double half[2], const double difference[2], graze_vec3 *one, graze_vec3 *other);

#endif
