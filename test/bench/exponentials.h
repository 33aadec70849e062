/* The vectorised exponentials of glibc's libmvec over arrays, by the widest instructions that the processor has. */
#ifndef BENCH_EXPONENTIALS_H
#define BENCH_EXPONENTIALS_H

#if defined(__x86_64__) && defined(__GLIBC__)
#define HAVE_LIBMVEC
#include <immintrin.h>

#include "bench/pairs.h"

/* libmvec's names: the instruction set (b: SSE4, d: AVX2, e: AVX-512) and the numbers a call. */
__m128 _ZGVbN4v_expf(__m128);
__m128d _ZGVbN2v_exp(__m128d);
__attribute__((target("avx2"))) __m256 _ZGVdN8v_expf(__m256);
__attribute__((target("avx2"))) __m256d _ZGVdN4v_exp(__m256d);
__attribute__((target("avx512f"))) __m512 _ZGVeN16v_expf(__m512);
__attribute__((target("avx512f"))) __m512d _ZGVeN8v_exp(__m512d);

/* Of the components x of v; what the numbers are makes no difference. */
static void expf_128(const pairs *p) {
    for (size_t i = 0; i < p->count; i += 4)
        _mm_store_ps(p->float_results[0] + i, _ZGVbN4v_expf(_mm_load_ps(p->floats[3] + i)));
}
static void exp_128(const pairs *p) {
    for (size_t i = 0; i < p->count; i += 2)
        _mm_store_pd(p->results[0] + i, _ZGVbN2v_exp(_mm_load_pd(p->numbers[3] + i)));
}
__attribute__((target("avx2"))) static void expf_256(const pairs *p) {
    for (size_t i = 0; i < p->count; i += 8)
        _mm256_store_ps(p->float_results[0] + i, _ZGVdN8v_expf(_mm256_load_ps(p->floats[3] + i)));
}
__attribute__((target("avx2"))) static void exp_256(const pairs *p) {
    for (size_t i = 0; i < p->count; i += 4)
        _mm256_store_pd(p->results[0] + i, _ZGVdN4v_exp(_mm256_load_pd(p->numbers[3] + i)));
}
__attribute__((target("avx512f"))) static void expf_512(const pairs *p) {
    for (size_t i = 0; i < p->count; i += 16)
        _mm512_store_ps(p->float_results[0] + i, _ZGVeN16v_expf(_mm512_load_ps(p->floats[3] + i)));
}
__attribute__((target("avx512f"))) static void exp_512(const pairs *p) {
    for (size_t i = 0; i < p->count; i += 8)
        _mm512_store_pd(p->results[0] + i, _ZGVeN8v_exp(_mm512_load_pd(p->numbers[3] + i)));
}

static void libmvec_expf(const pairs *p) {
    (__builtin_cpu_supports("avx512f") ? expf_512 : __builtin_cpu_supports("avx2") ? expf_256 : expf_128)(p);
}
static void libmvec_exp(const pairs *p) {
    (__builtin_cpu_supports("avx512f") ? exp_512 : __builtin_cpu_supports("avx2") ? exp_256 : exp_128)(p);
}
#endif

#endif
