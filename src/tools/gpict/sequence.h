/* rpict's -S: a picture for each view on standard input. */
#ifndef TOOLS_GPICT_SEQUENCE_H
#define TOOLS_GPICT_SEQUENCE_H

#include "tools/gpict/shot.h"

/* Renders the views as they come, until there are no more or a signal stops one. A view that cannot be is told, and its
 * number passed over. */
graze_status sequence_render(job *);

#endif
