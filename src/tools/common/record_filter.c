/* The pipeline that record filters run. */
#include "tools/common/record_filter.h"

#include <stdlib.h>
#include <unistd.h>

#include "base/parallel.h"

typedef struct chunk {
    record_portion portion;
    record_buffer output;
} chunk;

typedef struct run {
    const record_filter *filter;
    double **values; /* for each worker: the numbers of its block */
    uint64_t read, answered;
    const graze_report *report;
} run;

static size_t room(const run *r) {
    size_t chunk_records = (size_t)r->filter->chunk_records;
    uint64_t left = r->filter->wanted ? r->filter->wanted - r->read : chunk_records;
    return left < chunk_records ? (size_t)left : chunk_records;
}

static graze_status read_chunk(void *user, void *memory, bool *more) {
    run *r = user;
    chunk *c = memory;
    size_t capacity = room(r);
    *more = capacity > 0 && record_read(r->filter->reader, &c->portion, capacity);
    r->read += *more ? c->portion.count : 0;
    return GRAZE_OK;
}

/* Whatever is wrong becomes the chunk's trouble, and is reported when its turn comes to be written: only then is it
 * known that nothing before it is wrong. */
static void answer_chunk(void *user, void *memory, int worker) {
    const run *r = user;
    const record_filter *f = r->filter;
    chunk *c = memory;
    record_portion *p = &c->portion;
    if (p->count > 0) {
        record_block block = {.first = p->first};
        if (f->floats)
            block.floats = record_floats(p);
        else
            block.values = record_doubles(p, r->values[worker]);
        block.count = p->count;
        char trouble[RECORD_TROUBLE_SIZE] = "";
        size_t answered = block.count ? f->answer(f->user, &block, worker, &c->output, trouble) : 0;
        if (answered < block.count)
            record_set_trouble(p, answered, trouble);
    }
    if (p->trouble.status)
        record_reader_cancel(f->reader);
}

static graze_status write_chunk(void *user, void *memory) {
    run *r = user;
    const record_filter *f = r->filter;
    chunk *c = memory;
    graze_status status = record_buffer_write(&c->output, STDOUT_FILENO, "standard output", r->report);
    if (status == GRAZE_OK) {
        r->answered += c->portion.count;
        status = record_report_trouble(f->reader, &c->portion);
    }
    if (status)
        record_reader_cancel(f->reader);
    return status;
}

static graze_status run_pipeline(run *r, chunk *chunks, void **places, int chunk_count) {
    const record_filter *f = r->filter;
    size_t numbers = (size_t)f->chunk_records * (size_t)f->fields;
    for (int i = 0; i < chunk_count; i++)
        places[i] = &chunks[i];
    for (int i = 0; i < f->threads && !f->floats; i++) {
        r->values[i] = malloc(numbers * sizeof *r->values[i]);
        if (!r->values[i])
            return report_out_of_memory(r->report);
    }
    const pipeline p = {f->threads, places, chunk_count, r, read_chunk, answer_chunk, write_chunk};
    graze_status status = pipeline_run(&p, r->report);
    if (status == GRAZE_OK && r->answered < f->wanted)
        status = report_error(r->report, NULL, "standard input ended after %llu of %llu records",
                              (unsigned long long)r->answered, (unsigned long long)f->wanted);
    return status;
}

graze_status record_filter_run(const record_filter *f, uint64_t *count, const graze_report *report) {
    int chunk_count = 3 * f->threads;
    chunk *chunks = calloc((size_t)chunk_count, sizeof *chunks);
    void **places = calloc((size_t)chunk_count, sizeof *places);
    double **values = calloc((size_t)f->threads, sizeof *values);
    run r = {.filter = f, .values = values, .report = report};
    graze_status status =
        chunks && places && values ? run_pipeline(&r, chunks, places, chunk_count) : report_out_of_memory(report);
    for (int i = 0; i < chunk_count && chunks; i++) {
        record_portion_free(&chunks[i].portion);
        record_buffer_free(&chunks[i].output);
    }
    for (int i = 0; i < f->threads && values; i++)
        free(values[i]);
    free(values);
    free(places);
    free(chunks);
    *count = r.answered;
    return status;
}
