/* Direct light, Eq. 18: lights that are sampled at a vertex. */
#ifndef TRACE_DIRECT_LIGHT_H
#define TRACE_DIRECT_LIGHT_H

#include "trace/path_state.h"

/* The vertex as lights see it. */
light_receiver direct_light_receiver(const path *, const vertex *);

/* Samples every light, or one that is chosen, and adds what it finds to the path's radiance. */
void direct_light_add(path *, const vertex *, const light_receiver *, lobe_choice);

#endif
