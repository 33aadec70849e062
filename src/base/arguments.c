/* The words of a command line, with $NAME and @file replaced by what they stand for. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/options_internal.h"
#include "base/text.h"

/* How deep `@file` may lead to `@file`, and how many there may be: a file that names itself twice would double at each
 * turn. */
enum { DEEPEST = 16, MOST = 1000 };

typedef struct expansion {
    options_arguments *arguments;
    int done; /* replacements so far */
    const graze_report *report;
} expansion;

static graze_status add_word(expansion *e, const char *text, size_t length) {
    options_arguments *a = e->arguments;
    if (a->count == a->capacity) {
        int capacity = a->capacity ? 2 * a->capacity : 64;
        const char **words = realloc(a->words, (size_t)capacity * sizeof *words);
        if (!words)
            return report_out_of_memory(e->report);
        a->words = words;
        a->capacity = capacity;
    }
    const char *word = arena_copy_text(a->memory, text, length);
    if (!word)
        return report_out_of_memory(e->report);
    a->words[a->count++] = word;
    return GRAZE_OK;
}

static graze_status expand_word(expansion *, const char *word, size_t length, const place *where, int depth);

/* A text being split, and the word last taken from it. */
typedef struct splitter {
    const char *next;
    char *word; /* has room for the whole text */
    size_t length;
    bool quoted; /* the word begins with a quote */
    place where; /* of `next` */
    const graze_report *report;
} splitter;

static char take(splitter *s) {
    s->where.line += *s->next == '\n';
    return *s->next++;
}

static void skip_to_word(splitter *s) {
    for (;;) {
        while (text_is_blank(*s->next))
            take(s);
        if (*s->next != '#')
            return;
        while (*s->next && *s->next != '\n')
            take(s);
    }
}

/* What stands behind an opening quote, and the closing one. */
static graze_status take_quoted(splitter *s, char quote, const place *begin) {
    while (*s->next != quote) {
        if (quote == '"' && *s->next == '\\' && (s->next[1] == '"' || s->next[1] == '\\'))
            take(s);
        if (!*s->next)
            return report_error(s->report, begin, "the quote %c is never closed", quote);
        s->word[s->length++] = take(s);
    }
    take(s);
    return GRAZE_OK;
}

static graze_status take_word(splitter *s) {
    s->length = 0;
    s->quoted = *s->next == '\'' || *s->next == '"' || *s->next == '\\';
    while (*s->next && !text_is_blank(*s->next)) {
        place begin = s->where;
        char c = take(s);
        if (c == '\'' || c == '"') {
            graze_status status = take_quoted(s, c, &begin);
            if (status)
                return status;
        } else if (c == '\\' && *s->next) {
            s->word[s->length++] = take(s);
        } else {
            s->word[s->length++] = c;
        }
    }
    return GRAZE_OK;
}

static graze_status expand_text(expansion *e, const char *text, place where, int depth) {
    splitter s = {.next = text, .word = malloc(strlen(text) + 1), .where = where, .report = e->report};
    if (!s.word)
        return report_out_of_memory(e->report);
    graze_status status = GRAZE_OK;
    for (skip_to_word(&s); !status && *s.next; skip_to_word(&s)) {
        place begin = s.where;
        status = take_word(&s);
        if (!status)
            status = s.quoted ? add_word(e, s.word, s.length) : expand_word(e, s.word, s.length, &begin, depth);
    }
    free(s.word);
    return status;
}

/* The whole file with a 0 behind it; null and errno where it cannot be read. */
static char *read_stream(FILE *file, size_t *length) {
    char *bytes = NULL;
    size_t capacity = 0;
    *length = 0;
    do {
        if (capacity - *length < 2) {
            capacity = capacity ? 2 * capacity : 4096;
            char *more = realloc(bytes, capacity);
            if (!more) {
                free(bytes);
                errno = ENOMEM;
                return NULL;
            }
            bytes = more;
        }
        *length += fread(bytes + *length, 1, capacity - *length - 1, file);
    } while (!feof(file) && !ferror(file));
    if (ferror(file)) {
        int number = errno;
        free(bytes);
        errno = number;
        return NULL;
    }
    bytes[*length] = 0;
    return bytes;
}

