/* Primitives in binary: what frozen octrees and compiled meshes hold. */
#ifndef RAD_BINARY_SCENE_H
#define RAD_BINARY_SCENE_H

#include "rad/bytes.h"
#include "rad/reader.h"

/* Reads the names of types, then primitives up to their end. An object's number has `object_size` bytes. */
graze_status rad_binary_scene_read(rad_reader *, rad_bytes *, int object_size, const rad_sink *);

#endif
