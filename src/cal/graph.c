/* Building values from trees: functions where they are called, variables once. */
#include "cal/graph_internal.h"

#include <string.h>

enum {
    DEPTH_MOST = 1500,   /* of trees within trees, in calls within calls */
    UNROLLED_MOST = 64,  /* calls of a function within itself */
    INLINE_MOST = 50000, /* values, before calls stay calls */
    UNITS_MOST = 1000
};

typedef struct cal_variable {
    const cal_symbol *symbol;
    cal_value *value; /* null while it is being built */
    struct cal_variable *next;
} cal_variable;

static cal_value *build_chain(cal_graph *g, const cal_node *node) {
    cal_value *v = cal_graph_build(g, node->first);
    for (const cal_node *n = node->first->next; v && n; n = n->next)
        v = cal_value_binary(g, node->kind == CAL_PRODUCT ? CAL_V_MULTIPLY : CAL_V_ADD, v, cal_graph_build(g, n));
    return v;
}

static cal_value *build_pair(cal_graph *g, cal_value_kind kind, const cal_node *node) {
    cal_value *a = cal_graph_build(g, node->first);
    return cal_value_binary(g, kind, a, cal_graph_build(g, node->last));
}

/* The function that a name, or a parameter through all calls around it, stands for; null where it stands for none. */
static cal_symbol *function_of(const cal_node *node, const cal_call *call) {
    while (node->kind == CAL_PARAMETER) {
        if (!call || node->index >= call->argument_count)
            return NULL;
        const cal_argument *a = &call->arguments[node->index];
        if (!a->tree)
            return a->bound;
        node = a->tree;
        call = a->outside;
    }
    return node->kind == CAL_VARIABLE ? node->symbol : NULL;
}

static cal_value *named(cal_value *v) {
    if (v)
        v->is_named = true;
    return v;
}

static cal_value *build_parameter(cal_graph *g, const cal_node *node) {
    if (node->index >= g->call->argument_count)
        return cal_graph_too_few(g, node, g->call->symbol->name);
    cal_argument *a = &g->call->arguments[node->index];
    if (a->value)
        return a->value;
    /* The tree belongs to where the call is. */
    cal_call *inside = g->call;
    int branches = g->branches;
    g->call = a->outside;
    g->branches = inside->branches;
    a->value = named(cal_graph_build(g, a->tree));
    g->call = inside;
    g->branches = branches;
    return a->value;
}

/* Whether to build the function's body here: it is not within itself already, or there is no way around that. */
static bool may_unroll(const cal_graph *g, const cal_symbol *symbol) {
    int times = 0;
    if (g->value_count > INLINE_MOST || g->depth > DEPTH_MOST / 2)
        return false;
    for (const cal_call *c = g->call; c; c = c->within) {
        if (c->symbol != symbol)
            continue;
        if (g->branches > c->branches || ++times >= UNROLLED_MOST)
            return false;
    }
    return true;
}

static cal_value *unroll(cal_graph *g, const cal_node *call, cal_symbol *symbol) {
    int count = call->count - 1;
    cal_call *inside = cal_graph_allocate(g, sizeof *inside);
    cal_argument *arguments = cal_graph_allocate(g, (size_t)count * sizeof *arguments);
    if (!inside || !arguments)
        return NULL;
    int i = 0;
    for (const cal_node *n = call->first->next; n; n = n->next)
        arguments[i++] = (cal_argument){.tree = n, .outside = g->call};
    *inside = (cal_call){
        .symbol = symbol, .within = g->call, .branches = g->branches, .argument_count = count, .arguments = arguments};
    g->call = inside;
    cal_value *v = cal_graph_build(g, symbol->definition->body);
    g->call = inside->within;
    return v;
}

static bool is_same_list(cal_symbol *const *a, cal_symbol *const *b, int count) {
    for (int i = 0; i < count; i++)
        if (a[i] != b[i])
            return false;
    return true;
}

