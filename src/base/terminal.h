/* What may be drawn on standard error. */
#ifndef BASE_TERMINAL_H
#define BASE_TERMINAL_H

#include <stdbool.h>

/* Standard error is a terminal that knows colours and cursor movements, and the user has not forbidden them by
 * NO_COLOR. */
bool terminal_is_fancy(void);

/* To column 1, and erase the line. */
#define TERMINAL_ERASE_LINE "\r\033[K"

#endif
