/* What gtrace prints for a ray: rtrace's -o letters. */
#ifndef TOOLS_GTRACE_RAY_OUTPUT_H
#define TOOLS_GTRACE_RAY_OUTPUT_H

#include <stdbool.h>

#include "base/records.h"
#include "graze/trace.h"
#include "tools/common/output_color.h"

typedef enum ray_format { RAY_ASCII = 'a', RAY_FLOAT = 'f', RAY_DOUBLE = 'd', RAY_COLOR = 'c' } ray_format;

typedef struct ray_output {
    const char *letters; /* as given, checked */
    size_t answer_count; /* those that stand before t or T: of an answer */
    const char *tree;    /* those behind: of every ray of the tree; null: there is no t or T */
    bool shadows;        /* T: of shadow rays, too */
    ray_format format;
    output_color color;
    bool needs_value;     /* some letter asks for light: else rays are only cast */
    bool needs_mirror;    /* some letter tells what a mirror reflects from the rest */
    bool needs_error;     /* e */
    bool needs_hit;       /* some letter tells what is met, or where */
    bool casts_only;      /* no letter depends on light, so that irradiance makes no sense */
    int numbers;          /* in a record, each name counted as one: the header's NCOMP */
    char tree_only_value; /* V or W without t or T, for a warning; 0: none */
} ray_output;

/* Checks the letters against what gtrace knows, and against the format. The color option must outlive the result. */
graze_status ray_output_parse(ray_output *, const char *letters, char format, const output_color_option *,
                              const graze_report *);

/* All that letters may ask for. */
typedef struct ray_values {
    graze_vec3 origin, direction;
    const graze_hit *hit; /* also of a surface that is hidden from behind (-bv-) */
    double seen_distance; /* to what is seen: beyond such surfaces */
    graze_rgb value, standard_error, coefficient, contribution, mirrored, unmirrored;
    double mirrored_distance; /* GRAZE_FAR: no mirror */
    double weight;
} ray_values;

/* Appends the record of an answer. */
void ray_output_append(const ray_output *, record_buffer *, const ray_values *);

/* Whether nothing but v is asked for, and not in four bytes. */
static inline bool ray_output_is_value(const ray_output *o) {
    return o->answer_count == 1 && o->letters[0] == 'v' && !o->tree && o->format != RAY_COLOR;
}

/* Appends the record of an answer then. */
void ray_output_append_value(const ray_output *, record_buffer *, graze_rgb value);

/* Appends the line of a ray of the tree. */
void ray_output_append_tree_ray(const ray_output *, record_buffer *, int depth, const ray_values *);

#endif
