/* What light goes straight through on its way. */
#ifndef TRACE_PANES_H
#define TRACE_PANES_H

#include "trace/hit.h"

/* What is left of light between a point, `length` from the eye, and another one, `far` from it in the ray's direction,
 * or on the surface `target` there: black where something is between that it does not pass. An illum stands for all
 * light that comes through its front but that of lights proper: it stops the rest, if the light `is_proper` not. */
rgb panes_transmittance(const path_context *, const geometry_ray *, double length, int64_t target, bool is_proper);

/* What a probe for irradiance in the ray's place (-i) would be put on: the first surface that is not glass or a
 * dielectric, straight on. */
path_hit panes_look_through(const path_context *, const path_hit *first);

#endif
