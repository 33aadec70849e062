/* Emitting code: every value once, where it is first needed.
 *
 * A branch that may not be taken is a scope: what is computed in it is not known to be computed behind it. A value that
 * is first needed in such a scope, and again elsewhere, gets a flag, and code that is gone to and left (code.h). */
#include "cal/emit.h"

#include <string.h>

typedef struct cal_scope {
    struct cal_scope *outer;
    int closed; /* 0: what was computed in it is there */
} cal_scope;

typedef struct emitter {
    cal_graph *graph;
    struct cal_code *code;
    uint32_t instruction_capacity, constant_capacity, function_capacity;
    cal_scope *scope;
    cal_value *wanted; /* of what is emitted next, the value that shall be in the register `into` */
    uint32_t into;
    uint32_t place_count, flag_count, first; /* of the unit */
    uint32_t flags_total;
    bool no_fault; /* none is noted at this point, whatever happened before */
} emitter;

static uint32_t emit(emitter *, cal_value *);

static bool failed(const emitter *e) {
    return e->graph->status != GRAZE_OK;
}

static void out_of_memory(emitter *e) {
    if (!e->graph->status)
        e->graph->status = report_out_of_memory(e->graph->report);
}

/* Room for one more; null where there is none. */
static void *grow(emitter *e, void *items, uint32_t count, uint32_t *capacity, size_t size) {
    if (count < *capacity)
        return items;
    uint32_t larger = *capacity ? 2 * *capacity : 32;
    void *more = arena_allocate(e->code->memory, larger * size);
    if (!more) {
        out_of_memory(e);
        return NULL;
    }
    if (count)
        memcpy(more, items, count * size);
    *capacity = larger;
    return more;
}

static uint32_t put(emitter *e, cal_instruction instruction) {
    struct cal_code *code = e->code;
    cal_instruction *items =
        grow(e, code->instructions, code->instruction_count, &e->instruction_capacity, sizeof *items);
    if (!items)
        return 0;
    code->instructions = items;
    items[code->instruction_count] = instruction;
    return code->instruction_count++;
}

static uint32_t put_op(emitter *e, cal_op op, uint32_t d, uint32_t a, uint32_t b) {
    return put(e, (cal_instruction){.op = (uint16_t)op, .d = d, .a = a, .b = b});
}

static uint32_t here(const emitter *e) {
    return e->code->instruction_count;
}

/* The jump goes to what comes next. */
static void land(emitter *e, uint32_t jump) {
    if (!failed(e))
        e->code->instructions[jump].d = here(e);
}

static uint32_t constant_index(emitter *e, double number) {
    struct cal_code *code = e->code;
    for (uint32_t i = 0; i < code->constant_count; i++)
        if (memcmp(&code->constants[i], &number, sizeof number) == 0)
            return i;
    double *items = grow(e, code->constants, code->constant_count, &e->constant_capacity, sizeof *items);
    if (!items)
        return 0;
    code->constants = items;
    items[code->constant_count] = number;
    return code->constant_count++;
}

static uint32_t function_index(emitter *e, const cal_function *function) {
    struct cal_code *code = e->code;
    for (uint32_t i = 0; i < code->function_count; i++)
        if (code->functions[i] == function)
            return i;
    const cal_function **items = grow(e, code->functions, code->function_count, &e->function_capacity, sizeof *items);
    if (!items)
        return 0;
    code->functions = items;
    items[code->function_count] = function;
    return code->function_count++;
}

/* --- Scopes and places ----------------------------------------------------------------------------------------------
 */

static cal_scope *enter_scope(emitter *e) {
    cal_scope *scope = arena_allocate(e->graph->memory, sizeof *scope);
    if (!scope) {
        out_of_memory(e);
        return NULL;
    }
    *scope = (cal_scope){e->scope, 0};
    return e->scope = scope;
}

static void leave_scope(emitter *e) {
    e->scope->closed++;
    e->scope = e->scope->outer;
}

static bool is_at_hand(const cal_value *v) {
    return v->scope && v->scope->closed == 0;
}

