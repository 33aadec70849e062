/* Looking at records many bytes at a time. */
#ifndef BASE_RECORD_SCAN_H
#define BASE_RECORD_SCAN_H

#include <stddef.h>

/* Adds the ends of words (a blank behind a byte that is none) and of lines among bytes[0 .. length). Looks at bytes[-1]
 * too. */
void record_count_ends(const char *bytes, size_t length, size_t *words, size_t *lines);

/* How many values there are before the first that is not finite. */
size_t record_finite_floats(const float *values, size_t count);
size_t record_finite_doubles(const double *values, size_t count);

#endif
