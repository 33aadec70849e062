/* The colours that values are printed in: -p. */
#ifndef TOOLS_COMMON_OUTPUT_COLOR_H
#define TOOLS_COMMON_OUTPUT_COLOR_H

#include "base/options.h"
#include "base/vector.h"
#include "image/color.h"

typedef enum output_space {
    OUTPUT_RGB,       /* Radiance's own */
    OUTPUT_PRIMARIES, /* RGB in others */
    OUTPUT_XYZ,       /* CIE 1931, in lumens */
    OUTPUT_PHOTOPIC,  /* one number, in lumens */
    OUTPUT_SCOTOPIC,
    OUTPUT_MELANOPIC,
    OUTPUT_MEAN, /* the mean of red, green and blue */
} output_space;

/* What the option says. Begins as {0}. */
typedef struct output_color_option {
    output_space space;
    double primaries[8]; /* of OUTPUT_PRIMARIES: x and y of red, green, blue and white */
} output_color_option;

/* For an option table: OPTION_CUSTOM -p with an output_color_option as target. */
graze_status output_color_take(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *);
void output_color_print(void *target, FILE *);

/* What it means. */
typedef struct output_color {
    output_space space;
    int numbers;             /* 3, or 1 */
    double efficacy;         /* of values; reflectances and the like have none */
    double rows[3][3];       /* white becomes 1 in each, but for white's adaptation to other primaries */
    const double *primaries; /* for a header's PRIMARIES line; null: none is needed. Lives as long as the option */
} output_color;

output_color output_color_prepare(const output_color_option *);

/* A radiance or irradiance, into `numbers` numbers. What lies outside the primaries' colors is brought towards gray, so
 * that nothing is negative. */
void output_color_value(const output_color *, rgb, double out[3]);
/* Its standard error: at most this, the errors of red, green and blue being alike. */
void output_color_error(const output_color *, rgb, double out[3]);
/* A share of one. */
void output_color_coefficient(const output_color *, rgb, double out[3]);

#endif
