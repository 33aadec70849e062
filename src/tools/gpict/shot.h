/* One picture from beginning to end. */
#ifndef TOOLS_GPICT_SHOT_H
#define TOOLS_GPICT_SHOT_H

#include "tools/common/tool.h"
#include "tools/gpict/options.h"

/* What all pictures have in common. */
typedef struct job {
    const gpict_options *options;
    const tool_arguments *arguments;
    graze_trace_settings trace;
    graze_scene *scene; /* null until it is needed */
    int signal;         /* that has stopped a picture, or 0 */
    const graze_report *report;
} job;

typedef struct shot shot;

/* Finds out all that can be wrong with a picture before it is rendered: names, view, size, and the checkpoint if it is
 * to go on with one. `number` is 0 where there is no sequence; `previous`, prepared, is the view of the frame before.
 * *out is null, and all is well, for a frame that is there already. */
graze_status shot_prepare(shot **out, const job *, int number, const rad_view *view, const rad_view *previous);
/* Renders and writes it, or the checkpoint where a signal has stopped it: then the job's `signal` is set. Loads the
 * scene if that has not been done. */
graze_status shot_render(shot *, job *);
void shot_destroy(shot *); /* null is let pass */

/* Loads the scene. */
graze_status job_load(job *);

#endif
