/* Memory for much at a time, or for large arrays that are read here and there. */
#ifndef BASE_LARGE_MEMORY_H
#define BASE_LARGE_MEMORY_H

#include <stddef.h>

/* Zeroed memory for `count` objects of this size, aligned to cache lines; null if there is none. To be freed by free().
 * Where it is large it lies in large pages, if the system has such for those that ask: where a scene is larger than
 * what the processor knows the pages of, each look into it else costs a search for its page, too. */
void *large_memory(size_t count, size_t size);

/* So many bytes of the same, not zeroed: for what is written once, too, a large page is one fault in place of 512. */
void *large_memory_unset(size_t bytes);

#endif
