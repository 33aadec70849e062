/* Sides of cylinders and truncated cones. On the generator at azimuth phi around the axis (from the half-plane in which
 * the point lies) the solid angle is H r(s)/D^3 dphi ds: H is the point's distance from the tangent plane, which
 * touches the whole generator, s runs along it, r(s) is the radius and D the distance there. Its integral over s is
 * elementary, so s is drawn exactly; phi is drawn by that integral, which a table holds. Generators whose plane the
 * point is behind are not seen. Of an inward side (tube, cup) seen from outside, the part that the side itself hides
 * counts as missed. */
#include "geometry/solid_angle_shapes.h"
#include "geometry/solid_angle_table.h"

/* Azimuths are phi = x - asin(q sin(x)): for q near 1, the point being near the surface, that spreads the near part of
 * the surface over all x. In the plane across a cylinder x is the angle of incidence seen from outside, the direction
 * seen from inside. */
typedef struct view_cone {
    vec3 toward, side, axis; /* unit, from the axis to the point, and across */
    double offset;           /* of the point from the axis */
    double height;           /* of the point along the axis, from p0 */
    double radius_here;      /* of the cone at that height, below 0 beyond the apex */
    double r0, r1, length, slant;
    double taper, steepness; /* of r and of the height, along a generator */
    bool inward;
    double q;
    solid_angle_table table;
    double half; /* the half phi >= 0 of the solid angle */
} view_cone;

typedef struct generator {
    double sine, cosine; /* of phi */
    double slope;        /* dphi/dx */
    vec3 to_start;       /* from the point to its end at p0; coordinates toward, side, axis like all here */
    vec3 along;          /* unit */
    double s0, s1;       /* its ends, counted from the foot of the point on its line */
    double d0, d1;       /* their distances */
    double miss_squared; /* distance of the point from the line */
    double foot_radius;  /* r where s = 0, below 0 beyond the apex */
    double taper;        /* dr/ds */
    double measure;      /* H times the integral of r/D^3 */
} generator;

/* The integral of r/D^3 over the generator. */
static double distance_integral(const generator *g, double slant) {
    double ends = g->d0 * g->d1, drop = slant * (g->s0 + g->s1) / ends, sines;
    /* (s1/d1 - s0/d0)/miss^2, without the difference where both ends lie on the same side of the foot. */
    if (g->s0 * g->s1 > 0)
        sines = drop / (g->s0 * g->d1 + g->s1 * g->d0);
    else
        sines = (g->s1 * g->d0 - g->s0 * g->d1) / (ends * g->miss_squared);
    return g->foot_radius * sines + g->taper * drop / (g->d0 + g->d1);
}

static generator generator_at(const view_cone *w, double x) {
    generator g;
    double s = sin(x), c = cos(x), y_cosine = sqrt(fmax((1 - w->q * s) * (1 + w->q * s), 0));
    /* cos(y) - q cos(x), y = asin(q sin(x)), by its product with cos(y) + q cos(x) where it would cancel. */
    double excess = c > 0 ? (1 - w->q) * (1 + w->q) / (y_cosine + w->q * c) : y_cosine - w->q * c;
    g.sine = s * excess;
    g.cosine = c * y_cosine + w->q * s * s;
    g.slope = y_cosine > 0 ? excess / y_cosine : 1;
    g.taper = w->taper;
    g.to_start = (vec3){w->r0 * g.cosine - w->offset, w->r0 * g.sine, -w->height};
    vec3 to_end = {w->r1 * g.cosine - w->offset, w->r1 * g.sine, w->length - w->height};
    g.along = (vec3){g.taper * g.cosine, g.taper * g.sine, w->steepness};
    g.s0 = vec3_dot(g.to_start, g.along);
    g.s1 = vec3_dot(to_end, g.along);
    g.d0 = vec3_length(g.to_start);
    g.d1 = vec3_length(to_end);
    vec3 across = vec3_cross(g.d0 < g.d1 ? g.to_start : to_end, g.along);
    g.miss_squared = vec3_dot(across, across);
    g.foot_radius = w->r0 - g.taper * g.s0;
    double lowered = g.cosine > 0 ? g.sine * g.sine / (1 + g.cosine) : 1 - g.cosine;
    double in_front = (w->offset - w->radius_here - w->offset * lowered) * w->steepness;
    if (w->inward)
        in_front = -in_front;
    g.measure = 0;
    if (in_front > 0 && g.miss_squared > 0)
        g.measure = fmax(in_front * distance_integral(&g, w->slant), 0);
    return g;
}

