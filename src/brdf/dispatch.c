/* The choice of the table that suits the processor. */
#include "brdf/kernels.h"

/* Only reads what the C runtime found out before main(). */
static brdf_processor this_processor(void) {
#ifdef BRDF_X86_64
    return (brdf_processor){
        .avx2 = __builtin_cpu_supports("avx2"),
        .fma = __builtin_cpu_supports("fma"),
        .avx512f = __builtin_cpu_supports("avx512f"),
        .avx512dq = __builtin_cpu_supports("avx512dq"),
        .avx512vl = __builtin_cpu_supports("avx512vl"),
    };
#else
    return (brdf_processor){.avx2 = false};
#endif
}

const brdf_kernels *brdf_kernels_for(brdf_processor processor) {
#ifdef BRDF_X86_64
    bool avx2 = processor.avx2 && processor.fma;
    if (avx2 && processor.avx512f && processor.avx512dq && processor.avx512vl)
        return &brdf_kernels_avx512;
    if (avx2)
        return &brdf_kernels_avx2;
#else
    (void)processor;
#endif
    return &brdf_kernels_baseline;
}

const brdf_kernels *brdf_kernels_best(void) {
    return brdf_kernels_for(this_processor());
}
