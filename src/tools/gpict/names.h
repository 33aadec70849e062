/* Names of a frame's files. */
#ifndef TOOLS_GPICT_NAMES_H
#define TOOLS_GPICT_NAMES_H

#include "base/arena.h"
#include "base/report.h"

/* The name with the frame's number in place of its %d, which may have a width, as in %04d; %% is a per cent sign. With
 * number 0, which is no frame, the name is as it stands. Null when out of memory. */
char *name_of_frame(arena *, const char *spec, int number);
/* Whether the name has one %d, and nothing else behind a per cent sign: an input error if not. */
graze_status name_check_frame(const char *spec, const graze_report *);

/* DIR/NAME.preview.SUFFIX of DIR/NAME.SUFFIX. Null when out of memory. */
char *name_of_preview(arena *, const char *file);
/* FILE.checkpoint. Null when out of memory. */
char *name_of_checkpoint(arena *, const char *file);

#endif
