/* Numbers of ASCII records, many at a time. */
#ifndef BASE_RECORD_WORDS_H
#define BASE_RECORD_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether this processor can. */
bool record_words_available(void);

/* As record_scan_words, with 16 bytes before *at that can be read. */
size_t record_words_scan(const char **at, const char *limit, double *values, size_t count);

#endif
