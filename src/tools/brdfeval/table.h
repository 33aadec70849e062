/* Tables: a grid's points with their answers. */
#ifndef TOOLS_BRDFEVAL_TABLE_H
#define TOOLS_BRDFEVAL_TABLE_H

#include "tools/brdfeval/evaluation.h"
#include "tools/brdfeval/grid.h"

typedef enum table_format { TABLE_CSV, TABLE_NPY } table_format;

typedef struct table_job {
    const evaluation *evaluation;
    const grid *grid;
    table_format format;
    int flush, threads; /* see records_job */
} table_job;

/* To standard output: all inputs and the answer of each point, in the grid's order. */
graze_status table_write(const table_job *, const graze_report *);

#endif
