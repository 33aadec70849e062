/* What a number's text looks like, spelled out once more and as plainly as can be. */
#ifndef FUZZ_NUMBER_TEXT_H
#define FUZZ_NUMBER_TEXT_H

#include <stddef.h>
#include <string.h>

static inline size_t number_text_skip_digits(const char *text, size_t size, size_t at) {
    while (at < size && text[at] >= '0' && text[at] <= '9')
        at++;
    return at;
}

/* The length of the number that begins at `text`: 0 where none does. An `e` has to be followed by an exponent. */
static inline size_t number_text_length(const char *text, size_t size) {
    size_t begin = size > 0 && (text[0] == '+' || text[0] == '-');
    size_t at = number_text_skip_digits(text, size, begin), digits = at - begin;
    if (at < size && text[at] == '.') {
        size_t fraction = number_text_skip_digits(text, size, at + 1);
        digits += fraction - at - 1;
        at = fraction;
    }
    if (digits == 0)
        return 0;
    if (at == size || (text[at] != 'e' && text[at] != 'E'))
        return at;
    size_t exponent = at + 1;
    exponent += exponent < size && (text[exponent] == '+' || text[exponent] == '-');
    at = number_text_skip_digits(text, size, exponent);
    return at > exponent ? at : 0;
}

static inline int number_text_same_bits(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

#endif
