/* Arguments of materials that say how much of the light goes where. */
#ifndef MATERIAL_AMOUNTS_H
#define MATERIAL_AMOUNTS_H

#include "rad/scene_file.h"

/* Of one colour in a scene, and of a pattern on one: more, though it is no use even for pictures of nonsense, would let
 * the squares of radiances overflow. */
#define MATERIAL_LARGEST_AMOUNT 1e10

/* Whether none of the first `count` real arguments is negative; reported. */
graze_status material_check_signs(const rad_primitive *, uint32_t count, const graze_report *);

/* Whether none of them is above MATERIAL_LARGEST_AMOUNT; reported. */
graze_status material_check_largest(const rad_primitive *, uint32_t count, const graze_report *);

/* Both. */
graze_status material_check_amounts(const rad_primitive *, uint32_t count, const graze_report *);

#endif
