/* What paths have in common: the scene, the settings, and which ways of finding light these allow. */
#ifndef TRACE_CONTEXT_H
#define TRACE_CONTEXT_H

#include <stdbool.h>

#include "graze/trace.h"
#include "scene/scene.h"
#include "trace/path_memory.h"

struct path_observer;
struct path_indirect;

/* What one path needs of its surroundings. */
typedef struct path_context {
    const graze_scene *scene;
    const graze_trace_settings *settings;
    path_memory *memory;                  /* of paths; null only beside an observer or a record */
    const struct path_observer *observer; /* is told of every ray (trace/observer.h); null: nobody is */
    const struct irradiance_cache *cache; /* null: none */
    const struct path_indirect *indirect; /* what is known where the path begins (trace/path.h); null: nothing */
    struct irradiance_record *record;     /* not null: all that is asked is where the first diffuse reflection leads */
} path_context;

/* Whether the strategy looks for lights at all, or leaves them to reflections. */
static inline bool context_samples_lights(const graze_trace_settings *settings) {
    return settings->strategy == GRAZE_STRATEGY_MIS || settings->strategy == GRAZE_STRATEGY_LIGHT;
}

/* Glows that shine through hidden back faces would be lost to shadow rays, which those stop as in Radiance: so without
 * back faces, glows are found by reflection alone. */
static inline bool context_samples_glows(const graze_trace_settings *settings) {
    return context_samples_lights(settings) && settings->back_faces_visible;
}

#endif
