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

/* Notes what ends a stream in this record, numbered from 1: that reading failed, or, where `error` is 0, that there are
 * but some of its bytes. */
void record_note_end(record_error *, uint64_t record, int error, size_t bytes, size_t record_size);

/* Of a number in a binary format; 0 of ASCII. */
size_t record_number_size(record_format);
/* A chunk's memory, with room for so many bytes and whatever they are now. If there is none that is the chunk's error.
 */
char *record_chunk_reserve(record_chunk *, size_t room);

/* Converts up to `count` words from *at on, which moves behind them; `limit` stands behind a blank. Gives how many are
 * finite numbers; *at is the word that is none. */
size_t record_scan_words(const char **at, const char *limit, double *values, size_t count);
/* Cuts a chunk down to its first `count` records, because this word of the next is no finite number. */
void record_set_word_error(record_chunk *, size_t count, const char *word, const char *limit);

#endif
