/* What the arithmetic of this folder relies on, set or checked: every operation rounds once, to its own type. */
#ifndef BRDF_ARITHMETIC_H
#define BRDF_ARITHMETIC_H

#include <float.h>

#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 /* 16 is about half precision */
#error "double arithmetic has to round to double: on 32-bit x86, compile with -msse2 -mfpmath=sse"
#endif
#ifdef __FAST_MATH__
#error "not with -ffast-math: errors of roundings are computed, and would be optimised away"
#endif

/* No a * b + c in one rounding, whatever the compiler's options (but for clang's -ffp-contract=fast, which heeds
 * nothing). */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

/* Loops become vector code only if all of their bodies is inlined. (Without optimisation there is one copy of each
 * function, for debuggers and for reports of coverage.) */
#if defined(__GNUC__) && defined(__OPTIMIZE__)
#define BRDF_INLINE static inline __attribute__((always_inline))
#else
#define BRDF_INLINE static inline
#endif

#endif
