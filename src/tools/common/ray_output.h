/* What gtrace prints for a ray: rtrace's -o letters. */
#ifndef TOOLS_COMMON_RAY_OUTPUT_H
#define TOOLS_COMMON_RAY_OUTPUT_H

#include <stdbool.h>

#include "base/records.h"
#include "graze/trace.h"

typedef enum ray_format { RAY_ASCII = 'a', RAY_FLOAT = 'f', RAY_DOUBLE = 'd', RAY_COLOR = 'c' } ray_format;

typedef struct ray_output {
    const char *letters; /* checked */
    ray_format format;
    bool needs_value; /* some letter asks for light: else rays are only cast */
    int numbers;      /* in a record: the header's NCOMP */
} ray_output;

/* Checks the letters against what gtrace knows, and against the format. */
graze_status ray_output_parse(ray_output *, const char *letters, char format, const graze_report *);

/* Appends the record of one ray. */
void ray_output_append(const ray_output *, record_buffer *, const graze_ray *, const graze_hit *, const graze_answer *);

#endif
