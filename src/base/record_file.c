/* Binary records of a regular file, read a chunk at a time by as many threads as like. */
#define _XOPEN_SOURCE 700 /* S_ISREG */
#include "base/record_file.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/record_chunk.h"

/* For less than this it is better to read ahead, once for several chunks. */
enum { BYTES_AT_LEAST = 4096 };

void record_file_find(record_file *f, int descriptor, size_t record_size) {
    struct stat file;
    off_t at = lseek(descriptor, 0, SEEK_CUR);
    *f = (record_file){0};
    if (at < 0 || fstat(descriptor, &file) != 0 || !S_ISREG(file.st_mode) || file.st_size <= at)
        return;
    f->at = at;
    f->end = file.st_size - (file.st_size - at) % (off_t)record_size;
}

/* The position moves as if read() had been called: it shows how far the work has come, and what the file may have got
 * behind `end` is read from there on. */
bool record_file_give(record_file *f, int descriptor, record_chunk *c, size_t capacity) {
    size_t record_size = c->fields * record_number_size(c->format);
    size_t left = (size_t)((f->end - f->at) / (off_t)record_size), count = left < capacity ? left : capacity;
    off_t length = (off_t)(count * record_size);
    if (count == 0 || capacity < BYTES_AT_LEAST / record_size || lseek(descriptor, f->at + length, SEEK_SET) < 0) {
        f->end = f->at;
        return false;
    }
    c->count = count;
    c->length = (size_t)length;
    c->unread = true;
    c->descriptor = descriptor;
    c->offset = f->at;
    f->at += length;
    return true;
}

/* Gives how many bytes there were: fewer than wanted if reading failed, with errno, or the file has become shorter. */
static size_t read_all(const record_chunk *c, char *bytes, int *error) {
    size_t done = 0;
    ssize_t got = 1;
    *error = 0;
    while (done < c->length && got != 0) {
        got = pread(c->descriptor, bytes + done, c->length - done, c->offset + (off_t)done);
        if (got > 0)
            done += (size_t)got;
        else if (got < 0 && errno != EINTR) {
            *error = errno;
            break;
        }
    }
    return done;
}

void record_file_load(record_chunk *c) {
    if (!c->unread)
        return;
    c->unread = false;
    char *bytes = record_chunk_reserve(c, c->length);
    if (!bytes) {
        c->count = 0;
        return;
    }
    c->bytes = bytes;
    int error;
    size_t record_size = c->length / c->count, got = read_all(c, bytes, &error);
    if (got == c->length)
        return;
    c->count = got / record_size;
    record_note_end(&c->error, c->first + c->count + 1, error, got % record_size, record_size);
}