static graze_status expand_file(expansion *e, const char *name, const place *where, int depth) {
    FILE *file = fopen(name, "rb");
    size_t length = 0;
    char *bytes = file ? read_stream(file, &length) : NULL;
    graze_status status;
    if (!bytes) {
        status = report_file_error(e->report, where, "cannot read the options in '@%s'", name);
    } else if (memchr(bytes, 0, length)) {
        status = report_error(e->report, where, "'@%s' is not a file of options: it has zero bytes", name);
    } else {
        place inside = {.file = name, .line = 1, .parent = where};
        status = expand_text(e, bytes, inside, depth);
    }
    if (file)
        fclose(file);
    free(bytes);
    return status;
}

static graze_status expand_variable(expansion *e, const char *name, const place *where, int depth) {
    const char *value = getenv(name);
    if (!value)
        return report_error(e->report, where, "the environment has no variable '$%s'", name);
    /* A copy, for its place in messages is "$NAME". */
    size_t length = strlen(name);
    char *shown = malloc(length + 2);
    if (!shown)
        return report_out_of_memory(e->report);
    shown[0] = '$';
    memcpy(shown + 1, name, length + 1);
    graze_status status = expand_text(e, value, (place){.file = shown, .line = 1, .parent = where}, depth);
    free(shown);
    return status;
}

static graze_status expand_word(expansion *e, const char *word, size_t length, const place *where, int depth) {
    if (length < 2 || (word[0] != '@' && word[0] != '$'))
        return add_word(e, word, length);
    if (depth == DEEPEST || ++e->done > MOST)
        return report_error(e->report, where, "'%.*s' is one replacement too many: does it lead back to itself?",
                            (int)length, word);
    char *name = malloc(length);
    if (!name)
        return report_out_of_memory(e->report);
    memcpy(name, word + 1, length - 1);
    name[length - 1] = 0;
    graze_status status =
        word[0] == '@' ? expand_file(e, name, where, depth + 1) : expand_variable(e, name, where, depth + 1);
    free(name);
    return status;
}

graze_status options_expand(options_arguments **arguments, int argc, char **argv, const graze_report *report) {
    *arguments = NULL;
    options_arguments *a = malloc(sizeof *a);
    if (!a)
        return report_out_of_memory(report);
    *a = (options_arguments){.memory = arena_create()};
    graze_status status = a->memory ? GRAZE_OK : report_out_of_memory(report);
    expansion e = {.arguments = a, .report = report};
    bool literal = false;
    for (int i = 1; i < argc && !status; i++) {
        size_t length = strlen(argv[i]);
        literal |= strcmp(argv[i], "--") == 0;
        status = literal ? add_word(&e, argv[i], length) : expand_word(&e, argv[i], length, NULL, 0);
    }
    if (status) {
        options_arguments_destroy(a);
        return status;
    }
    *arguments = a;
    return GRAZE_OK;
}

void options_arguments_destroy(options_arguments *a) {
    if (!a)
        return;
    arena_destroy(a->memory);
    free(a->words);
    free(a);
}

static bool is_plain(const char *word) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-_./,:=@%^";
    return *word && word[strspn(word, plain)] == 0;
}

/* Hands the word's text to `put`, character by character, in single quotes where `plain` does not say that it needs
 * none. */
static void quote_word(const char *word, bool plain, void (*put)(void *user, char), void *user) {
    if (plain) {
        for (; *word; word++)
            put(user, *word);
        return;
    }
    put(user, '\'');
    for (; *word; word++) {
        if (*word == '\'') {
            put(user, '\'');
            put(user, '\\');
            put(user, '\'');
        }
        put(user, *word);
    }
    put(user, '\'');
}

static void put_to_file(void *user, char c) {
    putc(c, user);
}

void options_print_word(FILE *out, const char *word) {
    quote_word(word, is_plain(word) && word[0] != '@', put_to_file, out);
}

typedef struct line {
    char *next, *last; /* `last` is kept for the terminating 0 */
} line;

static void put_to_line(void *user, char c) {
    line *l = user;
    if (l->next < l->last)
        *l->next++ = c == '\n' || c == '\r' ? ' ' : c;
}

void options_command_line(char *buffer, size_t size, int argc, char **argv) {
    if (size == 0)
        return;
    line l = {buffer, buffer + size - 1};
    for (int i = 0; i < argc; i++) {
        if (i > 0)
            put_to_line(&l, ' ');
        quote_word(argv[i], is_plain(argv[i]), put_to_line, &l);
    }
    *l.next = 0;
}
