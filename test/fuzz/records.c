/* Fuzz target: brdfeval's reader of records, against a reference that has the whole input before it. The reader gets
 * the input in pieces of any size, with interruptions between, and perhaps an error at its end: this program stands in
 * for read() and poll() (the linker's --wrap), so that a run is the same every time.
 *
 * The first five bytes say how, the rest is the input:
 *   0: format a, f, d    1: fields 1 .. 9    2: records asked for at once, and whether it all lies in a file
 *   3: how the input comes    4: repeated? */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/records.h"
#include "base/text.h"
#include "fuzz/number_text.h"
#include "fuzz/target.h"

/* --- The input and how it comes ---------------------------------------------------------------------------------- */

static struct {
    int descriptor;
    const char *bytes;
    size_t size, at;
    size_t piece; /* the most that a read gives */
    uint64_t random;
    bool fails, ended;
} source = {.descriptor = -1};

ssize_t __real_read(int descriptor, void *bytes, size_t size);
int __real_poll(struct pollfd *descriptors, nfds_t count, int timeout);
ssize_t __wrap_read(int descriptor, void *bytes, size_t size);
int __wrap_poll(struct pollfd *descriptors, nfds_t count, int timeout);

static size_t draw(size_t limit) {
    source.random = source.random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (size_t)(source.random >> 33) % limit;
}

ssize_t __wrap_read(int descriptor, void *bytes, size_t size) {
    if (descriptor != source.descriptor)
        return __real_read(descriptor, bytes, size);
    MUST(size > 0 && !source.ended);
    if (draw(8) == 0) {
        errno = draw(2) ? EINTR : EAGAIN;
        return -1;
    }
    size_t length = 1 + draw(source.piece), left = source.size - source.at;
    length = length < size ? length : size;
    length = length < left ? length : left;
    source.ended = length == 0;
    if (source.ended && source.fails) {
        errno = EIO;
        return -1;
    }
    /* Nobody reads what was not written. */
    memset(bytes, '7', size < length + 64 ? size : length + 64);
    memcpy(bytes, source.bytes + source.at, length);
    source.at += length;
    return (ssize_t)length;
}

/* What would be waited for is there; what is only asked for is there sometimes. */
int __wrap_poll(struct pollfd *descriptors, nfds_t count, int timeout) {
    if (count < 1 || descriptors[0].fd != source.descriptor)
        return __real_poll(descriptors, count, timeout);
    for (nfds_t i = 0; i < count; i++)
        descriptors[i].revents = 0;
    if (draw(8) == 0) {
        errno = EINTR;
        return -1;
    }
    if (timeout >= 0 && draw(2))
        return 0;
    descriptors[0].revents = POLLIN;
    return 1;
}

/* --- What must come of it ---------------------------------------------------------------------------------------- */

typedef struct question {
    record_format format;
    size_t fields, capacity;
    const char *bytes;
    size_t size;
    bool fails;
} question;

/* The reference goes through the input number by number. */
typedef struct reference {
    const question *q;
    size_t at;      /* of the next number */
    size_t numbers; /* before it */
    size_t begin;   /* of the record at hand */
} reference;

typedef enum verdict { GOOD, BAD, ENDED } verdict;

static verdict next_word(reference *r, double *value) {
    const question *q = r->q;
    while (r->at < q->size && text_is_blank(q->bytes[r->at]))
        r->at++;
    if (r->numbers % q->fields == 0)
        r->begin = r->at;
    size_t length = 0;
    while (r->at + length < q->size && !text_is_blank(q->bytes[r->at + length]))
        length++;
    if (length == 0)
        return ENDED;
    const char *word = q->bytes + r->at;
    char *copy = malloc(length + 1);
    MUST(copy);
    memcpy(copy, word, length);
    copy[length] = 0;
    *value = strtod(copy, NULL);
    free(copy);
    if (number_text_length(word, length) != length || !isfinite(*value))
        return BAD;
    r->at += length;
    return GOOD;
}

static verdict next_binary(reference *r, double *value) {
    const question *q = r->q;
    size_t size = q->format == RECORD_FLOAT ? sizeof(float) : sizeof(double);
    /* Numbers of a record that is cut short are not looked at. */
    if (r->numbers % q->fields == 0) {
        r->begin = r->at;
        if (q->size - r->at < size * q->fields)
            return ENDED;
    }
    float single;
    if (q->format == RECORD_FLOAT) {
        memcpy(&single, q->bytes + r->at, size);
        *value = (double)single;
    } else {
        memcpy(value, q->bytes + r->at, size);
    }
    if (!isfinite(*value))
        return BAD;
    r->at += size;
    return GOOD;
}

static verdict next_number(reference *r, double *value) {
    verdict v = r->q->format == RECORD_ASCII ? next_word(r, value) : next_binary(r, value);
    r->numbers += v == GOOD;
    return v;
}

static void check_place(const reference *r, const record_error *e) {
    int line = 1, column = 1;
    for (size_t i = 0; i < r->at; i++) {
        column++;
        if (r->q->bytes[i] == '\n') {
            line++;
            column = 1;
        }
    }
    MUST(e->line == line && e->column == column);
}

static void check_text(const reference *r, const record_error *e, const char *what) {
    char begin[64];
    snprintf(begin, sizeof begin, "record %zu", r->numbers / r->q->fields + 1);
    size_t length = strlen(begin);
    MUST(strncmp(e->text, begin, length) == 0 && (e->text[length] == ':' || e->text[length] == ' '));
    MUST(strstr(e->text, what));
    for (const char *p = e->text; *p; p++)
        MUST((unsigned char)*p >= ' ');
}

