/* A group's surfaces and copies counted and measured, in blocks that threads share, before Embree gets them. */
#ifndef GEOMETRY_SURVEY_H
#define GEOMETRY_SURVEY_H

#include "geometry/geometry_internal.h"

typedef struct geometry_box {
    vec3 lower, upper;
} geometry_box;

static inline geometry_box geometry_box_join(geometry_box a, geometry_box b) {
    return (geometry_box){vec3_min(a.lower, b.lower), vec3_max(a.upper, b.upper)};
}

static inline double geometry_box_reach(geometry_box b) {
    return double_max(vec3_max_abs(b.lower), vec3_max_abs(b.upper));
}

/* What is found out of some neighbouring surfaces at a time. */
typedef struct geometry_block {
    geometry_box bounds;
    size_t triangles, curved;            /* how many */
    size_t first_triangle, first_curved; /* where they go among all */
} geometry_block;

enum { GEOMETRY_BLOCK_SIZE = 2048 };

/* The blocks of a tree, and what threads fill in by them. */
typedef struct geometry_survey {
    geometry_tree *tree;
    geometry_block *blocks;
    size_t count;
    float *vertices; /* Embree's */
    unsigned *indices;
} geometry_survey;

static inline size_t geometry_block_end(const geometry_survey *s, size_t index) {
    size_t end = (index + 1) * GEOMETRY_BLOCK_SIZE;
    return end < s->tree->shape_count ? end : s->tree->shape_count;
}

/* Finds the extent of all, and how many triangles and curved surfaces there are. False: there is no memory. */
bool geometry_survey_make(const geometry *, geometry_survey *, int threads);

/* Lays out a polygon's triangles, but for what Embree's errors do to them. */
void geometry_collect_polygon(const geometry_tree *, int surface, geometry_triangle *);

#endif
