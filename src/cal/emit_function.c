/* Code for the library's functions. */
#include "cal/emitter.h"

#include <string.h>

/* Before the arguments of a function of the library. Gives whether its instruction shall be `fresh`: where its
 * arguments have no effect it forgets faults itself. */
static bool begin_function(cal_emitter *e, const cal_value *v) {
    bool has_effect = false;
    for (int i = 0; i < v->count; i++)
        has_effect = has_effect || (v->operands[i]->effect && !cal_is_at_hand(v->operands[i]));
    if (!has_effect)
        return !e->no_fault;
    if (!e->no_fault)
        cal_put_op(e, CAL_OP_FORGET, 0, 0, 0);
    e->no_fault = true;
    return false;
}

static void end_function(cal_emitter *e, bool fresh, cal_instruction instruction) {
    instruction.fresh = fresh;
    cal_put(e, instruction);
    cal_may_fault(e);
}

static bool is_power(const cal_function *f, const cal_value *v, double exponent) {
    return f == cal_library_power() && cal_is_plain_constant(v->operands[1]) && v->operands[1]->number == exponent;
}

static cal_instruction real_1_instruction(cal_emitter *e, const cal_function *f, uint32_t a) {
    cal_instruction i = {.op = CAL_OP_REAL_1, .a = a};
    if (strcmp(f->name, "floor") == 0)
        i.op = CAL_OP_FLOOR;
    else if (strcmp(f->name, "sqrt") == 0)
        i.op = CAL_OP_SQRT;
    else
        i.b = cal_function_index(e, f);
    return i;
}

/* Of two arguments the second is computed first, of three the first. */
void cal_emit_real(cal_emitter *e, cal_value *v) {
    const cal_function *f = v->function;
    cal_instruction i;
    bool fresh = begin_function(e, v);
    if (v->count == 1) {
        i = real_1_instruction(e, f, cal_emit_value(e, v->operands[0]));
    } else if (v->count == 3) {
        i = (cal_instruction){.op = CAL_OP_NOISE, .extra = (uint8_t)f->noise};
        i.a = cal_emit_value(e, v->operands[0]);
        i.b = cal_emit_value(e, v->operands[1]);
        i.c = cal_emit_value(e, v->operands[2]);
    } else if (is_power(f, v, 2)) {
        i = (cal_instruction){.op = CAL_OP_SQUARE, .a = cal_emit_value(e, v->operands[0])};
    } else {
        i = (cal_instruction){.op = CAL_OP_REAL_2, .c = cal_function_index(e, f)};
        i.b = cal_emit_value(e, v->operands[1]);
        i.a = cal_emit_value(e, v->operands[0]);
    }
    i.d = cal_place_of(e, v);
    end_function(e, fresh, i);
}

/* Computes v in a scope of its own, into register d. */
static void emit_branch(cal_emitter *e, cal_value *v, uint32_t d) {
    cal_value *wanted = e->wanted;
    uint32_t into = e->into;
    if (!cal_enter_scope(e))
        return;
    bool may_place = v->uses == 1 && !v->shared && !v->has_place && v->kind != CAL_V_PARAMETER;
    e->wanted = may_place ? v : NULL;
    e->into = d;
    uint32_t r = cal_emit_value(e, v);
    if (r != d)
        cal_put_op(e, CAL_OP_MOVE, d, r, 0);
    e->wanted = wanted;
    e->into = into;
    cal_leave_scope(e);
}

/* Jumps unless the condition is above 0: a difference is not computed for that. */
static uint32_t emit_condition(cal_emitter *e, cal_value *v) {
    if (cal_is_private(v, CAL_V_SUBTRACT) && cal_is_plain_constant(v->operands[0])) {
        uint32_t r = cal_emit_value(e, v->operands[1]);
        return cal_put_op(e, CAL_OP_UNLESS_BELOW_CONSTANT, 0, r, cal_constant_index(e, v->operands[0]->number));
    }
    if (cal_is_private(v, CAL_V_SUBTRACT) && !cal_is_plain_constant(v->operands[1])) {
        uint32_t a = cal_emit_value(e, v->operands[0]), b = cal_emit_value(e, v->operands[1]);
        return cal_put_op(e, CAL_OP_UNLESS_ABOVE, 0, a, b);
    }
    if (cal_is_private(v, CAL_V_ADD) && cal_is_plain_constant(v->operands[1])) {
        uint32_t r = cal_emit_value(e, v->operands[0]);
        return cal_put_op(e, CAL_OP_UNLESS_ABOVE_CONSTANT, 0, r, cal_constant_index(e, -v->operands[1]->number));
    }
    return cal_put_op(e, CAL_OP_UNLESS_POSITIVE, 0, cal_emit_value(e, v), 0);
}

