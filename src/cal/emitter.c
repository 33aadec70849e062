/* Instructions, constants and scopes of code in the making. */
#include "cal/emitter.h"

#include <string.h>

bool cal_emit_failed(const cal_emitter *e) {
    return e->graph->status != GRAZE_OK;
}

void cal_emit_out_of_memory(cal_emitter *e) {
    if (!e->graph->status)
        e->graph->status = report_out_of_memory(e->graph->report);
}

/* Room for one more; null where there is none. */
static void *grow(cal_emitter *e, void *items, uint32_t count, uint32_t *capacity, size_t size) {
    if (count < *capacity)
        return items;
    uint32_t larger = *capacity ? 2 * *capacity : 32;
    void *more = arena_allocate(e->code->memory, larger * size);
    if (!more) {
        cal_emit_out_of_memory(e);
        return NULL;
    }
    if (count)
        memcpy(more, items, count * size);
    *capacity = larger;
    return more;
}

uint32_t cal_put(cal_emitter *e, cal_instruction instruction) {
    struct cal_code *code = e->code;
    cal_instruction *items =
        grow(e, code->instructions, code->instruction_count, &e->instruction_capacity, sizeof *items);
    if (!items)
        return 0;
    code->instructions = items;
    items[code->instruction_count] = instruction;
    return code->instruction_count++;
}

uint32_t cal_put_op(cal_emitter *e, cal_op op, uint32_t d, uint32_t a, uint32_t b) {
    return cal_put(e, (cal_instruction){.op = (uint16_t)op, .d = d, .a = a, .b = b});
}

uint32_t cal_emit_here(const cal_emitter *e) {
    return e->code->instruction_count;
}

void cal_emit_land(cal_emitter *e, uint32_t jump) {
    if (!cal_emit_failed(e))
        e->code->instructions[jump].d = cal_emit_here(e);
}

uint32_t cal_constant_index(cal_emitter *e, double number) {
    struct cal_code *code = e->code;
    for (uint32_t i = 0; i < code->constant_count; i++)
        if (cal_is_same_number(code->constants[i], number))
            return i;
    double *items = grow(e, code->constants, code->constant_count, &e->constant_capacity, sizeof *items);
    if (!items)
        return 0;
    code->constants = items;
    items[code->constant_count] = number;
    return code->constant_count++;
}

uint32_t cal_function_index(cal_emitter *e, const cal_function *function) {
    struct cal_code *code = e->code;
    for (uint32_t i = 0; i < code->function_count; i++)
        if (code->functions[i] == function)
            return i;
    const cal_function **items = grow(e, code->functions, code->function_count, &e->function_capacity, sizeof(void *));
    if (!items)
        return 0;
    code->functions = items;
    items[code->function_count] = function;
    return code->function_count++;
}

cal_scope *cal_enter_scope(cal_emitter *e) {
    cal_scope *scope = arena_allocate(e->graph->memory, sizeof *scope);
    if (!scope) {
        cal_emit_out_of_memory(e);
        return NULL;
    }
    *scope = (cal_scope){e->scope, 0};
    return e->scope = scope;
}

void cal_leave_scope(cal_emitter *e) {
    e->scope->closed++;
    e->scope = e->scope->outer;
}

bool cal_is_at_hand(const cal_value *v) {
    return v->scope && v->scope->closed == 0;
}

uint32_t cal_place_of(cal_emitter *e, cal_value *v) {
    if (!v->has_place) {
        v->has_place = true;
        v->place = e->wanted == v ? e->into : e->place_count++;
    }
    v->scope = e->scope;
    return v->place;
}

void cal_may_fault(cal_emitter *e) {
    e->no_fault = false;
}

bool cal_is_plain_constant(const cal_value *v) {
    return v->kind == CAL_V_CONSTANT && !v->effect;
}

bool cal_is_private(const cal_value *v, cal_value_kind kind) {
    return v->kind == kind && v->uses == 1 && !v->shared && !cal_is_at_hand(v);
}
