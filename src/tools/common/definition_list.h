/* Definitions for function files from the command line, -e and -f; and the file for messages that -e may name instead.
 */
#ifndef TOOLS_COMMON_DEFINITION_LIST_H
#define TOOLS_COMMON_DEFINITION_LIST_H

#include "base/arena.h"
#include "base/options.h"
#include "graze/scene.h"

/* Begins as {0}. */
typedef struct definition_list {
    const char *error_file; /* null: standard error */
    graze_definitions *definitions;
    size_t count, capacity;
    arena *memory; /* of their names in messages; null: none */
} definition_list;

/* For an option table: each is the `handle` of its option, with the list as target. */

/* -e WORD: with = or : in it definitions, else the name of a file for messages. */
graze_status definition_list_take_expression(void *target, const char *suffix, int count, const char *const *words,
                                             int *used, const graze_report *);
/* -f FILE: a function file. */
graze_status definition_list_take_file(void *target, const char *suffix, int count, const char *const *words, int *used,
                                       const graze_report *);
/* Prints all of it, re-readable: for one of the two. */
void definition_list_print(void *target, FILE *);

void definition_list_free(definition_list *);

#endif
