/* Streams of records: fixed numbers of reals in a row, as ASCII, float or double, in and out. */
#ifndef BASE_RECORDS_H
#define BASE_RECORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include "base/report.h"

typedef enum record_format { RECORD_ASCII = 'a', RECORD_FLOAT = 'f', RECORD_DOUBLE = 'd' } record_format;

/* What ends a stream before its proper end. */
enum { RECORD_MESSAGE_SIZE = 256 };
typedef struct record_error {
    graze_status status; /* GRAZE_OK: there is none */
    int error_number;    /* the errno that goes with GRAZE_SYSTEM_ERROR */
    int line, column;    /* 0: not known */
    char text[RECORD_MESSAGE_SIZE];
} record_error;

/* A chunk: some whole records as they came, before anyone has looked at their numbers: reading is the one step that
 * cannot be shared out among threads, so it does no more than find where records end. Where that is known beforehand,
 * for binary records of a regular file, they are not even read yet. Begins as {0}. */
typedef struct record_chunk {
    uint64_t first;     /* number of the first record, from 0 */
    size_t count;       /* of records */
    record_error error; /* with the record behind them */

    record_format format;
    size_t fields;
    const char *bytes; /* of the records, aligned for their numbers; ASCII ends with a blank */
    size_t length;
    int line; /* where the first byte stands, from 1; and how many of its line are before it */
    size_t column;
    char *memory;
    size_t capacity;

    bool unread; /* still to be read from here */
    int descriptor;
    off_t offset;
} record_chunk;
void record_chunk_free(record_chunk *);

typedef struct record_reader record_reader;

/* Reads records of `fields` (at least 1) reals from the file descriptor. `name` stands in messages ("standard input").
 * A record may span lines; in ASCII it may be 128 KiB long, or 64 bytes a field if that is more. */
graze_status record_reader_open(record_reader **, int descriptor, const char *name, record_format, int fields,
                                const graze_report *);
void record_reader_close(record_reader *); /* leaves the descriptor open; null is let pass */

/* Reads up to `capacity` (at least 1) records. Blocks for the first; then gives what is at hand without blocking again,
 * so that an interactive client is answered. A record cut short or a failing read is the error of the chunk that
 * ends there, which may hold no records. Gives false, and an empty chunk, when there is nothing more. Nothing is
 * reported: errors in earlier chunks may not be known yet. */
bool record_read(record_reader *, record_chunk *, size_t capacity);

/* Ends the input for a read that waits for it and for all later ones. The one call that may be made while another
 * thread is in record_read. */
void record_reader_cancel(record_reader *);

/* A chunk's numbers, record after record: where they are, or converted into `room` (for count * fields doubles).
 * Where a word is no number, a number is not finite, or a file's records cannot be read, the chunk is cut down to the
 * records before and the error noted. */
const double *record_doubles(record_chunk *, double *room);
/* A chunk's numbers where they are, for RECORD_FLOAT: they may not be finite. Errors in reading are noted as above. */
const float *record_floats(record_chunk *);
/* What is wrong with a record whose number `index`, from 0, is not finite, for record_set_error. */
void record_describe_not_finite(char message[RECORD_MESSAGE_SIZE], size_t index);

/* Cuts a chunk down to its first `count` records, and notes what is wrong with the next: "record N: TEXT". */
void record_set_error(record_chunk *, size_t count, const char *text);
/* Reports the error of a chunk, if there is one, and gives the status to hand on. */
graze_status record_report_error(const record_reader *, const record_chunk *);

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
 * Radiance's `%e`), each followed by a tab. */
void record_append_reals(record_buffer *, record_format, int digits, const double *values, size_t count);
/* Appends `count` records of `fields` finite reals: as above, in ASCII with a line's end behind each record. */
void record_append_records(record_buffer *, record_format, int digits, const double *values, size_t count, int fields);
/* Writes all bytes to the descriptor and empties the buffer. EPIPE, ENOSPC and the like are system errors, as is a
 * buffer that has failed. */
graze_status record_buffer_write(record_buffer *, int descriptor, const char *name, const graze_report *);

/* The machine's byte order, for headers of binary records. */
bool record_is_big_endian(void);

#endif
