/* The functions that are there without being defined, and how they are computed. */
#ifndef CAL_LIBRARY_H
#define CAL_LIBRARY_H

#include <stdbool.h>

#include "cal/noise.h"

typedef enum cal_builtin {
    CAL_NO_BUILTIN,
    CAL_REAL_1, /* a function of one real, of two, ... */
    CAL_REAL_2,
    CAL_NOISE, /* of three */
    CAL_IF,
    CAL_SELECT,
    CAL_MIN,
    CAL_MAX,
    CAL_ARGUMENT /* arg(n): the primitive's real arguments */
} cal_builtin;

typedef struct cal_function {
    const char *name;
    double (*real_1)(double);
    double (*real_2)(double, double);
    cal_builtin kind;
    cal_noise_kind noise;
} cal_function;

/* Null where there is none of that name. */
const cal_function *cal_library_find(const char *name);
const cal_function *cal_library_power(void);

#endif
