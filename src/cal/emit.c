/* Code for arithmetic and calls, for what is computed at first need, and for units. */
#include "cal/emit.h"

#include "cal/emitter.h"

static void emit_multiply_add(cal_emitter *e, cal_value *v, cal_value *product, cal_value *term, bool product_first) {
    cal_value *a = product->operands[0], *b = product->operands[1];
    uint32_t c = 0, ra, rb;
    if (!product_first)
        c = cal_emit_value(e, term);
    ra = cal_emit_value(e, a);
    rb = cal_emit_value(e, b);
    if (product_first)
        c = cal_emit_value(e, term);
    cal_put(e, (cal_instruction){.op = CAL_OP_MULTIPLY_ADD, .d = cal_place_of(e, v), .a = ra, .b = rb, .c = c});
}

static bool can_multiply_add(const cal_value *v) {
    return cal_is_private(v, CAL_V_MULTIPLY) && !cal_is_plain_constant(v->operands[0]) &&
           !cal_is_plain_constant(v->operands[1]);
}

static void emit_add(cal_emitter *e, cal_value *v) {
    cal_value *a = v->operands[0], *b = v->operands[1];
    if (cal_is_plain_constant(a) || cal_is_plain_constant(b)) {
        const cal_value *k = cal_is_plain_constant(a) ? a : b;
        uint32_t r = cal_emit_value(e, k == a ? b : a);
        cal_put_op(e, CAL_OP_ADD_CONSTANT, cal_place_of(e, v), r, cal_constant_index(e, k->number));
    } else if (a != b && can_multiply_add(b)) {
        emit_multiply_add(e, v, b, a, false);
    } else if (a != b && can_multiply_add(a)) {
        emit_multiply_add(e, v, a, b, true);
    } else {
        uint32_t ra = cal_emit_value(e, a), rb = cal_emit_value(e, b);
        cal_put_op(e, CAL_OP_ADD, cal_place_of(e, v), ra, rb);
    }
}

static void emit_subtract(cal_emitter *e, cal_value *v) {
    cal_value *a = v->operands[0], *b = v->operands[1];
    if (cal_is_plain_constant(b)) {
        uint32_t r = cal_emit_value(e, a);
        cal_put_op(e, CAL_OP_ADD_CONSTANT, cal_place_of(e, v), r, cal_constant_index(e, -b->number));
    } else if (cal_is_plain_constant(a)) {
        uint32_t r = cal_emit_value(e, b);
        cal_put_op(e, CAL_OP_SUBTRACT_FROM, cal_place_of(e, v), r, cal_constant_index(e, a->number));
    } else {
        uint32_t ra = cal_emit_value(e, a), rb = cal_emit_value(e, b);
        cal_put_op(e, CAL_OP_SUBTRACT, cal_place_of(e, v), ra, rb);
    }
}

static void emit_multiply(cal_emitter *e, cal_value *v) {
    cal_value *a = v->operands[0], *b = v->operands[1];
    if (cal_is_plain_constant(a) || cal_is_plain_constant(b)) {
        const cal_value *k = cal_is_plain_constant(a) ? a : b;
        uint32_t r = cal_emit_value(e, k == a ? b : a);
        cal_put_op(e, CAL_OP_MULTIPLY_CONSTANT, cal_place_of(e, v), r, cal_constant_index(e, k->number));
    } else {
        uint32_t ra = cal_emit_value(e, a), rb = cal_emit_value(e, b);
        cal_put_op(e, CAL_OP_MULTIPLY, cal_place_of(e, v), ra, rb);
    }
}

/* The denominator comes first, and where it is 0 the numerator is not computed, for that may have effects. */
static void emit_divide(cal_emitter *e, cal_value *v) {
    cal_value *numerator = v->operands[0], *denominator = v->operands[1];
    uint32_t b = cal_emit_value(e, denominator), a, jump = 0;
    if (cal_is_plain_constant(numerator)) {
        cal_put_op(e, CAL_OP_DIVIDE_CONSTANT, cal_place_of(e, v), b, cal_constant_index(e, numerator->number));
        cal_may_fault(e);
        return;
    }
    bool skips = numerator->effect && !cal_is_at_hand(numerator);
    if (skips) {
        /* Where the register is known only later, the jump's target and it are set then. */
        jump = cal_put_op(e, CAL_OP_IF_ZERO, 0, b, 0);
        if (!cal_enter_scope(e))
            return;
        a = cal_emit_value(e, numerator);
        cal_leave_scope(e);
    } else {
        a = cal_emit_value(e, numerator);
    }
    uint32_t d = cal_place_of(e, v);
    cal_put_op(e, CAL_OP_DIVIDE, d, a, b);
    if (skips && !cal_emit_failed(e)) {
        e->code->instructions[jump].d = d;
        e->code->instructions[jump].b = cal_emit_here(e);
    }
    cal_may_fault(e);
}

