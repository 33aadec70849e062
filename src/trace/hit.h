/* What rays meet. */
#ifndef TRACE_HIT_H
#define TRACE_HIT_H

#include "base/vector.h"
#include "trace/context.h"

/* What a ray meets: nothing, a source, or a surface. */
typedef struct path_hit {
    int64_t surface;               /* -1: none */
    int light;                     /* of the surface or the source; -1: none */
    double distance;               /* from the ray's origin; GEOMETRY_FAR for a source or nothing */
    vec3 point, normal, direction; /* the surface's own normal; the ray's direction */
    bool behind;                   /* the surface was hit from behind */
    bool passed;                   /* faces hidden by -bv- lie before it */
} path_hit;

/* Finds what the ray meets first, passing hidden back faces. */
void path_cast_into(path_hit *, const path_context *, vec3 origin, vec3 direction, double limit, int64_t from);

static inline path_hit path_cast(const path_context *context, vec3 origin, vec3 direction, double limit, int64_t from) {
    path_hit hit;
    path_cast_into(&hit, context, origin, direction, limit, from);
    return hit;
}

#endif
