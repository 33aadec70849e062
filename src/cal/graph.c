/* Building values from trees. */
#include "cal/graph.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    DEPTH_MOST = 1500,     /* of trees within trees, in calls within calls */
    HEIGHT_MOST = 3000,    /* of the graph */
    UNROLLED_MOST = 64,    /* calls of a function within itself */
    INLINE_MOST = 50000,   /* values, before calls stay calls */
    VALUES_MOST = 1000000, /* before giving up */
    UNITS_MOST = 1000
};

typedef struct cal_variable {
    const cal_symbol *symbol;
    cal_value *value; /* null while it is being built */
    struct cal_variable *next;
} cal_variable;

static cal_value *build(cal_graph *, const cal_node *);

static cal_value *stop(cal_graph *g, const char *what) {
    if (!g->status)
        g->status = what ? report_error(g->report, g->where, "%s", what) : report_out_of_memory(g->report);
    return NULL;
}

static void *allocate(cal_graph *g, size_t size) {
    void *memory = arena_allocate(g->memory, size);
    if (!memory)
        stop(g, NULL);
    return memory;
}

/* --- Values ---------------------------------------------------------------------------------------------------------
 */

static cal_value *new_value(cal_graph *g, cal_value_kind kind, int count) {
    if (++g->value_count > VALUES_MOST)
        return stop(g, "the functions of this expression call each other too often to be compiled");
    cal_value *v = allocate(g, sizeof *v);
    cal_value **operands = count > 0 ? allocate(g, (size_t)count * sizeof *operands) : NULL;
    if (!v || (count > 0 && !operands))
        return NULL;
    *v = (cal_value){.kind = kind, .count = count, .operands = operands};
    return v;
}

static cal_value *set_operand(cal_graph *g, cal_value *v, int i, cal_value *operand) {
    if (!v || !operand)
        return NULL;
    v->operands[i] = operand;
    operand->uses++;
    v->effect |= operand->effect;
    if (v->height <= operand->height)
        v->height = operand->height + 1;
    return v->height > HEIGHT_MOST ? stop(g, "the functions of this expression are nested too deeply") : v;
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
    if (a->kind != b->kind || a->index != b->index || a->count != b->count ||
        memcmp(&a->number, &b->number, sizeof a->number) != 0)
        return false;
    for (int i = 0; i < a->count; i++)
        if (a->operands[i] != b->operands[i])
            return false;
    return true;
}

