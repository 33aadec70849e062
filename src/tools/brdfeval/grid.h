/* Grids: all combinations of values of a query's inputs. */
#ifndef TOOLS_BRDFEVAL_GRID_H
#define TOOLS_BRDFEVAL_GRID_H

#include <stdbool.h>
#include <stdint.h>

#include "graze/error.h"
#include "tools/brdfeval/evaluation.h"

/* The values that one input takes. */
typedef struct grid_axis {
    int input;
    uint64_t count;
    enum { AXIS_STEPS, AXIS_ENDS, AXIS_MIDPOINTS } kind;
    double from, to;    /* ENDS: `count` values, both ends included */
    double step, scale; /* STEPS: from + i step, where both are `scale` times what they stand for, */
    bool meets;         /* and, if they meet it, `to`, which is not scaled, as the last value */
} grid_axis;

/* Inputs in order: theta and phi of each direction in degrees, then the query's random numbers. Those without an axis
 * are 0. The last axis changes fastest. */
typedef struct grid {
    int input_count;
    const char *names[INPUTS_MAX]; /* in tables */
    int axis_count;
    grid_axis axes[INPUTS_MAX];
    uint64_t points;
} grid;

/* Reads `NAME=VALUES,...` for the query. VALUES: a number, FROM:TO:STEP, FROM:TO/COUNT, and for random numbers /COUNT,
 * the midpoints of as many parts of 0 .. 1. */
graze_status grid_parse(grid *, const char *spec, const query *, const graze_report *);

/* Value number `index` of an axis. */
double grid_axis_value(const grid_axis *, uint64_t index);

#endif
