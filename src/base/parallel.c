/* For sched_getaffinity. */
#define _GNU_SOURCE
#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/parallel_team.h"

int parallel_processor_count(void) {
#ifdef CPU_COUNT
    cpu_set_t usable;
    if (sched_getaffinity(0, sizeof usable, &usable) == 0 && CPU_COUNT(&usable) > 0)
        return CPU_COUNT(&usable);
#endif
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

typedef struct team_member {
    pthread_t thread;
    int worker;
    void (*run)(void *user, int worker);
    void *user;
} team_member;

static void *run_member(void *argument) {
    team_member *m = argument;
    m->run(m->user, m->worker);
    return NULL;
}

void parallel_run_team(int threads, void (*run)(void *user, int worker), void *user) {
    team_member *members = threads > 1 ? malloc((size_t)(threads - 1) * sizeof *members) : NULL;
    int started = 0;
    while (members && started < threads - 1) {
        team_member *m = &members[started];
        m->worker = started + 1;
        m->run = run;
        m->user = user;
        if (pthread_create(&m->thread, NULL, run_member, m) != 0)
            break;
        started++;
    }
    run(user, 0);
    for (int i = 0; i < started; i++)
        pthread_join(members[i].thread, NULL);
    free(members);
}

typedef struct loop {
    atomic_size_t next;
    size_t count;
    void (*work)(void *user, size_t index, int worker);
    void *user;
} loop;

static void run_loop(void *user, int worker) {
    loop *l = user;
    for (;;) {
        size_t index = atomic_fetch_add_explicit(&l->next, 1, memory_order_relaxed);
        if (index >= l->count)
            return;
        l->work(l->user, index, worker);
    }
}

void parallel_for(int threads, size_t count, void (*work)(void *user, size_t index, int worker), void *user) {
    loop l = {.count = count, .work = work, .user = user};
    atomic_init(&l.next, 0);
    parallel_run_team(count < (size_t)threads ? (int)count : threads, run_loop, &l);
}
