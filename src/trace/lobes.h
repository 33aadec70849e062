/* How a path goes on from a vertex: which lobe, how likely, and in which direction. */
#ifndef TRACE_LOBES_H
#define TRACE_LOBES_H

#include "trace/path_state.h"

/* The probabilities with which the path goes on with each lobe; and those of both sides of a surface that transmits. */
lobe_choice lobes_choose(const path *, const vertex *);
void lobes_choose_both(const path *, const vertex *, lobe_choice *above, lobe_choice *below);

/* Whether any lobe of the viewer's side may be taken. Where none is, lobes_reflect must not be called. */
static inline bool lobes_may_reflect(const lobe_choice *choice) {
    return choice->diffuse + choice->specular > 0;
}

/* Draws the lobe to go on with, of those of the viewer's side or of both, and turns the path into it. False: the path
 * ends here. */
bool lobes_reflect(path *, const vertex *, const light_choice *, const lobe_choice *, vec3 *direction);
bool lobes_go_on(path *, const gathering *, const other_side *, vec3 *direction);

/* Puts by the branches that split off there; `below` is null where there is but one side. */
void lobes_split(path *, const vertex *, const lobe_choice *above, const lobe_choice *below, path_branches *);

#endif
