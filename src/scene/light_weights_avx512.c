/* The weights of lights for x86-64 processors with AVX-512. */
#include "scene/light_weights.h"

#ifdef LIGHT_WEIGHTS_X86_64
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")
#endif
#include "scene/light_weights_loop.h"

void light_weights_avx512(const light_tree *tree, const light_group *group, const light_weights_input *in,
                          light_weights *w) {
    weigh(tree, group, in, w);
}
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
