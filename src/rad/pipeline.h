/* Commands of scene files, taken apart just far enough to do their `xform` stages here. */
#ifndef RAD_PIPELINE_H
#define RAD_PIPELINE_H

#include <stdbool.h>

#include "base/arena.h"

/* One `xform WORDS` of a command. words[0] is the program's name. */
typedef struct rad_stage {
    const char *const *words;
    int count;
} rad_stage;

/* `front | xform ... | xform ...` */
typedef struct rad_pipeline {
    const char *front; /* for the shell; or null where the first stage has no pipe before it */
    const rad_stage *stages;
    int stage_count;       /* 0: all of the command is `front` */
    bool front_is_options; /* the first stage reads arguments from its input (`-f -`): `front` gives these, no scene */
} rad_pipeline;

/* Splits the trailing xform stages off the command, as far as they need nothing of a shell but quotes and backslashes,
 * and as far as what stands before them is one pipeline. False when out of memory. */
bool rad_pipeline_split(rad_pipeline *, const char *command, arena *);

#endif
