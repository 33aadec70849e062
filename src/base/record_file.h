/* Binary records of a regular file: where they are is known beforehand, so that whoever works on them can read them. */
#ifndef BASE_RECORD_FILE_H
#define BASE_RECORD_FILE_H

#include <sys/types.h>

#include "base/records.h"

/* The whole records that a file has left: those from `at` up to `end`. Begins as {0}, with none. */
typedef struct record_file {
    off_t at, end;
} record_file;

/* Finds them, if the descriptor is that of a regular file. */
void record_file_find(record_file *, int descriptor, size_t record_size);
/* Sets a chunk to the next of them, up to `capacity`, and the file's position behind them. Gives false, and nothing any
 * more, where there are none, or where so few are wanted that it is not worth while. */
bool record_file_give(record_file *, int descriptor, record_chunk *, size_t capacity);
/* Reads what a chunk was set to and has not read yet. */
void record_file_load(record_chunk *);

#endif
