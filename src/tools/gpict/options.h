/* gpict's command line. */
#ifndef TOOLS_GPICT_OPTIONS_H
#define TOOLS_GPICT_OPTIONS_H

#include "rad/view.h"
#include "tools/common/render_options.h"

#define OUTPUT_LIMIT 8

/* Files to write besides or instead of standard output. */
typedef struct outputs {
    const char *files[OUTPUT_LIMIT];
    int count;
} outputs;

typedef struct gpict_options {
    render_options render;
    rad_view view;
    int width, height, spacing;
    double pixel_aspect, jitter, aperture, shutter, tolerance, exposure;
    outputs pictures;
    const char *contours, *depth; /* "": none */
    int contours_per_decade;
    int first_frame;                              /* -S; 0: no sequence */
    const char *recover;                          /* -r, -ro; "": nothing */
    bool recover_output;                          /* -ro: it is an output as well */
    const char *checkpoint, *preview;             /* "": beside the first output */
    double checkpoint_interval, preview_interval; /* seconds; 0: none */
    int report_interval;
    bool progress;
} gpict_options;

gpict_options gpict_options_default(void);

enum { GPICT_OPTION_COUNT = 36, GPICT_TABLE_SIZE = GPICT_OPTION_COUNT + RENDER_OPTION_COUNT };

/* Fills in the table: entries that store into the options. */
void gpict_options_table(gpict_options *, option table[GPICT_TABLE_SIZE]);

/* What the picture's bytes depend on besides its scene, view and size: the options that have an effect, a line each. To
 * be freed; null when out of memory. */
char *gpict_options_question(const gpict_options *);

#endif
