/* The choice of the table that suits the processor. */
#include "brdf/kernels.h"

/* Each needs all that those before it need. */
static const brdf_kernels *const tables[] = {
    &brdf_kernels_baseline,
#ifdef BRDF_X86_64
    &brdf_kernels_avx2,
    &brdf_kernels_avx512,
#endif
};

/* The last table that this processor can run. Only reads what the C runtime found out before main(). */
static int last_table(void) {
#ifdef BRDF_X86_64
    int avx2 = (__builtin_cpu_supports("avx2") != 0) & (__builtin_cpu_supports("fma") != 0);
    int avx512 = (__builtin_cpu_supports("avx512f") != 0) & (__builtin_cpu_supports("avx512dq") != 0) &
                 (__builtin_cpu_supports("avx512vl") != 0);
    return avx2 + (avx2 & avx512);
#else
    return 0;
#endif
}

int brdf_kernels_available(const brdf_kernels *available[BRDF_KERNELS_MOST]) {
    int last = last_table();
    for (int i = 0; i <= last; ++i)
        available[i] = tables[i];
    return last + 1;
}

const brdf_kernels *brdf_kernels_best(void) {
    return tables[last_table()];
}
