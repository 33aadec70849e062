/* A parser by recursive descent; chains of sums and products are taken in loops. */
#include "cal/syntax.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { DEPTH_MOST = 500 };

void cal_node_append(cal_node *node, cal_node *operand) {
    operand->next = NULL;
    if (node->last)
        node->last->next = operand;
    else
        node->first = operand;
    node->last = operand;
    node->count++;
    if (node->height <= operand->height)
        node->height = operand->height + 1;
}

graze_status cal_complain(const cal_parser *p, int line, int column, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (p->expression)
        return report_error(p->report, &p->where, "in the expression '%.200s', column %d: %s", p->expression, column,
                            text);
    place where = p->where;
    where.line = line;
    where.column = column;
    return report_error(p->report, &where, "%s", text);
}

void cal_parse_begin(cal_parser *p, const char *text, size_t length, arena *memory, const graze_report *report) {
    *p = (cal_parser){.memory = memory, .report = report};
    cal_scan_begin(&p->scanner, text, length);
}

/* All parsing functions give null after an error, which is in the parser's status. */
static cal_node *fail(cal_parser *p, const char *what) {
    const cal_scanner *s = &p->scanner;
    if (p->status)
        return NULL;
    if (s->open_comment)
        p->status = cal_complain(p, s->open_line, s->open_column, "this comment has no '}'");
    else
        p->status = cal_complain(p, s->line, cal_scan_column(s), "%s", what);
    return NULL;
}

static void *allocate(cal_parser *p, size_t size) {
    void *memory = arena_allocate(p->memory, size);
    if (!memory && !p->status)
        p->status = report_out_of_memory(p->report);
    return memory;
}

static cal_node *node_here(cal_parser *p, cal_kind kind) {
    cal_node *node = allocate(p, sizeof *node);
    if (node)
        *node = (cal_node){.kind = kind, .line = p->scanner.line, .column = cal_scan_column(&p->scanner)};
    return node;
}

static const char *take_name(cal_parser *p) {
    size_t length;
    const char *name = cal_scan_name(&p->scanner, &length);
    const char *copy = arena_copy_text(p->memory, name, length);
    if (!copy && !p->status)
        p->status = report_out_of_memory(p->report);
    return copy;
}

static cal_node *parse_sum(cal_parser *);

static cal_node *take_closing(cal_parser *p, cal_node *node) {
    if (!node)
        return NULL;
    if (cal_scan_peek(&p->scanner) != ')')
        return fail(p, "')' expected");
    cal_scan_skip(&p->scanner);
    return node;
}

static cal_node *parse_name(cal_parser *p) {
    cal_node *node = node_here(p, CAL_NAME);
    if (!node || !(node->name = take_name(p)))
        return NULL;
    if (cal_scan_peek(&p->scanner) != '(')
        return node;
    do {
        cal_scan_skip(&p->scanner);
        cal_node *argument = parse_sum(p);
        if (!argument)
            return NULL;
        cal_node_append(node, argument);
    } while (cal_scan_peek(&p->scanner) == ',');
    return take_closing(p, node);
}

static cal_node *parse_number(cal_parser *p) {
    cal_node *node = node_here(p, CAL_NUMBER);
    cal_scanner before = p->scanner;
    if (!node)
        return NULL;
    if (!cal_scan_number(&p->scanner, &node->number))
        return fail(p, "no number can be read here");
    if (isfinite(node->number))
        return node;
    p->scanner = before;
    return fail(p, "this number is too large");
}

static cal_node *parse_channel(cal_parser *p) {
    cal_node *node = node_here(p, CAL_CHANNEL);
    if (!node)
        return NULL;
    cal_scan_skip(&p->scanner);
    return cal_scan_integer(&p->scanner, &node->index) ? node : fail(p, "no channel has such a number");
}

static cal_node *parse_atom(cal_parser *p) {
    char c = cal_scan_peek(&p->scanner);
    if (c == '(') {
        cal_scan_skip(&p->scanner);
        return take_closing(p, parse_sum(p));
    }
    if (c == '$')
        return parse_channel(p);
    if (cal_starts_name(c))
        return parse_name(p);
    if ((c >= '0' && c <= '9') || c == '.')
        return parse_number(p);
    return fail(p, cal_scan_at_end(&p->scanner) ? "the expression ends too early" : "unexpected character");
}

static cal_node *parse_sign(cal_parser *p) {
    char sign = cal_scan_peek(&p->scanner);
    if (sign != '-' && sign != '+')
        return parse_atom(p);
    cal_node *negative = node_here(p, CAL_NEGATIVE);
    cal_scan_skip(&p->scanner);
    cal_node *atom = negative ? parse_atom(p) : NULL;
    if (!atom || sign == '+')
        return atom;
    cal_node_append(negative, atom);
    return negative;
}

