/* Materials that scatter the light of lights by functions: plasfunc, metfunc, transfunc, the same by data, and
 * BRTDfunc. As in Radiance the functions stand for lights alone; what other surfaces send is scattered diffusely, of
 * the first six by the whole colour. */
#ifndef MATERIAL_REFLECTION_H
#define MATERIAL_REFLECTION_H

#include "graze/material.h"
#include "material/modifier.h"

/* What leaves one side of the surface towards the viewer, for white light on that side. */
typedef struct material_reflection_side {
    rgb diffuse, ambient; /* reflectances, or transmittances: of lights, and of all other light */
    rgb function;         /* to multiply the function's values by; black: it does not count */
} material_reflection_side;

typedef struct material_reflection {
    material_owner owner;
    material_function places, value;   /* value: one for all colours, or three; none where `by_function` is not set */
    const rad_data *data;              /* or null */
    material_function mirror, through; /* BRTDfunc: what is mirrored, and let straight through */
    bool by_function, mirrors, passes; /* whether there may be any of these */
    bool keeps_normal;                 /* functions see the surface's own normal, on whichever side the ray is */
    /* For a material without patterns. The viewer's side, seen from the front and from behind; and the other one. */
    material_reflection_side front, back, beyond;
    rgb color;                                   /* CrP, CgP, CbP without patterns */
    bool pattern_on_function, pattern_on_beyond; /* whether patterns multiply the functions' parts, too */
} material_reflection;

bool material_reflects_by_function(rad_type);

/* Compiled for such a material; lives as long as the library. */
graze_status material_reflection_compile(const material_reflection **, material_library *, const rad_primitive *);

/* Where a ray ends: its normal is that on its own side, or the surface's own where this is kept. */
typedef struct material_reflection_point {
    material_ray ray;
    vec3 normal; /* perturbed, on the ray's side */
    rgb color;   /* with patterns */
} material_reflection_point;

/* The parts under a pattern. */
void material_reflection_sides(const material_reflection *, rgb pattern, bool behind, material_reflection_side *above,
                               material_reflection_side *below);

/* The function's value for light from a direction, in 1/sr: not negative, and 0 after a compute error. */
rgb material_reflection_value(const material_reflection *, const material_reflection_point *, vec3 light);

/* What is mirrored, and what goes straight through: not negative, 0 after a compute error and where there is none. */
rgb material_reflection_mirrored(const material_reflection *, const material_reflection_point *);
rgb material_reflection_through(const material_reflection *, const material_reflection_point *);

#endif
