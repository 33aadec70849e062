/* What mist does to light on its way, and the light of lamps that it scatters. */
#ifndef TRACE_MIST_H
#define TRACE_MIST_H

#include "trace/path_state.h"

/* Whether there is any. */
static inline bool mist_is_there(const path_context *context) {
    return context->scene->mist || rgb_max(context->settings->mist_extinction) > 0;
}

/* Takes the path through the mist on its way of a ray: what is absorbed or scattered away is lost, and what is
 * scattered towards the eye found. */
void mist_follow(path *, vec3 origin, vec3 direction, double distance);

/* What is left of a light on a way. Of what lights as a light does (`direct`) only what is absorbed is lost: what is
 * scattered goes on about as it was, as in Radiance. */
rgb mist_transmittance(const path_context *, vec3 origin, vec3 direction, double distance, bool direct);

#endif
