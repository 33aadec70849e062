/* From text to trees: the grammar of function files. Names are only read here; resolve.h finds what they mean.
 *
 *   statement:  name = sum;  name : sum;  name(name, ...) = sum;  name(name, ...) : sum;
 *   sum:        product { +|- product }
 *   product:    power { *|/ power }
 *   power:      sign [ ^ power ]
 *   sign:       [ +|- ] atom              so -x^2 is (-x)^2, and 2^-1 is allowed, but --x is not
 *   atom:       ( sum )  number  $digits  name  name(sum, ...)
 */
#ifndef CAL_SYNTAX_H
#define CAL_SYNTAX_H

#include "base/arena.h"
#include "base/report.h"
#include "cal/scanner.h"

typedef enum cal_kind {
    CAL_NUMBER,
    CAL_NAME, /* not yet resolved; with operands: a call */
    CAL_CHANNEL,
    CAL_NEGATIVE,
    CAL_SUM,     /* of two operands or more; as parsed, `inverse` ones are subtracted */
    CAL_PRODUCT, /* the same; `inverse` ones divide */
    CAL_POWER,
    /* Only in resolved trees: */
    CAL_DIFFERENCE,
    CAL_QUOTIENT,
    CAL_VARIABLE,  /* symbol */
    CAL_PARAMETER, /* the one of that index of the function that the tree is of */
    CAL_CALL       /* the first operand says of what: a variable or a parameter */
} cal_kind;

typedef struct cal_node {
    cal_kind kind;
    bool inverse;
    int line, column;
    int height; /* of the tree */
    int index;  /* of a channel from 1, of a parameter from 0 */
    int count;  /* of operands */
    double number;
    const char *name;
    struct cal_symbol *symbol;
    struct cal_node *first, *last, *next; /* operands; the next one of the tree above */
} cal_node;

typedef struct cal_statement {
    const char *name;
    int line, column;
    bool is_constant, is_function;
    int parameter_count;
    const char **parameters;
    cal_node *body;
} cal_statement;

typedef struct cal_parser {
    cal_scanner scanner;
    arena *memory;
    const graze_report *report;
    place where;            /* file and parents; messages add line and column */
    const char *expression; /* where the text is one expression of a scene: messages quote it and give the column */
    int depth;
    graze_status status;
} cal_parser;

void cal_node_append(cal_node *, cal_node *operand);

/* `text` need not outlive the trees. Errors have been reported when the status is not GRAZE_OK. */
void cal_parse_begin(cal_parser *, const char *text, size_t length, arena *, const graze_report *);
/* The next statement; *found is false at the text's end. */
graze_status cal_parse_statement(cal_parser *, cal_statement *, bool *found);
/* The whole text as one expression. */
graze_status cal_parse_expression(cal_parser *, cal_node **);
/* Reports an error at that place of the parser's text. */
graze_status cal_complain(const cal_parser *, int line, int column, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
