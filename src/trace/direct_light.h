/* Direct light, Eq. 18: lights that are sampled at a vertex. */
#ifndef TRACE_DIRECT_LIGHT_H
#define TRACE_DIRECT_LIGHT_H

#include "trace/path_state.h"

/* The lights as the vertex sees them; none where the strategy does not sample them. */
void direct_light_prepare(const path *, const vertex *, light_choice *);

/* The same of the other side of a surface that transmits, and the surface as light from there sees it. */
void direct_light_prepare_below(const path *, const vertex *, other_side *);

/* Samples every light, or one that is chosen, and adds what it finds on its side to the path's radiance. */
void direct_light_add(path *, const vertex *, const light_choice *, const lobe_choice *);
void direct_light_add_below(path *, const vertex *, const light_choice *, const lobe_choice *);

/* The reflectance functions for a light sample on the viewer's side, by the rules for its role, weighted against
 * finding the light by reflection. `matte`: with what is reflected diffusely. */
rgb direct_light_reflectance(const path *, const vertex *, const light_sample *, double density, const lobe_choice *,
                             bool matte);

#endif
