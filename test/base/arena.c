/* Pieces of memory: aligned, apart from each other, kept. */
#include "base/arena.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { PIECES = 5000 };

/* Sizes from 0 to far beyond a block, in an order without pattern. */
static size_t size_of_piece(int i) {
    uint32_t mixed = (uint32_t)i * 2654435761u;
    return i % 97 == 0 ? mixed % 100000 : mixed % 300;
}

static void test_pieces_are_apart(void **state) {
    (void)state;
    arena *a = arena_create();
    assert_non_null(a);
    static unsigned char *pieces[PIECES];
    for (int i = 0; i < PIECES; i++) {
        size_t size = size_of_piece(i);
        pieces[i] = arena_allocate(a, size);
        assert_non_null(pieces[i]);
        assert_int_equal((uintptr_t)pieces[i] % _Alignof(max_align_t), 0);
        memset(pieces[i], i % 251, size);
    }
    for (int i = 0; i < PIECES; i++) {
        size_t size = size_of_piece(i);
        for (size_t k = 0; k < size; k++)
            if (pieces[i][k] != i % 251)
                fail_msg("piece %d was overwritten at byte %zu", i, k);
    }
    arena_destroy(a);
}

static void test_empty_pieces_differ(void **state) {
    (void)state;
    arena *a = arena_create();
    void *first = arena_allocate(a, 0), *second = arena_allocate(a, 0);
    assert_non_null(first);
    assert_non_null(second);
    assert_ptr_not_equal(first, second);
    arena_destroy(a);
}

static void test_large_piece(void **state) {
    (void)state;
    arena *a = arena_create();
    void *small = arena_allocate(a, 16);
    char *large = arena_allocate(a, 5000000);
    assert_non_null(large);
    memset(large, 1, 5000000);
    /* A large piece has its own block: small ones go on where they were. */
    assert_ptr_equal(arena_allocate(a, 16), (char *)small + 16);
    arena_destroy(a);
}

static void test_impossible_sizes(void **state) {
    (void)state;
    arena *a = arena_create();
    assert_null(arena_allocate(a, SIZE_MAX));
    assert_null(arena_allocate(a, SIZE_MAX - 15));
    assert_null(arena_allocate(a, PTRDIFF_MAX));
    assert_null(arena_copy_text(a, "", SIZE_MAX));
    assert_non_null(arena_allocate(a, 1));
    arena_destroy(a);
}

static void test_copies(void **state) {
    (void)state;
    arena *a = arena_create();
    char source[] = "grazing angles";
    char *copy = arena_copy_text(a, source, 7);
    source[0] = 'G';
    assert_string_equal(copy, "grazing");
    assert_string_equal(arena_copy_text(a, "", 0), "");
    assert_string_equal(copy, "grazing");
    arena_destroy(a);
}

static void test_absorbs_another(void **state) {
    (void)state;
    arena *a = arena_create(), *other = arena_create(), *empty = arena_create();
    assert_true(a && other && empty);
    char *own = arena_copy_text(a, "own", 3), *moved = arena_copy_text(other, "moved", 5);
    char *large = arena_allocate(other, 100000);
    assert_true(own && moved && large);
    memset(large, 'x', 100000);
    arena_absorb(a, other);
    arena_absorb(a, empty);
    for (int i = 0; i < 1000; i++)
        assert_string_equal(arena_copy_text(a, "later", 5), "later");
    assert_string_equal(own, "own");
    assert_string_equal(moved, "moved");
    assert_int_equal(large[99999], 'x');
    arena_destroy(a);
}

static void test_null_is_let_pass(void **state) {
    (void)state;
    arena_destroy(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pieces_are_apart), cmocka_unit_test(test_empty_pieces_differ),
        cmocka_unit_test(test_large_piece),      cmocka_unit_test(test_impossible_sizes),
        cmocka_unit_test(test_copies),           cmocka_unit_test(test_absorbs_another),
        cmocka_unit_test(test_null_is_let_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
