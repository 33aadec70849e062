/* Compiled meshes: what obj2mesh writes. */
#ifndef RAD_MESH_H
#define RAD_MESH_H

#include "base/whole_file.h"
#include "rad/link.h"

/* Reads a mesh; its materials, and for each of them a primitive `M-Tri` that it modifies, go to the linker's scene.
 * `where` names the file. */
graze_status rad_mesh_read(const rad_mesh **, rad_linker *, const whole_file *, const place *where);

#endif
