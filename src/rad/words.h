/* The words of a scene description, with their places: blanks separate them, quotes of either kind protect blanks. */
#ifndef RAD_WORDS_H
#define RAD_WORDS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct rad_words {
    const char *next, *end; /* what is left of the text; *end is a zero byte */
    const char *line_start; /* of the line that `next` is in */
    int line;
    char *scratch; /* holds a word that had quotes, or a command */
    size_t scratch_length, scratch_capacity;
} rad_words;

typedef enum rad_word_status {
    RAD_WORD,
    RAD_WORD_NONE, /* the text has ended */
    RAD_WORD_OPEN, /* a quote without its end */
    RAD_WORD_ZERO, /* a zero byte: this is no text */
    RAD_WORD_NO_MEMORY
} rad_word_status;

typedef struct rad_word {
    const char *text; /* without quotes; not zero-terminated; valid until the next word is read */
    size_t length;
    int line, column; /* of its beginning, from 1 */
} rad_word;

/* `text` must have a zero byte behind its `length` bytes, and outlive the words. */
void rad_words_begin(rad_words *, const char *text, size_t length);
void rad_words_end(rad_words *);

/* The first byte of the next word, or 0 at the text's end (or where the text has a zero byte). */
char rad_words_peek(rad_words *, int *line, int *column);
rad_word_status rad_words_next(rad_words *, rad_word *);
/* Reads a real if the next word is one; false, and reads nothing, otherwise. */
bool rad_words_real(rad_words *, double *value);
void rad_words_skip_line(rad_words *);
/* The rest of the line without its end, and further lines while the last has a backslash at its end (both stay, as a
 * shell wants them); carriage returns are line ends, or part of one. Zero-terminated. */
rad_word_status rad_words_command(rad_words *, rad_word *);

#endif
