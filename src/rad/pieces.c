/* Large texts read in pieces by several threads, to the same end as by one.
 *
 * Where a primitive begins cannot be told but by reading all before it. A piece begins where one seems to begin, and is
 * read for itself, up to where the next piece begins or something needs to be said or done. In the text's order then
 * follows what cannot be done at once: a piece's primitives are taken if reading does come to where it begins; what no
 * piece has read is read there and then. */
#include "rad/pieces.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"

enum { PIECE_BYTES = 1 << 18, LARGE_TEXT = 4 * PIECE_BYTES, LINES_TRIED = 16, ARGUMENTS_MOST = 1 << 14 };

bool rad_pieces_are_worth_it(const rad_source *s) {
    return s->reader->threads > 1 && s->words.end - s->words.next >= LARGE_TEXT;
}

/* A primitive with the place to be corrected: it counts lines from the piece's first. */
typedef struct found {
    rad_raw raw;
    place *where;
} found;

/* Each in cache lines of its own, for the thread that reads it. */
typedef struct piece {
    _Alignas(64) rad_source source;
    rad_context context;
    rad_reader reader;
    graze_report quiet;
    bool said_something;
    const char *begin, *end; /* where its first primitive begins, and the next piece's */
    found *primitives;
    size_t count, capacity;
} piece;

typedef struct division {
    rad_source *whole;
    const char *next; /* where the next piece begins; null: there is none */
    const char *line; /* where its line begins */
} division;

/* ---- Where pieces begin ---- */

static const char *skip_blanks(const char *p, const char *end) {
    while (p < end && (*p == ' ' || *p == '\t'))
        p++;
    return p;
}

static const char *skip_word(const char *p, const char *end) {
    while (p < end && (unsigned char)*p > ' ' && *p != '"' && *p != '\'')
        p++;
    return p;
}

/* A modifier and a type, without quotes. */
static bool seems_primitive(const char *line, const char *end, const char **begin) {
    *begin = skip_blanks(line, end);
    const char *modifier_end = skip_word(*begin, end), *type = skip_blanks(modifier_end, end);
    const char *type_end = skip_word(type, end);
    return modifier_end > *begin && **begin != '#' && **begin != '!' && type > modifier_end &&
           rad_type_find(type, (size_t)(type_end - type), &(rad_type){RAD_POLYGON});
}

/* Finds a place in the bytes behind `from` where a primitive seems to begin. */
static bool find_begin(division *d, const char *from) {
    const char *end = d->whole->words.end;
    for (int i = 0; i < LINES_TRIED; i++) {
        const char *newline = memchr(from, '\n', (size_t)(end - from < PIECE_BYTES ? end - from : PIECE_BYTES));
        if (!newline)
            return false;
        from = d->line = newline + 1;
        if (seems_primitive(from, end, &d->next))
            return true;
    }
    return false;
}

static graze_status begin_piece(void *user, void *chunk, bool *more) {
    division *d = user;
    piece *p = chunk;
    *more = d->next != NULL;
    if (!*more)
        return GRAZE_OK;
    const rad_words *text = &d->whole->words;
    rad_words_end(&p->source.words);
    rad_words_begin(&p->source.words, d->line, (size_t)(text->end - d->line));
    p->begin = d->next;
    p->count = 0;
    p->said_something = false;
    const char *from = d->next;
    do {
        if (text->end - from <= PIECE_BYTES) {
            d->next = NULL;
            break;
        }
        from += PIECE_BYTES;
    } while (!find_begin(d, from));
    p->end = d->next ? d->next : text->end;
    return GRAZE_OK;
}

/* ---- What can be done at once ---- */

static bool has_room(piece *p) {
    if (p->count < p->capacity)
        return true;
    size_t capacity = p->capacity ? 2 * p->capacity : 256;
    found *larger = realloc(p->primitives, capacity * sizeof *larger);
    if (!larger)
        return false;
    p->primitives = larger;
    p->capacity = capacity;
    return true;
}

static void read_piece(void *user, void *chunk, int worker) {
    (void)user;
    (void)worker;
    piece *p = chunk;
    rad_words *words = &p->source.words;
    for (;;) {
        int line, column;
        char first = rad_words_peek(words, &line, &column);
        if (words->next >= p->end || first == '!')
            return;
        if (first == '#') {
            rad_words_skip_line(words);
            continue;
        }
        rad_words before = *words;
        found *f = has_room(p) ? &p->primitives[p->count] : NULL;
        if (!f || rad_source_primitive(&p->source, line, column, &f->raw, &f->where) || p->said_something) {
            words->next = before.next;
            words->line = before.line;
            words->line_start = before.line_start;
            return;
        }
        p->count++;
    }
}

/* ---- What is done in order ---- */

/* Later lines have no numbers of their own (rad_words.line). */
static int add_lines(int line, int lines) {
    return line < INT_MAX - lines ? line + lines : INT_MAX;
}

static graze_status take_piece(void *user, void *chunk) {
    rad_source *whole = ((division *)user)->whole;
    piece *p = chunk;
    rad_words *words = &whole->words;
    graze_status status = rad_source_read(whole, p->begin);
    if (status || words->next != p->begin)
        return status;
    int lines = words->line - 1;
    for (size_t i = 0; i < p->count && !status; i++) {
        p->primitives[i].where->line = add_lines(p->primitives[i].where->line, lines);
        status = whole->sink->take(whole->sink->user, &p->primitives[i].raw);
    }
    whole->any = whole->any || p->count > 0;
    words->next = p->source.words.next;
    words->line_start = p->source.words.line_start;
    words->line = add_lines(p->source.words.line, lines);
    return status;
}

/* ---- All of it ---- */

static bool prepare_piece(piece *p, const rad_source *whole) {
    *p = (piece){.quiet = report_to_flag(&p->said_something), .context = *whole->context};
    arena *memory = arena_create();
    rad_reader_begin(&p->reader, memory, &p->quiet);
    /* What goes on for long would be read again and again where it is no primitive after all. */
    p->source = (rad_source){
        .reader = &p->reader, .name = whole->name, .context = &p->context, .arguments_most = ARGUMENTS_MOST};
    return memory != NULL;
}

/* What has been taken points into the pieces' memory. */
static void end_piece(piece *p, arena *memory) {
    if (p->reader.memory)
        arena_absorb(memory, p->reader.memory);
    rad_reader_end(&p->reader);
    rad_words_end(&p->source.words);
    free(p->primitives);
}

graze_status rad_pieces_read(rad_source *s) {
    rad_reader *reader = s->reader;
    int count = pipeline_chunk_count(reader->threads);
    piece *pieces = aligned_alloc(_Alignof(piece), (size_t)count * sizeof *pieces);
    bool ready = pieces != NULL;
    if (ready)
        memset(pieces, 0, (size_t)count * sizeof *pieces);
    for (int i = 0; i < count && ready; i++)
        ready = prepare_piece(&pieces[i], s);
    int line, column;
    (void)rad_words_peek(&s->words, &line, &column);
    division d = {.whole = s, .next = s->words.next, .line = s->words.line_start};
    const pipeline line_of_pieces = {.threads = reader->threads,
                                     .chunks = pieces,
                                     .chunk_size = sizeof *pieces,
                                     .chunk_count = count,
                                     .user = &d,
                                     .read = begin_piece,
                                     .work = read_piece,
                                     .write = take_piece};
    graze_status status = ready ? pipeline_run(&line_of_pieces, reader->report) : report_out_of_memory(reader->report);
    for (int i = 0; pieces && i < count; i++)
        end_piece(&pieces[i], reader->memory);
    free(pieces);
    return status;
}
