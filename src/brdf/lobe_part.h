/* Parts of outlines in the slope plane. */
#ifndef BRDF_LOBE_PART_H
#define BRDF_LOBE_PART_H

#include <stdbool.h>

#include "brdf/lobe_field.h"
#include "brdf/outline.h"

/* A, B and C of lobe_field.h in Bernstein's form, so scaled that C is 1 at both ends. Of an arc, which is not an edge,
 * the distances are interpolated from both ends and the middle; it keeps its directions, scaled as well. */
typedef struct brdf_part {
    double a[3], b[3], c[3];
    bool is_edge;
    brdf_arc arc;
    double misfit; /* the sum of what interpolated distances are off in the middles of both halves, each over C */
} brdf_part;

/* Of an edge between unit vectors, and of an arc. */
brdf_part brdf_part_of_edge(const brdf_lobe_field *, graze_vec3 from, graze_vec3 to);
brdf_part brdf_part_of_arc(const brdf_lobe_field *, const brdf_arc *);

void brdf_halve_part(const brdf_lobe_field *, const brdf_part *, brdf_part *first, brdf_part *second);

/* Whether a part is where the field is nothing: for large |a|; for large b side. And whether it depends on a alone, for
 * large -b side. Each holds of all of the part if it does of the hull of its coefficients' quotients, in which it is.
 */
bool brdf_part_is_beside(const brdf_part *);
bool brdf_part_is_above(const brdf_part *, double side);
bool brdf_part_is_below(const brdf_part *, double side);

/* The sign of b; 0 if it has both, or may have. */
double brdf_part_side(const brdf_part *);

/* From the axis a = 0, at the nearer end, or 0 if ends are on both sides. */
double brdf_part_distance(const brdf_part *);

/* How far what the field depends on goes along a part, squared. With P[i] the coefficients' quotients and w the middle
 * one of C, it is the sum of
 *
 *     (2 w |P[i+1] - P[i]|)^2, the greater one, and |P[0] - 2 w P[1] + P[2]|, the sum of both coordinates (or a alone);
 *     (4 lean w (a[i+1] - a[i]))^2/(d[i] d[i+1]), the greater one, for the divisors d = 1 + lean a;
 *     12 (1 - w)(2 - w) or, for w > 1, 12 (w - 1);
 *     5 times the turn of an arc, and 100 times what the misfit makes of the coordinates.
 *
 * DBL_MAX where w or the middle divisor is not positive. */
double brdf_part_size(const brdf_lobe_field *, const brdf_part *);

/* How many points do for such a size; more than BRDF_MOST_GAUSS_POINTS where a part had better be cut. By trial: errors
 * of 5e5 lights, then, were within what brdf_light.h says. */
int brdf_part_points(double size);

void brdf_piece_of_part(brdf_piece *, const brdf_part *, int points);

#endif