static uint32_t place_of(emitter *e, cal_value *v) {
    if (!v->has_place) {
        v->has_place = true;
        v->place = e->wanted == v ? e->into : e->place_count++;
    }
    v->scope = e->scope;
    return v->place;
}

static void may_fault(emitter *e) {
    e->no_fault = false;
}

/* Before the arguments of a function of the library. Gives whether its instruction shall be `fresh`: where its
 * arguments have no effect it forgets faults itself. */
static bool begin_function(emitter *e, const cal_value *v) {
    bool has_effect = false;
    for (int i = 0; i < v->count; i++)
        has_effect = has_effect || (v->operands[i]->effect && !is_at_hand(v->operands[i]));
    if (!has_effect)
        return !e->no_fault;
    if (!e->no_fault)
        put_op(e, CAL_OP_FORGET, 0, 0, 0);
    e->no_fault = true;
    return false;
}

static void end_function(emitter *e, bool fresh, cal_instruction instruction) {
    instruction.fresh = fresh;
    put(e, instruction);
    may_fault(e);
}

/* --- Values ---------------------------------------------------------------------------------------------------------
 */

static bool is_plain_constant(const cal_value *v) {
    return v->kind == CAL_V_CONSTANT && !v->effect;
}

/* A value computed here and used here alone, so that its instruction may be part of another. */
static bool is_private(const cal_value *v, cal_value_kind kind) {
    return v->kind == kind && v->uses == 1 && !v->shared && !is_at_hand(v);
}

static void emit_multiply_add(emitter *e, cal_value *v, cal_value *product, cal_value *term, bool product_first) {
    cal_value *a = product->operands[0], *b = product->operands[1];
    uint32_t c = 0, ra, rb;
    if (!product_first)
        c = emit(e, term);
    ra = emit(e, a);
    rb = emit(e, b);
    if (product_first)
        c = emit(e, term);
    put(e, (cal_instruction){.op = CAL_OP_MULTIPLY_ADD, .d = place_of(e, v), .a = ra, .b = rb, .c = c});
}

static bool can_multiply_add(const cal_value *v) {
    return is_private(v, CAL_V_MULTIPLY) && !is_plain_constant(v->operands[0]) && !is_plain_constant(v->operands[1]);
}

static void emit_add(emitter *e, cal_value *v) {
    cal_value *a = v->operands[0], *b = v->operands[1];
    if (is_plain_constant(a) || is_plain_constant(b)) {
        const cal_value *k = is_plain_constant(a) ? a : b;
        uint32_t r = emit(e, k == a ? b : a);
        put_op(e, CAL_OP_ADD_CONSTANT, place_of(e, v), r, constant_index(e, k->number));
    } else if (a != b && can_multiply_add(b)) {
        emit_multiply_add(e, v, b, a, false);
    } else if (a != b && can_multiply_add(a)) {
        emit_multiply_add(e, v, a, b, true);
    } else {
        uint32_t ra = emit(e, a), rb = emit(e, b);
        put_op(e, CAL_OP_ADD, place_of(e, v), ra, rb);
    }
}

static void emit_subtract(emitter *e, cal_value *v) {
    cal_value *a = v->operands[0], *b = v->operands[1];
    if (is_plain_constant(b)) {
        uint32_t r = emit(e, a);
        put_op(e, CAL_OP_ADD_CONSTANT, place_of(e, v), r, constant_index(e, -b->number));
    } else if (is_plain_constant(a)) {
        uint32_t r = emit(e, b);
        put_op(e, CAL_OP_SUBTRACT_FROM, place_of(e, v), r, constant_index(e, a->number));
    } else {
        uint32_t ra = emit(e, a), rb = emit(e, b);
        put_op(e, CAL_OP_SUBTRACT, place_of(e, v), ra, rb);
    }
}

static void emit_multiply(emitter *e, cal_value *v) {
    cal_value *a = v->operands[0], *b = v->operands[1];
    if (is_plain_constant(a) || is_plain_constant(b)) {
        const cal_value *k = is_plain_constant(a) ? a : b;
        uint32_t r = emit(e, k == a ? b : a);
        put_op(e, CAL_OP_MULTIPLY_CONSTANT, place_of(e, v), r, constant_index(e, k->number));
    } else {
        uint32_t ra = emit(e, a), rb = emit(e, b);
        put_op(e, CAL_OP_MULTIPLY, place_of(e, v), ra, rb);
    }
}

