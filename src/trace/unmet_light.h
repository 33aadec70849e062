/* Light that may yet be found where a path looks for it only after panes and mirrors. An estimate whose samples are all
 * alike there, since none of them has met any, must not claim to be certain: what would be found if nothing stood in
 * the way of lights tells how much that may be. */
#ifndef TRACE_UNMET_LIGHT_H
#define TRACE_UNMET_LIGHT_H

#include "trace/path_state.h"

/* Notes what lights that are sampled at a vertex might give, at the first one after panes and mirrors. What is known of
 * them without samples must have been added. */
void unmet_light_expect(path *, const gathering *);

/* What is expected where nothing has been noted yet: for the caller to replace. */
#define UNMET_LIGHT_NEW (-1)

/* What is noted, where the path is, of a light in a mirror; or, by negative numbers, of all those in none. Null: there
 * is no room. */
path_unmet_at *unmet_light_at(const path *, int surface, int light);

/* Once the path, or its branch, has ended: takes whether it has met any of that. */
void unmet_light_settle(path *);

/* So much of a mean of `taken` samples is not met by any. */
double unmet_light_of(const path_unmet *, double taken);

#endif
