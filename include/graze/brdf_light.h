/* Light from a whole light at once: what a surface reflects of uniform radiance that comes from all directions in which
 * a polygon or an ellipse is seen, without sampling it.
 *
 * The new model's lobe is a Gaussian in the slope of the half vector times the weight (15), which is a quotient of
 * polynomials in the slope. Along one of two axes of the slope plane both have antiderivatives that erf and exp give;
 * by Green's theorem, what is left is a smooth integral along the light's outline. The other models' weights do not
 * allow that.
 *
 * All is as in brdf.h: unit vector `v` in the shading frame, specular reflectance 1. Positions are relative to the
 * surface point, of any scale. What lies below the surface (z <= 0) is cut off. A light must not surround the surface
 * point; which of its sides faces the point, and which way round it goes, does not matter. Results are the reflected
 * radiance for a radiance of 1: the integral of value x l.z over the directions l of the light, 0 .. 1.
 *
 *   error                    relative  at least  measured, relative
 *   graze_brdf_polygon       1e-8      1e-14     3e-9
 *   graze_brdf_ellipse       1e-8      1e-14     4e-9
 *   graze_diffuse_polygon    1e-14     1e-14     1e-15     and of a quadrangle
 *   graze_diffuse_ellipse    1e-9      1e-14     2e-11
 *
 * as tested; for the lobe, 4e-16/(roughness v.z) more, since so much does a unit vector's rounding matter, and at least
 * 1e-12 for a light that passes by the lobe on two sides; and these for v.z of 1e-6 or more. Where the surface point
 * lies on the outline or next to it (by less than 1e-6 of its size), only that they are in 0 .. 1. Results are 0 for v
 * below the surface, for fewer than three corners, and for what is not finite. A ring is the difference of two disks,
 * with both their errors. */
#ifndef GRAZE_BRDF_LIGHT_H
#define GRAZE_BRDF_LIGHT_H

#include <stddef.h>

#include "graze/brdf.h"
#include "graze/export.h"
#include "graze/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The new model's lobe; the model that the brdf names does not matter. The polygon is plane and may be concave; a seam
 * to a hole and back, as in Radiance's polygons, is let pass. A third of a microsecond for four corners where the light
 * is smaller than the lobe or misses it, two where it is much larger. */
GRAZE_API double graze_brdf_polygon(const graze_brdf *brdf, const graze_vec3 *corners, size_t count, graze_vec3 v);

/* The same for the ellipse center + cos(t) first + sin(t) second: a disk with two radii at right angles, or the outline
 * of a sphere or a cone of directions (narrower than half of all). */
GRAZE_API double graze_brdf_ellipse(const graze_brdf *brdf, graze_vec3 center, graze_vec3 first, graze_vec3 second,
                                    graze_vec3 v);

/* The diffuse term for reflectance 1, whatever the viewer: Lambert's formula. */
GRAZE_API double graze_diffuse_polygon(const graze_vec3 *corners, size_t count);
GRAZE_API double graze_diffuse_ellipse(graze_vec3 center, graze_vec3 first, graze_vec3 second);

/* The diffuse term of a polygon of four corners where these, the surface point and the surface's unit normal, on the
 * side of which light counts, are given in space. */
GRAZE_API double graze_diffuse_quadrangle(graze_vec3 point, graze_vec3 normal, const graze_vec3 corners[4]);

#ifdef __cplusplus
}
#endif

#endif
