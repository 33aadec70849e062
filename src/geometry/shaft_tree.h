/* A coarse hierarchy of boxes over a scene's shapes, quickly built. */
#ifndef GEOMETRY_SHAFT_TREE_H
#define GEOMETRY_SHAFT_TREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "geometry/shape.h"

typedef struct shaft_node {
    vec3 lower, upper;
    uint32_t first; /* of its shapes, in `order`; or of its two children, which stand together */
    uint32_t count; /* of its shapes; 0: it has children */
    bool reflects;  /* not all in it shines */
} shaft_node;

typedef struct shaft_tree {
    shaft_node *nodes; /* the root first */
    uint32_t node_count, capacity;
    int *order; /* indices of shapes */
} shaft_tree;

/* A path from the root has at most this many nodes. */
#define SHAFT_TREE_DEPTH 64

/* `lower` and `upper` bound all shapes, at least one. The tree's boxes do not depend on the threads, but their order in
 * memory does. False: no memory. */
bool shaft_tree_build(shaft_tree *, const shape *shapes, size_t count, vec3 lower, vec3 upper, int threads);
void shaft_tree_free(shaft_tree *);

#endif
