/* gfalsecolor's options. */
#ifndef TOOLS_GFALSECOLOR_OPTIONS_H
#define TOOLS_GFALSECOLOR_OPTIONS_H

#include "base/options.h"
#include "image/false_color.h"

/* The scale's upper end: what suits luminances or differences, whichever are shown; by the picture; or a number. */
typedef enum scale_choice { SCALE_DEFAULT, SCALE_AUTO, SCALE_GIVEN } scale_choice;

/* A whole number of 0 or more, or AUTOMATIC. */
enum { AUTOMATIC = -1 };
typedef struct count_option {
    const char *name;
    int largest, value;
} count_option;

/* Texts are null where they were not given. */
typedef struct false_color_options {
    const char *input, *background, *input_and_background, *reference, *output, *label, *palette;
    scale_choice scale;
    double scale_end; /* of SCALE_GIVEN */
    count_option decimals, legend_width, legend_height;
    bool palettes, extrema;
    double decades, multiplier, exposure;
    int divisions;
    image_false_color_style style;
} false_color_options;

false_color_options false_color_options_default(void);

/* How many entries false_color_options_table fills. */
#define FALSE_COLOR_OPTION_COUNT 24

/* Fills in table entries that store into the options. */
void false_color_options_table(false_color_options *, option table[FALSE_COLOR_OPTION_COUNT]);

/* Refuses options that contradict each other or would do nothing, and an output that cannot be written. */
graze_status false_color_options_check(const false_color_options *, const graze_report *);

/* The palette that is meant; null, and told, where there is none. */
const image_palette *false_color_options_palette(const false_color_options *, const graze_report *);

#endif
