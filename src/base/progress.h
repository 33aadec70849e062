/* A progress line on standard error: drawn only on a terminal, and only when NO_COLOR does not forbid. */
#ifndef BASE_PROGRESS_H
#define BASE_PROGRESS_H

#include <stdbool.h>

typedef struct progress progress;

/* Null, and then nothing is drawn, when not wanted or where there is no terminal. */
progress *progress_start(const char *what, bool wanted);
/* `done` in [0,1]; `detail` (may be null) stands behind the bar. Callable from any thread; redraws at most ten times a
 * second. */
void progress_update(progress *, double done, const char *detail);
void progress_finish(progress *); /* erases the line; null is let pass */

#endif
