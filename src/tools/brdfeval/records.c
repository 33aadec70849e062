/* The filter that brdfeval is: blocks of records through the batch functions. */
#define _XOPEN_SOURCE 700 /* S_ISREG */
#include "tools/brdfeval/records.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/progress.h"
#include "tools/brdfeval/block.h"
#include "tools/common/record_filter.h"

/* A worker's memory. */
typedef struct workspace {
    union {
        block_double doubles;
        block_float floats;
    } block;
    union {
        double doubles[BLOCK_RECORDS * NUMBERS_MAX];
        float floats[BLOCK_RECORDS * NUMBERS_MAX];
    } numbers;
} workspace;

typedef struct run {
    const records_job *job;
    workspace *workspaces;
    progress *progress;
    off_t begin, end; /* of the input, for the progress line */
} run;

static size_t answer_doubles(const run *r, const double *records, size_t count, workspace *w, record_buffer *out,
                             char *message) {
    const evaluation *e = r->job->evaluation;
    block_double *b = &w->block.doubles;
    block_double_take(b, e, records, count, message);
    block_double_answer(b, e, w->numbers.doubles);
    record_append_records(out, r->job->out, 17, w->numbers.doubles, b->count, e->numbers);
    return b->count;
}

static size_t answer_floats(const run *r, const float *records, size_t count, workspace *w, record_buffer *out,
                            char *message) {
    const evaluation *e = r->job->evaluation;
    block_float *b = &w->block.floats;
    block_float_take(b, e, records, count, message);
    block_float_answer(b, e, w->numbers.floats);
    record_append_bytes(out, w->numbers.floats, b->count * (size_t)e->numbers * sizeof(float));
    return b->count;
}

static void show_progress(const run *r) {
    off_t at = r->progress ? lseek(STDIN_FILENO, 0, SEEK_CUR) : 0;
    if (at > r->begin)
        progress_update(r->progress, (double)(at - r->begin) / (double)(r->end - r->begin), NULL);
}

static size_t answer_chunk(void *user, const record_numbers *records, int worker, record_buffer *out, char *message) {
    const run *r = user;
    workspace *w = &r->workspaces[worker];
    size_t fields = (size_t)evaluation_record_fields(r->job->evaluation), done = 0, count, answered;
    show_progress(r);
    do {
        count = records->count - done < BLOCK_RECORDS ? records->count - done : BLOCK_RECORDS;
        answered = records->floats ? answer_floats(r, records->floats + fields * done, count, w, out, message)
                                   : answer_doubles(r, records->doubles + fields * done, count, w, out, message);
        done += answered;
    } while (answered == count && done < records->count);
    return done;
}

/* Null where nobody could see it, where it would mix with answers, or where the input's length is not known. */
static progress *start_progress(run *r) {
    struct stat input;
    if (isatty(STDOUT_FILENO) || fstat(STDIN_FILENO, &input) != 0 || !S_ISREG(input.st_mode))
        return NULL;
    r->begin = lseek(STDIN_FILENO, 0, SEEK_CUR);
    r->end = input.st_size;
    return progress_start("evaluating", r->begin >= 0 && r->end > r->begin);
}

/* Floats stay what they are where nothing but arithmetic is done with them. */
static bool computes_in_floats(const records_job *j) {
    return j->in == RECORD_FLOAT && j->out == RECORD_FLOAT && !j->evaluation->angles;
}

static graze_status run_filter(run *r, const graze_report *report) {
    const records_job *j = r->job;
    record_filter filter = {.fields = evaluation_record_fields(j->evaluation),
                            .chunk_records = evaluation_chunk_records(j->evaluation, j->flush),
                            .floats = computes_in_floats(j),
                            .threads = j->threads,
                            .user = r,
                            .answer = answer_chunk};
    uint64_t count;
    graze_status status =
        record_reader_open(&filter.reader, STDIN_FILENO, "standard input", j->in, filter.fields, report);
    r->progress = start_progress(r);
    if (status == GRAZE_OK)
        status = record_filter_run(&filter, &count, report);
    progress_finish(r->progress);
    record_reader_close(filter.reader);
    return status;
}

graze_status records_answer(const records_job *j, const graze_report *report) {
    run r = {.job = j};
    r.workspaces = aligned_alloc(_Alignof(workspace), (size_t)j->threads * sizeof *r.workspaces);
    graze_status status = r.workspaces ? run_filter(&r, report) : report_out_of_memory(report);
    free(r.workspaces);
    return status;
}

graze_status records_answer_once(const records_job *j, const graze_report *report) {
    double numbers[NUMBERS_MAX];
    block_double block = {.count = 1};
    record_buffer out = {0};
    block_double_answer(&block, j->evaluation, numbers);
    record_append_records(&out, j->out, 17, numbers, 1, j->evaluation->numbers);
    graze_status status = record_buffer_write(&out, STDOUT_FILENO, "standard output", report);
    record_buffer_free(&out);
    return status;
}
