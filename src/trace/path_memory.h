/* What the paths of one estimate need not find out again and again. */
#ifndef TRACE_PATH_MEMORY_H
#define TRACE_PATH_MEMORY_H

#include "geometry/shaft.h"
#include "trace/gathering.h"
#include "trace/gleams.h"
#include "trace/unshadowed.h"

/* A scene has few lights if it has no more than this. At the first point all of few lights are sampled, and each has a
 * memory and a control of its own. */
enum { PATH_FEW_LIGHTS = 8 };

/* What is known of a light at the first point. */
typedef struct path_memory_light {
    geometry_visibility seen;
    bool integrated; /* `whole` is known */
    unshadowed_light whole;
    bool kept;       /* the above is what the next path would find, too */
    int times_mixed; /* how often it was in vain to ask whether the light is seen */
} path_memory_light;

/* Light that is looked for after so many mirrors and passages (trace/unmet_light.h), and what would be found of it if
 * nothing stood in its way. */
typedef struct path_unmet_at {
    int depth, passages;
    int surface, light; /* of a light in a mirror: a surface of that, and the light; else negative */
    bool met;           /* some of it was found */
    double expected;
} path_unmet_at;

/* Of lights in mirrors, half as many at most. */
enum { PATH_UNMET = 16 };

typedef struct path_unmet {
    int count;
    path_unmet_at at[PATH_UNMET];
} path_unmet;

/* Belongs to the estimate, whose paths come one after another. */
typedef struct path_memory {
    bool alike;                                /* all paths have the same first point */
    gathering first;                           /* where they do */
    path_memory_light lights[PATH_FEW_LIGHTS]; /* so many of them have been asked for: */
    int light_count;
    path_unmet unmet;
    bool gleams_found;
    gleams gleams; /* as the first point sees them, where all paths have the same */
} path_memory;

/* Nothing is known yet. What is not set here is not read before it is; to clear all of it would take longer than many a
 * path. */
static inline void path_memory_begin(path_memory *memory, bool alike) {
    memory->alike = alike;
    memory->first.decided = memory->gleams_found = false;
    memory->unmet.count = memory->light_count = 0;
}

/* What is known of a light, which may be nothing yet. */
static inline path_memory_light *path_memory_of_light(path_memory *memory, int light) {
    for (; memory->light_count <= light; memory->light_count++) {
        memory->lights[memory->light_count].kept = false;
        memory->lights[memory->light_count].times_mixed = 0;
    }
    return &memory->lights[light];
}

#endif
