/* The words of ASCII records, and where they stand. */
#ifndef BASE_RECORD_CONVERT_H
#define BASE_RECORD_CONVERT_H

#include "base/records.h"

/* Moves a place on from one byte to another, with so many ends of lines between them; bytes before `from` belong to the
 * same stream. */
void record_advance(int *line, size_t *column, const char *from, const char *to, size_t lines);

/* Converts up to `count` words from *at on, which moves behind them; `limit` stands behind a blank. Gives how many are
 * finite numbers; *at is the word that is none. */
size_t record_scan_words(const char **at, const char *limit, double *values, size_t count);
/* Cuts a chunk down to its first `count` records, because this word of the next is no finite number. */
void record_set_word_error(record_chunk *, size_t count, const char *word, const char *limit);

#endif
