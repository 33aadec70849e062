/* The pipeline that record filters run. */
#include "tools/common/record_filter.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/parallel.h"

/* Where records are uneven: how long a turn should be, how many records the first takes, how much longer a turn may be
 * than the one that it is judged by, and how many turns there are ahead of the one that is waited for. */
#define TURN_SECONDS   1e-3
#define FIRST_TURN     8
#define TURN_GROWTH    4
#define TURNS_A_THREAD 16

typedef struct chunk {
    record_chunk records;
    record_buffer answers;
} chunk;

typedef struct run {
    const record_filter *filter;
    double *room; /* for each worker: the numbers of a chunk, converted */
    uint64_t read, answered;
    atomic_size_t turn; /* records that the next chunk may take */
    const graze_report *report;
} run;

static size_t capacity(const run *r) {
    size_t chunk_records = atomic_load_explicit(&r->turn, memory_order_relaxed);
    uint64_t left = r->filter->wanted ? r->filter->wanted - r->read : chunk_records;
    return left < chunk_records ? (size_t)left : chunk_records;
}

static graze_status read_chunk(void *user, void *memory, bool *more) {
    run *r = user;
    chunk *c = memory;
    size_t most = capacity(r);
    *more = most > 0 && record_read(r->filter->reader, &c->records, most);
    r->read += *more ? c->records.count : 0;
    return GRAZE_OK;
}

static size_t chunk_numbers(const record_filter *f) {
    return (size_t)f->chunk_records * (size_t)f->fields;
}

static double thread_seconds(void) {
    struct timespec now = {0};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Judges the length of turns by one that took so long. Answers do not depend on it, nor does their order. */
static void adapt_turn(run *r, size_t count, double seconds) {
    size_t most = TURN_GROWTH * count, limit = (size_t)r->filter->chunk_records;
    most = most < limit ? most : limit;
    double goal = TURN_SECONDS * (double)count / seconds;
    size_t turn = !(goal < (double)most) ? most : goal > 1 ? (size_t)goal : 1;
    atomic_store_explicit(&r->turn, turn, memory_order_relaxed);
}

static void answer_records(run *r, chunk *c, int worker) {
    const record_filter *f = r->filter;
    record_numbers numbers = {.first = c->records.first};
    char message[RECORD_MESSAGE_SIZE] = "";
    if (f->floats)
        numbers.floats = record_floats(&c->records);
    else
        numbers.doubles = record_doubles(&c->records, r->room + (size_t)worker * chunk_numbers(f));
    numbers.count = c->records.count;
    double start = f->uneven ? thread_seconds() : 0;
    size_t answered = numbers.count ? f->answer(f->user, &numbers, worker, &c->answers, message) : 0;
    if (f->uneven && numbers.count)
        adapt_turn(r, numbers.count, thread_seconds() - start);
    if (answered < numbers.count)
        record_set_error(&c->records, answered, message);
}

/* Whatever is wrong becomes the chunk's error, and is reported when its turn comes to be written: only then is it known
 * that nothing before it is wrong. */
static void answer_chunk(void *user, void *memory, int worker) {
    run *r = user;
    chunk *c = memory;
    if (c->records.count > 0)
        answer_records(r, c, worker);
    if (c->records.error.status)
        record_reader_cancel(r->filter->reader);
}

static graze_status write_chunk(void *user, void *memory) {
    run *r = user;
    const record_filter *f = r->filter;
    chunk *c = memory;
    graze_status status = record_buffer_write(&c->answers, STDOUT_FILENO, "standard output", r->report);
    if (status == GRAZE_OK) {
        r->answered += c->records.count;
        status = record_report_error(f->reader, &c->records);
    }
    if (status)
        record_reader_cancel(f->reader);
    return status;
}

static graze_status run_pipeline(run *r, chunk *chunks, int chunk_count) {
    const record_filter *f = r->filter;
    const pipeline p = {f->threads, chunks, sizeof *chunks, chunk_count, r, read_chunk, answer_chunk, write_chunk};
    graze_status status = pipeline_run(&p, r->report);
    if (status == GRAZE_OK && r->answered < f->wanted)
        status = report_error(r->report, NULL, "standard input ended after %llu of %llu records",
                              (unsigned long long)r->answered, (unsigned long long)f->wanted);
    return status;
}

graze_status record_filter_run(const record_filter *f, uint64_t *count, const graze_report *report) {
    int chunk_count = f->uneven && f->threads > 1 ? TURNS_A_THREAD * f->threads : pipeline_chunk_count(f->threads);
    chunk *chunks = calloc((size_t)chunk_count, sizeof *chunks);
    run r = {.filter = f, .report = report};
    atomic_init(&r.turn, (size_t)(f->uneven && f->chunk_records > FIRST_TURN ? FIRST_TURN : f->chunk_records));
    if (!f->floats)
        r.room = malloc((size_t)f->threads * chunk_numbers(f) * sizeof *r.room);
    graze_status status =
        chunks && (r.room || f->floats) ? run_pipeline(&r, chunks, chunk_count) : report_out_of_memory(report);
    for (int i = 0; i < chunk_count && chunks; i++) {
        record_chunk_free(&chunks[i].records);
        record_buffer_free(&chunks[i].answers);
    }
    free(r.room);
    free(chunks);
    *count = r.answered;
    return status;
}
