/* The functions for x86-64 processors with AVX2 and FMA. */
#include "brdf/kernels.h"

#ifdef BRDF_X86_64
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC target("avx2,fma")
#endif
#define BRDF_FMA
#define BRDF_TABLE      brdf_kernels_avx2
#define BRDF_TABLE_NAME "AVX2"
#include "brdf/instruction_set.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
