/* Scenes of few surfaces, on x86-64 processors with AVX2. */
#include "geometry/few.h"

#ifdef FEW_X86_64
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif
#define LANES   4
#define MASK(f) (unsigned)__builtin_ia32_movmskpd256((numbers)(f))
#include "geometry/few_look.h"

void few_look_avx2(struct query *q) {
    look_through(q);
}
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
