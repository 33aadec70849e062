/* The queries, and what each can answer. */
#include "tools/brdfeval/evaluation.h"

#include <stddef.h>
#include <string.h>

static const answer_field eval_fields[] = {
    {'f', "f", 0, SCALING_VALUE},  {'c', "c", 0, SCALING_COSINE}, {'p', "p", 1, SCALING_PLAIN},
    {'w', "w", 2, SCALING_WEIGHT}, {'P', "P", 3, SCALING_PLAIN},  {'W', "W", 4, SCALING_WEIGHT},
};
static const answer_field sample_fields[] = {
    {'x', "lx", 0, SCALING_PLAIN}, {'y', "ly", 1, SCALING_PLAIN}, {'z', "lz", 2, SCALING_PLAIN},
    {'p', "p", 3, SCALING_PLAIN},  {'w', "w", 4, SCALING_WEIGHT},
};
static const answer_field pair_fields[] = {
    {'x', "lx", 0, SCALING_PLAIN}, {'y', "ly", 1, SCALING_PLAIN}, {'z', "lz", 2, SCALING_PLAIN},
    {'P', "P", 3, SCALING_PLAIN},  {'W', "W", 4, SCALING_WEIGHT},
};
static const answer_field albedo_fields[] = {
    {'a', "a", 0, SCALING_ALBEDO},
    {'A', "A", 1, SCALING_PLAIN},
};
static const answer_field mean_fields[] = {{'m', "m", 0, SCALING_MEAN}};

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
