/* A filter: records in, an answer for each out, in order, on several threads. */
#ifndef TOOLS_COMMON_RECORD_FILTER_H
#define TOOLS_COMMON_RECORD_FILTER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/records.h"

/* The numbers of a chunk's records, record after record: count x fields. */
typedef struct record_numbers {
    uint64_t first; /* number of the first record, from 0 */
    size_t count;
    const double *doubles; /* all finite; null where the filter wants floats */
    const float *floats;   /* as they came: it is for `answer` to find what is not finite */
} record_numbers;

typedef struct record_filter {
    record_reader *reader;
    int fields;        /* of a record */
    int chunk_records; /* enough to make a thread's turn worthwhile, few enough to share out evenly */
    bool uneven; /* records may take long, and some far longer than others: of `chunk_records` a thread's turn takes
                    only so many as are answered in a millisecond or so, and more turns are taken ahead */
    bool floats; /* wanted, not doubles; the reader's format has to be RECORD_FLOAT */
    int threads;
    uint64_t wanted; /* stop after so many records, and it is an error if there are fewer; 0: all there are */
    void *user;
    /* Appends the answers to the records of a chunk, in order; `worker` in [0, threads). Where a record cannot be
     * answered it gives how many were, and writes what is wrong with the next one, without its number, into `message`
     * (of RECORD_MESSAGE_SIZE). */
    size_t (*answer)(void *user, const record_numbers *, int worker, record_buffer *, char *message);
} record_filter;

/* Reads from the reader, writes to standard output. A record that is wrong ends the run with an error that names its
 * number, after all before it have been answered. *count is the number of records answered. */
graze_status record_filter_run(const record_filter *, uint64_t *count, const graze_report *);

#endif
