/* The weights of lights for x86-64 processors with AVX2. */
#include "scene/light_weights.h"

#ifdef LIGHT_WEIGHTS_X86_64
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif
#include "scene/light_weights_loop.h"

void light_weights_avx2(const light_tree *tree, const light_group *group, const light_weights_input *in,
                        light_weights *w) {
    weigh(tree, group, in, w);
}
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
