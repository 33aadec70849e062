/* Loops and pipelines: everything once, in order, on any number of threads. */
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/captured_report.h"

static void test_processors(void **state) {
    (void)state;
    assert_true(parallel_processor_count() >= 1);
}

enum { INDICES = 10000, THREADS = 8 };

typedef struct tally {
    atomic_int visits[INDICES];
    int by_worker[THREADS]; /* each worker's own: a data race if two threads had the same number */
    int threads;
    pthread_t caller;
    atomic_int strangers; /* calls from other threads than the caller's */
} tally;

static void count_visit(void *user, size_t index, int worker) {
    tally *t = user;
    atomic_fetch_add(&t->visits[index], 1);
    if (worker < 0 || worker >= t->threads)
        abort();
    t->by_worker[worker]++;
    if (!pthread_equal(t->caller, pthread_self()))
        atomic_fetch_add(&t->strangers, 1);
}

static void test_for_visits_each_once(void **state) {
    (void)state;
    static const size_t counts[] = {0, 1, 2, 7, 8, 9, 100, INDICES};
    tally *t = malloc(sizeof *t);
    for (int threads = 1; threads <= THREADS; threads++) {
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
            memset(t, 0, sizeof *t);
            t->threads = threads;
            t->caller = pthread_self();
            parallel_for(threads, counts[k], count_visit, t);
            size_t total = 0;
            for (int w = 0; w < THREADS; w++)
                total += (size_t)t->by_worker[w];
            assert_int_equal(total, counts[k]);
            for (size_t i = 0; i < INDICES; i++)
                if (t->visits[i] != (i < counts[k]))
                    fail_msg("index %zu of %zu was visited %d times", i, counts[k], t->visits[i]);
            if (threads == 1)
                assert_int_equal(t->strangers, 0);
        }
    }
    free(t);
}

/* A pipeline that squares the numbers 0, 1, 2, ... */
typedef struct chunk {
    uint64_t number, square;
    int steps; /* 1: read, 2: worked on, 0: written */
} chunk;

typedef struct squares {
    uint64_t count, next_read, next_write;
    uint64_t read_error_at, write_error_at; /* UINT64_MAX: never */
    atomic_int reading, writing, in_flight, most_in_flight;
    atomic_int misuse, read_failed;
    int by_worker[THREADS];
    int threads;
    pthread_t caller;
} squares;

static graze_status read_number(void *user, void *memory, bool *more) {
    squares *s = user;
    chunk *c = memory;
    s->misuse += atomic_fetch_add(&s->reading, 1) != 0 || c->steps != 0;
    graze_status status = GRAZE_OK;
    if (s->next_read == s->read_error_at) {
        status = GRAZE_INPUT_ERROR;
        s->read_failed = 1;
    } else if (s->next_read == s->count) {
        *more = false;
    } else {
        c->number = s->next_read++;
        c->steps = 1;
        int in_flight = atomic_fetch_add(&s->in_flight, 1) + 1;
        if (in_flight > s->most_in_flight)
            s->most_in_flight = in_flight;
    }
    atomic_fetch_sub(&s->reading, 1);
    return status;
}

static void square_number(void *user, void *memory, int worker) {
    squares *s = user;
    chunk *c = memory;
    s->misuse += c->steps != 1 || worker < 0 || worker >= s->threads;
    if (s->threads == 1)
        s->misuse += !pthread_equal(s->caller, pthread_self());
    s->by_worker[worker]++;
    /* Some take much longer than others: a sum of odd numbers. */
    uint64_t repetitions = c->number % 7 == 0 ? 30 : 1;
    for (uint64_t k = 0; k < repetitions; k++) {
        c->square = 0;
        for (uint64_t i = 0; i < c->number; i++)
            c->square += 2 * i + 1;
    }
    c->steps = 2;
}

static graze_status write_number(void *user, void *memory) {
    squares *s = user;
    chunk *c = memory;
    s->misuse += atomic_fetch_add(&s->writing, 1) != 0 || c->steps != 2;
    graze_status status = GRAZE_OK;
    if (c->number == s->write_error_at) {
        status = GRAZE_SYSTEM_ERROR;
        /* Where both are to fail, the read is the first. */
        while (s->read_error_at != UINT64_MAX && !s->read_failed)
            sched_yield();
    } else {
        s->misuse += c->number != s->next_write || c->square != c->number * c->number;
        s->next_write++;
    }
    c->steps = 0;
    atomic_fetch_sub(&s->in_flight, 1);
    atomic_fetch_sub(&s->writing, 1);
    return status;
}

static graze_status run_squares(squares *s, int threads, int chunk_count) {
    chunk memory[64] = {0};
    s->threads = threads;
    s->caller = pthread_self();
    pipeline p = {threads, memory, sizeof *memory, chunk_count, s, read_number, square_number, write_number};
    graze_status status = pipeline_run(&p, NULL);
    assert_int_equal(s->misuse, 0);
    assert_true(s->most_in_flight <= chunk_count);
    return status;
}

