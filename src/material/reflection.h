/* Materials whose reflection of lights is a function: plasfunc, metfunc, plasdata, metdata. As in Radiance it stands
 * for lights alone; what other surfaces send is reflected diffusely, by the whole colour. */
#ifndef MATERIAL_REFLECTION_H
#define MATERIAL_REFLECTION_H

#include "graze/material.h"
#include "material/modifier.h"

typedef struct material_reflection {
    material_owner owner;
    material_function places, value;
    const rad_data *data; /* or null */
    rgb color;
    double specularity; /* share of the function, the rest being diffuse */
    bool metal;         /* the function's part is coloured, too */
} material_reflection;

bool material_reflects_by_function(rad_type);

/* Compiled for such a material; lives as long as the library. */
graze_status material_reflection_compile(const material_reflection **, material_library *, const rad_primitive *);

/* Where a ray ends: its normal is that on its own side. */
typedef struct material_reflection_point {
    material_ray ray;
    vec3 normal; /* perturbed */
    rgb color;   /* with patterns */
} material_reflection_point;

/* The function's value for light from a direction, in 1/sr: not negative, and 0 after a compute error. */
double material_reflection_value(const material_reflection *, const material_reflection_point *, vec3 light);

#endif
