/* Light that narrow gloss, or a mirror, throws on diffuse surfaces. A path that a diffuse reflection leads to the gloss
 * finds next to nothing there of a small light, and once in a while a high peak. But what gloss reflects of it in the
 * mean over all directions is known: it tells how much light the peaks bring that no path has met yet. */
#ifndef TRACE_RARE_GLOSS_H
#define TRACE_RARE_GLOSS_H

#include "trace/path_state.h"

/* How the vertex reflects lights in this way, if it does. On curved surfaces, where lights are few, and in mirrors
 * notes what is expected. */
rare_gloss rare_gloss_at(path *, const vertex *);

/* How it transmits them so to its other side. */
rare_gloss rare_gloss_beyond(const path *, const vertex *);

/* In the gloss of flat surfaces, or what they transmit, notes what is expected of a light that shines on the vertex by
 * a sample of it; `expectation` is how often the light is sampled on the average. */
void rare_gloss_expect(path *, const vertex *, const light_sample *, double expectation);

/* Notes what the gloss reflects, or transmits, of a light there, which has been sampled, or met by the path's last
 * reflection. */
void rare_gloss_find(path *, const vertex *, vec3 direction, double light_density, rgb found);
void rare_gloss_find_met(path *, const vertex *, const path_hit *, rgb found);

#endif
