/* From expressions of a scene, and the definitions they use, to code. */
#ifndef CAL_COMPILE_H
#define CAL_COMPILE_H

#include "cal/evaluate.h"
#include "cal/program.h"

typedef struct cal_expression {
    const char *text; /* an expression, or with arguments the name of a function */
    /* An expression where this is 0. Else the function is called with this many arguments, of which argument i
     * (from 0) is the channel first_argument + i. */
    int argument_count, first_argument;
} cal_expression;

typedef struct cal_request {
    const char *file; /* whose definitions the expressions see first, as scenes name it; it must have been read. Null or
                         ".": only the outermost */
    const cal_expression *expressions; /* as many outputs, in this order */
    size_t expression_count;
    const double *reals; /* of arg(n): the primitive's; copied */
    size_t real_count;
    uint64_t channels; /* bit N - 1: channel N has a value */
    const place *where;
} cal_request;

#define CAL_CHANNEL_BIT(n)            (UINT64_C(1) << ((n)-1))
#define CAL_CHANNEL_BITS(first, last) ((CAL_CHANNEL_BIT(last) - CAL_CHANNEL_BIT(first)) | CAL_CHANNEL_BIT(last))

/* Errors of syntax, and constants without a value, are found here; functions without enough arguments, and names
 * without a meaning, by the evaluation where they are needed. Names that are not defined can be asked for before. */
graze_status cal_compile(cal_code **, cal_program *, const cal_request *, const graze_report *);
void cal_code_destroy(cal_code *); /* null is let pass */

/* What there is to say of the first name that is not defined, also where it may never be needed; null: all are. */
const char *cal_code_undefined(const cal_code *);

/* The channels that are used, bit N - 1 for $N. */
uint64_t cal_code_channels(const cal_code *);

#endif
