/* What names mean where they are used, and constants: the rules by which Radiance computes them once, for they show.
 * A constant that is defined again later keeps its value in what was read before; a division by a constant is a product
 * with its inverse; products with a constant 0 are 0 whatever the other factor; a constant that cannot be computed is
 * an error even where it is never used. Constants are gathered within sums and products. */
#include <math.h>
#include <string.h>

#include "cal/constant.h"
#include "cal/program_internal.h"

typedef struct resolver {
    cal_program *program;
    const cal_parser *parser;
    const char *context;
    const cal_statement *function;
    bool *passed;
    graze_status status;
} resolver;

/* Chains of sums and products have one level, differences and quotients as many as there are of them. */
enum { HEIGHT_MOST = 1000 };

static cal_node *fail(resolver *r, const cal_node *node, const char *what) {
    if (!r->status)
        r->status = cal_complain(r->parser, node->line, node->column, "%s", what);
    return NULL;
}

static cal_node *out_of_memory(resolver *r) {
    r->status = report_out_of_memory(r->parser->report);
    return NULL;
}

static bool is_number(const cal_node *node, double value) {
    return node->kind == CAL_NUMBER && node->number == value;
}

static cal_node *as_number(cal_node *node, double value) {
    node->kind = CAL_NUMBER;
    node->number = value;
    node->first = node->last = NULL;
    node->count = node->height = 0;
    return node;
}

static cal_node *new_node(resolver *r, const cal_node *like, cal_kind kind) {
    cal_node *node = arena_allocate(r->parser->memory, sizeof *node);
    if (!node)
        return out_of_memory(r);
    *node = (cal_node){.kind = kind, .line = like->line, .column = like->column};
    return node;
}

static cal_node *resolve(resolver *, cal_node *);

/* Takes operands of `node` out of it, for it to be built again. */
static cal_node *take_operands(cal_node *node) {
    cal_node *first = node->first;
    node->first = node->last = NULL;
    node->count = node->height = 0;
    return first;
}

static cal_node *constant_of(const cal_node *chain) {
    cal_node *n = chain->first;
    while (n && n->kind != CAL_NUMBER)
        n = n->next;
    return n;
}

static void append_to_chain(cal_node *chain, cal_node *operand) {
    cal_node *constant = operand->kind == CAL_NUMBER ? constant_of(chain) : NULL;
    if (!constant)
        cal_node_append(chain, operand);
    else if (chain->kind == CAL_SUM)
        constant->number += operand->number;
    else
        constant->number *= operand->number;
}

/* `left` with one operand more; a chain of that kind on the right is taken in. */
static cal_node *join(resolver *r, cal_kind kind, cal_node *left, cal_node *right) {
    cal_node *chain = left;
    if (left->kind != kind) {
        if (!(chain = new_node(r, left, kind)))
            return NULL;
        cal_node_append(chain, left);
    }
    if (right->kind == kind) {
        for (cal_node *n = take_operands(right), *next; n; n = next) {
            next = n->next;
            append_to_chain(chain, n);
        }
    } else {
        append_to_chain(chain, right);
    }
    return chain;
}

/* A difference or quotient. */
static cal_node *pair(resolver *r, cal_kind kind, cal_node *left, cal_node *right) {
    cal_node *node = new_node(r, left, kind);
    if (!node)
        return NULL;
    cal_node_append(node, left);
    cal_node_append(node, right);
    return node->height > HEIGHT_MOST ? fail(r, right, "too many differences and quotients in one expression") : node;
}

static cal_node *add(resolver *r, cal_node *left, cal_node *right, bool inverse) {
    if (inverse && right->kind != CAL_NUMBER)
        return pair(r, CAL_DIFFERENCE, left, right);
    if (inverse)
        right->number = -right->number;
    if (left->kind == CAL_NUMBER && right->kind == CAL_NUMBER)
        return as_number(left, left->number + right->number);
    return join(r, CAL_SUM, left, right);
}

static cal_node *divide(resolver *r, cal_node *left, cal_node *right) {
    if (is_number(right, 0))
        return fail(r, right, "division by a constant 0");
    if (right->kind == CAL_NUMBER) {
        if (left->kind == CAL_NUMBER)
            return as_number(left, left->number / right->number);
        return join(r, CAL_PRODUCT, left, as_number(right, 1 / right->number));
    }
    return is_number(left, 0) ? left : pair(r, CAL_QUOTIENT, left, right);
}

static cal_node *multiply(resolver *r, cal_node *left, cal_node *right, bool inverse) {
    if (inverse)
        return divide(r, left, right);
    if (left->kind == CAL_NUMBER && right->kind == CAL_NUMBER)
        return as_number(left, left->number * right->number);
    if (is_number(left, 0) || is_number(right, 0))
        return is_number(left, 0) ? left : right;
    return join(r, CAL_PRODUCT, left, right);
}

