/* A filter: records in, an answer for each out, in order, on several threads. */
#ifndef TOOLS_RECORD_FILTER_H
#define TOOLS_RECORD_FILTER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/records.h"

typedef struct record_filter {
    record_reader *reader;
    int fields;        /* of a record */
    int chunk_records; /* that go through together: enough to make a thread's turn worthwhile, few enough to share out
                          evenly */
    int threads;
    uint64_t wanted; /* stop after so many records, and it is an error if there are fewer; 0: all there are */
    void *user;
    /* May be null. Says what is wrong with a record that cannot be answered, and returns false. */
    bool (*check)(const void *user, const double *record, char *trouble, size_t trouble_size);
    /* Appends the answer to record `number`, counted from 0. Called from several threads. */
    void (*answer)(void *user, const double *record, uint64_t number, record_buffer *);
} record_filter;

/* Reads from the reader, writes to standard output. A record that is wrong ends the run with an error that names its
 * number, after all before it have been answered. *count is the number of records read. */
graze_status record_filter_run(const record_filter *, uint64_t *count, const graze_report *);

#endif
