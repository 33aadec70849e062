/* Pipelines: chunks are read and written in turn, and worked on by all threads at once. */
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/parallel.h"
#include "base/parallel_team.h"
#include "base/report.h"

/* Chunks are numbered as they are read, and number n lies in chunk n % chunk_count. All threads do the same: whenever
 * one is free it writes the next chunk if that is ready, or else reads one and works on it. Reading and writing each
 * are one thread's at a time, and never under the lock: while one waits for input, the others write. */
typedef struct flow {
    const pipeline *line;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool *ready; /* for each chunk: worked on, not yet written */
    uint64_t next_read, next_write;
    bool reading, writing;
    bool input_ended, broken; /* broken: by a failed write */
    graze_status read_status, write_status;
} flow;

static void *chunk_at(const pipeline *p, size_t index) {
    return (char *)p->chunks + index * p->chunk_size;
}

static size_t slot(const flow *f, uint64_t number) {
    return (size_t)(number % (uint64_t)f->line->chunk_count);
}

static bool can_write(const flow *f) {
    return !f->broken && !f->writing && f->next_write < f->next_read && f->ready[slot(f, f->next_write)];
}

static bool can_read(const flow *f) {
    return !f->broken && !f->input_ended && !f->reading &&
           f->next_read - f->next_write < (uint64_t)f->line->chunk_count;
}

static bool is_over(const flow *f) {
    return f->broken || (f->input_ended && f->next_write == f->next_read);
}

/* The steps are entered and left with the lock held. */

static void write_chunk(flow *f) {
    size_t i = slot(f, f->next_write);
    f->writing = true;
    pthread_mutex_unlock(&f->lock);
    graze_status status = f->line->write(f->line->user, chunk_at(f->line, i));
    pthread_mutex_lock(&f->lock);
    f->writing = false;
    f->ready[i] = false;
    f->next_write++;
    f->broken = status != GRAZE_OK;
    f->write_status = status;
    pthread_cond_broadcast(&f->changed);
}

static void work_on_chunk(flow *f, size_t i, int worker) {
    pthread_mutex_unlock(&f->lock);
    f->line->work(f->line->user, chunk_at(f->line, i), worker);
    pthread_mutex_lock(&f->lock);
    f->ready[i] = true;
    pthread_cond_broadcast(&f->changed);
}

static void read_and_work(flow *f, int worker) {
    size_t i = slot(f, f->next_read);
    bool more = true;
    f->reading = true;
    pthread_mutex_unlock(&f->lock);
    graze_status status = f->line->read(f->line->user, chunk_at(f->line, i), &more);
    pthread_mutex_lock(&f->lock);
    f->reading = false;
    if (status || !more) {
        f->input_ended = true;
        f->read_status = status;
    } else {
        f->next_read++;
    }
    pthread_cond_broadcast(&f->changed);
    if (!f->input_ended && !f->broken)
        work_on_chunk(f, i, worker);
}

static void run_flow(void *user, int worker) {
    flow *f = user;
    pthread_mutex_lock(&f->lock);
    while (!is_over(f)) {
        if (can_write(f))
            write_chunk(f);
        else if (can_read(f))
            read_and_work(f, worker);
        else
            pthread_cond_wait(&f->changed, &f->lock);
    }
    pthread_mutex_unlock(&f->lock);
}

static graze_status run_alone(const pipeline *p) {
    for (;;) {
        bool more = true;
        graze_status status = p->read(p->user, p->chunks, &more);
        if (status || !more)
            return status;
        p->work(p->user, p->chunks, 0);
        status = p->write(p->user, p->chunks);
        if (status)
            return status;
    }
}

/* While a thread works on one chunk, one can wait to be written, and one be read ahead. */
int pipeline_chunk_count(int threads) {
    return threads > 1 ? 3 * threads : 1;
}

graze_status pipeline_run(const pipeline *p, const graze_report *report) {
    if (p->threads <= 1)
        return run_alone(p);
    flow f = {.line = p, .ready = calloc((size_t)p->chunk_count, sizeof *f.ready)};
    if (!f.ready)
        return report_out_of_memory(report);
    /* These two cannot fail without attributes but where memory is wanting. */
    graze_status status = GRAZE_OK;
    if (pthread_mutex_init(&f.lock, NULL) != 0)
        status = report_out_of_memory(report);
    else if (pthread_cond_init(&f.changed, NULL) != 0) {
        status = report_out_of_memory(report);
        pthread_mutex_destroy(&f.lock);
    }
    if (!status) {
        parallel_run_team(p->threads, run_flow, &f);
        status = f.write_status ? f.write_status : f.read_status;
        pthread_cond_destroy(&f.changed);
        pthread_mutex_destroy(&f.lock);
    }
    free(f.ready);
    return status;
}
