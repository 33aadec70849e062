/* Streams of records: fixed numbers of reals in a row, as ASCII, float or double, in and out. */
#ifndef BASE_RECORDS_H
#define BASE_RECORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/report.h"

typedef enum record_format { RECORD_ASCII = 'a', RECORD_FLOAT = 'f', RECORD_DOUBLE = 'd' } record_format;

typedef struct record_reader record_reader;

/* Reads records of `fields` (at least 1) reals from the file descriptor. `name` stands in messages ("standard input").
 */
graze_status record_reader_open(record_reader **, int descriptor, const char *name, record_format, int fields,
                                const graze_report *);
void record_reader_close(record_reader *); /* leaves the descriptor open; null is let pass */

/* Reads up to `capacity` records into `values` (capacity * fields doubles). Blocks for the first; then gives what is at
 * hand without blocking again, so that an interactive client is answered. *count = 0: the input has ended.
 * An ASCII word that is no number, a record cut short, a number that is not finite, or a failing read: the records
 * before it are given with GRAZE_OK first; the next call reports the trouble with the record's number (from 1) and, for
 * ASCII, its line and column, and returns the error, as do all later calls, without a text. */
graze_status record_read(record_reader *, double *values, size_t capacity, size_t *count);

/* A growing buffer of output bytes, filled by one worker and written in order by one writer. */
typedef struct record_buffer {
    char *bytes;
    size_t length, capacity;
    bool failed; /* out of memory: later appends are dropped */
} record_buffer;
void record_buffer_free(record_buffer *);
void record_append_bytes(record_buffer *, const void *bytes, size_t length);
void record_append_text(record_buffer *, const char *text);
/* Appends finite reals: in binary formats in the machine's byte order (doubles out of float's range become +-FLT_MAX:
 * no infinity leaves), in ASCII each with `digits` significant digits (17: a double survives a round trip; 0:
 * Radiance's
 * `%e`), each followed by a tab. */
void record_append_reals(record_buffer *, record_format, int digits, const double *values, size_t count);
/* Writes all bytes to the descriptor and empties the buffer. EPIPE, ENOSPC and the like are system errors, as is a
 * buffer that has failed. */
graze_status record_buffer_write(record_buffer *, int descriptor, const char *name, const graze_report *);

#endif
