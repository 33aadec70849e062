/* An arena: many small pieces of memory that live and die together. */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stddef.h>

typedef struct arena arena;

arena *arena_create(void);                /* null when out of memory */
void arena_destroy(arena *);              /* frees all pieces; null is let pass */
void arena_absorb(arena *, arena *other); /* moves all pieces of `other`, which is no more, into the first */
/* `size` bytes, aligned for any type, not cleared; null when out of memory. */
void *arena_allocate(arena *, size_t size);
/* A copy of `length` bytes of text, with a terminating zero behind it. */
char *arena_copy_text(arena *, const char *text, size_t length);

#endif
