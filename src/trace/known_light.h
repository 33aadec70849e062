/* Light that is known without sampling as long as nothing casts shadows, as a control of what samples find. */
#ifndef TRACE_KNOWN_LIGHT_H
#define TRACE_KNOWN_LIGHT_H

#include "trace/path_state.h"

/* Whether it is at the path's last vertex. */
bool known_light_is(const path *, int light);

/* Adds what is known of the lights' unshadowed light at a vertex, and remembers of which. */
void known_light_add(path *, const vertex *, const light_choice *);

/* Takes what a sample finds, or would find without shadows, of a light that is known. */
void known_light_subtract(path *, int light, rgb found, bool lit);

/* Takes away what the last reflection finds, or would find without shadows, of the known lights. */
void known_light_subtract_reflected(path *, const vertex *from, const path_hit *, rgb found);

#endif
