/* What reading and converting records share. */
#ifndef BASE_RECORD_CONVERT_H
#define BASE_RECORD_CONVERT_H

#include "base/records.h"

/* Notes an error without a place. */
void record_note(record_error *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds the place behind `column` bytes of a line. */
void record_note_place(record_error *, int line, size_t column);
/* Moves a place on from one byte to another; bytes before `from` belong to the same stream. */
void record_advance(int *line, size_t *column, const char *from, const char *to);

/* Converts up to `count` words from *at on, which moves behind them; `limit` stands behind a blank. Gives how many are
 * finite numbers; *at is the word that is none. */
size_t record_scan_words(const char **at, const char *limit, double *values, size_t count);
/* Cuts a chunk down to its first `count` records, because this word of the next is no finite number. */
void record_set_word_error(record_chunk *, size_t count, const char *word, const char *limit);

#endif
