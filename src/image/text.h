/* Numbers as text, free of the locale. */
#ifndef IMAGE_TEXT_H
#define IMAGE_TEXT_H

#include <stddef.h>

/* As printf's "%.*g" in the C locale. The value must be finite. */
void image_format_real(char *buffer, size_t size, int digits, double value);

#endif
