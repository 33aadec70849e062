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

uint64_t cal_code_channels(const cal_code *code) {
    return code->channels;
}

static graze_status parse_expression(cal_program *program, const cal_request *request, const cal_expression *x,
                                     const char *context, const graze_report *report, cal_node **tree) {
    cal_parser p;
    graze_status status;
    cal_parse_begin(&p, x->text, strlen(x->text), program->memory, report);
    p.where = request->where ? *request->where : (place){0};
    p.expression = x->text;
    status = cal_parse_expression(&p, tree);
    if (!status)
        *tree = cal_resolve(program, &p, context, NULL, NULL, *tree, &status);
    return status;
}

/* The call of a function with channels as arguments. */
static graze_status make_call(cal_program *program, const cal_expression *x, const char *context,
                              const graze_report *report, cal_node **tree) {
    size_t count = (size_t)x->argument_count + 2;
    cal_node *nodes = arena_allocate(program->memory, count * sizeof *nodes);
    cal_symbol *symbol = cal_symbols_use(&program->symbols, context, x->text);
    if (!nodes || !symbol)
        return report_out_of_memory(report);
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

static graze_status compile_all(cal_graph *g, cal_code *code, cal_node *const *trees, size_t count) {
    cal_value **results = arena_allocate(g->memory, count * sizeof *results);
    if (!results)
        return report_out_of_memory(g->report);
    for (size_t i = 0; i < count; i++)
        if (!(results[i] = cal_graph_expression(g, trees[i])))
            return g->status;
    graze_status status = cal_graph_finish(g);
    return status ? status : cal_emit(code, g, results, count);
}

static graze_status compile_trees(cal_code **made, cal_program *program, cal_node *const *trees, size_t count,
                                  const cal_request *request, const graze_report *report) {
    cal_code *code = new_code();
    arena *memory = arena_create();
    cal_graph *g = memory ? arena_allocate(memory, sizeof *g) : NULL;
    size_t real_count = request ? request->real_count : 0;
    double *reals = code ? arena_allocate(code->memory, real_count * sizeof *reals) : NULL;
    graze_status status;
    if (!code || !g || !reals) {
        status = report_out_of_memory(report);
    } else {
        if (real_count)
            memcpy(reals, request->reals, real_count * sizeof *reals);
        code->reals = reals;
        code->real_count = (uint32_t)real_count;
        cal_graph_begin(g, program, memory, code->memory, report);
        g->where = request ? request->where : NULL;
        g->reals = reals;
        g->real_count = real_count;
        g->channels = request ? request->channels : 0;
        g->is_constant = !request;
        status = compile_all(g, code, trees, count);
    }
    arena_destroy(memory);
    *made = status ? NULL : code;
    if (status)
        cal_code_destroy(code);
    return status;
}

graze_status cal_compile(cal_code **code, cal_program *program, const cal_request *request,
                         const graze_report *report) {
    size_t count = request->expression_count;
    const char *context = cal_context_of_file(program->memory, request->file);
    cal_node **trees = arena_allocate(program->memory, count * sizeof *trees);
    *code = NULL;
    if (!context || !trees)
        return report_out_of_memory(report);
    for (size_t i = 0; i < count; i++) {
        const cal_expression *x = &request->expressions[i];
        graze_status status = x->argument_count ? make_call(program, x, context, report, &trees[i])
                                                : parse_expression(program, request, x, context, report, &trees[i]);
        if (status)
            return status;
    }
    return compile_trees(code, program, trees, count, request, report);
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
    cal_code *code;
    graze_status status = compile_trees(&code, program, &node, 1, NULL, p->report);
    if (!status)
        status = evaluate_constant(code, p, node, value);
    cal_code_destroy(code);
    return status;
}
