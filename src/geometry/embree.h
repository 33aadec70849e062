/* Embree 3 and 4 by the same names. */
#ifndef GEOMETRY_EMBREE_H
#define GEOMETRY_EMBREE_H

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

/* What rides along with a ray and is handed to the callbacks. */
#if RTC_VERSION_MAJOR >= 4

typedef struct RTCRayQueryContext embree_context;

static inline void embree_context_init(embree_context *context) {
    rtcInitRayQueryContext(context);
}

static inline void embree_intersect(RTCScene scene, embree_context *context, struct RTCRayHit *ray) {
    struct RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = context;
    rtcIntersect1(scene, ray, &arguments);
}

static inline void embree_occluded(RTCScene scene, embree_context *context, struct RTCRay *ray) {
    struct RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = context;
    rtcOccluded1(scene, ray, &arguments);
}

#else

typedef struct RTCIntersectContext embree_context;

static inline void embree_context_init(embree_context *context) {
    rtcInitIntersectContext(context);
}

static inline void embree_intersect(RTCScene scene, embree_context *context, struct RTCRayHit *ray) {
    rtcIntersect1(scene, context, ray);
}

static inline void embree_occluded(RTCScene scene, embree_context *context, struct RTCRay *ray) {
    rtcOccluded1(scene, context, ray);
}

#endif

/* A callback's ray and hit: those of a single ray lie as RTCRay and RTCHit do. */
static inline struct RTCRay *embree_ray(void *ray) {
    return ray;
}
static inline const struct RTCHit *embree_hit(const void *hit) {
    return hit;
}

#endif
