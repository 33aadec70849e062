/* Lights that flat mirrors and panes show: light samples of what is seen in them. */
#ifndef TRACE_MIRRORED_LIGHT_H
#define TRACE_MIRRORED_LIGHT_H

#include "trace/path_state.h"

/* Whether the surface is a flat mirror or pane, in which lights are sampled. */
static inline bool mirrored_light_is_in(const graze_scene *scene, int64_t surface) {
    return surface >= 0 && surface < (int64_t)scene->surface_count && scene->surfaces[surface].mirrors;
}

/* Samples lights as the vertex sees them in the mirrors around, each or some of many, and adds what it finds to the
 * path's radiance. */
void mirrored_light_add(path *, const vertex *, const lobe_choice *);

/* The weight of a light that the path has hit after its last scattering and then a mirror, against the same found in
 * that way. */
double mirrored_light_weight(const path *, const path_hit *);

#endif
