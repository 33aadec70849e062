/* The options that say which reflectance is evaluated. */
#ifndef TOOLS_BRDFEVAL_REFLECTANCE_OPTIONS_H
#define TOOLS_BRDFEVAL_REFLECTANCE_OPTIONS_H

#include "base/options.h"
#include "tools/brdfeval/evaluation.h"

typedef struct reflectance_options reflectance_options;

/* A number that a material would set, too. */
typedef struct reflectance_parameter {
    const char *name, *what;
    double low, high; /* its range, ends included */
    double value;
    const char *given; /* the option that set it; null: none did */
    const reflectance_options *options;
} reflectance_parameter;

enum { ALPHA_X, ALPHA_Y, SPECULAR, DIFFUSE, PARAMETER_COUNT };

struct reflectance_options {
    const char *model;
    const char *material_file, *material_name; /* both or none */
    reflectance_parameter parameters[PARAMETER_COUNT];
};

#define REFLECTANCE_OPTION_COUNT 8

/* Sets the defaults, and fills in table entries that store into the options. */
void reflectance_options_begin(reflectance_options *, option table[REFLECTANCE_OPTION_COUNT]);

/* What they say. `input_taken`: standard input can be no scene. */
graze_status reflectance_options_read(const reflectance_options *, bool input_taken, reflectance *,
                                      const graze_report *);

#endif
