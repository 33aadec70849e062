/* Outlines of lights, cut at the horizon, as a closed chain of arcs.
 *
 * Only the directions of an outline's points matter, not their distances. A part of an ellipse, whose points are
 * quotients of quadratic polynomials, is therefore as good as the polynomials above the quotients' common
 * denominator. */
#ifndef BRDF_OUTLINE_H
#define BRDF_OUTLINE_H

#include <stddef.h>

#include "brdf/arithmetic.h"
#include "graze/brdf.h"

/* The directions constant + u linear + u^2 quadratic, of any length. */
typedef struct brdf_arc {
    graze_vec3 constant, linear, quadratic;
} brdf_arc;

BRDF_INLINE graze_vec3 brdf_arc_at(const brdf_arc *arc, double u) {
    return (graze_vec3){arc->constant.x + u * (arc->linear.x + u * arc->quadratic.x),
                        arc->constant.y + u * (arc->linear.y + u * arc->quadratic.y),
                        arc->constant.z + u * (arc->linear.z + u * arc->quadratic.z)};
}

BRDF_INLINE graze_vec3 brdf_arc_derivative(const brdf_arc *arc, double u) {
    return (graze_vec3){arc->linear.x + 2 * u * arc->quadratic.x, arc->linear.y + 2 * u * arc->quadratic.y,
                        arc->linear.z + 2 * u * arc->quadratic.z};
}

/* Gauss's points and weights for the integral from 0 to 1. */
enum { BRDF_GAUSS_POINTS = 8 };
static const double brdf_gauss_points[BRDF_GAUSS_POINTS] = {
    0x1.454e34f5339ap-6,  0x1.a06d536d82f88p-4, 0x1.e5dad4f9af698p-3, 0x1.a214dac30e32fp-2,
    0x1.2ef5929e78e68p-1, 0x1.86894ac19425ap-1, 0x1.cbf255924fa0fp-1, 0x1.f5d58e5856633p-1};
static const double brdf_gauss_weights[BRDF_GAUSS_POINTS] = {
    0x1.9ea1d04ca03aep-5, 0x1.c76fb531d2b94p-4, 0x1.413c50a2556p-3,   0x1.736360b19933dp-3,
    0x1.736360b19933dp-3, 0x1.413c50a2556p-3,   0x1.c76fb531d2b94p-4, 0x1.9ea1d04ca03aep-5};

/* A polygon, or, where `corners` is null, the ellipse center + cos(t) first + sin(t) second. */
typedef struct brdf_outline {
    const graze_vec3 *corners;
    size_t count;
    graze_vec3 center, first, second;
} brdf_outline;

/* Takes the part of an arc between two values of u. */
typedef void brdf_arc_visitor(void *context, const brdf_arc *, double from, double to);

/* Visits all parts above the surface in order, and what closes the chain along the horizon. */
void brdf_outline_visit(const brdf_outline *, brdf_arc_visitor *, void *context);

#endif
