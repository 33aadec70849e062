/* The functions of block.h for one type of numbers, which whoever includes this names:
 *
 *   REAL, REAL_MAX            the type, and its largest number
 *   REAL_OF(x)                the nearest finite REAL to a double
 *   REAL_ABS(x)               fabs
 *   LENGTH_ROUNDING           what rounding does at most to a squared length computed in REAL
 *   BLOCK, BLOCK_NAME(name)   the block, and its functions
 *   BATCH(name)               a function of graze/brdf_batch.h
 *   VECTORS, SAMPLES          its arrays
 *
 * Loops are such that a compiler makes vector instructions of them. */
#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "graze/brdf_batch.h"
#include "tools/brdfeval/block.h"
#include "tools/brdfeval/overflow.h"
#include "tools/brdfeval/validate.h"

/* --- Records in -------------------------------------------------------------------------------------------------- */

static void transpose(BLOCK *b, const REAL *records, size_t columns, size_t first) {
    for (size_t i = first; i < b->count; i++)
        for (size_t column = 0; column < columns; column++)
            b->input[column][i] = records[columns * i + column];
}

/* Whether all lengths are within the tolerance for certain, and numbers finite. A squared length is off by twice what
 * the length is. */
static bool are_unit_vectors(const REAL *restrict x, const REAL *restrict y, const REAL *restrict z, size_t count) {
    const REAL tolerance = (REAL)(1.999 * VALIDATE_LENGTH_TOLERANCE - LENGTH_ROUNDING);
    int off = 0;
    for (size_t i = 0; i < count; i++)
        off |= !(REAL_ABS(x[i] * x[i] + y[i] * y[i] + z[i] * z[i] - 1) <= tolerance);
    return !off;
}

static bool are_random_numbers(const REAL *restrict s, size_t count) {
    int off = 0;
    for (size_t i = 0; i < count; i++)
        off |= !((s[i] >= 0) & (s[i] < 1));
    return !off;
}

static bool are_valid(const BLOCK *b, const query *q) {
    bool valid = true;
    for (int i = 0; i < q->directions; i++)
        valid = valid && are_unit_vectors(b->input[3 * i], b->input[3 * i + 1], b->input[3 * i + 2], b->count);
    for (int i = 0; i < q->random_numbers; i++)
        valid = valid && are_random_numbers(b->input[3 * q->directions + i], b->count);
    return valid;
}

static bool repair_record(BLOCK *b, const evaluation *e, size_t i, char *message) {
    const query *q = e->query;
    for (int k = 0; k < 3 * q->directions + q->random_numbers; k++)
        if (!validate_number(b->input[k][i], k, message))
            return false;
    for (int k = 0; k < q->directions; k++) {
        REAL(*component)[BLOCK_RECORDS] = &b->input[3 * k];
        vec3 direction = {component[0][i], component[1][i], component[2][i]};
        if (!validate_direction(&direction, e, k, message))
            return false;
        component[0][i] = (REAL)direction.x;
        component[1][i] = (REAL)direction.y;
        component[2][i] = (REAL)direction.z;
    }
    for (int k = 0; k < q->random_numbers; k++)
        if (!validate_random_number(b->input[3 * q->directions + k][i], k, message))
            return false;
    return true;
}

/* Normalises what has to be; ends the block before the first record that cannot be answered. */
static void repair(BLOCK *b, const evaluation *e, char *message) {
    size_t i = 0;
    while (i < b->count && repair_record(b, e, i, message))
        i++;
    b->count = i;
}

/* --- Results ----------------------------------------------------------------------------------------------------- */

static VECTORS vectors(BLOCK *b, int which) {
    return (VECTORS){b->input[3 * which], b->input[3 * which + 1], b->input[3 * which + 2]};
}

