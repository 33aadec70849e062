/* The weights of lights for any processor, and the choice of the version that suits this one. */
#include "scene/light_weights.h"
#include "scene/light_weights_loop.h"

void light_weights_baseline(const light_tree *tree, const light_group *group, const light_weights_input *in,
                            light_weights *w) {
    weigh(tree, group, in, w);
}

light_weigh_function *light_weights_best(void) {
#ifdef LIGHT_WEIGHTS_X86_64
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return light_weights_avx512;
    if (__builtin_cpu_supports("avx2"))
        return light_weights_avx2;
#endif
    return light_weights_baseline;
}
