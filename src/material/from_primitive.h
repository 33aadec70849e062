/* From a scene file's primitive to a material. */
#ifndef MATERIAL_FROM_PRIMITIVE_H
#define MATERIAL_FROM_PRIMITIVE_H

#include <stdbool.h>

#include "graze/material.h"
#include "rad/scene_file.h"

/* Whether the type has a reflectance model: `plastic`, `metal`, `trans`, `plastic2`, `metal2` or `trans2`. */
bool material_is_reflector(rad_type);

/* Reads `plastic`, `metal`, `trans`, their anisotropic kin, `glass`, `dielectric` and `interface`. Wrong arguments and
 * all other types of material are errors. Parameters with which a surface may reflect more light than it receives are
 * warned of and taken as they are, as in Radiance. An orientation by functions
 * (material/orientation.h) is left null. */
graze_status material_from_primitive(graze_material *, const rad_primitive *, const graze_report *);

/* Where the transform begins among the strings of a primitive, from number `rest` on; words before it are told to have
 * no meaning. */
uint32_t material_find_transform(const rad_primitive *, uint32_t rest, const graze_report *);

#endif
