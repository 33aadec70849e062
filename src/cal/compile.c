/* The way from text to code. */
#include "cal/compile.h"

#include <stdlib.h>
#include <string.h>

#include "cal/constant.h"
#include "cal/emit.h"

static cal_code *new_code(void) {
    arena *memory = arena_create();
    cal_code *code = memory ? arena_allocate(memory, sizeof *code) : NULL;
    if (!code) {
        arena_destroy(memory);
        return NULL;
    }
    *code = (cal_code){.memory = memory};
    return code;
}

void cal_code_destroy(cal_code *code) {
    if (code)
        arena_destroy(code->memory);
}

const char *cal_code_undefined(const cal_code *code) {
    return code->undefined;
}

uint64_t cal_code_channels(const cal_code *code) {
    return code->channels;
}

/* What is made on the way to code, and left behind then. */
typedef struct workshop {
    arena *memory;
    cal_program *program;
    const cal_request *request; /* null for a constant */
    const char *context;
    const graze_report *report;
} workshop;

static graze_status parse_expression(const workshop *w, const cal_expression *x, cal_node **tree) {
    cal_parser p;
    graze_status status;
    cal_parse_begin(&p, x->text, strlen(x->text), w->memory, w->report);
    p.where = w->request->where ? *w->request->where : (place){0};
    p.expression = x->text;
    status = cal_parse_expression(&p, tree);
    if (!status)
        *tree = cal_resolve(w->program, &p, w->context, NULL, NULL, *tree, &status);
    return status;
}

/* The call of a function with channels as arguments. */
static graze_status make_call(const workshop *w, const cal_expression *x, cal_node **tree) {
    size_t count = (size_t)x->argument_count + 2;
    cal_node *nodes = arena_allocate(w->memory, count * sizeof *nodes);
    cal_symbol *symbol = cal_symbols_use(&w->program->symbols, w->context, x->text);
    if (!nodes || !symbol)
        return report_out_of_memory(w->report);
    nodes[0] = (cal_node){.kind = CAL_CALL, .line = 1, .column = 1};
    nodes[1] = (cal_node){.kind = CAL_VARIABLE, .symbol = symbol, .line = 1, .column = 1};
    cal_node_append(&nodes[0], &nodes[1]);
    for (size_t i = 2; i < count; i++) {
        nodes[i] = (cal_node){.kind = CAL_CHANNEL, .index = x->first_argument + (int)i - 2, .line = 1, .column = 1};
        cal_node_append(&nodes[0], &nodes[i]);
    }
    *tree = nodes;
    return GRAZE_OK;
}

static graze_status emit_trees(cal_graph *g, cal_code *code, const cal_request *request, cal_node *const *trees,
                               size_t count) {
    cal_value **results = arena_allocate(g->memory, count * sizeof(void *));
    if (!results)
        return report_out_of_memory(g->report);
    for (size_t i = 0; i < count; i++) {
        g->expression = request ? request->expressions[i].text : NULL;
        if (!(results[i] = cal_graph_expression(g, trees[i])))
            return g->status;
    }
    graze_status status = cal_graph_finish(g);
    return status ? status : cal_emit(code, g, results, count);
}

static bool copy_reals(cal_code *code, const cal_request *request) {
    size_t count = request ? request->real_count : 0;
    double *reals = arena_allocate(code->memory, count * sizeof *reals);
    if (!reals)
        return false;
    if (count)
        memcpy(reals, request->reals, count * sizeof *reals);
    code->reals = reals;
    code->real_count = (uint32_t)count;
    return true;
}

static graze_status compile_trees(cal_code **made, const workshop *w, cal_node *const *trees, size_t count) {
    cal_code *code = new_code();
    cal_graph *g = arena_allocate(w->memory, sizeof *g);
    graze_status status;
    if (!code || !g || !copy_reals(code, w->request)) {
        status = report_out_of_memory(w->report);
    } else {
        cal_graph_begin(g, w->program, w->memory, code->memory, w->report);
        g->where = w->request ? w->request->where : NULL;
        g->reals = code->reals;
        g->real_count = code->real_count;
        g->channels = w->request ? w->request->channels : 0;
        g->is_constant = !w->request;
        status = emit_trees(g, code, w->request, trees, count);
    }
    *made = status ? NULL : code;
    if (status)
        cal_code_destroy(code);
    return status;
}

static graze_status compile_request(cal_code **code, workshop *w) {
    size_t count = w->request->expression_count;
    cal_node **trees = arena_allocate(w->memory, count * sizeof(void *));
    w->context = cal_context_of_file(w->memory, w->request->file);
    if (!w->context || !trees)
        return report_out_of_memory(w->report);
    for (size_t i = 0; i < count; i++) {
        const cal_expression *x = &w->request->expressions[i];
        graze_status status = x->argument_count ? make_call(w, x, &trees[i]) : parse_expression(w, x, &trees[i]);
        if (status)
            return status;
    }
    return compile_trees(code, w, trees, count);
}

graze_status cal_compile(cal_code **code, cal_program *program, const cal_request *request,
                         const graze_report *report) {
    workshop w = {.memory = arena_create(), .program = program, .request = request, .report = report};
    *code = NULL;
    graze_status status = w.memory ? compile_request(code, &w) : report_out_of_memory(report);
    arena_destroy(w.memory);
    return status;
}

static graze_status evaluate_constant(const cal_code *code, const cal_parser *p, const cal_node *node, double *value) {
    void *memory = malloc(cal_memory_size(code));
    if (!memory)
        return report_out_of_memory(p->report);
    cal_outcome outcome = cal_evaluate(code, NULL, value, memory);
    graze_status status = GRAZE_OK;
    if (outcome == CAL_FAILED)
        status = cal_complain(p, node->line, node->column, "this constant has no value: %s", cal_failure(code, memory));
    else if (outcome == CAL_FAULT)
        status = cal_complain(p, node->line, node->column,
                              "this constant has no value: a division by 0, or a function outside of its domain");
    free(memory);
    return status;
}

graze_status cal_constant(cal_program *program, const cal_parser *p, cal_node *node, double *value) {
    const cal_definition *d = node->kind == CAL_VARIABLE ? node->symbol->definition : NULL;
    if (d && d->body->kind == CAL_NUMBER) {
        *value = d->body->number;
        return GRAZE_OK;
    }
    cal_code *code = NULL;
    const workshop w = {.memory = arena_create(), .program = program, .report = p->report};
    graze_status status = w.memory ? compile_trees(&code, &w, &node, 1) : report_out_of_memory(p->report);
    if (!status)
        status = evaluate_constant(code, p, node, value);
    cal_code_destroy(code);
    arena_destroy(w.memory);
    return status;
}
