/* Direct light, Eq. 18: lights that are sampled at a vertex. */
#ifndef TRACE_DIRECT_LIGHT_H
#define TRACE_DIRECT_LIGHT_H

#include "trace/path_state.h"

/* The lights as the vertex sees them; none where the strategy does not sample them. */
void direct_light_prepare(const path *, const vertex *, light_choice *);

/* Samples every light, or one that is chosen, and adds what it finds to the path's radiance. */
void direct_light_add(path *, const vertex *, const light_choice *, lobe_choice);

#endif
