/* Points where light is gathered. */
#ifndef TRACE_VERTEX_H
#define TRACE_VERTEX_H

#include "trace/path_state.h"

/* Makes the vertex where the path has hit a reflecting surface. False: it has not, or carries nothing. */
bool vertex_at_hit(const path *, const path_hit *, vertex *);

/* Sets what the ambient term stands for at a vertex whose shading is prepared from this material. */
void vertex_find_ambient(const path *, vertex *, const graze_material *);

/* The same by the specularities that are compared with the threshold of the ambient term. */
void vertex_set_ambient(const path *, vertex *, double reflected, double transmitted);

/* For a surface that transmits and does not refract: sets where the path goes on, and leaves of one that only looks for
 * lights straight on nothing else. Its ambient terms must be set. */
void vertex_set_passage(const path *, vertex *);

/* What a vertex's function reflects to the viewer of light from a direction, in 1/sr; black where it has none. */
rgb vertex_function_value(const vertex *, vec3 direction);

/* Leaves of a vertex what the part of its light needs. False: nothing. */
bool vertex_keep_part(vertex *, graze_part);

/* A sensor at `point`, a little above it: a Lambertian surface whose radiance is the irradiance there. */
vertex vertex_of_sensor(vec3 point, vec3 normal);

/* The same at a point of a surface. */
vertex vertex_of_point(vec3 point, vec3 normal, int64_t surface);

#endif
