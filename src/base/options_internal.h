/* What the files that make up options.h share. */
#ifndef BASE_OPTIONS_INTERNAL_H
#define BASE_OPTIONS_INTERNAL_H

#include "base/arena.h"
#include "base/options.h"

struct options_arguments {
    arena *memory; /* of the words */
    const char **words;
    int count, capacity;
};

/* To standard output; a write that fails is an error. */
graze_status options_print_defaults(const option_table *, const graze_report *);
graze_status options_print_help(const option_table *, const graze_report *);
graze_status options_print_version(const option_table *, const graze_report *);

#endif