/* The value of the unit that is the same as this new one, which then is given up, or this one. */
static cal_value *unique(cal_graph *g, cal_value *v) {
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

static cal_value *constant(cal_graph *g, double number, bool effect) {
    cal_value *v = new_value(g, CAL_V_CONSTANT, 0);
    if (!v)
        return NULL;
    v->number = number;
    v->effect = effect;
    return unique(g, v);
}

static cal_value *leaf(cal_graph *g, cal_value_kind kind, int index) {
    cal_value *v = new_value(g, kind, 0);
    if (!v)
        return NULL;
    v->index = index;
    v->effect = kind == CAL_V_PARAMETER;
    return unique(g, v);
}

__attribute__((format(printf, 3, 4))) static cal_value *failing(cal_graph *g, const cal_node *node, const char *format,
                                                                ...) {
    char text[512], message[640];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const cal_definition *d = g->call && g->call->symbol ? g->call->symbol->definition : NULL;
    if (d)
        snprintf(message, sizeof message, "%s:%d:%d: %s", d->file ? d->file : "expression", node->line, node->column,
                 text);
    else
        snprintf(message, sizeof message, "column %d of the expression: %s", node->column, text);
    cal_value *v = new_value(g, CAL_V_FAIL, 0);
    if (!v)
        return NULL;
    if (g->message_count == g->message_capacity) {
        int capacity = g->message_capacity ? 2 * g->message_capacity : 16;
        const char **more = arena_allocate(g->code_memory, (size_t)capacity * sizeof *more);
        if (!more)
            return stop(g, NULL);
        if (g->message_count)
            memcpy(more, g->messages, (size_t)g->message_count * sizeof *more);
        g->messages = more;
        g->message_capacity = capacity;
    }
    const char *copy = arena_copy_text(g->code_memory, message, strlen(message));
    if (!copy)
        return stop(g, NULL);
    v->index = g->message_count;
    v->effect = true;
    g->messages[g->message_count++] = copy;
    return v;
}

/* --- Arithmetic -----------------------------------------------------------------------------------------------------
 */

static bool is_constant(const cal_value *v) {
    return v->kind == CAL_V_CONSTANT;
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

static cal_value *binary(cal_graph *g, cal_value_kind kind, cal_value *a, cal_value *b) {
    double number;
    if (!a || !b)
        return NULL;
    if (is_constant(a) && is_constant(b) && compute(kind, a->number, b->number, &number))
        return constant(g, number, a->effect || b->effect);
    /* A factor 1; no term 0, for that changes the sign of another 0. */
    if ((kind == CAL_V_MULTIPLY || kind == CAL_V_DIVIDE) && is_constant(b) && b->number == 1 && !b->effect)
        return a;
    if (kind == CAL_V_MULTIPLY && is_constant(a) && a->number == 1 && !a->effect)
        return b;
    cal_value *v = new_value(g, kind, 2);
    if (!set_operand(g, v, 0, a) || !set_operand(g, v, 1, b))
        return NULL;
    v->effect |= kind == CAL_V_DIVIDE && !(is_constant(b) && b->number != 0);
    return unique(g, v);
}

static cal_value *negate(cal_graph *g, cal_value *a) {
    if (!a)
        return NULL;
    if (is_constant(a))
        return constant(g, -a->number, a->effect);
    cal_value *v = new_value(g, CAL_V_NEGATE, 1);
    return unique(g, set_operand(g, v, 0, a));
}

static cal_value *build_chain(cal_graph *g, const cal_node *node) {
    cal_value *v = build(g, node->first);
    for (const cal_node *n = node->first->next; v && n; n = n->next)
        v = binary(g,
                   node->kind == CAL_PRODUCT ? CAL_V_MULTIPLY
                   : n->inverse              ? CAL_V_SUBTRACT
                                             : CAL_V_ADD,
                   v, build(g, n));
    return v;
}

static cal_value *build_pair(cal_graph *g, cal_value_kind kind, const cal_node *node) {
    cal_value *a = build(g, node->first);
    return binary(g, kind, a, build(g, node->last));
}

/* --- Functions of the library ---------------------------------------------------------------------------------------
 */

/* Its value is that of a function of the library already, computed here and not before. */
static bool is_checked(const cal_value *v) {
    if (v->is_named)
        return false;
    return v->kind == CAL_V_REAL || v->kind == CAL_V_IF || v->kind == CAL_V_SELECT || v->kind == CAL_V_EXTREME ||
           v->kind == CAL_V_CHECK || v->kind == CAL_V_ARGUMENT || (v->kind == CAL_V_CONSTANT && v->effect);
}

static cal_value *check(cal_graph *g, cal_value *operand) {
    if (!operand || is_checked(operand))
        return operand;
    if (is_constant(operand))
        return constant(g, operand->number, true);
    /* Where the operand was computed before, the fault noted then is forgotten. */
    cal_value *v = set_operand(g, new_value(g, CAL_V_CHECK, 1), 0, operand);
    if (v)
        v->effect = true;
    return v;
}

static cal_value *too_few(cal_graph *g, const cal_node *call, const char *name) {
    return failing(g, call, "%s() is called with too few arguments", name);
}

static const cal_node *argument_tree(const cal_node *call, int i) {
    const cal_node *n = call->first->next;
    while (n && i-- > 0)
        n = n->next;
    return n;
}

static cal_value *build_argument(cal_graph *g, const cal_node *call, int i, const char *name) {
    const cal_node *tree = argument_tree(call, i);
    return tree ? build(g, tree) : too_few(g, call, name);
}

static double apply(const cal_function *f, cal_value *const *a) {
    if (f->kind == CAL_REAL_1)
        return f->real_1(a[0]->number);
    if (f->kind == CAL_REAL_2)
        return f->real_2(a[0]->number, a[1]->number);
    cal_noise_memory memory = {.known = 0};
    const double point[3] = {a[0]->number, a[1]->number, a[2]->number};
    return cal_noise(f->noise, point, &memory);
}

static cal_value *real_function(cal_graph *g, const cal_function *f, cal_value **a, int count) {
    bool known = true;
    for (int i = 0; i < count; i++)
        known = known && is_constant(a[i]);
    double number = known ? apply(f, a) : 0;
    if (known && isfinite(number))
        return constant(g, number, true);
    cal_value *v = new_value(g, CAL_V_REAL, count);
    for (int i = 0; i < count; i++)
        if (!set_operand(g, v, i, a[i]))
            return NULL;
    v->function = f;
    v->effect = true;
    return v;
}

static cal_value *build_real(cal_graph *g, const cal_node *call, const cal_function *f) {
    int count = f->kind == CAL_REAL_1 ? 1 : f->kind == CAL_REAL_2 ? 2 : 3;
    cal_value *a[3] = {NULL, NULL, NULL};
    for (int i = 0; i < count; i++)
        if (!(a[i] = build_argument(g, call, i, f->name)))
            return NULL;
    return real_function(g, f, a, count);
}

static cal_value *build_branch(cal_graph *g, const cal_node *call, int i, const char *name) {
    g->branches++;
    cal_value *v = build_argument(g, call, i, name);
    g->branches--;
    return v;
}

static cal_value *build_if(cal_graph *g, const cal_node *call) {
    cal_value *condition = build_argument(g, call, 0, "if");
    if (!condition)
        return NULL;
    if (is_constant(condition))
        return check(g, build_argument(g, call, condition->number > 0 ? 1 : 2, "if"));
    cal_value *v = set_operand(g, new_value(g, CAL_V_IF, 3), 0, condition);
    for (int i = 1; i < 3; i++)
        if (!v || !set_operand(g, v, i, build_branch(g, call, i, "if")))
            return NULL;
    v->effect = true;
    return v;
}

static cal_value *build_select(cal_graph *g, const cal_node *call) {
    int count = call->count - 1;
    cal_value *which = build_argument(g, call, 0, "select");
    if (!which)
        return NULL;
    if (is_constant(which) && which->number >= -.5 && which->number + .5 < count) {
        int n = (int)(which->number + .5);
        return n == 0 ? constant(g, count - 1, true) : check(g, build_argument(g, call, n, "select"));
    }
    cal_value *v = set_operand(g, new_value(g, CAL_V_SELECT, count), 0, which);
    for (int i = 1; i < count; i++)
        if (!v || !set_operand(g, v, i, build_branch(g, call, i, "select")))
            return NULL;
    if (v)
        v->effect = true;
    return v;
}

static cal_value *build_extreme(cal_graph *g, const cal_node *call, const cal_function *f) {
    int count = call->count - 1;
    if (count == 1)
        return check(g, build_argument(g, call, 0, f->name));
    bool known = true;
    cal_value *v = new_value(g, CAL_V_EXTREME, count);
    for (int i = 0; i < count; i++) {
        if (!v || !set_operand(g, v, i, build_argument(g, call, i, f->name)))
            return NULL;
        known = known && is_constant(v->operands[i]);
    }
    v->function = f;
    v->effect = true;
    if (!known)
        return v;
    double extreme = v->operands[0]->number;
    for (int i = 1; i < count; i++) {
        double number = v->operands[i]->number;
        if (f->kind == CAL_MIN ? number < extreme : number > extreme)
            extreme = number;
    }
    return constant(g, extreme, true);
}

static cal_value *build_real_argument(cal_graph *g, const cal_node *call) {
    if (g->is_constant)
        return failing(g, call, "a constant cannot depend on arg()");
    cal_value *which = build_argument(g, call, 0, "arg");
    if (!which)
        return NULL;
    if (is_constant(which)) {
        double n = floor(which->number + .5);
        if (n < 1)
            return constant(g, (double)g->real_count, true);
        if (n <= (double)g->real_count)
            return constant(g, g->reals[(size_t)n - 1], true);
        return failing(g, call, "the primitive has no real argument %.0f", n);
    }
    cal_value *missing = failing(g, call, "the primitive has fewer real arguments than this asks for");
    cal_value *v = set_operand(g, new_value(g, CAL_V_ARGUMENT, 1), 0, which);
    if (!v || !missing)
        return NULL;
    v->index = missing->index;
    v->effect = true;
    return v;
}

static cal_value *build_library_call(cal_graph *g, const cal_node *call, const cal_symbol *symbol) {
    const cal_function *f = symbol->library;
    if (!f)
        return failing(g, call, "there is no function %s()", symbol->name);
    switch (f->kind) {
    case CAL_IF:
        return build_if(g, call);
    case CAL_SELECT:
        return build_select(g, call);
    case CAL_MIN:
    case CAL_MAX:
        return build_extreme(g, call, f);
    case CAL_ARGUMENT:
        return build_real_argument(g, call);
    default:
        return build_real(g, call, f);
    }
}

static cal_value *build_power(cal_graph *g, const cal_node *node) {
    cal_value *a[2] = {build(g, node->first), NULL};
    if (!a[0] || !(a[1] = build(g, node->first->next)))
        return NULL;
    return real_function(g, cal_library_power(), a, 2);
}

/* --- Functions that are defined -------------------------------------------------------------------------------------
 */

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
        return too_few(g, node, g->call->symbol->name);
    cal_argument *a = &g->call->arguments[node->index];
    if (a->value)
        return a->value;
    /* The tree belongs to where the call is. */
    cal_call *inside = g->call;
    int branches = g->branches;
    g->call = a->outside;
    g->branches = inside->branches;
    a->value = named(build(g, a->tree));
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
    cal_call *inside = allocate(g, sizeof *inside);
    cal_argument *arguments = allocate(g, (size_t)count * sizeof *arguments);
    if (!inside || !arguments)
        return NULL;
    int i = 0;
    for (const cal_node *n = call->first->next; n; n = n->next)
        arguments[i++] = (cal_argument){.tree = n, .outside = g->call};
    *inside = (cal_call){
        .symbol = symbol, .within = g->call, .branches = g->branches, .argument_count = count, .arguments = arguments};
    g->call = inside;
    cal_value *v = build(g, symbol->definition->body);
    g->call = inside->within;
    return v;
}

static int find_unit(cal_graph *g, cal_symbol *symbol, cal_symbol **bound, int count) {
    for (int u = 1; u < g->unit_count; u++)
        if (g->units[u].symbol == symbol && memcmp(g->units[u].bound, bound, (size_t)count * sizeof(cal_symbol *)) == 0)
            return u;
    if (g->unit_count == UNITS_MOST) {
        stop(g, "the functions of this expression call each other in too many ways");
        return -1;
    }
    if (g->unit_count == g->unit_capacity) {
        int capacity = g->unit_capacity ? 2 * g->unit_capacity : 8;
        cal_graph_unit *more = allocate(g, (size_t)capacity * sizeof *more);
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
    cal_symbol **bound = allocate(g, (size_t)count * sizeof *bound);
    cal_value *v = new_value(g, CAL_V_CALL, count);
    if (!v || !bound)
        return NULL;
    g->branches++;
    for (int i = 0; i < count && v; i++) {
        const cal_node *tree = argument_tree(call, i);
        bound[i] = tree && d->passed[i] ? function_of(tree, g->call) : NULL;
        v = set_operand(g, v, i, tree ? build(g, tree) : too_few(g, call, symbol->name));
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
        return failing(g, call, "an argument that is called here is not the name of a function");
    if (!symbol->definition || !symbol->definition->is_function)
        return build_library_call(g, call, symbol);
    return may_unroll(g, symbol) ? unroll(g, call, symbol) : call_unit(g, call, symbol);
}

/* --- Variables ------------------------------------------------------------------------------------------------------
 */

static cal_variable *variable_of(cal_graph *g, const cal_symbol *symbol, bool *is_new) {
    cal_variable **slot = &g->variables[((uintptr_t)symbol >> 5) % CAL_VALUE_HASH];
    cal_variable *variable = *slot;
    while (variable && variable->symbol != symbol)
        variable = variable->next;
    *is_new = !variable;
    if (variable || !(variable = allocate(g, sizeof *variable)))
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
        return variable->value ? variable->value : failing(g, node, "%s is defined by itself", symbol->name);
    cal_call at = {.symbol = symbol, .within = NULL, .branches = 0};
    cal_call *call = g->call;
    int branches = g->branches;
    g->call = &at;
    g->branches = 0;
    variable->value = named(build(g, symbol->definition->body));
    g->call = call;
    g->branches = branches;
    return variable->value;
}

static bool share(cal_graph *g, cal_value *v) {
    if (v->shared)
        return true;
    if (g->shared_count == g->shared_capacity) {
        size_t capacity = g->shared_capacity ? 2 * g->shared_capacity : 16;
        cal_value **more = allocate(g, capacity * sizeof *more);
        if (!more)
            return false;
        if (g->shared_count)
            memcpy(more, g->shared, g->shared_count * sizeof *more);
        g->shared = more;
        g->shared_capacity = capacity;
    }
    g->shared[g->shared_count++] = v;
    v->shared = true;
    v->uses += 2;
    return true;
}

static cal_value *seen_from_unit(cal_graph *g, cal_value *v) {
    if (v && is_constant(v))
        return constant(g, v->number, v->effect);
    if (v && v->kind == CAL_V_CHANNEL)
        return leaf(g, CAL_V_CHANNEL, v->index);
    cal_value *reference = new_value(g, CAL_V_OF_MAIN, 0);
    if (!v || !reference)
        return NULL;
    reference->other = v;
    reference->effect = true;
    return share(g, v) ? reference : NULL;
}

static cal_value *build_variable(cal_graph *g, const cal_node *node) {
    const cal_definition *d = node->symbol->definition;
    if (!d || d->is_function)
        return failing(g, node, "there is no variable %s", node->symbol->name);
    if (d->body->kind == CAL_NUMBER)
        return constant(g, d->body->number, false);
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
        return failing(g, node, "there is no channel $%d", node->index);
    if (g->channels & CAL_CHANNEL_BIT(node->index))
        return leaf(g, CAL_V_CHANNEL, node->index - 1);
    const cal_symbol *symbol = g->call ? g->call->symbol : NULL;
    bool is_name = symbol && symbol->definition && symbol->definition->body == node;
    return failing(g, node, "%s%.0d has no value here", is_name ? symbol->name : "channel $",
                   is_name ? 0 : node->index);
}

static cal_value *build_kind(cal_graph *g, const cal_node *node) {
    switch (node->kind) {
    case CAL_NUMBER:
        return constant(g, node->number, false);
    case CAL_CHANNEL:
        return build_channel(g, node);
    case CAL_NEGATIVE:
        return negate(g, build(g, node->first));
    case CAL_DIFFERENCE:
        return build_pair(g, CAL_V_SUBTRACT, node);
    case CAL_QUOTIENT:
        return build_pair(g, CAL_V_DIVIDE, node);
    case CAL_POWER:
        return build_power(g, node);
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

static cal_value *build(cal_graph *g, const cal_node *node) {
    if (g->status)
        return NULL;
    if (++g->depth > DEPTH_MOST)
        return stop(g, "the functions of this expression are nested too deeply");
    cal_value *v = build_kind(g, node);
    g->depth--;
    return v;
}

/* --- The whole ------------------------------------------------------------------------------------------------------
 */

void cal_graph_begin(cal_graph *g, cal_program *program, arena *memory, arena *code_memory,
                     const graze_report *report) {
    *g = (cal_graph){.memory = memory, .program = program, .code_memory = code_memory, .report = report};
    find_unit(g, NULL, NULL, 0);
}

cal_value *cal_graph_expression(cal_graph *g, const cal_node *node) {
    cal_value *v = build(g, node);
    if (v)
        v->uses++;
    return v;
}

static cal_value *build_unit(cal_graph *g, const cal_graph_unit *unit) {
    cal_argument *arguments = allocate(g, (size_t)unit->parameter_count * sizeof *arguments);
    if (!arguments)
        return NULL;
    for (int i = 0; i < unit->parameter_count; i++)
        arguments[i] = (cal_argument){.value = leaf(g, CAL_V_PARAMETER, i), .bound = unit->bound[i]};
    cal_call call = {.symbol = unit->symbol, .argument_count = unit->parameter_count, .arguments = arguments};
    g->call = &call;
    cal_value *v = g->status ? NULL : build(g, unit->symbol->definition->body);
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
