/* From a ray to its record. */
#ifndef TOOLS_GTRACE_ANSWER_H
#define TOOLS_GTRACE_ANSWER_H

#include "base/records.h"
#include "graze/trace.h"
#include "tools/common/modifier_list.h"
#include "tools/gtrace/ray_output.h"

/* What all rays share. */
typedef struct answering {
    const graze_scene *scene;
    graze_trace_settings settings;
    ray_output output;
    uint32_t tree_paths;                 /* for t and T */
    const modifier_list *tree_modifiers; /* surfaces that rays must meet to be told of */
} answering;

/* Traces the ray, whose number is its stream, and appends its record. A direction of zero asks for an empty record.
 * False: it took as many samples as it may without reaching the error asked for. */
bool answer_ray(const answering *, const graze_ray *, uint64_t number, record_buffer *);

#endif
