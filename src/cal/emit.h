/* From values to instructions. */
#ifndef CAL_EMIT_H
#define CAL_EMIT_H

#include "cal/code.h"
#include "cal/graph.h"

/* Makes the code of a finished graph; `results` are the outputs. The code has its memory and reals already. */
graze_status cal_emit(struct cal_code *, cal_graph *, cal_value *const *results, size_t count);

#endif
