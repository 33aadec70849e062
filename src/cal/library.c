/* The table of functions. */
#include "cal/library.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* A number below 1 that looks random: a fraction of a hyperbola. Patterns depend on its very values. */
static double scatter(double x) {
    x *= 1 / (1 + x * x) + 2.71828182845904;
    x += .785398163397447 - floor(x);
    x = 1e5 / x;
    return x - floor(x);
}

static const cal_function functions[] = {
    {.name = "if", .kind = CAL_IF},
    {.name = "select", .kind = CAL_SELECT},
    {.name = "min", .kind = CAL_MIN},
    {.name = "max", .kind = CAL_MAX},
    {.name = "arg", .kind = CAL_ARGUMENT},
    {.name = "sqrt", .kind = CAL_REAL_1, .real_1 = sqrt},
    {.name = "sin", .kind = CAL_REAL_1, .real_1 = sin},
    {.name = "cos", .kind = CAL_REAL_1, .real_1 = cos},
    {.name = "tan", .kind = CAL_REAL_1, .real_1 = tan},
    {.name = "asin", .kind = CAL_REAL_1, .real_1 = asin},
    {.name = "acos", .kind = CAL_REAL_1, .real_1 = acos},
    {.name = "atan", .kind = CAL_REAL_1, .real_1 = atan},
    {.name = "atan2", .kind = CAL_REAL_2, .real_2 = atan2},
    {.name = "exp", .kind = CAL_REAL_1, .real_1 = exp},
    {.name = "log", .kind = CAL_REAL_1, .real_1 = log},
    {.name = "log10", .kind = CAL_REAL_1, .real_1 = log10},
    {.name = "floor", .kind = CAL_REAL_1, .real_1 = floor},
    {.name = "ceil", .kind = CAL_REAL_1, .real_1 = ceil},
    {.name = "erf", .kind = CAL_REAL_1, .real_1 = erf},
    {.name = "erfc", .kind = CAL_REAL_1, .real_1 = erfc},
    {.name = "rand", .kind = CAL_REAL_1, .real_1 = scatter},
    {.name = "noise3", .kind = CAL_NOISE, .noise = CAL_NOISE_VALUE},
    {.name = "noise3x", .kind = CAL_NOISE, .noise = CAL_NOISE_X},
    {.name = "noise3y", .kind = CAL_NOISE, .noise = CAL_NOISE_Y},
    {.name = "noise3z", .kind = CAL_NOISE, .noise = CAL_NOISE_Z},
    {.name = "fnoise3", .kind = CAL_NOISE, .noise = CAL_NOISE_FRACTAL},
};

/* It has no name in the language. */
static const cal_function power = {.name = "^", .kind = CAL_REAL_2, .real_2 = pow};

const cal_function *cal_library_find(const char *name) {
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strcmp(functions[i].name, name) == 0)
            return &functions[i];
    return NULL;
}

const cal_function *cal_library_power(void) {
    return &power;
}
