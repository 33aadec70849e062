/* Large pages, by advice to the system: Linux has them, POSIX does not. */
#define _DEFAULT_SOURCE
#include "base/large_memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* Of x86-64 and most others; larger ones are then not used. */
#define LARGE_PAGE ((size_t)1 << 21)
#define CACHE_LINE ((size_t)64)

void *large_memory_unset(size_t bytes) {
    if (bytes > PTRDIFF_MAX - LARGE_PAGE)
        return NULL;
    size_t unit = bytes >= LARGE_PAGE ? LARGE_PAGE : CACHE_LINE;
    bytes = bytes > 0 ? (bytes + unit - 1) / unit * unit : unit;
    void *memory = aligned_alloc(unit, bytes);
    if (!memory)
        return NULL;
#ifdef MADV_HUGEPAGE
    if (unit == LARGE_PAGE)
        (void)madvise(memory, bytes, MADV_HUGEPAGE); /* only advice: nothing is lost where it is not taken */
#endif
    return memory;
}

void *large_memory(size_t count, size_t size) {
    if (size > 0 && count > PTRDIFF_MAX / size)
        return NULL;
    void *memory = large_memory_unset(count * size);
    return memory ? memset(memory, 0, count * size) : NULL;
}
