/* What modifies a material: patterns, which multiply its colour, textures, which lean its normal, mixtures of these and
 * of materials. */
#ifndef MATERIAL_MODIFIER_H
#define MATERIAL_MODIFIER_H

#include "material/function.h"

typedef enum material_modifier_kind {
    MATERIAL_ITSELF,   /* a material among its modifiers: passed over */
    MATERIAL_PATTERN,  /* multiplies the colour */
    MATERIAL_TEXTURE,  /* leans the normal */
    MATERIAL_MIXTURE,  /* of patterns and textures */
    MATERIAL_MATERIALS /* a mixture of materials: the end of a chain */
} material_modifier_kind;

/* A primitive that is a modifier, and what modifies it in turn. */
typedef struct material_modifier {
    material_modifier_kind kind;
    const rad_primitive *primitive;
    const struct material_modifier *next; /* or null */
    material_owner owner;
    /* Where there are data: the functions that say where in it to look; what is found is what `values` see. */
    material_function places, values;
    int data_count;                                                  /* 0, 1, or 3 */
    const rad_data *data[3];                                         /* of a picture, one grid for three planes */
    const material_picture *picture;                                 /* or null */
    int fore, back;                                                  /* of mixtures: primitives, or RAD_VOID */
    const struct material_modifier *fore_modifiers, *back_modifiers; /* of a mixture of patterns and textures */
} material_modifier;

/* A scene's modifiers, each compiled when it is first asked for. */
typedef struct material_modifiers material_modifiers;

/* Null when out of memory. The report is kept. */
material_modifiers *material_modifiers_create(const rad_primitive *, size_t count, const graze_report *);
void material_modifiers_destroy(material_modifiers *); /* null is let pass */
material_library *material_modifiers_library(material_modifiers *);

/* The patterns and textures of that name, the latest before the primitive; null for void. Materials are errors. */
graze_status material_modifiers_find(const material_modifier **, material_modifiers *, const rad_primitive *,
                                     const char *name);

/* What a surface of this modifier (a primitive's index) is made of. */
typedef struct material_chain {
    int material; /* the primitive that is its material, or the mixture of materials; RAD_VOID: there is none */
    const material_modifier *modifiers; /* all patterns and textures before and behind it; null: none */
    const material_modifier *mixture;   /* where it is one of materials */
} material_chain;

/* Compiles what is not compiled yet. Two materials in a chain, and modifiers of a mixture of materials, are errors. */
graze_status material_chain_find(material_chain *, material_modifiers *, int modifier);

typedef struct material_effect {
    rgb color;         /* to multiply the material's by; may be negative, and large */
    vec3 perturbation; /* to add to the normal */
} material_effect;

/* What all modifiers of a chain do at a ray's end. */
material_effect material_modify(const material_modifier *, const material_ray *);

/* How many pixels the largest picture has that a chain looks at, or values the largest data; 0: none. */
size_t material_modifiers_pixels(const material_modifier *);

/* Whether there are textures among them. */
bool material_modifiers_lean(const material_modifier *);

/* The share of the foreground in a mixture, 0 .. 1. False: a compute error, of which the user is told once. */
bool material_mixture_share(const material_modifier *, const material_ray *, double *share);

/* The normal with a perturbation, unit: leaned back where the ray would otherwise see its other side. `normal` is the
 * surface's own on the side that the ray comes from, the perturbation as for that side. */
vec3 material_perturbed_normal(vec3 normal, vec3 perturbation, vec3 direction);

#endif
