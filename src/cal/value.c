/* Values: making them, joining those that are the same, arithmetic with what is known. */
#include "cal/graph_internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    HEIGHT_MOST = 3000,   /* of the graph */
    VALUES_MOST = 1000000 /* before giving up */
};

cal_value *cal_graph_stop(cal_graph *g, const char *what) {
    if (!g->status)
        g->status = what ? report_error(g->report, g->where, "%s", what) : report_out_of_memory(g->report);
    return NULL;
}

void *cal_graph_allocate(cal_graph *g, size_t size) {
    void *memory = arena_allocate(g->memory, size);
    if (!memory)
        cal_graph_stop(g, NULL);
    return memory;
}

cal_value *cal_value_new(cal_graph *g, cal_value_kind kind, int count) {
    if (++g->value_count > VALUES_MOST)
        return cal_graph_stop(g, "the functions of this expression call each other too often to be compiled");
    cal_value *v = cal_graph_allocate(g, sizeof *v);
    cal_value **operands = count > 0 ? cal_graph_allocate(g, (size_t)count * sizeof(void *)) : NULL;
    if (!v || (count > 0 && !operands))
        return NULL;
    *v = (cal_value){.kind = kind, .count = count, .operands = operands};
    return v;
}

cal_value *cal_value_set(cal_graph *g, cal_value *v, int i, cal_value *operand) {
    if (!v || !operand)
        return NULL;
    v->operands[i] = operand;
    operand->uses++;
    v->effect |= operand->effect;
    if (v->height <= operand->height)
        v->height = operand->height + 1;
    return v->height > HEIGHT_MOST ? cal_graph_stop(g, "the functions of this expression are nested too deeply") : v;
}

