/* Blocks: some records' inputs and results, a component an array, as the batch functions of graze/brdf_batch.h want
 * them. */
#ifndef TOOLS_BRDFEVAL_BLOCK_H
#define TOOLS_BRDFEVAL_BLOCK_H

#include <stddef.h>

#include "tools/brdfeval/evaluation.h"

/* Few enough that a block stays in the fastest cache. A multiple of 16 keeps all arrays aligned alike. */
enum { BLOCK_RECORDS = 256 };

/* Inputs: lx ly lz vx vy vz, or vx vy vz s t u, as far as the query has them. */
typedef struct block_double {
    size_t count;
    _Alignas(64) double input[INPUTS_MAX][BLOCK_RECORDS];
    double result[RESULTS_MAX][BLOCK_RECORDS];
} block_double;

typedef struct block_float {
    size_t count;
    _Alignas(64) float input[INPUTS_MAX][BLOCK_RECORDS];
    float result[RESULTS_MAX][BLOCK_RECORDS];
} block_float;

/* Takes up to BLOCK_RECORDS records. Directions whose length is off by more than 1e-6 are normalised. Stops before a
 * record that cannot be answered, and says why in `message` (of RECORD_MESSAGE_SIZE). */
void block_double_take(block_double *, const evaluation *, const double *records, size_t count, char *message);
/* The same for floats; not for records of angles. */
void block_float_take(block_float *, const evaluation *, const float *records, size_t count, char *message);

/* Sets a direction of one record, as `take` does. */
void block_double_set_direction(block_double *, int which, size_t index, graze_vec3 direction);

/* Answers what was taken: count x numbers, record after record. */
void block_double_answer(block_double *, const evaluation *, double *numbers);
void block_float_answer(block_float *, const evaluation *, float *numbers);

#endif
