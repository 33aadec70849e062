/* The words of scene files. */
#include "rad/words.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"

enum { SPACE = 1, QUOTE = 2, ZERO = 4 };

static const unsigned char kinds[256] = {
    [0] = ZERO,     ['\t'] = SPACE, ['\n'] = SPACE, ['\v'] = SPACE, ['\f'] = SPACE,
    ['\r'] = SPACE, [' '] = SPACE,  ['"'] = QUOTE,  ['\''] = QUOTE,
};

static int kind(char c) {
    return kinds[(unsigned char)c];
}

void rad_words_begin(rad_words *w, const char *text, size_t length) {
    *w = (rad_words){.next = text, .end = text + length, .line_start = text, .line = 1};
}

void rad_words_end(rad_words *w) {
    free(w->scratch);
}

static void pass_newline(rad_words *w, const char *newline) {
    w->line_start = newline + 1;
    if (w->line < INT_MAX)
        ++w->line;
}

static int column_of(const rad_words *w, const char *p) {
    ptrdiff_t column = p - w->line_start + 1;
    return column < INT_MAX ? (int)column : INT_MAX;
}

static void skip_space(rad_words *w) {
    const char *p = w->next;
    for (; kind(*p) == SPACE; ++p)
        if (*p == '\n')
            pass_newline(w, p);
    w->next = p;
}

char rad_words_peek(rad_words *w, int *line, int *column) {
    skip_space(w);
    *line = w->line;
    *column = column_of(w, w->next);
    return *w->next;
}

static bool scratch_append(rad_words *w, const char *text, size_t length) {
    if (length >= w->scratch_capacity - w->scratch_length) {
        size_t capacity = 2 * (w->scratch_length + length + 1);
        char *bytes = realloc(w->scratch, capacity);
        if (!bytes)
            return false;
        w->scratch = bytes;
        w->scratch_capacity = capacity;
    }
    memcpy(w->scratch + w->scratch_length, text, length);
    w->scratch_length += length;
    w->scratch[w->scratch_length] = 0;
    return true;
}

/* Collects a word in which the byte at `p` is its first quote. */
static rad_word_status next_quoted(rad_words *w, rad_word *word, const char *p) {
    char quote = 0;
    w->scratch_length = 0;
    if (!scratch_append(w, w->next, (size_t)(p - w->next)))
        return RAD_WORD_NO_MEMORY;
    for (;;) {
        const char *piece = p;
        while (quote ? *p != quote && *p : !kind(*p)) {
            if (*p == '\n')
                pass_newline(w, p);
            ++p;
        }
        if (!scratch_append(w, piece, (size_t)(p - piece)))
            return RAD_WORD_NO_MEMORY;
        if (!*p || kind(*p) == SPACE)
            break;
        quote = quote ? 0 : *p;
        ++p;
    }
    w->next = p;
    *word = (rad_word){w->scratch, w->scratch_length, word->line, word->column};
    if (!*p && p < w->end)
        return RAD_WORD_ZERO;
    return quote ? RAD_WORD_OPEN : RAD_WORD;
}

rad_word_status rad_words_next(rad_words *w, rad_word *word) {
    rad_words_peek(w, &word->line, &word->column);
    const char *p = w->next;
    while (!kind(*p))
        ++p;
    if (kind(*p) == QUOTE)
        return next_quoted(w, word, p);
    word->text = w->next;
    word->length = (size_t)(p - w->next);
    w->next = p;
    if (!*p && p < w->end)
        return RAD_WORD_ZERO;
    return word->length ? RAD_WORD : RAD_WORD_NONE;
}

/* As rad_words_real, of a word with quotes. */
static bool quoted_real(rad_words *w, double *value) {
    rad_words before = *w;
    rad_word word;
    bool good = rad_words_next(w, &word) == RAD_WORD && word.text == w->scratch && !memchr(word.text, 0, word.length) &&
                text_to_real(w->scratch, value);
    if (!good) {
        w->next = before.next;
        w->line_start = before.line_start;
        w->line = before.line;
    }
    return good;
}

bool rad_words_real(rad_words *w, double *value) {
    skip_space(w);
    const char *end = number_scan(w->next, w->end, value);
    if (!end || !(kind(*end) == SPACE || end == w->end))
        return quoted_real(w, value);
    if (!isfinite(*value))
        return false;
    w->next = end;
    return true;
}

void rad_words_skip_line(rad_words *w) {
    const char *newline = memchr(w->next, '\n', (size_t)(w->end - w->next));
    if (newline)
        pass_newline(w, newline);
    w->next = newline ? newline + 1 : w->end;
}

rad_word_status rad_words_command(rad_words *w, rad_word *word) {
    word->line = w->line;
    word->column = column_of(w, w->next);
    w->scratch_length = 0;
    const char *p = w->next;
    bool escaped = false;
    for (;; ++p) {
        bool line_end = *p == '\n' || *p == '\r';
        if (*p == '\n')
            pass_newline(w, p);
        if (*p == '\r' && p[1] == '\n')
            continue;
        if (!*p || (line_end && !escaped))
            break;
        escaped = *p == '\\';
        if (!scratch_append(w, line_end ? "\n" : p, 1))
            return RAD_WORD_NO_MEMORY;
    }
    if (!*p && p < w->end)
        return RAD_WORD_ZERO;
    if (!scratch_append(w, "", 0))
        return RAD_WORD_NO_MEMORY;
    w->next = *p ? p + 1 : p;
    word->text = w->scratch;
    word->length = w->scratch_length;
    return RAD_WORD;
}
