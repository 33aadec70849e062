/* Files by name, as Radiance's programs look for them: seen from a directory, along RAYPATH. */
#ifndef RAD_PATH_H
#define RAD_PATH_H

#include <stdbool.h>

#include "base/arena.h"

/* All give null when out of memory. A null `directory` is this process's own. */

/* The name under which this process can open what `directory` knows as `name`. */
const char *rad_path_resolve(arena *, const char *directory, const char *name);

/* Looks for a readable file `name` along RAYPATH; names with a leading dot or slash just where they say. Where there is
 * none *found is false. */
const char *rad_path_find(arena *, const char *directory, const char *name, bool *found);

/* The directory of a file. *own tells that it is this process's, and null is given. */
const char *rad_path_directory(arena *, const char *path, bool *own);

#endif