static unsigned hash_of(const cal_value *v) {
    uint64_t bits, h = (uint64_t)v->kind * 31 + (uint64_t)v->index;
    memcpy(&bits, &v->number, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15u;
    for (int i = 0; i < v->count; i++)
        h = (h ^ (uint64_t)(uintptr_t)v->operands[i]) * 0x9e3779b97f4a7c15u;
    return (unsigned)(h >> 40) % CAL_VALUE_HASH;
}

static bool is_same(const cal_value *a, const cal_value *b) {
    if (a->kind != b->kind || a->index != b->index || a->count != b->count || !cal_is_same_number(a->number, b->number))
        return false;
    for (int i = 0; i < a->count; i++)
        if (a->operands[i] != b->operands[i])
            return false;
    return true;
}

/* The value of the unit that is the same as this new one, which then is given up, or this one. */
static cal_value *unique_value(cal_graph *g, cal_value *v) {
    if (!v || v->effect)
        return v;
    cal_value **slot = &g->tables[g->unit != 0][hash_of(v)];
    for (cal_value *w = *slot; w; w = w->next) {
        if (is_same(v, w)) {
            for (int i = 0; i < v->count; i++)
                v->operands[i]->uses--;
            return w;
        }
    }
    v->next = *slot;
    return *slot = v;
}

cal_value *cal_value_constant(cal_graph *g, double number, bool effect) {
    cal_value *v = cal_value_new(g, CAL_V_CONSTANT, 0);
    if (!v)
        return NULL;
    v->number = number;
    v->effect = effect;
    return unique_value(g, v);
}

cal_value *cal_value_leaf(cal_graph *g, cal_value_kind kind, int index) {
    cal_value *v = cal_value_new(g, kind, 0);
    if (!v)
        return NULL;
    v->index = index;
    v->effect = kind == CAL_V_PARAMETER;
    return unique_value(g, v);
}

cal_value *cal_value_failing(cal_graph *g, const cal_node *node, const char *format, ...) {
    char text[512], message[640];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const cal_definition *d = g->call && g->call->symbol ? g->call->symbol->definition : NULL;
    if (d)
        snprintf(message, sizeof message, "%s:%d:%d: %s", d->file ? d->file : "expression", node->line, node->column,
                 text);
    else if (g->expression)
        snprintf(message, sizeof message, "in the expression '%.80s', column %d: %s", g->expression, node->column,
                 text);
    else
        snprintf(message, sizeof message, "%s", text);
    cal_value *v = cal_value_new(g, CAL_V_FAIL, 0);
    if (!v)
        return NULL;
    if (g->message_count == g->message_capacity) {
        int capacity = g->message_capacity ? 2 * g->message_capacity : 16;
        const char **more = arena_allocate(g->code_memory, (size_t)capacity * sizeof *more);
        if (!more)
            return cal_graph_stop(g, NULL);
        if (g->message_count)
            memcpy(more, g->messages, (size_t)g->message_count * sizeof *more);
        g->messages = more;
        g->message_capacity = capacity;
    }
    const char *copy = arena_copy_text(g->code_memory, message, strlen(message));
    if (!copy)
        return cal_graph_stop(g, NULL);
    v->index = g->message_count;
    v->effect = true;
    g->messages[g->message_count++] = copy;
    return v;
}

cal_value *cal_value_undefined(cal_graph *g, const cal_node *node, const cal_symbol *symbol, bool is_called) {
    cal_value *v =
        cal_value_failing(g, node, is_called ? "there is no function %s()" : "there is no variable %s", symbol->name);
    if (v && !g->undefined_count)
        g->undefined_count = g->message_count;
    return v;
}

static bool compute(cal_value_kind kind, double a, double b, double *result) {
    switch (kind) {
    case CAL_V_ADD:
        *result = a + b;
        break;
    case CAL_V_SUBTRACT:
        *result = a - b;
        break;
    case CAL_V_MULTIPLY:
        *result = a * b;
        break;
    case CAL_V_DIVIDE:
        *result = b != 0 ? a / b : (double)INFINITY;
        break;
    default:
        *result = -a;
    }
    return isfinite(*result);
}

cal_value *cal_value_binary(cal_graph *g, cal_value_kind kind, cal_value *a, cal_value *b) {
    double number;
    if (!a || !b)
        return NULL;
    if (cal_value_is_constant(a) && cal_value_is_constant(b) && compute(kind, a->number, b->number, &number))
        return cal_value_constant(g, number, a->effect || b->effect);
    /* A factor 1; no term 0, for that changes the sign of another 0. */
    if ((kind == CAL_V_MULTIPLY || kind == CAL_V_DIVIDE) && cal_value_is_constant(b) && b->number == 1 && !b->effect)
        return a;
    if (kind == CAL_V_MULTIPLY && cal_value_is_constant(a) && a->number == 1 && !a->effect)
        return b;
    cal_value *v = cal_value_new(g, kind, 2);
    if (!cal_value_set(g, v, 0, a) || !cal_value_set(g, v, 1, b))
        return NULL;
    v->effect |= kind == CAL_V_DIVIDE && !(cal_value_is_constant(b) && b->number != 0);
    return unique_value(g, v);
}

cal_value *cal_value_negate(cal_graph *g, cal_value *a) {
    if (!a)
        return NULL;
    if (cal_value_is_constant(a))
        return cal_value_constant(g, -a->number, a->effect);
    cal_value *v = cal_value_new(g, CAL_V_NEGATE, 1);
    return unique_value(g, cal_value_set(g, v, 0, a));
}

/* Its value is that of a function of the library already, computed here and not before. */
static bool is_checked(const cal_value *v) {
    if (v->is_named)
        return false;
    return v->kind == CAL_V_REAL || v->kind == CAL_V_IF || v->kind == CAL_V_SELECT || v->kind == CAL_V_EXTREME ||
           v->kind == CAL_V_CHECK || v->kind == CAL_V_ARGUMENT || (v->kind == CAL_V_CONSTANT && v->effect);
}

cal_value *cal_value_check(cal_graph *g, cal_value *operand) {
    if (!operand || is_checked(operand))
        return operand;
    if (cal_value_is_constant(operand))
        return cal_value_constant(g, operand->number, true);
    /* Where the operand was computed before, the fault noted then is forgotten. */
    cal_value *v = cal_value_set(g, cal_value_new(g, CAL_V_CHECK, 1), 0, operand);
    if (v)
        v->effect = true;
    return v;
}
