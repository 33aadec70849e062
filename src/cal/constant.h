/* The value of an expression that depends on nothing. */
#ifndef CAL_CONSTANT_H
#define CAL_CONSTANT_H

#include "cal/program.h"
#include "cal/syntax.h"

/* Reports, at the expression's place, why there is none. */
graze_status cal_constant(cal_program *, const cal_parser *, cal_node *, double *value);

#endif
