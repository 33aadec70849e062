/* A point that light is gathered at, and what is decided there before anything is drawn. */
#ifndef TRACE_GATHERING_H
#define TRACE_GATHERING_H

#include <stdbool.h>

#include "graze/material.h"
#include "material/reflection.h"
#include "scene/light_choice.h"
#include "scene/sight_cells.h"

typedef struct vertex {
    vec3 point;
    vec3 normal;     /* of the surface as it stands in space, on the viewer's side; that of `shading` may lean */
    int64_t surface; /* -1: a sensor */
    graze_surface shading;
    rgb ambient; /* reflectance of the ambient term: diffuse, and lobes below the specular threshold */
    bool gloss_is_ambient;
    const material_reflection *function; /* lights are reflected by it, beside diffusely; null: none */
    const graze_scene
        *function_scene; /* where the surface is in a copy, which the function's point is seen from; else null */
    material_reflection_point function_point;
    rgb function_color; /* to multiply its values by, on the viewer's side */
    bool leans;         /* the normal of `shading` is not the surface's own */
    bool drawn;         /* some of what the surface is here, as which of two materials, was drawn at random */
    bool no_ambient;    /* diffuse light from surfaces is not followed here (-ae, -ai) */
    bool behind;        /* the viewer is behind the surface */
    double distance;    /* that the path came from */
    rgb before;         /* transmittance of a unit of length on the viewer's side; set where the scene refracts */
    /* Where the surface transmits, of its other side: */
    rgb transmitted_ambient;
    rgb transmitted_function; /* to multiply the function's values by */
    bool transmitted_gloss_is_ambient;
    bool refracts; /* what TRANSMITTED lets through no light sample finds */
    rgb beyond;    /* transmittance of a unit of length there; set where the scene refracts */
} vertex;

/* Probabilities of going on with each lobe of one side; they sum to at most 1. Where a lobe `ends`, the ray only looks
 * for lights that shine on the vertex: what sampling the lights would find. */
typedef struct lobe_choice {
    double diffuse, specular;
    bool diffuse_ends, specular_ends;
    bool specular_splits; /* it is followed in any case, as a branch of the path; `specular` is 0 then */
} lobe_choice;

/* Large: not to be copied, also because the lights refer to the vertex. */
typedef struct gathering {
    vertex vertex;
    bool decided; /* the rest is known, also to other paths that come to the vertex: */
    sight_cell cell;
    bool lit;   /* all light from lights is known: */
    rgb direct; /* what is reflected of it, for a throughput of 1 */
    lobe_choice lobes;
    light_choice lights;
} gathering;

/* The same of the other side of a surface that transmits: the surface as light from there sees it. */
typedef struct other_side {
    graze_surface surface;
    lobe_choice lobes;
    light_choice lights;
} other_side;

#endif
