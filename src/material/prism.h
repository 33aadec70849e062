/* Materials that send light on in directions that are functions: prism1, prism2. */
#ifndef MATERIAL_PRISM_H
#define MATERIAL_PRISM_H

#include "material/modifier.h"

typedef struct material_prism {
    material_owner owner;
    material_function function; /* a coefficient and a direction for each way */
    int ways;                   /* 1 or 2 */
    atomic_flag *amplification_told;
} material_prism;

bool material_is_prism(rad_type);

/* Compiled for such a material; lives as long as the library. */
graze_status material_prism_compile(const material_prism **, material_library *, const rad_primitive *);

/* A way on for a ray. */
typedef struct material_way {
    double coefficient; /* to multiply the radiance by that comes from there; 0: there is no such way */
    vec3 direction;     /* unit */
} material_way;

/* Where a ray goes on that ends on the surface; its normal is the surface's own. None after a compute error. Once it is
 * told of a prism that it amplifies light. */
void material_prism_ways(const material_prism *, const material_ray *, material_way ways[2]);

#endif
