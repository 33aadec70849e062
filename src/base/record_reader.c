/* Input records from ASCII and binary streams: reading, and where whole records end. */
#include <errno.h>
#include <poll.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/pipe.h"
#include "base/record_chunk.h"
#include "base/record_convert.h"
#include "base/record_file.h"
#include "base/record_scan.h"
#include "base/text.h"

/* There is room for ROOM bytes that have not been given yet, or for a whole record if that is more: little enough for
 * all that they go through to lie in a processor's nearer caches. */
enum { ROOM = 1 << 17, READ_AT_LEAST = 1 << 16, BYTES_A_FIELD = 64 };

/* A record is known to be whole when the blank behind its last word is there. At the proper end of the input one is put
 * there. */
struct record_reader {
    int descriptor;
    char *name;
    record_format format;
    size_t fields;
    size_t record_size; /* 0: of ASCII */
    record_file file;   /* what need not be read here */
    const graze_report *report;
    int cancel[2]; /* a pipe; a byte in it ends a wait */

    char *memory; /* as a chunk's: what is read goes behind the first RECORD_FRONT bytes */
    size_t room;
    size_t begin, end; /* of what is unread in memory */
    size_t scanned;    /* ASCII: from `begin` on, with so many ends of words and lines */
    size_t words, lines;
    bool ended; /* the descriptor has no more, or failed with `error` */
    int error;
    bool finished; /* nothing more is given */

    uint64_t record; /* number of the one at `begin`, from 0 */
    int line;        /* of `begin`, for ASCII */
    size_t column;   /* bytes of this line before `begin` */
};

graze_status record_reader_open(record_reader **reader, int descriptor, const char *name, record_format format,
                                int fields, const graze_report *report) {
    *reader = NULL;
    record_reader *r = malloc(sizeof *r);
    if (!r)
        return report_out_of_memory(report);
    *r = (record_reader){.descriptor = descriptor,
                         .format = format,
                         .fields = (size_t)fields,
                         .record_size = (size_t)fields * record_number_size(format),
                         .report = report,
                         .cancel = {-1, -1},
                         .room = ROOM,
                         .begin = RECORD_FRONT,
                         .end = RECORD_FRONT,
                         .scanned = RECORD_FRONT,
                         .line = 1};
    size_t needed = r->record_size ? r->record_size : r->fields * BYTES_A_FIELD;
    if (r->room < needed)
        r->room = needed;
    r->name = strdup(name);
    r->memory = record_memory(r->room);
    graze_status status = GRAZE_OK;
    if (!r->name || !r->memory)
        status = report_out_of_memory(report);
    else if (pipe_open(r->cancel) != 0)
        status = report_system_error(report, &(place){.file = name}, "cannot read");
    if (status == GRAZE_OK && r->record_size)
        record_file_find(&r->file, descriptor, r->record_size);
    if (status)
        record_reader_close(r);
    else
        *reader = r;
    return status;
}

void record_reader_close(record_reader *r) {
    if (!r)
        return;
    for (int i = 0; i < 2; i++)
        if (r->cancel[i] >= 0)
            close(r->cancel[i]);
    free(r->memory);
    free(r->name);
    free(r);
}

void record_reader_cancel(record_reader *r) {
    while (write(r->cancel[1], "", 1) < 0 && errno == EINTR)
        ;
}

/* --- Reading ----------------------------------------------------------------------------------------------------- */

/* Whether a read would return at once; if not, waits until it would, or until it need not be done any more. */
static bool is_readable(record_reader *r, bool wait) {
    struct pollfd both[2] = {{.fd = r->descriptor, .events = POLLIN}, {.fd = r->cancel[0], .events = POLLIN}};
    int ready = 0;
    do
        ready = poll(both, 2, wait ? -1 : 0);
    while (ready < 0 && errno == EINTR);
    if (ready > 0 && both[1].revents)
        r->finished = true;
    return ready < 0 || both[0].revents;
}