/* The denominator comes first, and where it is 0 the numerator is not computed, for that may have effects. */
static void emit_divide(emitter *e, cal_value *v) {
    cal_value *numerator = v->operands[0], *denominator = v->operands[1];
    uint32_t b = emit(e, denominator), a, jump = 0;
    if (is_plain_constant(numerator)) {
        put_op(e, CAL_OP_DIVIDE_CONSTANT, place_of(e, v), b, constant_index(e, numerator->number));
        may_fault(e);
        return;
    }
    bool skips = numerator->effect && !is_at_hand(numerator);
    if (skips) {
        /* Where the register is known only later, the jump's target and it are set then. */
        jump = put_op(e, CAL_OP_IF_ZERO, 0, b, 0);
        if (!enter_scope(e))
            return;
        a = emit(e, numerator);
        leave_scope(e);
    } else {
        a = emit(e, numerator);
    }
    uint32_t d = place_of(e, v);
    put_op(e, CAL_OP_DIVIDE, d, a, b);
    if (skips && !failed(e)) {
        e->code->instructions[jump].d = d;
        e->code->instructions[jump].b = here(e);
    }
    may_fault(e);
}

static bool is_power(const cal_function *f, const cal_value *v, double exponent) {
    return f == cal_library_power() && is_plain_constant(v->operands[1]) && v->operands[1]->number == exponent;
}

static cal_instruction real_1_instruction(emitter *e, const cal_function *f, uint32_t a) {
    cal_instruction i = {.op = CAL_OP_REAL_1, .a = a};
    if (strcmp(f->name, "floor") == 0)
        i.op = CAL_OP_FLOOR;
    else if (strcmp(f->name, "sqrt") == 0)
        i.op = CAL_OP_SQRT;
    else
        i.b = function_index(e, f);
    return i;
}

/* Of two arguments the second is computed first, of three the first. */
static void emit_real(emitter *e, cal_value *v) {
    const cal_function *f = v->function;
    cal_instruction i;
    bool fresh = begin_function(e, v);
    if (v->count == 1) {
        i = real_1_instruction(e, f, emit(e, v->operands[0]));
    } else if (v->count == 3) {
        i = (cal_instruction){.op = CAL_OP_NOISE, .extra = (uint8_t)f->noise};
        i.a = emit(e, v->operands[0]);
        i.b = emit(e, v->operands[1]);
        i.c = emit(e, v->operands[2]);
    } else if (is_power(f, v, 2)) {
        i = (cal_instruction){.op = CAL_OP_SQUARE, .a = emit(e, v->operands[0])};
    } else {
        i = (cal_instruction){.op = CAL_OP_REAL_2, .c = function_index(e, f)};
        i.b = emit(e, v->operands[1]);
        i.a = emit(e, v->operands[0]);
    }
    i.d = place_of(e, v);
    end_function(e, fresh, i);
}

/* Computes v in a scope of its own, into register d. */
static void emit_branch(emitter *e, cal_value *v, uint32_t d) {
    cal_value *wanted = e->wanted;
    uint32_t into = e->into;
    if (!enter_scope(e))
        return;
    bool may_place = v->uses == 1 && !v->shared && !v->has_place && v->kind != CAL_V_PARAMETER;
    e->wanted = may_place ? v : NULL;
    e->into = d;
    uint32_t r = emit(e, v);
    if (r != d)
        put_op(e, CAL_OP_MOVE, d, r, 0);
    e->wanted = wanted;
    e->into = into;
    leave_scope(e);
}

