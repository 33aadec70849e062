/* An arena as a chain of blocks; large pieces get a block of their own. */
#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Blocks grow with the arena up to BLOCK_LARGEST; a piece too large to share a block gets one of its own. */
enum { BLOCK_SMALLEST = 4096, BLOCK_LARGEST = 1 << 20 };

typedef struct block {
    struct block *next;
    max_align_t bytes[];
} block;

/* In a cache line of its own, for the thread that uses it. */
struct arena {
    _Alignas(64) block *blocks; /* all of them, to be freed */
    char *free;                 /* of the block that small pieces come from */
    size_t left;                /* bytes at `free` */
    size_t capacity;            /* of the next such block */
};

arena *arena_create(void) {
    arena *a = aligned_alloc(_Alignof(arena), sizeof *a);
    if (a)
        *a = (arena){.capacity = BLOCK_SMALLEST};
    return a;
}

void arena_destroy(arena *a) {
    if (!a)
        return;
    for (block *b = a->blocks, *next; b; b = next) {
        next = b->next;
        free(b);
    }
    free(a);
}

void arena_absorb(arena *a, arena *other) {
    block **last = &other->blocks;
    while (*last)
        last = &(*last)->next;
    *last = a->blocks;
    a->blocks = other->blocks;
    free(other);
}

static void *add_block(arena *a, size_t size) {
    block *b = malloc(sizeof *b + size);
    if (!b)
        return NULL;
    b->next = a->blocks;
    a->blocks = b;
    return b->bytes;
}

void *arena_allocate(arena *a, size_t size) {
    const size_t unit = _Alignof(max_align_t);
    /* No object is larger, and the sums below cannot overflow. */
    if (size > PTRDIFF_MAX - sizeof(block) - unit)
        return NULL;
    /* At least one unit, so that each piece has its own address. */
    size = size ? (size + unit - 1) / unit * unit : unit;
    if (size > a->left) {
        if (size > a->capacity / 4)
            return add_block(a, size);
        char *fresh = add_block(a, a->capacity);
        if (!fresh)
            return NULL;
        a->free = fresh;
        a->left = a->capacity;
        if (a->capacity < BLOCK_LARGEST)
            a->capacity *= 2;
    }
    void *piece = a->free;
    a->free += size;
    a->left -= size;
    return piece;
}

char *arena_copy_text(arena *a, const char *text, size_t length) {
    if (length == SIZE_MAX)
        return NULL;
    char *copy = arena_allocate(a, length + 1);
    if (!copy)
        return NULL;
    memcpy(copy, text, length);
    copy[length] = 0;
    return copy;
}