static cal_node *parse_power(cal_parser *p) {
    if (++p->depth > DEPTH_MOST)
        return fail(p, "nested too deeply");
    cal_node *base = parse_sign(p);
    cal_node *power = base;
    if (base && cal_scan_peek(&p->scanner) == '^') {
        power = node_here(p, CAL_POWER);
        cal_scan_skip(&p->scanner);
        cal_node *exponent = power ? parse_power(p) : NULL;
        if (!exponent)
            return NULL;
        cal_node_append(power, base);
        cal_node_append(power, exponent);
    }
    p->depth--;
    return power;
}

static cal_node *parse_chain(cal_parser *p, cal_kind kind, char plain, char inverse,
                             cal_node *(*parse_operand)(cal_parser *)) {
    cal_node *chain = NULL, *operand = parse_operand(p);
    for (;;) {
        char c = cal_scan_peek(&p->scanner);
        if (!operand)
            return NULL;
        if (chain)
            cal_node_append(chain, operand);
        if (c != plain && c != inverse)
            return chain ? chain : operand;
        if (!chain) {
            if (!(chain = node_here(p, kind)))
                return NULL;
            cal_node_append(chain, operand);
        }
        cal_scan_skip(&p->scanner);
        operand = parse_operand(p);
        if (operand)
            operand->inverse = c == inverse;
    }
}

static cal_node *parse_product(cal_parser *p) {
    return parse_chain(p, CAL_PRODUCT, '*', '/', parse_power);
}

static cal_node *parse_sum(cal_parser *p) {
    return parse_chain(p, CAL_SUM, '+', '-', parse_product);
}

graze_status cal_parse_expression(cal_parser *p, cal_node **node) {
    *node = parse_sum(p);
    if (*node && !cal_scan_at_end(&p->scanner))
        *node = fail(p, "unexpected character");
    else if (*node && p->scanner.open_comment)
        *node = fail(p, "");
    return p->status;
}

static bool parse_parameters(cal_parser *p, cal_statement *s) {
    int capacity = 0;
    do {
        cal_scan_skip(&p->scanner);
        char c = cal_scan_peek(&p->scanner);
        if (!cal_starts_name(c) || c == '`')
            return fail(p, "a parameter's name expected");
        if (s->parameter_count == capacity) {
            capacity = capacity ? 2 * capacity : 8;
            const char **more = allocate(p, (size_t)capacity * sizeof *more);
            if (!more)
                return false;
            if (s->parameter_count)
                memcpy(more, s->parameters, (size_t)s->parameter_count * sizeof *more);
            s->parameters = more;
        }
        cal_scanner before = p->scanner;
        const char *name = take_name(p);
        if (!name)
            return false;
        if (strchr(name, '`')) {
            p->scanner = before;
            return fail(p, "a parameter's name cannot have a context");
        }
        s->parameters[s->parameter_count++] = name;
    } while (cal_scan_peek(&p->scanner) == ',');
    if (cal_scan_peek(&p->scanner) != ')')
        return fail(p, "')' expected");
    cal_scan_skip(&p->scanner);
    return true;
}

static bool parse_definition(cal_parser *p, cal_statement *s) {
    *s = (cal_statement){.line = p->scanner.line, .column = cal_scan_column(&p->scanner)};
    if (!cal_starts_name(cal_scan_peek(&p->scanner)))
        return fail(p, cal_scan_peek(&p->scanner) == '$' ? "channels cannot be set here" : "a name expected");
    if (!(s->name = take_name(p)))
        return false;
    s->is_function = cal_scan_peek(&p->scanner) == '(';
    if (s->is_function && !parse_parameters(p, s))
        return false;
    char c = cal_scan_peek(&p->scanner);
    if (c != '=' && c != ':')
        return fail(p, "'=' or ':' expected");
    s->is_constant = c == ':';
    cal_scan_skip(&p->scanner);
    if (!(s->body = parse_sum(p)))
        return false;
    if (cal_scan_peek(&p->scanner) == ';')
        cal_scan_skip(&p->scanner);
    else if (!cal_scan_at_end(&p->scanner))
        return fail(p, "';' expected");
    return true;
}

graze_status cal_parse_statement(cal_parser *p, cal_statement *s, bool *found) {
    while (cal_scan_peek(&p->scanner) == ';')
        cal_scan_skip(&p->scanner);
    *found = !cal_scan_at_end(&p->scanner) && parse_definition(p, s);
    if (!p->status && p->scanner.open_comment)
        fail(p, "");
    return p->status;
}
