/* The tables of kernels that the tests can compare: one for each instruction set that this processor has. */
#ifndef TEST_BRDF_KERNEL_TABLES_H
#define TEST_BRDF_KERNEL_TABLES_H

#include "brdf/kernels.h"

enum { KERNEL_TABLES_MOST = 3 };

/* All that this processor can run, the best one last; returns their number. */
static inline int kernel_tables_available(const brdf_kernels *available[KERNEL_TABLES_MOST]) {
    /* Each needs all that those before it need. */
    static const brdf_kernels *const tables[] = {
        &brdf_kernels_baseline,
#ifdef BRDF_X86_64
        &brdf_kernels_avx2,
        &brdf_kernels_avx512,
#endif
    };
    const brdf_kernels *best = brdf_kernels_best();
    int count = 0;
    do
        available[count] = tables[count];
    while (tables[count++] != best);
    return count;
}

#endif
