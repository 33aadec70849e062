/* Dividing a few shapes into two groups. */
#ifndef GEOMETRY_SHAFT_SPLIT_H
#define GEOMETRY_SHAFT_SPLIT_H

#include <stddef.h>

#include "geometry/shape.h"

#define SHAFT_SPLIT_MOST 256

/* Orders 2 to SHAFT_SPLIT_MOST shapes such that the boxes around the first ones, whose number it returns, and around
 * the others are small: by the surface area heuristic. */
size_t shaft_split(const shape *shapes, int *order, size_t count);

#endif