/* Moves what is unread to the front, and gives how much can be read behind it. */
static size_t make_room(record_reader *r) {
    size_t unread = r->end - r->begin, moved = r->begin - RECORD_FRONT;
    if (moved > 0) {
        memmove(r->memory + RECORD_FRONT, r->memory + r->begin, unread);
        r->begin -= moved;
        r->end -= moved;
        r->scanned -= moved;
    }
    return r->room - unread;
}

/* Reads up to `most` bytes behind what there is, or finds that the input has ended. */
static void fill(record_reader *r, size_t most) {
    ssize_t got = read(r->descriptor, r->memory + r->end, most);
    if (got > 0) {
        r->end += (size_t)got;
    } else if (got == 0 || (errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)) {
        r->ended = true;
        r->error = got == 0 ? 0 : errno;
        if (!r->record_size && !r->error) /* a word that an error cuts off is not whole */
            r->memory[r->end++] = ' ';
    }
}

/* --- Whole records ----------------------------------------------------------------------------------------------- */

/* Takes no more words than `most`: there are at most half as many ends of words as bytes, and one more. */
static void scan_words(record_reader *r, size_t most) {
    while (r->words < most && r->scanned < r->end) {
        size_t length = r->end - r->scanned, safe = 2 * (most - r->words) - 1;
        if (length > safe)
            length = safe;
        record_count_ends(r->memory + r->scanned, length, &r->words, &r->lines);
        r->scanned += length;
    }
}

/* The first word behind the last whole record of those that have been scanned. */
static size_t find_cut(const record_reader *r) {
    const char *begin = r->memory + r->begin, *p = r->memory + r->scanned;
    while (p > begin && !text_is_blank(p[-1]))
        p--;
    for (size_t words = r->words % r->fields; words > 0; words--) {
        while (text_is_blank(p[-1]))
            p--;
        while (p > begin && !text_is_blank(p[-1]))
            p--;
    }
    return (size_t)(p - r->memory);
}

/* How many whole records there are, of up to `capacity`. */
static size_t count_records(record_reader *r, size_t capacity) {
    if (!r->record_size) {
        scan_words(r, capacity * r->fields);
        return r->words / r->fields;
    }
    size_t whole = (r->end - r->begin) / r->record_size;
    return whole < capacity ? whole : capacity;
}

/* The bytes of records before `cut` and those behind it lie in one piece of memory: the chunk gets it, or a copy of
 * its share, whichever moves fewer bytes. */
static bool hand_over(record_reader *r, record_chunk *c, size_t cut) {
    size_t taken = cut - r->begin, left = r->end - cut;
    bool exchange = left < taken;
    char *room = record_chunk_reserve(c, exchange ? r->room : taken);
    if (!room)
        return false;
    if (exchange) {
        char *memory = r->memory;
        memcpy(room, memory + cut, left);
        r->memory = c->memory;
        c->memory = memory;
        c->bytes = memory + r->begin;
        r->scanned = r->scanned - cut + RECORD_FRONT;
        r->begin = RECORD_FRONT;
        r->end = RECORD_FRONT + left;
    } else {
        memcpy(room, r->memory + r->begin, taken);
        c->bytes = room;
        r->begin = cut;
    }
    c->length = taken;
    return true;
}

/* Moves the place, and what has been counted, on to `cut`. */
static void advance_to(record_reader *r, size_t cut) {
    size_t lines = r->lines;
    r->words = r->lines = 0;
    record_count_ends(r->memory + cut, r->scanned - cut, &r->words, &r->lines);
    record_advance(&r->line, &r->column, r->memory + r->begin, r->memory + cut, lines - r->lines);
}

static void give(record_reader *r, record_chunk *c, size_t count) {
    size_t cut = r->record_size ? r->begin + count * r->record_size : find_cut(r);
    if (!r->record_size)
        advance_to(r, cut);
    if (!hand_over(r, c, cut)) {
        r->finished = true;
        return;
    }
    c->count = count;
    r->record += count;
}

/* --- What is wrong where there is no whole record ---------------------------------------------------------------- */

