/* The functions for x86-64 processors with AVX-512. */
#include "brdf/kernels.h"

#ifdef BRDF_X86_64
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,fma"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512vl,fma,prefer-vector-width=512")
#endif
#define BRDF_FMA
#define BRDF_TABLE      brdf_kernels_avx512
#define BRDF_TABLE_NAME "AVX-512"
#include "brdf/instruction_set.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