static void compute_eval(BLOCK *b, const evaluation *e) {
    const graze_brdf *lobe = &e->reflectance.lobe;
    VECTORS l = vectors(b, 0), v = vectors(b, 1);
    if (e->needed[RESULT_VALUE])
        BATCH(value)(lobe, b->count, l, v, b->result[RESULT_VALUE]);
    if (e->needed[RESULT_WARD_DENSITY])
        BATCH(ward_density)(lobe, b->count, l, v, b->result[RESULT_WARD_DENSITY]);
    if (e->needed[RESULT_WARD_WEIGHT])
        BATCH(ward_weight)(lobe, b->count, l, v, b->result[RESULT_WARD_WEIGHT]);
    if (e->needed[RESULT_PAIR_DENSITY])
        BATCH(pair_density)(lobe, b->count, l, v, b->result[RESULT_PAIR_DENSITY]);
    if (e->needed[RESULT_PAIR_WEIGHT])
        BATCH(pair_weight)(lobe, b->count, l, v, b->result[RESULT_PAIR_WEIGHT]);
}

static void compute_samples(BLOCK *b, const evaluation *e) {
    const graze_brdf *lobe = &e->reflectance.lobe;
    VECTORS v = vectors(b, 0);
    const REAL *s = b->input[3], *t = b->input[4], *u = b->input[5];
    SAMPLES samples = {b->result[RESULT_X], b->result[RESULT_Y], b->result[RESULT_Z], b->result[RESULT_DENSITY],
                       b->result[RESULT_WEIGHT]};
    if (e->query->kind == QUERY_SAMPLE)
        BATCH(sample_ward)(lobe, b->count, v, s, t, samples);
    else
        BATCH(sample_pair)(lobe, b->count, v, s, t, u, samples);
}

static void compute_albedos(BLOCK *b, const evaluation *e) {
    const graze_brdf *lobe = &e->reflectance.lobe;
    for (size_t i = 0; i < b->count; i++) {
        vec3 v = {b->input[0][i], b->input[1][i], b->input[2][i]};
        if (e->needed[RESULT_ALBEDO])
            b->result[RESULT_ALBEDO][i] = REAL_OF(graze_brdf_albedo(lobe, v));
        if (e->needed[RESULT_ACCEPTANCE])
            b->result[RESULT_ACCEPTANCE][i] = REAL_OF(graze_brdf_ward_acceptance(lobe, v));
    }
}

static void compute(BLOCK *b, const evaluation *e) {
    switch (e->query->kind) {
    case QUERY_EVAL:
        compute_eval(b, e);
        break;
    case QUERY_SAMPLE:
    case QUERY_PAIR:
        compute_samples(b, e);
        break;
    case QUERY_ALBEDO:
        compute_albedos(b, e);
        break;
    case QUERY_MEAN:
        for (size_t i = 0; i < b->count; i++)
            b->result[RESULT_MEAN_ALBEDO][i] = REAL_OF(graze_brdf_mean_albedo(&e->reflectance.lobe));
        break;
    }
}

/* --- Numbers out ------------------------------------------------------------------------------------------------- */

/* What goes into one number of each answer. */
typedef struct column {
    const REAL *result, *lz, *vz;
    REAL diffuse, specular;
    size_t count;
} column;

/* No infinity leaves where colours above 1 make one. */
static inline REAL bounded(REAL x) {
    return x < REAL_MAX ? x : REAL_MAX;
}

/* The functions that follow give `count` numbers: those that are there already, or new ones in `room`. */

/* Nothing is multiplied where nothing has to be: numbers below the normal ones, of which tails have many, take a
 * hundred times as long. */
static const REAL *scale_weights(const column *c, REAL *restrict room) {
    const REAL *restrict r = c->result;
    const REAL specular = c->specular;
    if (specular == 1)
        return c->result;
    for (size_t i = 0; i < c->count; i++)
        room[i] = bounded(specular * r[i]);
    return room;
}

/* The lobe is 0 below the surface by itself. */
static const REAL *scale_values(const column *c, REAL *restrict room) {
    const REAL *restrict r = c->result, *restrict lz = c->lz, *restrict vz = c->vz;
    const REAL diffuse = c->diffuse / (REAL)PI, specular = c->specular;
    if (diffuse == 0)
        return scale_weights(c, room);
    for (size_t i = 0; i < c->count; i++) {
        REAL value = bounded(diffuse + specular * r[i]);
        room[i] = ((lz[i] > 0) & (vz[i] > 0)) ? value : 0;
    }
    return room;
}

