/* Which table of functions a processor gets. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "brdf/kernel_tables.h"

enum { FEATURES = 5, PROCESSORS = 1 << FEATURES };

/* The processor that has the features whose bits are set. */
static brdf_processor processor_of(int bits) {
    return (brdf_processor){bits & 1, bits & 2, bits & 4, bits & 8, bits & 16};
}

/* A table is for processors that have all it needs, and no other. */
static void a_table_follows_from_the_features(void **state) {
    (void)state;
    int chosen[KERNEL_TABLES_MOST] = {0};
    for (int bits = 0; bits < PROCESSORS; ++bits) {
        const brdf_kernels *kernels = brdf_kernels_for(processor_of(bits));
#ifdef BRDF_X86_64
        int place = bits == PROCESSORS - 1 ? 2 : (bits & 3) == 3;
        const brdf_kernels *const expected[] = {&brdf_kernels_baseline, &brdf_kernels_avx2, &brdf_kernels_avx512};
#else
        int place = 0;
        const brdf_kernels *const expected[] = {&brdf_kernels_baseline};
#endif
        assert_ptr_equal(kernels, expected[place]);
        ++chosen[place];
    }
    assert_int_equal(chosen[0] + chosen[1] + chosen[2], PROCESSORS);
#ifdef BRDF_X86_64
    assert_int_equal(chosen[1], 7); /* without one of AVX-512's three at least */
    assert_int_equal(chosen[2], 1);
#endif
}

/* From the one that runs everywhere to the best one, and nothing is written behind that. */
static void available_tables_end_with_the_best(void **state) {
    (void)state;
    const brdf_kernels *tables[KERNEL_TABLES_MOST + 1] = {NULL};
    int count = kernel_tables_available(tables);
    assert_true(count >= 1 && count <= KERNEL_TABLES_MOST);
    assert_ptr_equal(tables[0], &brdf_kernels_baseline);
    assert_ptr_equal(tables[count - 1], brdf_kernels_best());
    assert_null(tables[count]);
    for (int i = 1; i < count; ++i)
        assert_ptr_not_equal(tables[i], tables[i - 1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_follows_from_the_features),
        cmocka_unit_test(available_tables_end_with_the_best),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
