/* From text to primitives as they are written: words and numbers, not yet linked to each other. */
#ifndef RAD_READER_H
#define RAD_READER_H

#include "base/arena.h"
#include "rad/types.h"

/* Types of a rad_raw beyond rad_type. */
enum { RAD_ALIAS = RAD_TYPE_COUNT, RAD_UNKNOWN };

typedef struct rad_raw {
    int type;
    bool broken; /* an error in it has been reported: its arguments may not be what its type needs */
    const char *modifier, *id;
    uint32_t string_count, real_count;
    const char *const *strings; /* of an alias: the one that it stands for */
    double *reals;              /* whoever is given the primitive may change them */
    const place *where;
} rad_raw;

/* Where primitives go. */
typedef struct rad_sink {
    graze_status (*take)(void *user, rad_raw *);
    void *user;
} rad_sink;

typedef struct rad_reader {
    arena *memory; /* for all that primitives point to */
    const graze_report *report;
    int threads;         /* that may read one text */
    graze_status status; /* of the first error that reading went on after */
    int error_count;
    /* Neighbouring primitives mostly share these. */
    const char *last_modifier;
    rad_type last_type;
    /* Arguments while they are being read. */
    double *reals;
    const char **strings;
    size_t real_capacity, string_capacity;
} rad_reader;

void rad_reader_begin(rad_reader *, arena *, const graze_report *);
void rad_reader_end(rad_reader *);

/* What an input is read for. */
typedef struct rad_context {
    const char *directory; /* of its commands; null: this process's own */
    const place *parent;   /* where it is named; null: on the command line */
    int depth;             /* of inputs in inputs */
} rad_context;

/* All these hand on an error that reading cannot go on after; of the others see rad_reader's status. */
graze_status rad_reader_file(rad_reader *, const char *path, const rad_context *, const rad_sink *);
graze_status rad_reader_standard_input(rad_reader *, const rad_context *, const rad_sink *);
/* Runs a command (without its `!`), with its xform stages done here. */
graze_status rad_reader_command(rad_reader *, const char *command, const rad_context *, const rad_sink *);
/* The shell's part of it. */
graze_status rad_reader_shell(rad_reader *, const char *command, const rad_context *, const rad_sink *);

/* Complains of argument counts that are not those of its type. */
graze_status rad_reader_check(rad_reader *, rad_raw *);

/* For messages; "" before its name is known. */
rad_primitive_name rad_describe(const rad_raw *);

/* Reports an error that reading may go on after; gives the error's status when there have been too many of them. */
graze_status rad_reader_complain(rad_reader *, const place *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same of a type that there is not, of the primitive of this name (null where it has none). */
graze_status rad_complain_of_type(rad_reader *, const place *where, const char *type, const char *id);

/* A word of the input as messages show it: cut where it is long, without what would upset a terminal. */
typedef struct rad_shown {
    char text[80];
} rad_shown;
rad_shown rad_show(const char *text, size_t length);

#endif