static cal_node *resolve_chain(resolver *r, cal_node *chain) {
    cal_kind kind = chain->kind;
    cal_node *operand = take_operands(chain), *next = operand->next, *result = resolve(r, operand);
    for (operand = next; operand && result; operand = next) {
        bool inverse = operand->inverse;
        next = operand->next;
        operand = resolve(r, operand);
        if (!operand)
            return NULL;
        result = kind == CAL_SUM ? add(r, result, operand, inverse) : multiply(r, result, operand, inverse);
    }
    if (!result)
        return NULL;
    if (result->kind == CAL_NUMBER && !isfinite(result->number))
        return fail(r, result, "this constant is out of range");
    return result;
}

static cal_node *resolve_power(resolver *r, cal_node *power) {
    cal_node *base = power->first, *exponent = base->next;
    take_operands(power);
    base->next = NULL;
    if (!(base = resolve(r, base)) || !(exponent = resolve(r, exponent)))
        return NULL;
    if (base->kind == CAL_NUMBER && exponent->kind == CAL_NUMBER) {
        double value = pow(base->number, exponent->number);
        return isfinite(value) ? as_number(base, value) : fail(r, power, "this power does not exist");
    }
    if (is_number(base, 0) || is_number(exponent, 1))
        return base;
    if (is_number(exponent, 0) || is_number(base, 1))
        return as_number(base, 1);
    cal_node_append(power, base);
    cal_node_append(power, exponent);
    return power;
}

static cal_node *resolve_negative(resolver *r, cal_node *negative) {
    cal_node *operand = take_operands(negative);
    operand = resolve(r, operand);
    if (!operand)
        return NULL;
    if (operand->kind == CAL_NUMBER)
        return as_number(operand, -operand->number);
    if (operand->kind == CAL_NEGATIVE)
        return operand->first;
    cal_node_append(negative, operand);
    return negative;
}

static bool is_constant_function(const cal_node *node) {
    if (node->kind != CAL_VARIABLE)
        return false;
    const cal_symbol *symbol = node->symbol;
    if (symbol->definition)
        return symbol->definition->is_function && symbol->definition->is_constant;
    return symbol->library && symbol->library->kind != CAL_ARGUMENT;
}

/* A call that can be computed: functions that are constant, of numbers and such functions. */
static bool is_constant_call(const cal_node *call) {
    if (!is_constant_function(call->first))
        return false;
    for (const cal_node *n = call->first->next; n; n = n->next)
        if (n->kind != CAL_NUMBER && !is_constant_function(n))
            return false;
    return true;
}

static bool is_constant_variable(const cal_node *node) {
    const cal_definition *d = node->symbol->definition;
    return d && d->is_constant && !d->is_function;
}

static cal_node *compute(resolver *r, cal_node *node) {
    double value;
    r->status = cal_constant(r->program, r->parser, node, &value);
    return r->status ? NULL : as_number(node, value);
}

static int parameter_of_name(const resolver *r, const char *name) {
    for (int i = 0; r->function && i < r->function->parameter_count; i++)
        if (strcmp(r->function->parameters[i], name) == 0)
            return i;
    return -1;
}

/* The name itself, of a call or not. */
static cal_node *resolve_symbol(resolver *r, cal_node *node) {
    int parameter = parameter_of_name(r, node->name);
    if (parameter >= 0) {
        node->kind = CAL_PARAMETER;
        node->index = parameter;
        return node;
    }
    node->kind = CAL_VARIABLE;
    node->symbol = cal_symbols_use(&r->program->symbols, r->context, node->name);
    return node->symbol ? node : out_of_memory(r);
}

static cal_node *resolve_call(resolver *r, cal_node *node) {
    cal_node *callee = new_node(r, node, CAL_NAME), *argument = take_operands(node);
    if (!callee)
        return NULL;
    callee->name = node->name;
    node->kind = CAL_CALL;
    if (!resolve_symbol(r, callee))
        return NULL;
    cal_node_append(node, callee);
    if (callee->kind == CAL_PARAMETER)
        r->passed[callee->index] = true;
    while (argument) {
        cal_node *next = argument->next;
        argument->next = NULL;
        argument = resolve(r, argument);
        if (!argument)
            return NULL;
        if (argument->kind == CAL_PARAMETER)
            r->passed[argument->index] = true;
        cal_node_append(node, argument);
        argument = next;
    }
    return is_constant_call(node) ? compute(r, node) : node;
}

static cal_node *resolve(resolver *r, cal_node *node) {
    switch (node->kind) {
    case CAL_NAME:
        if (node->count > 0)
            return resolve_call(r, node);
        if (!resolve_symbol(r, node))
            return NULL;
        return node->kind == CAL_VARIABLE && is_constant_variable(node) ? compute(r, node) : node;
    case CAL_SUM:
    case CAL_PRODUCT:
        return resolve_chain(r, node);
    case CAL_POWER:
        return resolve_power(r, node);
    case CAL_NEGATIVE:
        return resolve_negative(r, node);
    default:
        return node;
    }
}

cal_node *cal_resolve(cal_program *program, const cal_parser *parser, const char *context,
                      const cal_statement *function, bool *passed, cal_node *node, graze_status *status) {
    resolver r = {program, parser, context, function, passed, GRAZE_OK};
    cal_node *resolved = resolve(&r, node);
    *status = r.status;
    return resolved;
}