static const REAL *scale_cosines(const column *c, REAL *room) {
    const REAL *lz = c->lz, *values = scale_values(c, room);
    for (size_t i = 0; i < c->count; i++)
        room[i] = values[i] * (lz[i] > 0 ? lz[i] : 0);
    return room;
}

static const REAL *scale_means(const column *c, REAL *restrict room) {
    const REAL *restrict r = c->result;
    const REAL diffuse = c->diffuse, specular = c->specular;
    for (size_t i = 0; i < c->count; i++)
        room[i] = bounded(diffuse + specular * r[i]);
    return room;
}

static const REAL *scale_albedos(const column *c, REAL *restrict room) {
    const REAL *restrict vz = c->vz;
    scale_means(c, room);
    for (size_t i = 0; i < c->count; i++)
        room[i] = vz[i] > 0 ? room[i] : 0;
    return room;
}

static const REAL *scale(const column *c, scaling how, REAL *room) {
    switch (how) {
    case SCALING_PLAIN:
        break;
    case SCALING_WEIGHT:
        return scale_weights(c, room);
    case SCALING_VALUE:
        return scale_values(c, room);
    case SCALING_COSINE:
        return scale_cosines(c, room);
    case SCALING_ALBEDO:
        return scale_albedos(c, room);
    case SCALING_MEAN:
        return scale_means(c, room);
    }
    return c->result;
}

/* `stride` numbers lie between one number and the next answer's. */
static void spread(const REAL *restrict values, size_t count, REAL *restrict numbers, size_t stride) {
    if (stride == 1)
        memcpy(numbers, values, count * sizeof *values);
    else
        for (size_t i = 0; i < count; i++)
            numbers[i * stride] = values[i];
}

/* Whether a result was cut off at REAL_MAX, so that what it is scaled to is wrong. */
static bool overflows(const BLOCK *b, const evaluation *e, const answer_field *field) {
    const REAL *restrict r = b->result[field->result];
    int found = 0;
    if (e->query->kind != QUERY_EVAL || field->scaling == SCALING_PLAIN)
        return false;
    for (size_t i = 0; i < b->count; i++)
        found |= r[i] >= REAL_MAX;
    return found;
}

/* Such answers once more, from the beginning. */
static void repair_overflows(const BLOCK *b, const evaluation *e, const answer_field *field, int channel,
                             REAL *numbers) {
    const REAL *r = b->result[field->result];
    for (size_t i = 0; i < b->count; i++)
        if (r[i] >= REAL_MAX) {
            vec3 l = {b->input[0][i], b->input[1][i], b->input[2][i]};
            vec3 v = {b->input[3][i], b->input[4][i], b->input[5][i]};
            numbers[i * (size_t)e->numbers] = REAL_OF(overflow_answer(e, field, channel, l, v));
        }
}

void BLOCK_NAME(answer)(BLOCK *b, const evaluation *e, REAL *numbers) {
    const reflectance *r = &e->reflectance;
    REAL room[BLOCK_RECORDS];
    compute(b, e);
    for (int i = 0; i < e->field_count; i++) {
        const answer_field *field = e->fields[i];
        const bool repairs = overflows(b, e, field);
        for (int channel = 0; channel < evaluation_channels(e, field); channel++) {
            const column c = {.result = b->result[field->result],
                              .lz = b->input[2],
                              .vz = b->input[e->query->directions == 2 ? 5 : 2],
                              .diffuse = REAL_OF(r->diffuse[channel]),
                              .specular = REAL_OF(r->specular[channel]),
                              .count = b->count};
            spread(scale(&c, field->scaling, room), b->count, numbers, (size_t)e->numbers);
            if (repairs)
                repair_overflows(b, e, field, channel, numbers);
            numbers++;
        }
    }
}