static int find_unit(cal_graph *g, cal_symbol *symbol, cal_symbol **bound, int count) {
    for (int u = 1; u < g->unit_count; u++)
        if (g->units[u].symbol == symbol && is_same_list(g->units[u].bound, bound, count))
            return u;
    if (g->unit_count == UNITS_MOST) {
        cal_graph_stop(g, "the functions of this expression call each other in too many ways");
        return -1;
    }
    if (g->unit_count == g->unit_capacity) {
        int capacity = g->unit_capacity ? 2 * g->unit_capacity : 8;
        cal_graph_unit *more = cal_graph_allocate(g, (size_t)capacity * sizeof *more);
        if (!more)
            return -1;
        if (g->unit_count)
            memcpy(more, g->units, (size_t)g->unit_count * sizeof *more);
        g->units = more;
        g->unit_capacity = capacity;
    }
    g->units[g->unit_count] = (cal_graph_unit){.symbol = symbol, .bound = bound, .parameter_count = count};
    return g->unit_count++;
}

static cal_value *call_unit(cal_graph *g, const cal_node *call, cal_symbol *symbol) {
    const cal_definition *d = symbol->definition;
    int count = d->parameter_count;
    cal_symbol **bound = cal_graph_allocate(g, (size_t)count * sizeof(void *));
    cal_value *v = cal_value_new(g, CAL_V_CALL, count);
    if (!v || !bound)
        return NULL;
    g->branches++;
    for (int i = 0; i < count && v; i++) {
        const cal_node *tree = cal_graph_argument(call, i);
        bound[i] = tree && d->passed[i] ? function_of(tree, g->call) : NULL;
        v = cal_value_set(g, v, i, tree ? cal_graph_build(g, tree) : cal_graph_too_few(g, call, symbol->name));
    }
    g->branches--;
    int unit = v ? find_unit(g, symbol, bound, count) : -1;
    if (unit < 0)
        return NULL;
    v->index = unit;
    v->effect = true;
    return v;
}

static cal_value *build_call(cal_graph *g, const cal_node *call) {
    cal_symbol *symbol = function_of(call->first, g->call);
    if (!symbol)
        return cal_value_failing(g, call, "an argument that is called here is not the name of a function");
    if (!symbol->definition || !symbol->definition->is_function)
        return cal_graph_library_call(g, call, symbol);
    return may_unroll(g, symbol) ? unroll(g, call, symbol) : call_unit(g, call, symbol);
}

static cal_variable *variable_of(cal_graph *g, const cal_symbol *symbol, bool *is_new) {
    cal_variable **slot = &g->variables[((uintptr_t)symbol >> 5) % CAL_VALUE_HASH];
    cal_variable *variable = *slot;
    while (variable && variable->symbol != symbol)
        variable = variable->next;
    *is_new = !variable;
    if (variable || !(variable = cal_graph_allocate(g, sizeof *variable)))
        return variable;
    *variable = (cal_variable){.symbol = symbol, .next = *slot};
    return *slot = variable;
}

/* The value in unit 0, built as if no call were around it. */
static cal_value *build_variable_of_main(cal_graph *g, const cal_node *node) {
    bool is_new;
    const cal_symbol *symbol = node->symbol;
    cal_variable *variable = variable_of(g, symbol, &is_new);
    if (!variable)
        return NULL;
    if (!is_new)
        return variable->value ? variable->value : cal_value_failing(g, node, "%s is defined by itself", symbol->name);
    cal_call at = {.symbol = symbol, .within = NULL, .branches = 0};
    cal_call *call = g->call;
    int branches = g->branches;
    g->call = &at;
    g->branches = 0;
    variable->value = named(cal_graph_build(g, symbol->definition->body));
    g->call = call;
    g->branches = branches;
    return variable->value;
}

static bool share(cal_graph *g, cal_value *v) {
    if (v->shared)
        return true;
    if (g->shared_count == g->shared_capacity) {
        size_t capacity = g->shared_capacity ? 2 * g->shared_capacity : 16;
        cal_value **more = cal_graph_allocate(g, capacity * sizeof(void *));
        if (!more)
            return false;
        if (g->shared_count)
            memcpy(more, g->shared, g->shared_count * sizeof(void *));
        g->shared = more;
        g->shared_capacity = capacity;
    }
    g->shared[g->shared_count++] = v;
    v->shared = true;
    v->uses += 2;
    return true;
}

static cal_value *seen_from_unit(cal_graph *g, cal_value *v) {
    if (v && cal_value_is_constant(v))
        return cal_value_constant(g, v->number, v->effect);
    if (v && v->kind == CAL_V_CHANNEL)
        return cal_value_leaf(g, CAL_V_CHANNEL, v->index);
    cal_value *reference = cal_value_new(g, CAL_V_OF_MAIN, 0);
    if (!v || !reference)
        return NULL;
    reference->other = v;
    reference->effect = true;
    return share(g, v) ? reference : NULL;
}