/* The azimuths that face the point, as a range of x; false where there are none. */
static bool facing_range(view_cone *w, double rounding) {
    double here = w->radius_here, offset = w->offset;
    w->q = 0;
    w->table.start = 0;
    w->table.end = PI;
    if (w->inward) {
        if (here <= rounding - offset || (w->height >= 0 && w->height <= w->length && here < offset - rounding))
            return false;
        if (here > offset + rounding) {
            w->q = offset / here;
        } else if (here < offset - rounding) {
            w->table.start = acos(here / offset);
        } else {
            /* On the surface. Its own generator is not seen, and what is next to it only in the grazing directions of
             * the next 1e-5 rad, which contribute by 1e-10 of all at most: without them no digits are lost. */
            w->radius_here = offset;
            w->table.start = 1e-5;
        }
        return true;
    }
    if (here >= offset - rounding)
        return false;
    if (here > 0) {
        w->q = here / offset;
        w->table.end = 0.5 * PI;
    } else if (here > -offset) {
        w->table.end = acos(here / offset);
    }
    return true;
}

static bool view(view_cone *w, const shape *s, vec3 from) {
    vec3 from_p0 = vec3_subtract(from, s->cone.p0);
    w->axis = s->cone.axis;
    w->r0 = s->cone.r0;
    w->r1 = s->cone.r1;
    w->length = s->cone.length;
    w->slant = hypot(w->length, w->r1 - w->r0);
    w->taper = (w->r1 - w->r0) / w->slant;
    w->steepness = w->length / w->slant;
    w->inward = s->inward;
    w->height = vec3_dot(from_p0, w->axis);
    vec3 lateral = solid_angle_across(from_p0, w->axis);
    w->offset = vec3_length(lateral);
    double widest = fmax(w->r0, w->r1);
    w->toward = w->offset > 1e-12 * widest ? vec3_scale(1 / w->offset, lateral) : frame_around(w->axis).x;
    w->side = vec3_cross(w->axis, w->toward);
    w->radius_here = w->r0 + (w->r1 - w->r0) * (w->height / w->length);
    if (!facing_range(w, solid_angle_rounding(from, s->cone.p0) + 4 * DBL_EPSILON * (widest + w->length)))
        return false;
    for (int node = 0; node < SOLID_ANGLE_NODES; node++) {
        generator g = generator_at(w, solid_angle_table_node(&w->table, node));
        w->table.weight[node] = g.measure * g.slope;
    }
    solid_angle_table_complete(&w->table);
    w->half = solid_angle_table_integral(&w->table);
    return w->half > DBL_MIN;
}

/* Whether the inside of the side hides behind its outside from a point beyond the ends: the ray then comes in through
 * the side and not through the opening. The space between the ends is convex, so from inside it nothing hides. */
static bool hidden(const view_cone *w, vec3 to_point) {
    if (!w->inward || (w->height >= 0 && w->height <= w->length))
        return false;
    double opening = w->height < 0 ? 0 : w->length, opening_radius = w->height < 0 ? w->r0 : w->r1;
    double fraction = (opening - w->height) / to_point.z;
    double reach = hypot(w->offset + fraction * to_point.x, fraction * to_point.y);
    return reach > opening_radius * (1 + 1e-12);
}

/* The s up to which the integral of r/D^3 has reached the part v. With s = miss tan(a) it is, but for a factor,
 * foot_radius sin(a) - taper miss cos(a) = M sin(a - shift). */
static double draw_along(const generator *g, double v) {
    double miss = sqrt(g->miss_squared), shift = atan2(g->taper * miss, g->foot_radius);
    double first = sin(atan2(g->s0, miss) - shift), last = sin(atan2(g->s1, miss) - shift);
    double a = shift + asin(solid_angle_clamp(first + v * (last - first), -1, 1));
    return solid_angle_clamp(miss * tan(a), g->s0, g->s1);
}

solid_angle_sample solid_angle_cone_draw(const shape *s, vec3 from, double u, double v) {
    view_cone w;
    if (!view(&w, s, from))
        return (solid_angle_sample){{0, 0, 0}, 0, 0};
    double tabulated, x = solid_angle_table_find(&w.table, fabs(2 * u - 1) * w.half, &tabulated);
    generator g = generator_at(&w, x);
    vec3 to_point = vec3_add_scaled(g.to_start, draw_along(&g, v) - g.s0, g.along);
    if (u < 0.5)
        to_point.y = -to_point.y;
    double exact = g.measure * g.slope;
    double density = exact > 0 && !hidden(&w, to_point) ? tabulated / (exact * 2 * w.half) : 0;
    frame f = {w.toward, w.side, w.axis};
    return solid_angle_sample_at(frame_to_world(&f, to_point), density);
}

double solid_angle_cone_density(const shape *s, vec3 from, vec3 point) {
    view_cone w;
    if (!view(&w, s, from))
        return 0;
    frame f = {w.toward, w.side, w.axis};
    vec3 to_point = frame_to_local(&f, vec3_subtract(point, from));
    if (hidden(&w, to_point))
        return 0;
    double across = w.offset + to_point.x, side = fabs(to_point.y);
    double x = atan2(side, across - w.q * hypot(across, side));
    x = solid_angle_clamp(x, w.table.start, w.table.end);
    generator g = generator_at(&w, x);
    double exact = g.measure * g.slope;
    return exact > 0 ? solid_angle_table_weight(&w.table, x) / (exact * 2 * w.half) : 0;
}
