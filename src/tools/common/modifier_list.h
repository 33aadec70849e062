/* Modifiers named on the command line, or in files, to leave out or to take alone: -ae -aE -ai -aI, -te -tE -ti -tI. */
#ifndef TOOLS_COMMON_MODIFIER_LIST_H
#define TOOLS_COMMON_MODIFIER_LIST_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/options.h"

/* Begins with its letter alone. */
typedef struct modifier_list {
    char letter;  /* of the four options: a or t */
    bool given;   /* any of them has been */
    bool include; /* these alone; else: all but these */
    const char **names;
    size_t count, capacity;
    arena *memory; /* of names from files */
} modifier_list;

/* For an option table: each is the `handle` of one option, with the list as its target. A file, looked for along
 * RAYPATH, holds names with white space between; one that is empty gets a warning. Excluding some and including others
 * is an error. */
graze_status modifier_list_exclude(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *);
graze_status modifier_list_include(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *);
graze_status modifier_list_exclude_file(void *target, const char *suffix, int count, const char *const *words,
                                        int *used, const graze_report *);
graze_status modifier_list_include_file(void *target, const char *suffix, int count, const char *const *words,
                                        int *used, const graze_report *);
/* Prints the whole list, re-readable: for one of the four. */
void modifier_list_print(void *target, FILE *);

/* Whether the list has what a surface's modifier (null: none) is kept for. */
bool modifier_list_keeps(const modifier_list *, const char *modifier);

void modifier_list_free(modifier_list *);

#endif
