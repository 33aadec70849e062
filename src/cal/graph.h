/* Between trees and code: values and what they are computed from, with calls replaced by what they call.
 *
 * A variable, and an argument of a call, is one node however often it is used, so it is computed once at most; as
 * arguments are built when their function uses them, the language's laziness comes by itself. Only where functions call
 * themselves, and nothing known ends that, is there a call left, of a unit: a function with the functions that it was
 * given as arguments. Unit 0 is the expressions themselves.
 *
 * What can note or forget a fault (code.h) has an effect, and nodes with effects are never joined, so that faults are
 * what they are in Radiance. */
#ifndef CAL_GRAPH_H
#define CAL_GRAPH_H

#include <math.h>

#include "cal/compile.h"
#include "cal/program_internal.h"

typedef enum cal_value_kind {
    CAL_V_CONSTANT, /* with an effect: it also forgets faults, for a function was computed */
    CAL_V_CHANNEL,
    CAL_V_PARAMETER, /* of the unit */
    CAL_V_OF_MAIN,   /* other: a value of unit 0, seen from another unit */
    CAL_V_ADD,
    CAL_V_SUBTRACT,
    CAL_V_MULTIPLY,
    CAL_V_NEGATE,
    CAL_V_DIVIDE,
    CAL_V_REAL,    /* function of operands */
    CAL_V_IF,      /* of three operands */
    CAL_V_SELECT,  /* the first operand says which of the others */
    CAL_V_EXTREME, /* the least or greatest operand */
    CAL_V_CHECK,   /* the operand as value of a function of the library */
    CAL_V_ARGUMENT,
    CAL_V_CALL, /* of a unit */
    CAL_V_FAIL
} cal_value_kind;

typedef struct cal_value {
    cal_value_kind kind;
    bool effect;
    bool shared;   /* of unit 0, needed by others */
    bool is_named; /* of a variable or an argument */
    int index;     /* of a channel, parameter, unit or message */
    int count;
    int height;
    uint32_t uses;
    double number;
    const cal_function *function;
    struct cal_value **operands;
    struct cal_value *other;
    struct cal_value *next; /* of the same hash */
    /* While code is made of it: */
    struct cal_scope *scope; /* where its register holds it */
    uint32_t place, flag, entry;
    bool has_place, has_flag, is_marked;
} cal_value;

/* Not only equal, for 0 and -0 are two. */
static inline bool cal_is_same_number(double a, double b) {
    return a == b && signbit(a) == signbit(b);
}

/* What a parameter of a function is in one place where it is called. */
typedef struct cal_argument {
    const cal_node *tree;
    struct cal_call *outside; /* where the tree's own parameters are found */
    cal_value *value;         /* of the tree, once it was built; of a unit's parameter */
    cal_symbol *bound;        /* of a unit's parameter: the function that it is */
} cal_argument;

/* A function that is being built where it is called. */
typedef struct cal_call {
    const cal_symbol *symbol;
    struct cal_call *within; /* the function whose body calls, or null */
    int branches;            /* that may not be taken, around this call */
    int depth;
    int argument_count;
    cal_argument *arguments;
} cal_call;

/* A function that stays one: its key is the symbol and what its parameters are bound to. */
typedef struct cal_graph_unit {
    cal_symbol *symbol;
    cal_symbol **bound;
    int parameter_count;
    cal_value *result;
} cal_graph_unit;

enum { CAL_VALUE_HASH = 512 };

typedef struct cal_graph {
    arena *memory; /* for as long as the graph is needed */
    cal_program *program;
    const double *reals;
    size_t real_count;
    uint64_t channels; /* with a value */
    bool is_constant;  /* what is built is to be a constant: there is no primitive */
    const graze_report *report;
    const place *where;
    const char *expression; /* being built, or null: messages quote it */
    graze_status status;
    cal_graph_unit *units;
    int unit_count, unit_capacity;
    int unit;                             /* being built */
    cal_value *tables[2][CAL_VALUE_HASH]; /* values without effects, to be joined: of unit 0, of the other at hand */
    size_t value_count;
    int depth;
    cal_call *call; /* being built */
    int branches;
    /* Variables of unit 0 by symbol. */
    struct cal_variable *variables[CAL_VALUE_HASH];
    cal_value **shared; /* of unit 0, needed by others */
    size_t shared_count, shared_capacity;
    const char **messages; /* of CAL_V_FAIL, to last as long as the code */
    int message_count, message_capacity;
    int undefined_count; /* how many messages there were when the first name was not defined; 0: all are */
    arena *code_memory;
} cal_graph;

/* `code_memory` is for messages. */
void cal_graph_begin(cal_graph *, cal_program *, arena *memory, arena *code_memory, const graze_report *);
/* An output of unit 0; null after an error. */
cal_value *cal_graph_expression(cal_graph *, const cal_node *);
/* Builds the units that are called, until there are no more. */
graze_status cal_graph_finish(cal_graph *);

#endif
