/* The queries, and what each can answer. */
#include "tools/brdfeval/evaluation.h"

#include <stddef.h>
#include <string.h>

/* An albedo takes as long as a hundred values. */
enum { CHUNK_RECORDS = 4096, CHUNK_ALBEDOS = 16 };

static const answer_field eval_fields[] = {
    {'f', "f", RESULT_VALUE, SCALING_VALUE},        {'c', "c", RESULT_VALUE, SCALING_COSINE},
    {'p', "p", RESULT_WARD_DENSITY, SCALING_PLAIN}, {'w', "w", RESULT_WARD_WEIGHT, SCALING_WEIGHT},
    {'P', "P", RESULT_PAIR_DENSITY, SCALING_PLAIN}, {'W', "W", RESULT_PAIR_WEIGHT, SCALING_WEIGHT},
};
static const answer_field sample_fields[] = {
    {'x', "lx", RESULT_X, SCALING_PLAIN},      {'y', "ly", RESULT_Y, SCALING_PLAIN},
    {'z', "lz", RESULT_Z, SCALING_PLAIN},      {'p', "p", RESULT_DENSITY, SCALING_PLAIN},
    {'w', "w", RESULT_WEIGHT, SCALING_WEIGHT},
};
static const answer_field pair_fields[] = {
    {'x', "lx", RESULT_X, SCALING_PLAIN},      {'y', "ly", RESULT_Y, SCALING_PLAIN},
    {'z', "lz", RESULT_Z, SCALING_PLAIN},      {'P', "P", RESULT_DENSITY, SCALING_PLAIN},
    {'W', "W", RESULT_WEIGHT, SCALING_WEIGHT},
};
static const answer_field albedo_fields[] = {
    {'a', "a", RESULT_ALBEDO, SCALING_ALBEDO},
    {'A', "A", RESULT_ACCEPTANCE, SCALING_PLAIN},
};
static const answer_field mean_fields[] = {{'m', "m", RESULT_MEAN_ALBEDO, SCALING_MEAN}};

static const query queries[] = {
    {"eval", QUERY_EVAL, 2, 0, "fcpwPW", "f", eval_fields},
    {"sample", QUERY_SAMPLE, 1, 2, "xyzpw", "xyzpw", sample_fields},
    {"pair", QUERY_PAIR, 1, 3, "xyzPW", "xyzPW", pair_fields},
    {"albedo", QUERY_ALBEDO, 1, 0, "aA", "a", albedo_fields},
    {"mean", QUERY_MEAN, 0, 0, "m", "m", mean_fields},
};

const query *evaluation_find_query(const char *name) {
    for (size_t i = 0; i < sizeof queries / sizeof *queries; i++)
        if (strcmp(name, queries[i].name) == 0)
            return &queries[i];
    return NULL;
}

int evaluation_channels(const evaluation *e, const answer_field *field) {
    return field->scaling == SCALING_PLAIN ? 1 : e->reflectance.channels;
}

int evaluation_record_fields(const evaluation *e) {
    return (e->angles ? 2 : 3) * e->query->directions + e->query->random_numbers;
}

int evaluation_chunk_records(const evaluation *e, int flush) {
    int records = e->query->kind == QUERY_ALBEDO ? CHUNK_ALBEDOS : CHUNK_RECORDS;
    return flush > 0 && flush < records ? flush : records;
}

void evaluation_set_fields(evaluation *e, const char *letters) {
    memset(e->needed, 0, sizeof e->needed);
    e->numbers = 0;
    for (e->field_count = 0; letters[e->field_count]; e->field_count++) {
        const char *letter = strchr(e->query->letters, letters[e->field_count]);
        const answer_field *field = &e->query->fields[letter - e->query->letters];
        e->fields[e->field_count] = field;
        e->needed[field->result] = true;
        e->numbers += evaluation_channels(e, field);
    }
}
