/* How a path goes on from a vertex: which lobe, how likely, and in which direction. */
#ifndef TRACE_LOBES_H
#define TRACE_LOBES_H

#include "trace/path_state.h"

/* The probabilities with which the path goes on with each lobe. */
lobe_choice lobes_choose(const path *, const vertex *);

/* Draws the lobe to go on with and turns the path into it. False: the path ends here. */
bool lobes_reflect(path *, const vertex *, const light_choice *, lobe_choice, vec3 *direction);

#endif
