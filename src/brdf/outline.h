/* Outlines of lights, cut at the horizon, as a closed chain of great circles' arcs and parts of ellipses.
 *
 * Only the directions of an outline's points matter, not their distances. A part of an ellipse, whose points are
 * quotients of quadratic polynomials, is therefore as good as the polynomials above the quotients' common
 * denominator. */
#ifndef BRDF_OUTLINE_H
#define BRDF_OUTLINE_H

#include <stddef.h>

#include "graze/brdf.h"

/* The directions (1-u)^2 c[0] + 2 u (1-u) c[1] + u^2 c[2] for u in 0 .. 1, of any length: Bernstein's form. */
typedef struct brdf_arc {
    graze_vec3 c[3];
} brdf_arc;

graze_vec3 brdf_middle_of_arc(const brdf_arc *);
void brdf_halve_arc(const brdf_arc *, brdf_arc *first, brdf_arc *second);

/* How much an arc turns, for quadratures: the square of the angle through which it would turn were it all as fast as it
 * may be at its ends, and how far it is from straight; DBL_MAX where ends and control are at more than right angles,
 * no number where a length is 0. */
double brdf_turn_of_arc(const brdf_arc *);

/* Takes what an outline is made of, in order; unit vectors are the ends of an edge, along a great circle. */
typedef struct brdf_outline_visitor {
    void (*edge)(void *context, graze_vec3 from, graze_vec3 to);
    void (*arc)(void *context, const brdf_arc *);
    void *context;
} brdf_outline_visitor;

/* The part above the surface of the polygon. */
void brdf_outline_of_polygon(const graze_vec3 *corners, size_t count, const brdf_outline_visitor *);

/* That of the ellipse center + cos(t) first + sin(t) second: four arcs, and the edge along the horizon, if any. */
void brdf_outline_of_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second, const brdf_outline_visitor *);

#endif
