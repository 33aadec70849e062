/* Code in the making: every value once, where it is first needed.
 *
 * A branch that may not be taken is a scope: what is computed in it is not known to be computed behind it. A value that
 * is first needed in such a scope, and again elsewhere, gets a flag, and code that is gone to and left (code.h). */
#ifndef CAL_EMITTER_H
#define CAL_EMITTER_H

#include "cal/code.h"
#include "cal/graph.h"

typedef struct cal_scope {
    struct cal_scope *outer;
    int closed; /* 0: what was computed in it is there */
} cal_scope;

typedef struct cal_emitter {
    cal_graph *graph;
    struct cal_code *code;
    uint32_t instruction_capacity, constant_capacity, function_capacity;
    cal_scope *scope;
    cal_value *wanted; /* of what is emitted next, the value that shall be in the register `into` */
    uint32_t into;
    uint32_t place_count, flag_count, first; /* of the unit */
    uint32_t flags_total;
    bool no_fault; /* none is noted at this point, whatever happened before */
} cal_emitter;

/* After an error all go on without harm. */
bool cal_emit_failed(const cal_emitter *);
void cal_emit_out_of_memory(cal_emitter *);

/* Adds an instruction, and gives its index. */
uint32_t cal_put(cal_emitter *, cal_instruction);
uint32_t cal_put_op(cal_emitter *, cal_op, uint32_t d, uint32_t a, uint32_t b);
uint32_t cal_emit_here(const cal_emitter *); /* the index of the next */
/* The jump goes to what comes next. */
void cal_emit_land(cal_emitter *, uint32_t jump);
uint32_t cal_constant_index(cal_emitter *, double);
uint32_t cal_function_index(cal_emitter *, const cal_function *);

cal_scope *cal_enter_scope(cal_emitter *);
void cal_leave_scope(cal_emitter *);
/* It is in its register. */
bool cal_is_at_hand(const cal_value *);
/* The register for what is computed next, which then is at hand in this scope. */
uint32_t cal_place_of(cal_emitter *, cal_value *);
void cal_may_fault(cal_emitter *);

bool cal_is_plain_constant(const cal_value *);
/* A value computed here and used here alone, so that its instruction may be part of another. */
bool cal_is_private(const cal_value *, cal_value_kind);

/* Code that computes it, unless it is at hand; gives its register. */
uint32_t cal_emit_value(cal_emitter *, cal_value *);
void cal_emit_real(cal_emitter *, cal_value *);
void cal_emit_if(cal_emitter *, cal_value *);
void cal_emit_select(cal_emitter *, cal_value *);
void cal_emit_extreme(cal_emitter *, cal_value *);
void cal_emit_check(cal_emitter *, cal_value *);
void cal_emit_argument(cal_emitter *, cal_value *);

#endif
