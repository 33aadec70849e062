/* Running gnuplot. */
#ifndef TOOLS_BRDFFIT_GNUPLOT_H
#define TOOLS_BRDFFIT_GNUPLOT_H

#include "base/records.h"

/* Runs gnuplot on the script; what it draws goes to the file, of which nothing is left if that fails. No name of a file
 * gets into the script, for gnuplot takes some of them as commands. */
graze_status gnuplot_draw(record_buffer *script, const char *file, const graze_report *);

/* Creates the file with the buffer as its content, or removes it. */
graze_status gnuplot_write_file(record_buffer *, const char *file, const graze_report *);

#endif
