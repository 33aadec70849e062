/* Radiance's octrees, for what they say of the scene: what oconv writes. The tree itself is of no use here. */
#ifndef RAD_OCTREE_H
#define RAD_OCTREE_H

#include "base/whole_file.h"
#include "rad/reader.h"

bool rad_octree_is(const whole_file *);

/* Reads an octree's primitives: those in it if it is frozen; else those of the scene files and commands that it names,
 * as its program's own directory knows them, which are read again. `where` names the octree. Where the files hold other
 * numbers of primitives than they did, there is a warning. */
graze_status rad_octree_read(rad_reader *, const whole_file *, const place *where, const rad_context *,
                             const rad_sink *);

#endif