/* Notes the first of an incomplete record's words that is no number, if there is one. */
static void set_words_error(record_reader *r, record_chunk *c) {
    const char *at = r->memory + r->begin, *limit = r->memory + r->end;
    double value;
    c->bytes = at;
    for (size_t i = 0; i < r->words; i++)
        if (record_scan_words(&at, limit, &value, 1) == 0) {
            record_set_word_error(c, 0, at, limit);
            break;
        }
    c->bytes = NULL;
}

static void set_cut_short(record_reader *r, record_chunk *c) {
    if (r->record_size) {
        if (r->end > r->begin)
            record_note_end(&c->error, r->record + 1, 0, r->end - r->begin, r->record_size);
        return;
    }
    if (r->words == 0)
        return;
    record_note(&c->error, "record %llu is cut short: %zu of %zu numbers", (unsigned long long)r->record + 1, r->words,
                r->fields);
    /* The input ends before the blank that was put there. */
    advance_to(r, r->end - 1);
    record_note_place(&c->error, r->line, r->column);
}

/* Notes what is wrong; at the input's proper end nothing is. */
static void stop(record_reader *r, record_chunk *c) {
    r->finished = true;
    set_words_error(r, c);
    if (c->error.status)
        return;
    if (!r->ended) {
        record_note(&c->error, "record %llu is longer than %zu bytes", (unsigned long long)r->record + 1, r->room);
        record_note_place(&c->error, r->line, r->column);
    } else if (r->error) {
        record_note_end(&c->error, r->record + 1, r->error, 0, r->record_size);
    } else {
        set_cut_short(r, c);
    }
}

/* Blanks before a record do not count in its length. */
static void skip_blanks(record_reader *r) {
    size_t begin = r->begin;
    while (begin < r->scanned && text_is_blank(r->memory[begin]))
        begin++;
    if (begin == r->begin)
        return;
    advance_to(r, begin);
    r->begin = begin;
}

/* How much to read at most, to get on to `capacity` records without much behind them; 0: there is no room. */
static size_t plan_read(record_reader *r, size_t capacity) {
    size_t room = make_room(r);
    if (room == 0 && !r->record_size) {
        skip_blanks(r);
        room = make_room(r);
    }
    size_t records = r->room / (r->record_size ? r->record_size : 1);
    if (!r->record_size || capacity >= records || capacity * r->record_size < READ_AT_LEAST)
        return room;
    size_t needed = capacity * r->record_size - (r->end - r->begin);
    return needed < room ? needed : room;
}

/* The next records of a regular file, if there are such, with nothing read but whether to go on. */
static bool give_unread(record_reader *r, record_chunk *c, size_t capacity) {
    if (r->file.at == r->file.end)
        return false;
    is_readable(r, false);
    if (r->finished || !record_file_give(&r->file, r->descriptor, c, capacity))
        return false;
    r->record += c->count;
    return true;
}

bool record_read(record_reader *r, record_chunk *c, size_t capacity) {
    c->first = r->record;
    c->count = c->length = 0;
    c->unread = false;
    c->error.status = GRAZE_OK;
    c->format = r->format;
    c->fields = r->fields;
    if (!r->finished && give_unread(r, c, capacity))
        return true;
    size_t count = 0;
    while (!r->finished) {
        count = count_records(r, capacity);
        if (count == capacity || r->ended)
            break;
        size_t most = plan_read(r, capacity);
        if (most == 0 || (count > 0 && !is_readable(r, false)))
            break;
        if (count > 0 || is_readable(r, true))
            fill(r, most);
    }
    if (r->finished)
        return false;
    c->line = r->line;
    c->column = r->column;
    if (count > 0)
        give(r, c, count);
    else
        stop(r, c);
    return c->count > 0 || c->error.status;
}

graze_status record_report_error(const record_reader *r, const record_chunk *c) {
    const record_error *e = &c->error;
    const place where = {.file = r->name, .line = e->line, .column = e->column};
    if (!e->status)
        return GRAZE_OK;
    if (e->status != GRAZE_SYSTEM_ERROR)
        return report_error(r->report, &where, "%s", e->text);
    if (e->error_number == ENOMEM)
        return report_out_of_memory(r->report);
    errno = e->error_number;
    return report_file_error(r->report, &where, "%s", e->text);
}
