/* What all that fills or converts chunks of records shares: a chunk's memory, and its error. */
#ifndef BASE_RECORD_CHUNK_H
#define BASE_RECORD_CHUNK_H

#include "base/records.h"

/* So many bytes stand before a chunk's, the last of them a blank: what scans them may look back. */
enum { RECORD_FRONT = 64 };

/* Memory for RECORD_FRONT bytes, `room` bytes behind them, and one more; null if there is none. To be freed. */
char *record_memory(size_t room);
/* Where a chunk's own memory has `room` bytes behind RECORD_FRONT, whatever they are now. If there is none that is the
 * chunk's error, and null. */
char *record_chunk_reserve(record_chunk *, size_t room);

/* Of a number in a binary format; 0 of ASCII. */
size_t record_number_size(record_format);

/* Notes an error without a place. */
void record_note(record_error *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds the place behind `column` bytes of a line. */
void record_note_place(record_error *, int line, size_t column);
/* Notes what ends a stream in this record, numbered from 1: that reading failed, or, where `error` is 0, that there are
 * but some of its bytes. */
void record_note_end(record_error *, uint64_t record, int error, size_t bytes, size_t record_size);

#endif
