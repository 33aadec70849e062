/* Memory of all sizes: zeroed, aligned, and none where there cannot be any. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/large_memory.h"

/* Memory that was used before comes back zeroed, too. */
static void is_zeroed_and_aligned(void **state) {
    (void)state;
    static const size_t sizes[] = {0, 1, 63, 64, 65, 100000, (1 << 21) - 1, 1 << 21, (5 << 20) + 3};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int again = 0; again < 2; again++) {
            unsigned char *memory = large_memory(sizes[i], 1);
            assert_non_null(memory);
            assert_int_equal((uintptr_t)memory % 64, 0);
            for (size_t k = 0; k < sizes[i]; k++) {
                assert_int_equal(memory[k], 0);
                memory[k] = 0xff;
            }
            free(memory);
        }
}

static void too_much_is_none(void **state) {
    (void)state;
    assert_null(large_memory(SIZE_MAX, 1));
    assert_null(large_memory(SIZE_MAX / 2, 3));
    assert_null(large_memory((SIZE_MAX >> 1) / 64, 64));
    assert_null(large_memory_unset(SIZE_MAX));
    assert_null(large_memory_unset(SIZE_MAX >> 1));
}

static void what_is_not_zeroed_is_there(void **state) {
    (void)state;
    static const size_t sizes[] = {0, 1, 65, 1 << 21, (1 << 21) + 1};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned char *memory = large_memory_unset(sizes[i]);
        assert_non_null(memory);
        assert_int_equal((uintptr_t)memory % 64, 0);
        memset(memory, 1, sizes[i]);
        free(memory);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(is_zeroed_and_aligned), cmocka_unit_test(too_much_is_none),
                                       cmocka_unit_test(what_is_not_zeroed_is_there)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
