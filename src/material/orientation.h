/* Orientation vectors of anisotropic materials that depend on where a ray hits. */
#ifndef MATERIAL_ORIENTATION_H
#define MATERIAL_ORIENTATION_H

#include "material/modifier.h"

typedef struct material_orientation {
    material_owner owner;
    material_function vector;
} material_orientation;

/* Whether the orientation of the material (`plastic2` and its kin) is more than three numbers. */
bool material_orients_by_function(const rad_primitive *);

/* Compiled for such a material; lives as long as the library. */
graze_status material_orientation_compile(const material_orientation **, material_library *, const rad_primitive *);

/* In world space; the null vector after a compute error. The ray's normal is that on its own side. */
vec3 material_orientation_at(const material_orientation *, const material_ray *);

#endif
