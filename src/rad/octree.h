/* Radiance's octrees, for what they say of the scene: what oconv writes. Of the tree itself it only matters that it is
 * all there. */
#ifndef RAD_OCTREE_H
#define RAD_OCTREE_H

#include "base/whole_file.h"
#include "rad/reader.h"

bool rad_octree_is(const whole_file *);
/* Whether a file that is none should be one, by its name. */
bool rad_octree_is_named(const char *name);

/* Reads an octree's primitives: those in it if it is frozen; else those of the scene files and commands that it names,
 * as its program's own directory knows them, which are read again. `where` names the octree. Where the files hold other
 * numbers of primitives than they did, there is a warning. */
graze_status rad_octree_read(rad_reader *, const whole_file *, const place *where, const rad_context *,
                             const rad_sink *);

#endif
