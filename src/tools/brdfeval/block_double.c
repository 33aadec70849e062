/* Blocks of doubles. */
#include <float.h>

#include "tools/brdfeval/block.h"
#include "tools/brdfeval/direction.h"

#define REAL             double
#define REAL_MAX         DBL_MAX
#define REAL_OF(x)       (x)
#define REAL_ABS(x)      fabs(x)
#define LENGTH_ROUNDING  1e-15
#define BLOCK            block_double
#define BLOCK_NAME(name) block_double_##name
#define BATCH(name)      graze_brdf_##name##_batch
#define VECTORS          graze_vec3_arrays
#define SAMPLES          graze_brdf_sample_arrays

#include "tools/brdfeval/block_real.h"

static bool take_record_of_angles(block_double *b, const evaluation *e, const double *record, size_t i, char *message) {
    const query *q = e->query;
    for (int k = 0; k < q->directions; k++, record += 2) {
        if (!validate_angles(record[0], record[1], e, k, message))
            return false;
        block_double_set_direction(b, k, i,
                                   direction_from_angles(direction_angle_of(record[0]), direction_angle_of(record[1])));
    }
    for (int k = 0; k < q->random_numbers; k++)
        b->input[3 * q->directions + k][i] = record[k];
    return true;
}

/* Ends the block before the first record that has an angle out of range. */
static void take_angles(block_double *b, const evaluation *e, const double *records, char *message) {
    size_t fields = (size_t)evaluation_record_fields(e), i = 0;
    while (i < b->count && take_record_of_angles(b, e, records + fields * i, i, message))
        i++;
    b->count = i;
}

void block_double_set_direction(block_double *b, int which, size_t index, vec3 direction) {
    b->input[3 * which][index] = direction.x;
    b->input[3 * which + 1][index] = direction.y;
    b->input[3 * which + 2][index] = direction.z;
}

void block_double_take(block_double *b, const evaluation *e, const double *records, size_t count, char *message) {
    b->count = count;
    if (e->angles)
        take_angles(b, e, records, message);
    else
        transpose(b, records, (size_t)evaluation_record_fields(e), 0);
    if (!are_valid(b, e->query))
        repair(b, e, message);
}
