/* Whether a person is watching. */
#include "base/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool terminal_is_fancy(void) {
    const char *forbidden = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && !(forbidden && *forbidden) && terminal && strcmp(terminal, "dumb") != 0;
}
