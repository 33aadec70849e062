/* Emitters that a path comes upon. */
#ifndef TRACE_EMISSION_H
#define TRACE_EMISSION_H

#include "trace/path_state.h"

/* The radiance that arrives by the ray from the emitter hit, with its patterns. Where it `lights` the ray's origin, not
 * as it looks: see light_radiance_at. */
rgb emission_radiance(const path *, const path_hit *, bool lights);

/* Lets the path through where it has met what shines in place of what is behind: from there on it only finds lights
 * that do not, as light samples find them. */
void emission_pass_secondary(path *, const path_hit *);

/* What the path gets of the emitter it has hit, weighted against finding the same by sampling lights; and of all
 * sources that shine from where it has hit the first of them. */
rgb emission_found(const path *, const path_hit *);

/* What it gets of the hit's light alone. */
rgb emission_found_of(const path *, const path_hit *);

#endif
