/* Running compiled expressions. */
#ifndef CAL_EVALUATE_H
#define CAL_EVALUATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct cal_code cal_code;

typedef enum cal_outcome {
    CAL_FINE,
    CAL_FAULT, /* a division by 0, or a function outside of its domain or range: its value was taken for 0. Radiance
                  warns of a "compute error" and leaves out the primitive for this ray */
    CAL_FAILED /* no answer: see cal_failure */
} cal_outcome;

/* Bytes of memory that an evaluation needs, at an address fit for doubles. It need not be cleared, and each may use
 * another. */
size_t cal_memory_size(const cal_code *);

/* The expressions' values in outputs, all finite. channels[N - 1] is $N; those that cal_code_channels names are looked
 * at. Everything is computed once at most, and only when it is needed. Calls end after CAL_CALLS_MOST of them, or
 * where the memory's frames are used up. Safe on any number of threads at once with memory of their own. */
enum { CAL_CALLS_MOST = 1000000 };
cal_outcome cal_evaluate(const cal_code *, const double *channels, double *outputs, void *memory);

/* The same in memory of `size` bytes. Where functions call themselves that may be much less than cal_memory_size says,
 * and mostly is enough; *cramped tells that it was not: then there is no answer, nor a failure told. */
cal_outcome cal_evaluate_within(const cal_code *, const double *channels, double *outputs, void *memory, size_t size,
                                bool *cramped);

/* Why the last evaluation in that memory failed, with the place in the function file. */
const char *cal_failure(const cal_code *, const void *memory);

#endif