static cal_value *build_variable(cal_graph *g, const cal_node *node) {
    const cal_definition *d = node->symbol->definition;
    if (!d && !node->symbol->library)
        return cal_value_undefined(g, node, node->symbol, false);
    if (!d || d->is_function)
        return cal_value_failing(g, node, "there is no variable %s", node->symbol->name);
    if (d->body->kind == CAL_NUMBER)
        return cal_value_constant(g, d->body->number, false);
    if (g->unit == 0)
        return build_variable_of_main(g, node);
    int unit = g->unit;
    g->unit = 0;
    cal_value *v = build_variable_of_main(g, node);
    g->unit = unit;
    return seen_from_unit(g, v);
}

static cal_value *build_channel(cal_graph *g, const cal_node *node) {
    if (node->index < 1 || node->index > CAL_CHANNELS_MOST)
        return cal_value_failing(g, node, "there is no channel $%d", node->index);
    if (g->channels & CAL_CHANNEL_BIT(node->index))
        return cal_value_leaf(g, CAL_V_CHANNEL, node->index - 1);
    const cal_symbol *symbol = g->call ? g->call->symbol : NULL;
    bool is_name = symbol && symbol->definition && symbol->definition->body == node;
    return cal_value_failing(g, node, "%s%.0d has no value here", is_name ? symbol->name : "channel $",
                             is_name ? 0 : node->index);
}

static cal_value *build_kind(cal_graph *g, const cal_node *node) {
    switch (node->kind) {
    case CAL_NUMBER:
        return cal_value_constant(g, node->number, false);
    case CAL_CHANNEL:
        return build_channel(g, node);
    case CAL_NEGATIVE:
        return cal_value_negate(g, cal_graph_build(g, node->first));
    case CAL_DIFFERENCE:
        return build_pair(g, CAL_V_SUBTRACT, node);
    case CAL_QUOTIENT:
        return build_pair(g, CAL_V_DIVIDE, node);
    case CAL_POWER:
        return cal_graph_power(g, node);
    case CAL_VARIABLE:
        return build_variable(g, node);
    case CAL_PARAMETER:
        return build_parameter(g, node);
    case CAL_CALL:
        return build_call(g, node);
    default:
        return build_chain(g, node);
    }
}

cal_value *cal_graph_build(cal_graph *g, const cal_node *node) {
    if (g->status)
        return NULL;
    if (++g->depth > DEPTH_MOST)
        return cal_graph_stop(g, "the functions of this expression are nested too deeply");
    cal_value *v = build_kind(g, node);
    g->depth--;
    return v;
}

void cal_graph_begin(cal_graph *g, cal_program *program, arena *memory, arena *code_memory,
                     const graze_report *report) {
    *g = (cal_graph){.memory = memory, .program = program, .code_memory = code_memory, .report = report};
    find_unit(g, NULL, NULL, 0);
}

cal_value *cal_graph_expression(cal_graph *g, const cal_node *node) {
    cal_value *v = cal_graph_build(g, node);
    if (v)
        v->uses++;
    return v;
}

static cal_value *build_unit(cal_graph *g, const cal_graph_unit *unit) {
    cal_argument *arguments = cal_graph_allocate(g, (size_t)unit->parameter_count * sizeof *arguments);
    if (!arguments)
        return NULL;
    for (int i = 0; i < unit->parameter_count; i++)
        arguments[i] = (cal_argument){.value = cal_value_leaf(g, CAL_V_PARAMETER, i), .bound = unit->bound[i]};
    cal_call call = {.symbol = unit->symbol, .argument_count = unit->parameter_count, .arguments = arguments};
    g->call = &call;
    cal_value *v = g->status ? NULL : cal_graph_build(g, unit->symbol->definition->body);
    g->call = NULL;
    if (v)
        v->uses++;
    return v;
}

graze_status cal_graph_finish(cal_graph *g) {
    for (int u = 1; u < g->unit_count && !g->status; u++) {
        memset(g->tables[1], 0, sizeof g->tables[1]);
        g->unit = u;
        const cal_graph_unit unit = g->units[u];
        cal_value *result = build_unit(g, &unit);
        g->units[u].result = result;
    }
    return g->status;
}
