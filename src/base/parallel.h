/* Threads: loops over numbered pieces of work, and pipelines that keep order. Results never depend on thread count. */
#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

#include <stdbool.h>
#include <stddef.h>

#include "graze/error.h"

/* The number of processors this process may use, at least 1. */
int parallel_processor_count(void);

/* Calls work(user, i, worker) once for every i in [0, count), from up to `threads` threads (worker in [0, threads)), in
 * unspecified order, and returns when all are done. `threads` 1 runs in the caller's thread and starts none. If threads
 * cannot be started, fewer are used. */
void parallel_for(int threads, size_t count, void (*work)(void *user, size_t index, int worker), void *user);

/* A pipeline moves chunks through three steps: `read` fills a chunk (one call at a time, in order), `work` is done on
 * several at once, `write` empties them (one call at a time, in the order they were read), each as soon as those before
 * it are written, even while `read` waits for input. */
typedef struct pipeline {
    int threads;  /* of `work`; 1: all steps in the caller's thread */
    void *chunks; /* chunk_count pieces of chunk_size bytes, that go round and bound what is in flight */
    size_t chunk_size;
    int chunk_count; /* at least 1 */
    void *user;
    /* Fills the chunk; *more = false when there is nothing (left) to put into it: reading is then over. An error also
     * ends reading; chunks read before are still worked on and written, then the error is returned. */
    graze_status (*read)(void *user, void *chunk, bool *more);
    void (*work)(void *user, void *chunk, int worker);
    /* An error ends the pipeline at once (no further read begins, but one under way is waited for); it is returned. */
    graze_status (*write)(void *user, void *chunk);
} pipeline;
/* A good number of chunks for so many threads. */
int pipeline_chunk_count(int threads);
graze_status pipeline_run(const pipeline *, const graze_report *);

#endif
