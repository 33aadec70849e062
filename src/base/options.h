/* Radiance-style command lines: `-x 512`, `-av .1 .1 .1`, `-bv-`, `-fad`, `-vtv`, and Graze's own `--error .02`. */
#ifndef BASE_OPTIONS_H
#define BASE_OPTIONS_H

#include <stdbool.h>
#include <stdio.h>

#include "base/number.h"
#include "base/report.h"

typedef enum option_kind {
    OPTION_HEADING, /* no option: `help` is a heading in --help's text */
    OPTION_FLAG,    /* bool: `-bv` toggles, `--angles` sets; one of +1yYtT behind the name sets, of -0nNfF clears */
    OPTION_INTEGER, /* int */
    OPTION_REAL,    /* double; `[+-]digits[.digits][e[+-]digits]`, never inf, nan or hexadecimal */
    OPTION_REAL3,   /* double[3] */
    OPTION_TEXT,    /* const char *: lives as long as the options_arguments */
    OPTION_SUFFIX,  /* const char *: the letters behind the name in the same word, as in -fad, -ovn, -vtv; `handle`
                     * takes them in its place, if there is one */
    OPTION_CUSTOM,  /* `handle` takes what words it needs; a short name also matches longer words, as -v does -vtv */
} option_kind;

typedef struct option {
    const char *name; /* with its dashes: "-ab", "--error" */
    option_kind kind;
    void *target;          /* of the kind's type; for OPTION_CUSTOM handed to `handle` */
    const char *arguments; /* for --help: "N", "r g b", "FILE" */
    const char *help;      /* one line; null: left out of --help */
    double low, high;      /* for INTEGER and REAL(3): the closed range allowed, HUGE_VAL for no limit; both 0: any */
    /* OPTION_CUSTOM and OPTION_SUFFIX: gets the words that follow the name (`suffix` is what stands behind the name in
     * its own word, or ""), puts into *used how many words it took. */
    graze_status (*handle)(void *target, const char *suffix, int count, const char *const *words, int *used,
                           const graze_report *report);
    /* Goes with `handle`: prints the option with its present value, re-readable, for -defaults. Null: not printed. */
    void (*print)(void *target, FILE *out);
} option;

/* A program's whole command line: the table and the texts of --help and --version. */
typedef struct option_table {
    const char *program;  /* "gtrace" */
    const char *synopsis; /* "[options] scene..." */
    const char *summary;  /* one line */
    const option *options;
    int count;
} option_table;

/* The words of a command line (without the program's name) after `$NAME` and `@file` were replaced by the words they
 * stand for: recursively, a bounded number of times, so that a file naming itself is an error; not behind a `--`. Owns
 * the words.
 *
 * In the replacing text blanks divide words; '...', "..." and a backslash protect them as in a shell, and what begins
 * with such a quote is not replaced again. A word that begins with # makes the rest of the line a comment. */
typedef struct options_arguments options_arguments;
graze_status options_expand(options_arguments **, int argc, char **argv, const graze_report *);
void options_arguments_destroy(options_arguments *);

typedef enum options_outcome {
    OPTIONS_RUN,  /* go on: the operands are what is left */
    OPTIONS_DONE, /* --help, --version, -version, -defaults or -help was asked for and has been printed: exit 0 */
} options_outcome;

/* Reads the options up to the first word that is not one (`--` ends them; a lone `-` is an operand), stores their
 * values, and gives the operands, which live as long as the options_arguments. Where several options match a word, the
 * one with the longest name is meant. Long options also take their argument as `--name=value`. Unknown option, missing
 * or malformed or out-of-range argument: an error that names the word. -defaults (or -help) prints every option with
 * its present value in re-readable form (options before it reflected) to standard output. */
graze_status options_parse(const option_table *, options_arguments *, int *operand_count, const char *const **operands,
                           options_outcome *, const graze_report *);
/* The option with its value, as -defaults prints it and without its help: "" where it has none. To be freed; null when
 * out of memory. */
char *options_value(const option *);
/* A word in quotes where a shell or a file of options would need them, for `print`. */
void options_print_word(FILE *, const char *word);
/* All words as given (before expansion), quoted where a shell would need it, for headers; line breaks become blanks. In
 * `buffer`, cut to `size`. */
void options_command_line(char *buffer, size_t size, int argc, char **argv);

/* A report that writes "PROGRAM: error: TEXT" and "PROGRAM: warning: TEXT" to standard error, in colour on a terminal
 * unless NO_COLOR is set. `program` must outlive it. */
graze_report options_standard_error_report(const char *program);

#endif
