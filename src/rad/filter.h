/* What one xform does to each primitive that passes it. */
#ifndef RAD_FILTER_H
#define RAD_FILTER_H

#include "rad/reader.h"
#include "rad/transform.h"

typedef struct rad_filter {
    const char *modifier; /* for all surfaces; or null. Lives as long as what it is given to */
    const char *prefix;   /* before the names of all surfaces; or null */
    bool invert;          /* turn surfaces inside out */
    rad_transform transform;
    const char *const *words; /* the transform as it was written */
    int word_count;
} rad_filter;

/* Changes the primitive; its real arguments where they are. */
graze_status rad_filter_apply(const rad_filter *, rad_reader *, rad_raw *);

/* "prefix.name"; null when out of memory. */
const char *rad_join_names(arena *, const char *prefix, const char *name);

#endif
