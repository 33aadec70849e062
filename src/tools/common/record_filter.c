/* The pipeline that record filters run. */
#include "tools/common/record_filter.h"

#include <stdlib.h>
#include <unistd.h>

#include "base/parallel.h"

typedef struct chunk {
    uint64_t first; /* number of the first record */
    size_t count;
    double *records;
    record_buffer output;
} chunk;

typedef struct run {
    const record_filter *filter;
    uint64_t read;
    char trouble[128]; /* what is wrong with the record behind them, or nothing */
    const graze_report *report;
} run;

static graze_status report_trouble(const run *r) {
    return report_error(r->report, &(place){.file = "standard input"}, "record %llu: %s",
                        (unsigned long long)r->read + 1, r->trouble);
}

static size_t room(const run *r) {
    size_t chunk_records = (size_t)r->filter->chunk_records;
    uint64_t left = r->filter->wanted ? r->filter->wanted - r->read : chunk_records;
    return left < chunk_records ? (size_t)left : chunk_records;
}

static bool is_answerable(run *r, const double *record) {
    const record_filter *f = r->filter;
    return !f->check || f->check(f->user, record, r->trouble, sizeof r->trouble);
}

/* Records before one that is wrong are answered first; the next call then reports that one. */
static graze_status read_chunk(void *user, void *memory, bool *more) {
    run *r = user;
    chunk *c = memory;
    const record_filter *f = r->filter;
    *more = false;
    if (r->trouble[0])
        return report_trouble(r);
    size_t capacity = room(r), count = 0;
    graze_status status = capacity ? record_read(f->reader, c->records, capacity, &count) : GRAZE_OK;
    c->first = r->read;
    c->count = 0;
    while (c->count < count && is_answerable(r, &c->records[c->count * (size_t)f->fields]))
        c->count++;
    r->read += c->count;
    *more = c->count > 0;
    if (*more)
        return status;
    if (r->trouble[0])
        return report_trouble(r);
    if (status == GRAZE_OK && r->read < f->wanted)
        return report_error(r->report, NULL, "standard input ended after %llu of %llu records",
                            (unsigned long long)r->read, (unsigned long long)f->wanted);
    return status;
}

static void answer_chunk(void *user, void *memory, int worker) {
    (void)worker;
    const record_filter *f = ((const run *)user)->filter;
    chunk *c = memory;
    for (size_t i = 0; i < c->count; i++)
        f->answer(f->user, &c->records[i * (size_t)f->fields], c->first + i, &c->output);
}

static graze_status write_chunk(void *user, void *memory) {
    return record_buffer_write(&((chunk *)memory)->output, STDOUT_FILENO, "standard output", ((run *)user)->report);
}

graze_status record_filter_run(const record_filter *f, uint64_t *count, const graze_report *report) {
    run r = {.filter = f, .report = report};
    int chunk_count = 3 * f->threads;
    size_t numbers = (size_t)f->chunk_records * (size_t)f->fields;
    chunk *chunks = calloc((size_t)chunk_count, sizeof *chunks);
    void **places = calloc((size_t)chunk_count, sizeof *places);
    double *records = calloc((size_t)chunk_count * numbers, sizeof *records);
    graze_status status = GRAZE_OK;
    if (!chunks || !places || !records) {
        status = report_out_of_memory(report);
    } else {
        for (int i = 0; i < chunk_count; i++) {
            chunks[i].records = records + (size_t)i * numbers;
            places[i] = &chunks[i];
        }
        const pipeline p = {f->threads, places, chunk_count, &r, read_chunk, answer_chunk, write_chunk};
        status = pipeline_run(&p, report);
        for (int i = 0; i < chunk_count; i++)
            record_buffer_free(&chunks[i].output);
    }
    free(records);
    free(places);
    free(chunks);
    *count = r.read;
    return status;
}
