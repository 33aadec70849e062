/* What all contenders of the benchmark work on: pairs of directions and random numbers, and room for results. */
#ifndef BENCH_PAIRS_H
#define BENCH_PAIRS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

typedef struct pairs {
    size_t count;       /* a multiple of 16; arrays are aligned to 64 bytes */
    double *numbers[9]; /* l, v, s, t, u */
    double *results[5];
    float *floats[9], *float_results[5]; /* the same, rounded */
} pairs;

/* In 0 .. 1, without 1; all integers in turn, thoroughly mixed. */
static double pairs_uniform(uint64_t *state) {
    *state += UINT64_C(0x9e3779b97f4a7c15);
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static void *pairs_allocate(size_t size) {
    void *memory = aligned_alloc(64, (size + 63) / 64 * 64);
    if (!memory) {
        fprintf(stderr, "out of memory\n");
        exit(2);
    }
    /* Touched, so that no contender pays for fresh pages. */
    memset(memory, 0, size);
    return memory;
}

/* Directions all over the hemisphere. */
static pairs pairs_make(size_t count) {
    pairs p = {.count = count};
    for (int k = 0; k < 9; k++) {
        p.numbers[k] = pairs_allocate(count * sizeof(double));
        p.floats[k] = pairs_allocate(count * sizeof(float));
    }
    for (int k = 0; k < 5; k++) {
        p.results[k] = pairs_allocate(count * sizeof(double));
        p.float_results[k] = pairs_allocate(count * sizeof(float));
    }
    uint64_t state = 1;
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 6; k += 3) {
            double z = pairs_uniform(&state), angle = 2 * pi * pairs_uniform(&state), sine = sqrt(1 - z * z);
            p.numbers[k][i] = sine * cos(angle);
            p.numbers[k + 1][i] = sine * sin(angle);
            p.numbers[k + 2][i] = z;
        }
        for (int k = 6; k < 9; k++)
            p.numbers[k][i] = pairs_uniform(&state);
        for (int k = 0; k < 9; k++)
            p.floats[k][i] = (float)p.numbers[k][i];
    }
    return p;
}

static void pairs_free(pairs *p) {
    for (int k = 0; k < 9; k++) {
        free(p->numbers[k]);
        free(p->floats[k]);
    }
    for (int k = 0; k < 5; k++) {
        free(p->results[k]);
        free(p->float_results[k]);
    }
}

#endif