void cal_emit_if(cal_emitter *e, cal_value *v) {
    bool fresh = begin_function(e, v);
    uint32_t otherwise = emit_condition(e, v->operands[0]);
    bool no_fault = e->no_fault;
    uint32_t d = cal_place_of(e, v);
    v->scope = NULL;
    emit_branch(e, v->operands[1], d);
    uint32_t end = cal_put_op(e, CAL_OP_JUMP, 0, 0, 0);
    cal_emit_land(e, otherwise);
    e->no_fault = no_fault;
    emit_branch(e, v->operands[2], d);
    cal_emit_land(e, end);
    end_function(e, fresh, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
    v->scope = e->scope;
}

void cal_emit_select(cal_emitter *e, cal_value *v) {
    int branches = v->count - 1;
    bool fresh = begin_function(e, v);
    uint32_t which = cal_emit_value(e, v->operands[0]), d = cal_place_of(e, v);
    /* It may note a fault itself, so it, and not the end, forgets those before. */
    uint32_t table =
        cal_put(e, (cal_instruction){.op = CAL_OP_SELECT, .fresh = fresh, .d = d, .a = which, .b = (uint32_t)branches});
    v->scope = NULL;
    /* Where the count is asked for, or nothing is selected, it goes on at the first of these. */
    for (int i = 0; i <= branches; i++)
        cal_put_op(e, CAL_OP_JUMP, 0, 0, 0);
    uint32_t *ends = arena_allocate(e->graph->memory, (size_t)(branches + 1) * sizeof *ends);
    if (!ends) {
        cal_emit_out_of_memory(e);
        return;
    }
    bool no_fault = e->no_fault;
    for (int i = 1; i <= branches; i++) {
        cal_emit_land(e, table + 1 + (uint32_t)i);
        e->no_fault = no_fault;
        emit_branch(e, v->operands[i], d);
        ends[i] = cal_put_op(e, CAL_OP_JUMP, 0, 0, 0);
    }
    for (int i = 1; i <= branches; i++)
        cal_emit_land(e, ends[i]);
    cal_emit_land(e, table + 1);
    cal_may_fault(e);
    end_function(e, false, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
    v->scope = e->scope;
}

/* The first argument, then from the last down to the second. */
void cal_emit_extreme(cal_emitter *e, cal_value *v) {
    cal_op op = v->function->kind == CAL_MIN ? CAL_OP_MINIMUM : CAL_OP_MAXIMUM;
    bool fresh = begin_function(e, v);
    uint32_t r = cal_emit_value(e, v->operands[0]), d = 0;
    for (int i = v->count - 1; i > 0; i--) {
        uint32_t next = cal_emit_value(e, v->operands[i]);
        d = cal_place_of(e, v);
        v->scope = NULL;
        cal_put_op(e, op, d, r, next);
        r = d;
    }
    end_function(e, fresh, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
    v->scope = e->scope;
}

void cal_emit_check(cal_emitter *e, cal_value *v) {
    bool fresh = begin_function(e, v);
    uint32_t r = cal_emit_value(e, v->operands[0]), d = cal_place_of(e, v);
    cal_put_op(e, CAL_OP_MOVE, d, r, 0);
    end_function(e, fresh, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
}

void cal_emit_argument(cal_emitter *e, cal_value *v) {
    bool fresh = begin_function(e, v);
    uint32_t r = cal_emit_value(e, v->operands[0]);
    end_function(e, fresh,
                 (cal_instruction){.op = CAL_OP_ARGUMENT, .d = cal_place_of(e, v), .a = r, .b = (uint32_t)v->index});
}
