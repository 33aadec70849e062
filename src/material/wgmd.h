/* WGMDfunc: the new Ward model with colours, roughnesses and orientation by functions, on either side of a surface.
 * What it transmits is not supported yet. */
#ifndef MATERIAL_WGMD_H
#define MATERIAL_WGMD_H

#include "graze/material.h"
#include "material/modifier.h"

typedef struct material_wgmd {
    material_owner owner;
    material_function orientation, specular; /* the vector; the specular reflectance and both roughnesses */
    rgb front, back;                         /* diffuse reflectance */
    bool may_mirror;                         /* a roughness is 0, or may become that */
    bool specular_inherits;                  /* the material's own modifiers are for the specular part, too; else: */
    const material_modifier *specular_modifiers; /* or null */
} material_wgmd;

/* Compiled for such a material; lives as long as the modifiers. */
graze_status material_wgmd_compile(const material_wgmd **, material_modifiers *, const rad_primitive *);

/* A point of the surface. Colours and normals are those of the diffuse and of the specular part with their modifiers,
 * the normals on the ray's side; the ray's own normal is the surface's, on whichever side. */
typedef struct material_wgmd_point {
    material_ray ray;
    graze_brdf_model model;
    vec3 diffuse_normal, specular_normal;
    rgb diffuse_color, specular_color;
} material_wgmd_point;

/* Prepares two surfaces, which together are the material: of the first only the diffuse part counts, of the second only
 * the specular one. Where their normals are the same, so are their frames. */
void material_wgmd_prepare(const material_wgmd *, const material_wgmd_point *, graze_surface *diffuse,
                           graze_surface *specular);

#endif