/* An argument is given as it is where that costs nothing, else as code that computes it when it is needed. */
static uint32_t emit_later(cal_emitter *e, cal_value *v) {
    uint32_t jump = cal_put_op(e, CAL_OP_JUMP, 0, 0, 0), entry = cal_emit_here(e);
    bool no_fault = e->no_fault;
    e->no_fault = false;
    if (!cal_enter_scope(e))
        return 0;
    uint32_t r = cal_emit_value(e, v);
    cal_put_op(e, CAL_OP_ANSWER, 0, r, 0);
    cal_leave_scope(e);
    e->no_fault = no_fault;
    cal_emit_land(e, jump);
    return entry;
}

static void emit_call(cal_emitter *e, cal_value *v) {
    cal_instruction *gives = arena_allocate(e->graph->memory, (size_t)v->count * sizeof *gives);
    if (!gives) {
        cal_emit_out_of_memory(e);
        return;
    }
    for (int i = 0; i < v->count; i++) {
        cal_value *a = v->operands[i];
        bool at_hand = cal_is_at_hand(a) || cal_is_plain_constant(a) || a->kind == CAL_V_CHANNEL;
        gives[i] = (cal_instruction){.op = at_hand ? CAL_OP_GIVE_VALUE : CAL_OP_GIVE_LATER,
                                     .a = at_hand ? cal_emit_value(e, a) : emit_later(e, a)};
    }
    uint32_t d = cal_place_of(e, v);
    cal_put_op(e, CAL_OP_CALL, d, (uint32_t)v->index, (uint32_t)v->count);
    for (int i = 0; i < v->count; i++)
        cal_put(e, gives[i]);
    cal_may_fault(e);
}

static void emit_kind(cal_emitter *e, cal_value *v) {
    switch (v->kind) {
    case CAL_V_CONSTANT:
        if (v->effect && !e->no_fault) {
            cal_put_op(e, CAL_OP_FORGET, 0, 0, 0);
            e->no_fault = true;
        }
        cal_put_op(e, CAL_OP_CONSTANT, cal_place_of(e, v), 0, cal_constant_index(e, v->number));
        return;
    case CAL_V_CHANNEL:
        e->code->channels |= UINT64_C(1) << v->index;
        cal_put_op(e, CAL_OP_CHANNEL, cal_place_of(e, v), (uint32_t)v->index, 0);
        return;
    case CAL_V_PARAMETER:
        v->has_place = true;
        v->place = 2 * (uint32_t)v->index;
        cal_put_op(e, CAL_OP_NEED_PARAMETER, 0, v->place, 0);
        v->scope = e->scope;
        cal_may_fault(e);
        return;
    case CAL_V_OF_MAIN:
        cal_put_op(e, CAL_OP_NEED_OF_MAIN, v->other->entry, e->code->units[0].flags_begin + v->other->flag, 0);
        cal_put_op(e, CAL_OP_OF_MAIN, cal_place_of(e, v), v->other->place, 0);
        cal_may_fault(e);
        return;
    case CAL_V_ADD:
        emit_add(e, v);
        return;
    case CAL_V_SUBTRACT:
        emit_subtract(e, v);
        return;
    case CAL_V_MULTIPLY:
        emit_multiply(e, v);
        return;
    case CAL_V_NEGATE: {
        uint32_t r = cal_emit_value(e, v->operands[0]);
        cal_put_op(e, CAL_OP_NEGATE, cal_place_of(e, v), r, 0);
        return;
    }
    case CAL_V_DIVIDE:
        emit_divide(e, v);
        return;
    case CAL_V_REAL:
        cal_emit_real(e, v);
        return;
    case CAL_V_IF:
        cal_emit_if(e, v);
        return;
    case CAL_V_SELECT:
        cal_emit_select(e, v);
        return;
    case CAL_V_EXTREME:
        cal_emit_extreme(e, v);
        return;
    case CAL_V_CHECK:
        cal_emit_check(e, v);
        return;
    case CAL_V_ARGUMENT:
        cal_emit_argument(e, v);
        return;
    case CAL_V_CALL:
        emit_call(e, v);
        return;
    case CAL_V_FAIL:
        cal_put_op(e, CAL_OP_FAIL, cal_place_of(e, v), (uint32_t)v->index, 0);
        cal_may_fault(e);
        return;
    }
}

/* --- Values that are computed at first need --- */

static bool is_leaf(const cal_value *v) {
    return v->kind == CAL_V_CONSTANT || v->kind == CAL_V_CHANNEL || v->kind == CAL_V_PARAMETER ||
           v->kind == CAL_V_OF_MAIN || v->kind == CAL_V_FAIL;
}

/* Closes the scopes up to the unit's own, for code that others come to from elsewhere; all of them for a value that
 * functions need; or takes that back. */