/* Up to 128 KiB no record is too long. */
static void check_too_long(reference r, const record_error *e) {
    double value;
    check_text(&r, e, "is longer than");
    size_t wanted = r.numbers + r.q->fields;
    verdict v = next_number(&r, &value);
    size_t begin = r.begin;
    while (v == GOOD && r.numbers < wanted)
        v = next_number(&r, &value);
    MUST((v == GOOD ? r.at : r.q->size) - begin >= 1 << 17);
}

/* Where records end, what is wrong there must be said, or nothing. */
static void check_end(reference r, const record_error *e) {
    const question *q = r.q;
    if (q->format == RECORD_ASCII && strstr(e->text, "is longer than") && e->status == GRAZE_INPUT_ERROR) {
        check_too_long(r, e);
        return;
    }
    double value;
    verdict v;
    size_t given = r.numbers;
    while ((v = next_number(&r, &value)) == GOOD)
        MUST(r.numbers < given + q->fields); /* no whole record is left out */
    bool left = q->format == RECORD_ASCII ? r.numbers % q->fields > 0 : r.begin < q->size;
    graze_status expected = v == BAD || (left && !q->fails) ? GRAZE_INPUT_ERROR
                            : q->fails                      ? GRAZE_SYSTEM_ERROR
                                                            : GRAZE_OK;
    MUST(e->status == expected);
    if (expected == GRAZE_SYSTEM_ERROR) {
        MUST(e->error_number == EIO);
        check_text(&r, e, ": cannot read");
    }
    if (expected != GRAZE_INPUT_ERROR)
        return;
    if (q->format == RECORD_ASCII) {
        r.at = v == BAD ? r.at : q->size;
        check_place(&r, e);
    }
    check_text(&r, e, v == ENDED ? "is cut short" : q->format == RECORD_ASCII ? "number" : "is not finite");
}

/* A chunk's numbers against those of the reference, in both of the ways to get at them. */
static void check_numbers(reference *r, record_chunk *c, double *room) {
    if (c->count == 0)
        return;
    const float *floats = c->format == RECORD_FLOAT ? record_floats(c) : NULL;
    const double *doubles = record_doubles(c, room);
    for (size_t i = 0; i < c->count * c->fields; i++) {
        double value;
        MUST(next_number(r, &value) == GOOD);
        MUST(number_text_same_bits(doubles[i], value));
        MUST(!floats || number_text_same_bits((double)floats[i], value));
    }
}

static void read_all(const question *q, int descriptor, const graze_report *report) {
    reference r = {.q = q};
    record_reader *reader;
    record_chunk chunk = {0};
    double *room = malloc(q->capacity * q->fields * sizeof *room);
    MUST(room);
    MUST(record_reader_open(&reader, descriptor, "in", q->format, (int)q->fields, report) == GRAZE_OK);
    bool more;
    do {
        size_t given = r.numbers / q->fields;
        more = record_read(reader, &chunk, q->capacity);
        MUST(chunk.first == given && chunk.count <= q->capacity);
        MUST(more == (chunk.count > 0 || chunk.error.status != GRAZE_OK));
        check_numbers(&r, &chunk, room);
    } while (more && !chunk.error.status);
    check_end(r, &chunk.error);
    MUST(record_report_error(reader, &chunk) == chunk.error.status);
    record_chunk_free(&chunk);
    record_reader_close(reader);
    free(room);
}

/* --- Taking the input apart -------------------------------------------------------------------------------------- */

static void check_message(void *user, graze_severity severity, const char *text) {
    (void)user;
    MUST(severity == GRAZE_ERROR && strncmp(text, "in:", 3) == 0);
}

/* A file that holds the input and nothing else; it stays open from one input to the next. */
static int fill_file(const char *bytes, size_t size) {
    static FILE *file;
    if (!file)
        file = tmpfile();
    MUST(file);
    int descriptor = fileno(file);
    MUST(ftruncate(descriptor, 0) == 0 && lseek(descriptor, 0, SEEK_SET) == 0);
    MUST(pwrite(descriptor, bytes, size, 0) == (ssize_t)size);
    return descriptor;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char formats[] = {RECORD_ASCII, RECORD_FLOAT, RECORD_DOUBLE};
    static const size_t capacities[] = {1, 2, 3, 7, 64, 4096}, pieces[] = {1, 3, 17, 200, 5000, 100000};
    enum { HEAD = 5, LONGEST = 400000 };
    if (size < HEAD)
        return 0;
    size_t payload = size - HEAD, repeat = data[4] >= 240 ? (data[4] - 239u) * 16u : 1;
    while (repeat > 1 && repeat * payload > LONGEST)
        repeat--;
    bool in_file = data[2] & 0x80, fails = !in_file && data[3] & 0x80;
    char *bytes = malloc(repeat * payload + 1);
    MUST(bytes);
    for (size_t i = 0; i < repeat; i++)
        memcpy(bytes + i * payload, data + HEAD, payload);
    size_t length = repeat * payload;
    /* Where an error cuts a word, nobody knows what was to follow. */
    if (fails)
        bytes[length++] = '\n';
    const question q = {.format = (record_format)formats[data[0] % 3],
                        .fields = 1 + data[1] % 9,
                        .capacity = capacities[(data[2] & 0x7f) % 6],
                        .bytes = bytes,
                        .size = length,
                        .fails = fails};
    int descriptor = source.descriptor >= 0 ? source.descriptor : open("/dev/null", O_RDONLY);
    MUST(descriptor >= 0);
    memset(&source, 0, sizeof source);
    source.descriptor = descriptor;
    source.bytes = bytes;
    source.size = length;
    source.piece = pieces[data[3] % 6];
    source.random = data[3];
    source.fails = fails;
    const graze_report report = {check_message, NULL};
    read_all(&q, in_file ? fill_file(bytes, length) : source.descriptor, &report);
    free(bytes);
    return 0;
}