static void test_pipeline_order(void **state) {
    (void)state;
    static const uint64_t counts[] = {0, 1, 2, 50, 2000};
    for (int threads = 1; threads <= THREADS; threads++) {
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
            for (int chunk_count = 1; chunk_count <= 3 * threads; chunk_count += threads) {
                squares s = {.count = counts[k], .read_error_at = UINT64_MAX, .write_error_at = UINT64_MAX};
                assert_int_equal(run_squares(&s, threads, chunk_count), GRAZE_OK);
                assert_int_equal(s.next_write, counts[k]);
                assert_int_equal(s.in_flight, 0);
            }
        }
    }
}

/* What was read before the error is written. */
static void test_read_error(void **state) {
    (void)state;
    static const uint64_t places[] = {0, 1, 5, 300};
    for (int threads = 1; threads <= THREADS; threads++) {
        for (int k = 0; k < 4; k++) {
            squares s = {.count = 1000, .read_error_at = places[k], .write_error_at = UINT64_MAX};
            assert_int_equal(run_squares(&s, threads, 3 * threads), GRAZE_INPUT_ERROR);
            assert_int_equal(s.next_write, places[k]);
        }
    }
}

/* Nothing behind the error is written, and no more is read than the chunks hold. */
static void test_write_error(void **state) {
    (void)state;
    static const uint64_t places[] = {0, 1, 5, 300};
    for (int threads = 1; threads <= THREADS; threads++) {
        for (int k = 0; k < 4; k++) {
            squares s = {.count = 1000, .read_error_at = UINT64_MAX, .write_error_at = places[k]};
            assert_int_equal(run_squares(&s, threads, 3 * threads), GRAZE_SYSTEM_ERROR);
            assert_int_equal(s.next_write, places[k]);
            assert_true(s.next_read <= places[k] + 3 * (uint64_t)threads);
        }
    }
}

/* When both fail, the answer is that of the write, which lost results. */
static void test_both_errors(void **state) {
    (void)state;
    squares s = {.count = 10, .read_error_at = 3, .write_error_at = 2};
    assert_int_equal(run_squares(&s, 4, 12), GRAZE_SYSTEM_ERROR);
    assert_int_equal(s.next_write, 2);
}

/* An interactive client's pipeline: bytes from one pipe to another. */
typedef struct echo {
    int from_client, to_client;
} echo;

static graze_status read_byte(void *user, void *memory, bool *more) {
    echo *e = user;
    ssize_t got = read(e->from_client, memory, 1);
    *more = got == 1;
    return got < 0 ? GRAZE_SYSTEM_ERROR : GRAZE_OK;
}

static void raise_byte(void *user, void *memory, int worker) {
    (void)user;
    (void)worker;
    ++*(char *)memory;
}

static graze_status write_byte(void *user, void *memory) {
    echo *e = user;
    return write(e->to_client, memory, 1) == 1 ? GRAZE_OK : GRAZE_SYSTEM_ERROR;
}

typedef struct server {
    pipeline line;
    graze_status status;
} server;

static void *serve(void *argument) {
    server *s = argument;
    s->status = pipeline_run(&s->line, NULL);
    return NULL;
}

/* The client sends on only when it has its answer, so that a read is always waiting: would hang if answers waited for
 * it. */
static void test_interactive_client(void **state) {
    (void)state;
    for (int threads = 1; threads <= 4; threads++) {
        int there[2], back[2];
        assert_int_equal(pipe(there), 0);
        assert_int_equal(pipe(back), 0);
        echo e = {there[0], back[1]};
        char memory[6];
        server s = {{threads, memory, 1, 6, &e, read_byte, raise_byte, write_byte}, GRAZE_INPUT_ERROR};
        pthread_t thread;
        assert_int_equal(pthread_create(&thread, NULL, serve, &s), 0);
        for (int i = 0; i < 1000; i++) {
            char sent = (char)(i % 100), answer = 0;
            assert_int_equal(write(there[1], &sent, 1), 1);
            assert_int_equal(read(back[0], &answer, 1), 1);
            assert_int_equal(answer, sent + 1);
        }
        close(there[1]);
        pthread_join(thread, NULL);
        assert_int_equal(s.status, GRAZE_OK);
        close(there[0]);
        close(back[0]);
        close(back[1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_processors),         cmocka_unit_test(test_for_visits_each_once),
        cmocka_unit_test(test_pipeline_order),     cmocka_unit_test(test_read_error),
        cmocka_unit_test(test_write_error),        cmocka_unit_test(test_both_errors),
        cmocka_unit_test(test_interactive_client),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
