/* What those share that build a graph. All give null after an error, which is in the graph's status. */
#ifndef CAL_GRAPH_INTERNAL_H
#define CAL_GRAPH_INTERNAL_H

#include "cal/graph.h"

static inline bool cal_value_is_constant(const cal_value *v) {
    return v->kind == CAL_V_CONSTANT;
}

/* Ends building, with a message, or for lack of memory where that is null. */
cal_value *cal_graph_stop(cal_graph *, const char *what);
void *cal_graph_allocate(cal_graph *, size_t size);

/* A value whose operands are to be set. These let null pass. */
cal_value *cal_value_new(cal_graph *, cal_value_kind, int operand_count);
cal_value *cal_value_set(cal_graph *, cal_value *, int index, cal_value *operand);

cal_value *cal_value_constant(cal_graph *, double number, bool effect);
cal_value *cal_value_leaf(cal_graph *, cal_value_kind, int index);
/* What ends the evaluation with a message, if it is ever needed. */
cal_value *cal_value_undefined(cal_graph *, const cal_node *, const cal_symbol *, bool is_called);
cal_value *cal_value_failing(cal_graph *, const cal_node *, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
cal_value *cal_value_binary(cal_graph *, cal_value_kind, cal_value *a, cal_value *b);
cal_value *cal_value_negate(cal_graph *, cal_value *);
/* As value of a function of the library that only hands it on. */
cal_value *cal_value_check(cal_graph *, cal_value *);

cal_value *cal_graph_build(cal_graph *, const cal_node *);
/* Argument i of a call, from 0, or null. */
const cal_node *cal_graph_argument(const cal_node *call, int i);
cal_value *cal_graph_too_few(cal_graph *, const cal_node *call, const char *name);
cal_value *cal_graph_library_call(cal_graph *, const cal_node *call, const cal_symbol *);
cal_value *cal_graph_power(cal_graph *, const cal_node *);

#endif
