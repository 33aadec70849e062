/* Names and what they stand for. Each function file is a context: a name in it is looked for there, then outside.
 *
 * A name is kept with its context behind a mark: x`file is the x of file.cal, x`part`file that of a context in it, and
 * x the one that all files see. Written in a file, x` means the outermost x alone, and `x the one of that file alone.
 */
#ifndef CAL_SYMBOLS_H
#define CAL_SYMBOLS_H

#include "base/arena.h"
#include "base/report.h"
#include "cal/library.h"
#include "cal/syntax.h"

typedef struct cal_definition {
    bool is_constant, is_function;
    int parameter_count;
    bool *passed;   /* of parameters: it is called, or handed on as it is, and may so be a function */
    cal_node *body; /* resolved */
    const char *file;
    int line, column;
} cal_definition;

typedef struct cal_symbol {
    const char *name;
    const cal_function *library; /* of that name, or null */
    cal_definition *definition;  /* the one in force, or null */
    struct cal_symbol *next;     /* of the same hash */
} cal_symbol;

enum { CAL_HASH_SIZE = 1024 };

typedef struct cal_symbols {
    arena *memory;
    cal_symbol *table[CAL_HASH_SIZE];
} cal_symbols;

/* The context of a file: its name without .cal, and with _ for what names cannot have in them; "" for the name "." or
 * none. Null when out of memory. */
const char *cal_context_of_file(arena *, const char *file);

/* Null where the name has nothing to mean yet. */
cal_symbol *cal_symbols_find(cal_symbols *, const char *context, const char *name);
/* What a name that is used means: it becomes the inmost context's own where it means nothing yet. Null when out of
 * memory. */
cal_symbol *cal_symbols_use(cal_symbols *, const char *context, const char *name);
/* What a name that is defined means: always the inmost context's own. Null when out of memory. */
cal_symbol *cal_symbols_define(cal_symbols *, const char *context, const char *name);

#endif
