/* Characters of text. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdbool.h>

/* As C's isspace, but of no locale. */
static inline bool text_is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

#endif
