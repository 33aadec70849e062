/* The program xform(1), done here: `xform [options] [transforms] file ...`, with arrays and argument files. */
#ifndef RAD_XFORM_H
#define RAD_XFORM_H

#include "rad/pipeline.h"
#include "rad/reader.h"

/* Runs the pipeline's front by the shell and its stages here; what comes out of the last goes to the sink. */
graze_status rad_xform_run(rad_reader *, const rad_pipeline *, const rad_context *, const place *command,
                           const rad_sink *);

#endif
