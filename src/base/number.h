/* Numbers from text and back, correctly rounded and free of the locale. */
#ifndef BASE_NUMBER_H
#define BASE_NUMBER_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>

/* Reads the number `[+-]digits[.digits][e[+-]digits]` (digits on one side of the point are enough) that begins at
 * `text`; nothing at or behind `end` is looked at. Gives the end of the number, or null where there is none. A number
 * too large for a double becomes an infinity, which the caller must look for. */
const char *number_scan(const char *text, const char *end, double *value);

/* A whole word that is such a number, and finite. */
bool text_to_real(const char *word, double *value);
/* A whole word `[+-]digits` within int. */
bool text_to_integer(const char *word, int *value);

enum { NUMBER_TEXT_SIZE = 64 };
/* Prints a value as `%.{digits}g`, with 0 digits as `%e`, with a point whatever the locale. Gives the length. */
size_t number_print(char text[NUMBER_TEXT_SIZE], int digits, double value);
/* Prints a value with as few digits as read back the same, but not fewer than 15 where they matter. */
size_t number_print_exact(char text[NUMBER_TEXT_SIZE], double value);

/* The nearest float; what is too large becomes +-FLT_MAX. NaN stays NaN. */
static inline float number_to_float(double value) {
    return value > FLT_MAX ? FLT_MAX : value < -FLT_MAX ? -FLT_MAX : (float)value;
}

#endif
