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

#include "base/angle.h"
#include "graze/brdf_batch.h"
#include "tools/brdfeval/block.h"
#include "tools/brdfeval/care.h"

/* --- Records in -------------------------------------------------------------------------------------------------- */

static void transpose(BLOCK *b, const REAL *records, size_t columns, size_t first) {
    for (size_t i = first; i < b->count; i++)
        for (size_t column = 0; column < columns; column++)
            b->input[column][i] = records[columns * i + column];
}

/* Whether all lengths are within the tolerance for certain. A squared length is off by twice what the length is. */
static bool are_unit_vectors(const REAL *restrict x, const REAL *restrict y, const REAL *restrict z, size_t count) {
    const REAL tolerance = (REAL)(1.999 * CARE_LENGTH_TOLERANCE - LENGTH_ROUNDING);
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

static bool are_fine(const BLOCK *b, const query *q) {
    bool fine = true;
    for (int i = 0; i < q->directions; i++)
        fine = fine && are_unit_vectors(b->input[3 * i], b->input[3 * i + 1], b->input[3 * i + 2], b->count);
    for (int i = 0; i < q->random_numbers; i++)
        fine = fine && are_random_numbers(b->input[3 * q->directions + i], b->count);
    return fine;
}

static bool mend_record(BLOCK *b, const evaluation *e, size_t i, char *trouble) {
    const query *q = e->query;
    for (int k = 0; k < q->directions; k++) {
        REAL(*component)[BLOCK_RECORDS] = &b->input[3 * k];
        vec3 direction = {component[0][i], component[1][i], component[2][i]};
        if (!care_direction(&direction, e, k, trouble))
            return false;
        component[0][i] = (REAL)direction.x;
        component[1][i] = (REAL)direction.y;
        component[2][i] = (REAL)direction.z;
    }
    for (int k = 0; k < q->random_numbers; k++)
        if (!care_random_number(b->input[3 * q->directions + k][i], k, trouble))
            return false;
    return true;
}

static void mend(BLOCK *b, const evaluation *e, char *trouble) {
    size_t i = 0;
    while (i < b->count && mend_record(b, e, i, trouble))
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
    if (e->needed[0])
        BATCH(value)(lobe, b->count, l, v, b->result[0]);
    if (e->needed[1])
        BATCH(ward_density)(lobe, b->count, l, v, b->result[1]);
    if (e->needed[2])
        BATCH(ward_weight)(lobe, b->count, l, v, b->result[2]);
    if (e->needed[3])
        BATCH(pair_density)(lobe, b->count, l, v, b->result[3]);
    if (e->needed[4])
        BATCH(pair_weight)(lobe, b->count, l, v, b->result[4]);
}

static void compute_samples(BLOCK *b, const evaluation *e) {
    const graze_brdf *lobe = &e->reflectance.lobe;
    VECTORS v = vectors(b, 0);
    const REAL *s = b->input[3], *t = b->input[4], *u = b->input[5];
    SAMPLES samples = {b->result[0], b->result[1], b->result[2], b->result[3], b->result[4]};
    if (e->query->kind == QUERY_SAMPLE)
        BATCH(sample_ward)(lobe, b->count, v, s, t, samples);
    else
        BATCH(sample_pair)(lobe, b->count, v, s, t, u, samples);
}

static void compute_albedos(BLOCK *b, const evaluation *e) {
    const graze_brdf *lobe = &e->reflectance.lobe;
    for (size_t i = 0; i < b->count; i++) {
        vec3 v = {b->input[0][i], b->input[1][i], b->input[2][i]};
        if (e->needed[0])
            b->result[0][i] = REAL_OF(graze_brdf_albedo(lobe, v));
        if (e->needed[1])
            b->result[1][i] = REAL_OF(graze_brdf_ward_acceptance(lobe, v));
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
            b->result[0][i] = REAL_OF(graze_brdf_mean_albedo(&e->reflectance.lobe));
        break;
    }
}

/* --- Numbers out ------------------------------------------------------------------------------------------------- */

/* What goes into one number of each answer: `stride` numbers lie between it and the next answer's. */
typedef struct column {
    const REAL *result, *lz, *vz;
    REAL diffuse, specular;
    size_t count, stride;
} column;

/* No infinity leaves where colours above 1 make one. */
static inline REAL bounded(REAL x) {
    return x < REAL_MAX ? x : REAL_MAX;
}

static void put_plain(const column *c, REAL *restrict out) {
    const REAL *restrict r = c->result;
    for (size_t i = 0, stride = c->stride; i < c->count; i++)
        out[i * stride] = r[i];
}

/* Nothing is multiplied where nothing has to be: numbers below the normal ones, of which tails have many, take a
 * hundred times as long. */
static void put_weights(const column *c, REAL *restrict out) {
    const REAL *restrict r = c->result;
    const REAL specular = c->specular;
    if (specular == 1) {
        put_plain(c, out);
        return;
    }
    for (size_t i = 0, stride = c->stride; i < c->count; i++)
        out[i * stride] = bounded(specular * r[i]);
}

/* The lobe is 0 below the surface by itself. */
static void put_values(const column *c, REAL *restrict out) {
    const REAL *restrict r = c->result, *restrict lz = c->lz, *restrict vz = c->vz;
    const REAL diffuse = c->diffuse / (REAL)PI, specular = c->specular;
    if (diffuse == 0) {
        put_weights(c, out);
        return;
    }
    for (size_t i = 0, stride = c->stride; i < c->count; i++) {
        REAL value = bounded(diffuse + specular * r[i]);
        out[i * stride] = ((lz[i] > 0) & (vz[i] > 0)) ? value : 0;
    }
}

static void put_cosines(const column *c, REAL *restrict out) {
    const REAL *restrict lz = c->lz;
    put_values(c, out);
    for (size_t i = 0, stride = c->stride; i < c->count; i++)
        out[i * stride] *= lz[i] > 0 ? lz[i] : 0;
}

static void put_albedos(const column *c, REAL *restrict out) {
    for (size_t i = 0; i < c->count; i++)
        out[i * c->stride] = c->vz[i] > 0 ? bounded(c->diffuse + c->specular * c->result[i]) : 0;
}

static void put_means(const column *c, REAL *restrict out) {
    for (size_t i = 0; i < c->count; i++)
        out[i * c->stride] = bounded(c->diffuse + c->specular * c->result[i]);
}

static void put(const column *c, scaling how, REAL *out) {
    switch (how) {
    case SCALING_PLAIN:
        put_plain(c, out);
        break;
    case SCALING_WEIGHT:
        put_weights(c, out);
        break;
    case SCALING_VALUE:
        put_values(c, out);
        break;
    case SCALING_COSINE:
        put_cosines(c, out);
        break;
    case SCALING_ALBEDO:
        put_albedos(c, out);
        break;
    case SCALING_MEAN:
        put_means(c, out);
        break;
    }
}

void BLOCK_NAME(answer)(BLOCK *b, const evaluation *e, REAL *numbers) {
    const reflectance *r = &e->reflectance;
    compute(b, e);
    for (int i = 0; i < e->field_count; i++) {
        const answer_field *field = e->fields[i];
        for (int channel = 0; channel < evaluation_channels(e, field); channel++) {
            const column c = {.result = b->result[field->result],
                              .lz = b->input[2],
                              .vz = b->input[e->query->directions == 2 ? 5 : 2],
                              .diffuse = REAL_OF(r->diffuse[channel]),
                              .specular = REAL_OF(r->specular[channel]),
                              .count = b->count,
                              .stride = (size_t)e->numbers};
            put(&c, field->scaling, numbers++);
        }
    }
}
