/* Text of any length, for headers. */
#include "image/text.h"

#include <stdio.h>
#include <string.h>

void image_format_real(char *buffer, size_t size, int digits, double value) {
    snprintf(buffer, size, "%.*g", digits, value);
    /* Whatever is no digit, sign or e is the locale's decimal point, of one byte or more. */
    size_t first = strspn(buffer, "0123456789+-e");
    size_t length = strcspn(buffer + first, "0123456789+-e");
    if (length > 0) {
        memmove(buffer + first + 1, buffer + first + length, strlen(buffer + first + length) + 1);
        buffer[first] = '.';
    }
}
