/* Blocks of floats, in single precision throughout. */
#include <float.h>

#include "base/number.h"
#include "tools/brdfeval/block.h"

#ifndef __has_builtin
#define __has_builtin(name) 0
#endif

#if __has_builtin(__builtin_shufflevector)
typedef float four __attribute__((vector_size(16)));
typedef float four_anywhere __attribute__((vector_size(16), aligned(4), may_alias));
#define PICK(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)

/* Transposes records of six numbers, and gives how many. Four at a time: gcc makes no vector instructions of columns
 * this far apart. */
static size_t transpose_six(float input[][BLOCK_RECORDS], const float *records, size_t count) {
    size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        const four_anywhere *in = (const four_anywhere *)(records + 6 * i);
        four a = PICK(in[0], in[1], 0, 1, 6, 7), b = PICK(in[3], in[4], 0, 1, 6, 7);
        four c = PICK(in[0], in[2], 2, 3, 4, 5), d = PICK(in[3], in[5], 2, 3, 4, 5);
        four e = PICK(in[1], in[2], 0, 1, 6, 7), f = PICK(in[4], in[5], 0, 1, 6, 7);
        *(four_anywhere *)&input[0][i] = PICK(a, b, 0, 2, 4, 6);
        *(four_anywhere *)&input[1][i] = PICK(a, b, 1, 3, 5, 7);
        *(four_anywhere *)&input[2][i] = PICK(c, d, 0, 2, 4, 6);
        *(four_anywhere *)&input[3][i] = PICK(c, d, 1, 3, 5, 7);
        *(four_anywhere *)&input[4][i] = PICK(e, f, 0, 2, 4, 6);
        *(four_anywhere *)&input[5][i] = PICK(e, f, 1, 3, 5, 7);
    }
    return i;
}
#else
#define transpose_six(input, records, count) 0
#endif

#define REAL             float
#define REAL_MAX         FLT_MAX
#define REAL_OF(x)       number_to_float(x)
#define REAL_ABS(x)      fabsf(x)
#define LENGTH_ROUNDING  2.5e-7
#define BLOCK            block_float
#define BLOCK_NAME(name) block_float_##name
#define BATCH(name)      graze_brdf_##name##_float_batch
#define VECTORS          graze_vec3_float_arrays
#define SAMPLES          graze_brdf_sample_float_arrays

#include "tools/brdfeval/block_real.h"

void block_float_take(block_float *b, const evaluation *e, const float *records, size_t count, char *message) {
    size_t columns = (size_t)evaluation_record_fields(e);
    b->count = count;
    transpose(b, records, columns, columns == 6 ? transpose_six(b->input, records, count) : 0);
    if (!are_valid(b, e->query))
        repair(b, e, message);
}
