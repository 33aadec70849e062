/* What rays meet, as users of the library see it. */
#ifndef TRACE_DESCRIBE_H
#define TRACE_DESCRIBE_H

#include "trace/hit.h"

/* What a ray from this point meets that meets nothing. */
graze_hit describe_nothing(vec3 origin);

/* Names, distance, point and normals, that of shading as it is for the quantity. */
graze_hit describe_hit(const graze_scene *, const path_hit *, graze_quantity);

/* Checks a ray that users gave, and normalises its direction. False: it is not finite, or has no direction. */
bool describe_ray(const graze_ray *, vec3 *direction, double *limit);

#endif
