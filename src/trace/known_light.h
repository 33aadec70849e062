/* Light that is known without sampling. Where nothing stands between a light and a vertex, that is all there is to it,
 * and where nothing of the light is seen, too: it is settled. Else it is a control of what samples find. */
#ifndef TRACE_KNOWN_LIGHT_H
#define TRACE_KNOWN_LIGHT_H

#include "trace/path_state.h"

/* Whether it is a control at the path's last vertex, or one that only tells how much of it is hidden. */
bool known_light_is_control(const path *, int light);
/* Whether it has been added, and must not be found in other ways. */
bool known_light_is_settled(const path *, int light);

/* Whether nothing is on the way to any point of it. */
bool known_light_is_clear(const path *, int light);

/* Whether the lights are all that could be reflected at the vertex, and all of them are settled or shine elsewhere. */
bool known_light_is_all(const path *, const vertex *, const light_choice *);

/* Whether the cell of a surface tells of all lights whether they are seen, and diffuse reflection is all there is: then
 * no light is to be chosen or sampled, and this is what the vertex reflects of them for a throughput of 1. */
bool known_light_from_cells(const path *, const vertex *, sight_cell, rgb *reflected);

/* Adds that, and settles all lights. */
void known_light_settle_all(path *, rgb reflected);

/* Adds what is known of the lights' light at a vertex, and remembers of which. */
void known_light_add(path *, const vertex *, sight_cell, const light_choice *);

/* Takes what a sample finds, or would find without shadows, of a light that is known, and how bright it really is. */
void known_light_subtract(path *, int light, rgb found, double lit);

/* Where some of many lights are chosen, at a path's first point: takes how bright that would be which is hidden
 * wholly, in the mean of the draws, and what was found. */
void known_light_watch_chosen(path *, double hidden, double lit);

/* Where windows are looked through, at a path's first point: takes how bright the sky is beside them, where it is
 * hidden and where not. */
void known_light_watch_sky(path *, double hidden, double lit);

/* Takes away what the last reflection finds, or would find without shadows, of the known lights. */
void known_light_subtract_reflected(path *, const vertex *from, const path_hit *, rgb found);

#endif
