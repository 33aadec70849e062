/* Contenders that take turns, and the table of what each of them costs. */
#ifndef BENCH_TURNS_H
#define BENCH_TURNS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/pairs.h"

enum { TURNS = 41 };

typedef struct contender {
    const char *name;
    void (*run)(const pairs *); /* over the whole array once */
    const char *beside;         /* the contender before it that it is compared with, or null */
    double goal;                /* the most that the ratio of both may be; 0: none is set */
    double nanoseconds[TURNS];  /* for one pair, in ascending order */
} contender;

/* The thread's own time: what other programs do meanwhile does not count. */
static double turns_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static int turns_compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A turn works on so many pairs at least, repeating itself, that it is long beside the clock's grain. */
static void turns_measure(contender *contenders, int count, const pairs *p) {
    const size_t least = 1 << 15;
    size_t repeat = (least + p->count - 1) / p->count;
    for (int turn = -1; turn < TURNS; turn++) /* the first warms up */
        for (int i = 0; i < count; i++) {
            double start = turns_now();
            for (size_t k = 0; k < repeat; k++)
                contenders[i].run(p);
            if (turn >= 0)
                contenders[i].nanoseconds[turn] = (turns_now() - start) / (double)(repeat * p->count);
        }
    for (int i = 0; i < count; i++)
        qsort(contenders[i].nanoseconds, TURNS, sizeof(double), turns_compare);
}

static void turns_print(const contender *contenders, int count) {
    printf("  %-28s %9s %21s   %s\n", "", "median ns", "(quartiles)", "ratio");
    for (int i = 0; i < count; i++) {
        const contender *c = &contenders[i], *beside = NULL;
        double median = c->nanoseconds[TURNS / 2];
        printf("  %-28s %9.3f (%9.3f %9.3f)", c->name, median, c->nanoseconds[TURNS / 4],
               c->nanoseconds[3 * TURNS / 4]);
        for (int k = 0; c->beside && k < count; k++)
            if (strcmp(contenders[k].name, c->beside) == 0)
                beside = &contenders[k];
        double ratio = beside ? median / beside->nanoseconds[TURNS / 2] : 0;
        if (beside)
            printf("   %6.2f x %s", ratio, beside->name);
        if (beside && c->goal > 0)
            printf("; goal %g: %s", c->goal, ratio <= c->goal ? "met" : "MISSED");
        putchar('\n');
    }
}

#endif
