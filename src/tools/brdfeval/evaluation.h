/* What brdfeval was asked: which reflectance, which query, and how the numbers of an answer lie in a record. */
#ifndef TOOLS_BRDFEVAL_EVALUATION_H
#define TOOLS_BRDFEVAL_EVALUATION_H

#include <stdbool.h>

#include "graze/brdf.h"

/* The most inputs that a query has, components of directions counted each; the most results that a block computes for
 * it; the most letters of -o; the most numbers of an answer. */
enum { INPUTS_MAX = 6, RESULTS_MAX = 5, LETTERS_MAX = 64, NUMBERS_MAX = 3 * LETTERS_MAX };

/* diffuse[i]/pi + specular[i] f, with one channel, or with three: red, green and blue. */
typedef struct reflectance {
    bool has_lobe; /* else all `specular` are 0 */
    graze_brdf lobe;
    int channels;
    double diffuse[3], specular[3];
} reflectance;

/* What a block computes: of eval, of sample and pair, of albedo, and of mean. */
enum { RESULT_VALUE, RESULT_WARD_DENSITY, RESULT_WARD_WEIGHT, RESULT_PAIR_DENSITY, RESULT_PAIR_WEIGHT };
enum { RESULT_X, RESULT_Y, RESULT_Z, RESULT_DENSITY, RESULT_WEIGHT };
enum { RESULT_ALBEDO, RESULT_ACCEPTANCE };
enum { RESULT_MEAN_ALBEDO };

typedef enum query_kind { QUERY_EVAL, QUERY_SAMPLE, QUERY_PAIR, QUERY_ALBEDO, QUERY_MEAN } query_kind;

/* How a number of the answer comes from a result, which is the lobe's for specular reflectance 1. All but PLAIN ones
 * are one number a channel. */
typedef enum scaling {
    SCALING_PLAIN,
    SCALING_WEIGHT, /* specular x result */
    SCALING_VALUE,  /* diffuse/pi + specular x result, above the surface */
    SCALING_COSINE, /* the same x l.z */
    SCALING_ALBEDO, /* diffuse + specular x result, above the surface */
    SCALING_MEAN,   /* the same without a direction */
} scaling;

typedef struct answer_field {
    char letter;
    const char *name; /* in tables */
    int result;       /* RESULT_... */
    scaling scaling;
} answer_field;

typedef struct query {
    const char *name;
    query_kind kind;
    int directions, random_numbers;
    const char *letters;        /* of its fields */
    const char *usual;          /* letters where none are asked for */
    const answer_field *fields; /* one a letter */
} query;

typedef struct evaluation {
    reflectance reflectance;
    const query *query;
    bool angles; /* records hold theta and phi in degrees */
    int field_count;
    const answer_field *fields[LETTERS_MAX];
    bool needed[RESULTS_MAX];
    int numbers; /* of an answer */
} evaluation;

/* Null where there is no such query. */
const query *evaluation_find_query(const char *name);

/* Sets fields, needed and numbers for the letters, which are some of the query's and at most LETTERS_MAX. */
void evaluation_set_fields(evaluation *, const char *letters);

/* How many numbers the field has, and how many a record in. */
int evaluation_channels(const evaluation *, const answer_field *);
int evaluation_record_fields(const evaluation *);

/* How many records, or rows of a table, are a chunk: what a thread answers at a time. `flush`: no more than this; 0: as
 * is best. */
int evaluation_chunk_records(const evaluation *, int flush);

#endif
