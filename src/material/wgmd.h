/* WGMDfunc: the new Ward model with colours, roughnesses and orientation by functions, on either side of a surface, and
 * a rough or clear transmission beside it. */
#ifndef MATERIAL_WGMD_H
#define MATERIAL_WGMD_H

#include "graze/material.h"
#include "material/modifier.h"

/* Each has patterns and textures of its own. */
typedef enum material_wgmd_part {
    WGMD_DIFFUSE, /* the material's own modifiers are for this one */
    WGMD_SPECULAR,
    WGMD_THROUGH, /* what is transmitted about the direction straight on */
    WGMD_THROUGH_DIFFUSE,
    WGMD_PARTS
} material_wgmd_part;

typedef struct material_wgmd {
    material_owner owner;
    material_function orientation;       /* the vector */
    material_function specular, through; /* the specular reflectance, or transmittance, and both roughnesses */
    rgb front, back, beyond;             /* diffuse reflectance, and transmittance */
    bool has[WGMD_PARTS];                /* whether the part may be more than black */
    bool may_mirror, may_be_clear;       /* a roughness is 0, or may become that: of WGMD_SPECULAR, of WGMD_THROUGH */
    bool inherits[WGMD_PARTS];           /* the material's own modifiers are for the part, too; else: */
    const material_modifier *modifiers[WGMD_PARTS]; /* or null */
} material_wgmd;

/* Compiled for such a material; lives as long as the modifiers. */
graze_status material_wgmd_compile(const material_wgmd **, material_modifiers *, const rad_primitive *);

/* A point of the surface. Colours and normals are those of the parts that there are, with their modifiers, the normals
 * on the ray's side; the ray's own normal is the surface's, on whichever side. */
typedef struct material_wgmd_point {
    material_ray ray;
    graze_brdf_model model;
    vec3 normals[WGMD_PARTS];
    rgb colors[WGMD_PARTS];
} material_wgmd_point;

/* Prepares a surface for each part that there is; together they are the material. Where their normals are the same, so
 * are their frames, and material_wgmd_join makes one surface of them. Where the viewer looks on beyond the surface is
 * not theirs to say. */
void material_wgmd_prepare(const material_wgmd *, const material_wgmd_point *, graze_surface parts[WGMD_PARTS]);
void material_wgmd_join(graze_surface *, const graze_surface *part);

/* What goes straight through of the ray: black where what is transmitted is rough. */
rgb material_wgmd_through(const material_wgmd *, const material_wgmd_point *);

#endif