/* Jumps unless the condition is above 0: a difference is not computed for that. */
static uint32_t emit_condition(emitter *e, cal_value *v) {
    if (is_private(v, CAL_V_SUBTRACT) && is_plain_constant(v->operands[0])) {
        uint32_t r = emit(e, v->operands[1]);
        return put_op(e, CAL_OP_UNLESS_BELOW_CONSTANT, 0, r, constant_index(e, v->operands[0]->number));
    }
    if (is_private(v, CAL_V_SUBTRACT) && !is_plain_constant(v->operands[1])) {
        uint32_t a = emit(e, v->operands[0]), b = emit(e, v->operands[1]);
        return put_op(e, CAL_OP_UNLESS_ABOVE, 0, a, b);
    }
    if (is_private(v, CAL_V_ADD) && is_plain_constant(v->operands[1])) {
        uint32_t r = emit(e, v->operands[0]);
        return put_op(e, CAL_OP_UNLESS_ABOVE_CONSTANT, 0, r, constant_index(e, -v->operands[1]->number));
    }
    return put_op(e, CAL_OP_UNLESS_POSITIVE, 0, emit(e, v), 0);
}

static void emit_if(emitter *e, cal_value *v) {
    bool fresh = begin_function(e, v);
    uint32_t otherwise = emit_condition(e, v->operands[0]);
    bool no_fault = e->no_fault;
    uint32_t d = place_of(e, v);
    v->scope = NULL;
    emit_branch(e, v->operands[1], d);
    uint32_t end = put_op(e, CAL_OP_JUMP, 0, 0, 0);
    land(e, otherwise);
    e->no_fault = no_fault;
    emit_branch(e, v->operands[2], d);
    land(e, end);
    end_function(e, fresh, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
    v->scope = e->scope;
}

static void emit_select(emitter *e, cal_value *v) {
    int branches = v->count - 1;
    bool fresh = begin_function(e, v);
    uint32_t which = emit(e, v->operands[0]), d = place_of(e, v);
    /* It may note a fault itself, so it, and not the end, forgets those before. */
    uint32_t table =
        put(e, (cal_instruction){.op = CAL_OP_SELECT, .fresh = fresh, .d = d, .a = which, .b = (uint32_t)branches});
    v->scope = NULL;
    /* Where the count is asked for, or nothing is selected, it goes on at the first of these. */
    for (int i = 0; i <= branches; i++)
        put_op(e, CAL_OP_JUMP, 0, 0, 0);
    uint32_t *ends = arena_allocate(e->graph->memory, (size_t)(branches + 1) * sizeof *ends);
    if (!ends) {
        out_of_memory(e);
        return;
    }
    bool no_fault = e->no_fault;
    for (int i = 1; i <= branches; i++) {
        land(e, table + 1 + (uint32_t)i);
        e->no_fault = no_fault;
        emit_branch(e, v->operands[i], d);
        ends[i] = put_op(e, CAL_OP_JUMP, 0, 0, 0);
    }
    for (int i = 1; i <= branches; i++)
        land(e, ends[i]);
    land(e, table + 1);
    may_fault(e);
    end_function(e, false, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
    v->scope = e->scope;
}

/* The first argument, then from the last down to the second. */
static void emit_extreme(emitter *e, cal_value *v) {
    cal_op op = v->function->kind == CAL_MIN ? CAL_OP_MINIMUM : CAL_OP_MAXIMUM;
    bool fresh = begin_function(e, v);
    uint32_t r = emit(e, v->operands[0]), d = 0;
    for (int i = v->count - 1; i > 0; i--) {
        uint32_t next = emit(e, v->operands[i]);
        d = place_of(e, v);
        v->scope = NULL;
        put_op(e, op, d, r, next);
        r = d;
    }
    end_function(e, fresh, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
    v->scope = e->scope;
}

static void emit_check(emitter *e, cal_value *v) {
    bool fresh = begin_function(e, v);
    uint32_t r = emit(e, v->operands[0]), d = place_of(e, v);
    put_op(e, CAL_OP_MOVE, d, r, 0);
    end_function(e, fresh, (cal_instruction){.op = CAL_OP_CHECK, .d = d});
}

static void emit_argument(emitter *e, cal_value *v) {
    bool fresh = begin_function(e, v);
    uint32_t r = emit(e, v->operands[0]);
    end_function(e, fresh,
                 (cal_instruction){.op = CAL_OP_ARGUMENT, .d = place_of(e, v), .a = r, .b = (uint32_t)v->index});
}

/* An argument is given as it is where that costs nothing, else as code that computes it when it is needed. */
static uint32_t emit_later(emitter *e, cal_value *v) {
    uint32_t jump = put_op(e, CAL_OP_JUMP, 0, 0, 0), entry = here(e);
    bool no_fault = e->no_fault;
    e->no_fault = false;
    if (!enter_scope(e))
        return 0;
    uint32_t r = emit(e, v);
    put_op(e, CAL_OP_ANSWER, 0, r, 0);
    leave_scope(e);
    e->no_fault = no_fault;
    land(e, jump);
    return entry;
}

static void emit_call(emitter *e, cal_value *v) {
    cal_instruction *gives = arena_allocate(e->graph->memory, (size_t)v->count * sizeof *gives);
    if (!gives) {
        out_of_memory(e);
        return;
    }
    for (int i = 0; i < v->count; i++) {
        cal_value *a = v->operands[i];
        bool at_hand = is_at_hand(a) || is_plain_constant(a) || a->kind == CAL_V_CHANNEL;
        gives[i] = (cal_instruction){.op = at_hand ? CAL_OP_GIVE_VALUE : CAL_OP_GIVE_LATER,
                                     .a = at_hand ? emit(e, a) : emit_later(e, a)};
    }
    uint32_t d = place_of(e, v);
    put_op(e, CAL_OP_CALL, d, (uint32_t)v->index, (uint32_t)v->count);
    for (int i = 0; i < v->count; i++)
        put(e, gives[i]);
    may_fault(e);
}

static void emit_kind(emitter *e, cal_value *v) {
    switch (v->kind) {
    case CAL_V_CONSTANT:
        if (v->effect && !e->no_fault) {
            put_op(e, CAL_OP_FORGET, 0, 0, 0);
            e->no_fault = true;
        }
        put_op(e, CAL_OP_CONSTANT, place_of(e, v), 0, constant_index(e, v->number));
        return;
    case CAL_V_CHANNEL:
        e->code->channels |= UINT64_C(1) << v->index;
        put_op(e, CAL_OP_CHANNEL, place_of(e, v), (uint32_t)v->index, 0);
        return;
    case CAL_V_PARAMETER:
        v->has_place = true;
        v->place = 2 * (uint32_t)v->index;
        put_op(e, CAL_OP_NEED_PARAMETER, 0, v->place, 0);
        v->scope = e->scope;
        may_fault(e);
        return;
    case CAL_V_OF_MAIN:
        put_op(e, CAL_OP_NEED_OF_MAIN, v->other->entry, e->code->units[0].flags_begin + v->other->flag, 0);
        put_op(e, CAL_OP_OF_MAIN, place_of(e, v), v->other->place, 0);
        may_fault(e);
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
        uint32_t r = emit(e, v->operands[0]);
        put_op(e, CAL_OP_NEGATE, place_of(e, v), r, 0);
        return;
    }
    case CAL_V_DIVIDE:
        emit_divide(e, v);
        return;
    case CAL_V_REAL:
        emit_real(e, v);
        return;
    case CAL_V_IF:
        emit_if(e, v);
        return;
    case CAL_V_SELECT:
        emit_select(e, v);
        return;
    case CAL_V_EXTREME:
        emit_extreme(e, v);
        return;
    case CAL_V_CHECK:
        emit_check(e, v);
        return;
    case CAL_V_ARGUMENT:
        emit_argument(e, v);
        return;
    case CAL_V_CALL:
        emit_call(e, v);
        return;
    case CAL_V_FAIL:
        put_op(e, CAL_OP_FAIL, place_of(e, v), (uint32_t)v->index, 0);
        may_fault(e);
        return;
    }
}

/* --- Values that are computed at first need -------------------------------------------------------------------------
 */

static bool is_leaf(const cal_value *v) {
    return v->kind == CAL_V_CONSTANT || v->kind == CAL_V_CHANNEL || v->kind == CAL_V_PARAMETER ||
           v->kind == CAL_V_OF_MAIN || v->kind == CAL_V_FAIL;
}

/* Closes the scopes up to the unit's own, for code that others come to from elsewhere; all of them for a value that
 * functions need; or takes that back. */
static void close_scopes(emitter *e, const cal_value *v, int closing) {
    for (cal_scope *s = e->scope; s && (s->outer || v->shared); s = s->outer)
        s->closed += closing;
}

static void emit_with_flag(emitter *e, cal_value *v) {
    uint32_t enter = put_op(e, CAL_OP_ENTER, 0, v->flag = e->flag_count++, 0);
    v->has_flag = true;
    v->entry = here(e);
    close_scopes(e, v, 1);
    e->no_fault = false;
    if (!enter_scope(e))
        return;
    emit_kind(e, v);
    leave_scope(e);
    close_scopes(e, v, -1);
    put_op(e, CAL_OP_DONE, 0, v->flag, 0);
    land(e, enter);
    may_fault(e);
    v->scope = e->scope;
}

static uint32_t emit(emitter *e, cal_value *v) {
    if (failed(e))
        return 0;
    if (is_at_hand(v))
        return v->place;
    if (v->has_flag) {
        put_op(e, CAL_OP_NEED, v->entry, v->flag, 0);
        may_fault(e);
        v->scope = e->scope;
    } else if (v->shared || (v->uses > 1 && e->scope->outer && !is_leaf(v))) {
        emit_with_flag(e, v);
    } else {
        emit_kind(e, v);
    }
    return v->place;
}

/* --- Units ----------------------------------------------------------------------------------------------------------
 */

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

static void begin_unit(emitter *e, uint32_t place_count) {
    e->place_count = place_count;
    e->flag_count = 0;
    e->first = here(e);
    e->scope = NULL;
    e->no_fault = false;
    enter_scope(e);
}

static bool has_flag(uint16_t op) {
    return op == CAL_OP_ENTER || op == CAL_OP_NEED || op == CAL_OP_DONE;
}

/* Flags come behind the other registers, which now are known to be all. */
static void end_unit(emitter *e, cal_unit *unit) {
    for (uint32_t i = e->first; i < here(e); i++)
        if (has_flag(e->code->instructions[i].op))
            e->code->instructions[i].a += e->place_count;
    *unit = (cal_unit){e->first, e->place_count + e->flag_count, e->place_count, e->flag_count};
    e->flags_total += e->flag_count;
}

static void emit_main(emitter *e, cal_value *const *results, size_t count) {
    const cal_graph *g = e->graph;
    for (size_t i = 0; i < g->shared_count; i++)
        mark_shared(g->shared[i]);
    begin_unit(e, 0);
    e->no_fault = true;
    for (size_t i = 0; i < count; i++) {
        uint32_t r = emit(e, results[i]);
        put_op(e, CAL_OP_OUTPUT, (uint32_t)i, r, 0);
    }
    put_op(e, CAL_OP_END, 0, 0, 0);
    /* Functions may need what no output does at once. */
    for (size_t i = 0; i < g->shared_count && !failed(e); i++)
        if (!g->shared[i]->has_flag)
            emit_with_flag(e, g->shared[i]);
    end_unit(e, &e->code->units[0]);
}

static void emit_unit(emitter *e, int index) {
    const cal_graph_unit *unit = &e->graph->units[index];
    begin_unit(e, 2 * (uint32_t)unit->parameter_count);
    uint32_t r = emit(e, unit->result);
    put_op(e, CAL_OP_RETURN, 0, r, 0);
    end_unit(e, &e->code->units[index]);
}

graze_status cal_emit(struct cal_code *code, cal_graph *g, cal_value *const *results, size_t count) {
    emitter e = {.graph = g, .code = code};
    code->unit_count = (uint32_t)g->unit_count;
    code->units = arena_allocate(code->memory, code->unit_count * sizeof *code->units);
    if (!code->units)
        return report_out_of_memory(g->report);
    emit_main(&e, results, count);
    for (int u = 1; u < g->unit_count && !failed(&e); u++)
        emit_unit(&e, u);
    code->messages = g->messages;
    code->message_count = (uint32_t)g->message_count;
    code->output_count = (uint32_t)count;
    code->return_count = e.flags_total + 1;
    return g->status;
}
