/* Calls of the library's functions. */
#include "cal/graph_internal.h"

#include <math.h>

cal_value *cal_graph_too_few(cal_graph *g, const cal_node *call, const char *name) {
    return cal_value_failing(g, call, "%s() is called with too few arguments", name);
}

const cal_node *cal_graph_argument(const cal_node *call, int i) {
    const cal_node *n = call->first->next;
    while (n && i-- > 0)
        n = n->next;
    return n;
}

static cal_value *build_argument(cal_graph *g, const cal_node *call, int i, const char *name) {
    const cal_node *tree = cal_graph_argument(call, i);
    return tree ? cal_graph_build(g, tree) : cal_graph_too_few(g, call, name);
}

static double apply(const cal_function *f, cal_value *const *a, int count) {
    if (count == 1)
        return f->real_1(a[0]->number);
    if (count == 2)
        return f->real_2(a[0]->number, a[1]->number);
    cal_noise_memory memory = {.known = 0};
    const double point[3] = {a[0]->number, a[1]->number, a[2]->number};
    return cal_noise(f->noise, point, &memory);
}

static cal_value *real_function(cal_graph *g, const cal_function *f, cal_value **a, int count) {
    bool known = true;
    for (int i = 0; i < count; i++)
        known = known && cal_value_is_constant(a[i]);
    double number = known ? apply(f, a, count) : 0;
    if (known && isfinite(number))
        return cal_value_constant(g, number, true);
    cal_value *v = cal_value_new(g, CAL_V_REAL, count);
    for (int i = 0; i < count; i++)
        if (!cal_value_set(g, v, i, a[i]))
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
    if (cal_value_is_constant(condition))
        return cal_value_check(g, build_argument(g, call, condition->number > 0 ? 1 : 2, "if"));
    cal_value *v = cal_value_set(g, cal_value_new(g, CAL_V_IF, 3), 0, condition);
    for (int i = 1; i < 3; i++)
        if (!v || !cal_value_set(g, v, i, build_branch(g, call, i, "if")))
            return NULL;
    v->effect = true;
    return v;
}

static cal_value *build_select(cal_graph *g, const cal_node *call) {
    int count = call->count - 1;
    cal_value *which = build_argument(g, call, 0, "select");
    if (!which)
        return NULL;
    if (cal_value_is_constant(which) && which->number >= -.5 && which->number + .5 < count) {
        int n = (int)(which->number + .5);
        return n == 0 ? cal_value_constant(g, count - 1, true)
                      : cal_value_check(g, build_argument(g, call, n, "select"));
    }
    cal_value *v = cal_value_set(g, cal_value_new(g, CAL_V_SELECT, count), 0, which);
    for (int i = 1; i < count; i++)
        if (!v || !cal_value_set(g, v, i, build_branch(g, call, i, "select")))
            return NULL;
    if (v)
        v->effect = true;
    return v;
}

static cal_value *build_extreme(cal_graph *g, const cal_node *call, const cal_function *f) {
    int count = call->count - 1;
    if (count == 1)
        return cal_value_check(g, build_argument(g, call, 0, f->name));
    bool known = true;
    cal_value *v = cal_value_new(g, CAL_V_EXTREME, count);
    for (int i = 0; i < count; i++) {
        if (!v || !cal_value_set(g, v, i, build_argument(g, call, i, f->name)))
            return NULL;
        known = known && cal_value_is_constant(v->operands[i]);
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
    return cal_value_constant(g, extreme, true);
}

static cal_value *build_real_argument(cal_graph *g, const cal_node *call) {
    if (g->is_constant)
        return cal_value_failing(g, call, "a constant cannot depend on arg()");
    cal_value *which = build_argument(g, call, 0, "arg");
    if (!which)
        return NULL;
    if (cal_value_is_constant(which)) {
        double n = floor(which->number + .5);
        if (n < 1)
            return cal_value_constant(g, (double)g->real_count, true);
        if (n <= (double)g->real_count)
            return cal_value_constant(g, g->reals[(size_t)n - 1], true);
        return cal_value_failing(g, call, "the primitive has no real argument %.0f", n);
    }
    cal_value *missing = cal_value_failing(g, call, "the primitive has fewer real arguments than this asks for");
    cal_value *v = cal_value_set(g, cal_value_new(g, CAL_V_ARGUMENT, 1), 0, which);
    if (!v || !missing)
        return NULL;
    v->index = missing->index;
    v->effect = true;
    return v;
}

cal_value *cal_graph_library_call(cal_graph *g, const cal_node *call, const cal_symbol *symbol) {
    const cal_function *f = symbol->library;
    if (!f)
        return cal_value_undefined(g, call, symbol, true);
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

cal_value *cal_graph_power(cal_graph *g, const cal_node *node) {
    cal_value *a[2] = {cal_graph_build(g, node->first), NULL};
    if (!a[0] || !(a[1] = cal_graph_build(g, node->first->next)))
        return NULL;
    return real_function(g, cal_library_power(), a, 2);
}
