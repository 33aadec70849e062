/* What the parts of a program share. */
#ifndef CAL_PROGRAM_INTERNAL_H
#define CAL_PROGRAM_INTERNAL_H

#include "cal/program.h"
#include "cal/symbols.h"

typedef struct cal_file {
    const char *context;
    graze_status status;
    struct cal_file *next;
} cal_file;

struct cal_program {
    arena *memory;
    cal_symbols symbols;
    cal_file *files; /* those that were read */
    uint64_t fingerprint;
};

/* Resolves the names of a tree that the parser made, and computes constants. `function` is the statement that the tree
 * is the body of, where it has parameters, else null; `passed` then tells of each of them whether it may be a function.
 * Null after an error, which has been reported. */
cal_node *cal_resolve(cal_program *, const cal_parser *, const char *context, const cal_statement *function,
                      bool *passed, cal_node *, graze_status *);

#endif
