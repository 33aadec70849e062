/* A scene being put together. */
#ifndef RAD_LINK_H
#define RAD_LINK_H

#include "rad/name_table.h"
#include "rad/reader.h"
#include "rad/scene_file.h"

struct rad_scene {
    arena *memory;
    rad_primitive *primitives; /* of all parts */
    size_t count, capacity;
    size_t counts[RAD_TYPE_COUNT + 1]; /* by type; the last is of those that have none */
    rad_part *parts;
    size_t part_count, part_capacity;
    rad_copy *copies;
    size_t copy_count, copy_capacity;
};

typedef struct rad_linker {
    rad_reader reader;
    rad_scene *scene;
    size_t first; /* primitive of the part that is being read: */
    rad_name_table modifiers;
} rad_linker;

/* A sink for the primitives of a part; `user` is the linker. */
graze_status rad_link(void *user, rad_raw *);
graze_status rad_linker_append(rad_linker *, const rad_primitive *);

#endif
