/* Watching paths: who asks for it is told of every ray, as it is cast. */
#ifndef TRACE_OBSERVER_H
#define TRACE_OBSERVER_H

#include "trace/path_state.h"

typedef enum path_event_kind {
    PATH_RAY,     /* a reflected ray; the first ray of a path, which all its samples share, is not told of */
    PATH_SHADOW,  /* a ray to a point of a light, that arrived */
    PATH_SURFACE, /* no ray: what the ambient value gives where the last ray has ended */
} path_event_kind;

typedef struct path_event {
    path_event_kind kind;
    int depth;     /* reflections, this one included; for PATH_SHADOW as if the light had been found by reflection */
    bool mirrored; /* PATH_RAY: by a mirror */
    vec3 origin;   /* of the ray, as are the following three */
    path_hit hit;
    rgb radiance;     /* that comes from an emitter at the ray's end */
    rgb coefficient;  /* share of it, or of what a surface there reflects, in the path's radiance */
    rgb contribution; /* found by now: 0 for a ray that ends on a surface */
} path_event;

typedef struct path_observer {
    void (*tell)(void *user, const path_event *);
    void *user;
} path_observer;

/* Each tells the path's observer, if there is one. A light's `contribution` is that which the path has found. */
void observe_ray_told(const path *, vec3 origin, const path_hit *, rgb contribution);
void observe_shadow_ray_told(const path *, vec3 origin, const light_sample *, rgb contribution);
void observe_surface_told(const path *, rgb contribution);

static inline void observe_ray(const path *p, vec3 origin, const path_hit *hit, rgb contribution) {
    if (p->context->observer)
        observe_ray_told(p, origin, hit, contribution);
}
static inline void observe_shadow_ray(const path *p, vec3 origin, const light_sample *sample, rgb contribution) {
    if (p->context->observer)
        observe_shadow_ray_told(p, origin, sample, contribution);
}
static inline void observe_surface(const path *p, rgb contribution) {
    if (p->context->observer)
        observe_surface_told(p, contribution);
}

#endif
