/* Emitters that a path comes upon. */
#ifndef TRACE_EMISSION_H
#define TRACE_EMISSION_H

#include "trace/path_state.h"

/* What the path gets of the emitter it has hit, weighted against finding the same by sampling lights. */
rgb emission_found(const path *, const path_hit *);

#endif
