/* The characters of function files: blanks and comments between words, names, numbers. */
#ifndef CAL_SCANNER_H
#define CAL_SCANNER_H

#include <stdbool.h>
#include <stddef.h>

/* Only this much of a name counts, as in Radiance. */
enum { CAL_NAME_LENGTH = 127 };

typedef struct cal_scanner {
    const char *next, *end;
    const char *line_start; /* of the line that `next` is in */
    int line;
    const char *open_comment; /* begin of a comment without an end, or null; its line and column */
    int open_line, open_column;
} cal_scanner;

void cal_scan_begin(cal_scanner *, const char *text, size_t length);

/* The next character, or 0 at the end (or where the text has a zero byte). Blanks and comments, which nest, are behind
 * it already. */
static inline char cal_scan_peek(const cal_scanner *s) {
    return s->next < s->end ? *s->next : 0;
}
static inline bool cal_scan_at_end(const cal_scanner *s) {
    return s->next == s->end;
}
static inline int cal_scan_column(const cal_scanner *s) {
    return (int)(s->next - s->line_start) + 1;
}
/* Takes the next character, and what blanks and comments follow. */
void cal_scan_skip(cal_scanner *);

bool cal_starts_name(char);
bool cal_is_name_character(char);
/* The name that begins here; *length is cut to CAL_NAME_LENGTH. */
const char *cal_scan_name(cal_scanner *, size_t *length);
/* False where what begins here is no number. A number too large becomes an infinity. */
bool cal_scan_number(cal_scanner *, double *value);
/* Digits; 0 where there are none. False where they are too many. */
bool cal_scan_integer(cal_scanner *, int *value);

#endif
