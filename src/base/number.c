/* Words that are numbers, and the float nearest to a number. */
#include "base/number.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

bool text_to_real(const char *word, double *value) {
    const char *end = word + strlen(word);
    double number;
    if (number_scan(word, end, &number) != end || !isfinite(number))
        return false;
    *value = number;
    return true;
}

bool text_to_integer(const char *word, int *value) {
    const char *p = word + (*word == '-' || *word == '+');
    int64_t number = 0;
    if (!*p)
        return false;
    for (; *p >= '0' && *p <= '9'; p++)
        if (number <= INT_MAX)
            number = 10 * number + (*p - '0');
    if (*word == '-')
        number = -number;
    if (*p || number < INT_MIN || number > INT_MAX)
        return false;
    *value = (int)number;
    return true;
}