static void close_scopes(cal_emitter *e, const cal_value *v, int closing) {
    for (cal_scope *s = e->scope; s && (s->outer || v->shared); s = s->outer)
        s->closed += closing;
}

static void emit_with_flag(cal_emitter *e, cal_value *v) {
    uint32_t enter = cal_put_op(e, CAL_OP_ENTER, 0, v->flag = e->flag_count++, 0);
    v->has_flag = true;
    v->entry = cal_emit_here(e);
    close_scopes(e, v, 1);
    e->no_fault = false;
    if (!cal_enter_scope(e))
        return;
    emit_kind(e, v);
    cal_leave_scope(e);
    close_scopes(e, v, -1);
    cal_put_op(e, CAL_OP_DONE, 0, v->flag, 0);
    cal_emit_land(e, enter);
    cal_may_fault(e);
    v->scope = e->scope;
}

uint32_t cal_emit_value(cal_emitter *e, cal_value *v) {
    if (cal_emit_failed(e))
        return 0;
    if (cal_is_at_hand(v))
        return v->place;
    if (v->has_flag) {
        cal_put_op(e, CAL_OP_NEED, v->entry, v->flag, 0);
        cal_may_fault(e);
        v->scope = e->scope;
    } else if (v->shared || (v->uses > 1 && e->scope->outer && !is_leaf(v))) {
        emit_with_flag(e, v);
    } else {
        emit_kind(e, v);
    }
    return v->place;
}

/* --- Units --- */

/* What a shared value needs and others need too is shared as well, for there is no telling who comes first. */
static void mark_shared(cal_value *v) {
    if (v->is_marked)
        return;
    v->is_marked = true;
    for (int i = 0; i < v->count; i++) {
        cal_value *operand = v->operands[i];
        if (operand->uses > 1 && !is_leaf(operand))
            operand->shared = true;
        mark_shared(operand);
    }
}

static void begin_unit(cal_emitter *e, uint32_t place_count) {
    e->place_count = place_count;
    e->flag_count = 0;
    e->first = cal_emit_here(e);
    e->scope = NULL;
    e->no_fault = false;
    cal_enter_scope(e);
}

static bool has_flag(uint16_t op) {
    return op == CAL_OP_ENTER || op == CAL_OP_NEED || op == CAL_OP_DONE;
}

/* Flags come behind the other registers, which now are known to be all. */
static void end_unit(cal_emitter *e, cal_unit *unit) {
    for (uint32_t i = e->first; i < cal_emit_here(e); i++)
        if (has_flag(e->code->instructions[i].op))
            e->code->instructions[i].a += e->place_count;
    *unit = (cal_unit){e->first, e->place_count + e->flag_count, e->place_count, e->flag_count};
    e->flags_total += e->flag_count;
}

static void emit_main(cal_emitter *e, cal_value *const *results, size_t count) {
    const cal_graph *g = e->graph;
    for (size_t i = 0; i < g->shared_count; i++)
        mark_shared(g->shared[i]);
    begin_unit(e, 0);
    e->no_fault = true;
    for (size_t i = 0; i < count; i++) {
        uint32_t r = cal_emit_value(e, results[i]);
        cal_put_op(e, CAL_OP_OUTPUT, (uint32_t)i, r, 0);
    }
    cal_put_op(e, CAL_OP_END, 0, 0, 0);
    /* Functions may need what no output does at once. */
    for (size_t i = 0; i < g->shared_count && !cal_emit_failed(e); i++)
        if (!g->shared[i]->has_flag)
            emit_with_flag(e, g->shared[i]);
    end_unit(e, &e->code->units[0]);
}

static void emit_unit(cal_emitter *e, int index) {
    const cal_graph_unit *unit = &e->graph->units[index];
    begin_unit(e, 2 * (uint32_t)unit->parameter_count);
    uint32_t r = cal_emit_value(e, unit->result);
    cal_put_op(e, CAL_OP_RETURN, 0, r, 0);
    end_unit(e, &e->code->units[index]);
}

graze_status cal_emit(struct cal_code *code, cal_graph *g, cal_value *const *results, size_t count) {
    cal_emitter e = {.graph = g, .code = code};
    code->unit_count = (uint32_t)g->unit_count;
    code->units = arena_allocate(code->memory, code->unit_count * sizeof *code->units);
    if (!code->units)
        return report_out_of_memory(g->report);
    emit_main(&e, results, count);
    for (int u = 1; u < g->unit_count && !cal_emit_failed(&e); u++)
        emit_unit(&e, u);
    code->messages = g->messages;
    code->undefined = g->undefined_count ? g->messages[g->undefined_count - 1] : NULL;
    code->message_count = (uint32_t)g->message_count;
    code->output_count = (uint32_t)count;
    code->return_count = e.flags_total + 1;
    return g->status;
}
