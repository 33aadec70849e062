/* What the new model's lobe reflects of a whole light: integrals along the light's outline. */
#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "brdf/constants.h"
#include "brdf/kernels.h"
#include "brdf/parameters.h"
#include "graze/brdf_light.h"

/* A smaller cosine of the view would change little: the weight (15) is 2, but next to the horizon. */
static const double least_cosine = 1e-7;

/* Gauss's points do for a piece of an arc that goes nowhere faster than this, in all that a `place` keeps of it, over
 * u from one end to the other; and where one half of a piece that long is not so many times as long as the other. */
static const double fastest = 1.5, fastest_uneven = .15, uneven = 2;

/* Beyond this distance from the middle, the lobe is nothing: exp(-6.5^2) is 4e-19. */
static const double farthest = 6.5;

/* No more pieces than this are cut in two, whatever comes. */
static const int most_cuts = 300;

/* A point of an arc, and what the field along the arc goes with: coordinates in the slope plane, the logarithm of
 * 1 + lean a, and the direction, twice. */
enum { FEATURES = 6 };
typedef struct place {
    double u, a, b;
    double features[FEATURES];
} place;

typedef struct field_integral {
    brdf_lobe_field field;
    const brdf_kernels *kernels;
    double lowest, highest; /* b of the arcs' ends */
    int cuts;
    double sum;
} field_integral;

/* Further out, the field does not change any more. */
static double within_reach(double coordinate) {
    return fmax(fmin(coordinate, farthest), -farthest);
}

static place place_at(const brdf_lobe_field *f, const brdf_arc *arc, double u) {
    graze_vec3 e = brdf_arc_at(arc, u);
    double distance = sqrt(e.x * e.x + e.y * e.y + e.z * e.z), height = e.z + distance * f->v.z;
    double x = (e.x + distance * f->v.x) / height, y = (e.y + distance * f->v.y) / height, twice = 2 / distance;
    double a = f->a_of_x * x + f->a_of_y * y, b = f->b_of_x * x + f->b_of_y * y;
    double near_a = within_reach(a), near_b = within_reach(b), logarithm = log(fabs(1 + f->plane.lean * near_a));
    return (place){u, a, b, {near_a, near_b, logarithm, twice * e.x, twice * e.y, twice * e.z}};
}

static void measure(void *context, const brdf_arc *arc, double from, double to) {
    field_integral *i = context;
    (void)to;
    double b = place_at(&i->field, arc, from).b;
    i->lowest = fmin(i->lowest, b);
    i->highest = fmax(i->highest, b);
}

static double distance_between(place from, place to) {
    double sum = 0;
    for (int i = 0; i < FEATURES; ++i)
        sum += (to.features[i] - from.features[i]) * (to.features[i] - from.features[i]);
    return sqrt(sum);
}

/* At u of the first of three places, on the parabola through them; their u are evenly spaced over a length of 1. */
static double speed_at_end(place end, place middle, place other) {
    double sum = 0;
    for (int i = 0; i < FEATURES; ++i) {
        double speed = 4 * middle.features[i] - 3 * end.features[i] - other.features[i];
        sum += speed * speed;
    }
    return sqrt(sum);
}

static bool is_smooth(place from, place middle, place to) {
    double speed = fmax(speed_at_end(from, middle, to), speed_at_end(to, middle, from));
    double first = distance_between(from, middle), second = distance_between(middle, to);
    bool is_uneven = fmax(first, second) > uneven * fmin(first, second);
    return speed <= (is_uneven ? fastest_uneven : fastest);
}

/* Whether there is nothing of the field as near to the three as they are to each other. */
static bool is_nothing(double base, place from, place middle, place to) {
    double reach = farthest + hypot(middle.a - from.a, middle.b - from.b) + hypot(to.a - middle.a, to.b - middle.b);
    double least_a = fmin(fmin(from.a, to.a), middle.a), most_a = fmax(fmax(from.a, to.a), middle.a);
    double least_b = fmin(fmin(from.b, to.b), middle.b), most_b = fmax(fmax(from.b, to.b), middle.b);
    return least_a > reach || most_a < -reach || (base > 0 && least_b > reach) || (base < 0 && most_b < -reach);
}

static double integrate(field_integral *i, const brdf_arc *arc, place from, place to) {
    place middle = place_at(&i->field, arc, (from.u + to.u) / 2);
    if (is_nothing(i->field.base, from, middle, to))
        return 0;
    if (i->cuts < most_cuts && !is_smooth(from, middle, to)) {
        i->cuts++;
        double first = integrate(i, arc, from, middle);
        return first + integrate(i, arc, middle, to);
    }
    return i->kernels->field_along_arc(&i->field, arc, from.u, to.u);
}

static void add(void *context, const brdf_arc *arc, double from, double to) {
    field_integral *i = context;
    i->sum += integrate(i, arc, place_at(&i->field, arc, from), place_at(&i->field, arc, to));
}

static void prepare_field(brdf_lobe_field *f, const graze_brdf *brdf, graze_vec3 v) {
    const graze_brdf in_range = brdf_in_range(brdf);
    v.z = fmax(v.z, least_cosine);
    brdf_slope_plane_prepare(&f->plane, &in_range, v);
    double x = in_range.alpha_x * v.x, y = in_range.alpha_y * v.y, length = hypot(x, y);
    double cosine = length > 0 ? x / length : 1, sine = length > 0 ? y / length : 0;
    f->v = v;
    f->a_of_x = cosine / in_range.alpha_x;
    f->a_of_y = sine / in_range.alpha_y;
    f->b_of_x = -sine / in_range.alpha_x;
    f->b_of_y = cosine / in_range.alpha_y;
}

static double reflect(const graze_brdf *brdf, const brdf_outline *outline, graze_vec3 v) {
    if (!(v.z > 0))
        return 0;
    field_integral i = {.kernels = brdf_kernels_best(), .lowest = DBL_MAX, .highest = -DBL_MAX};
    prepare_field(&i.field, brdf, v);
    brdf_outline_visit(outline, measure, &i);
    i.field.base = i.lowest > 0 ? 1 : i.highest < 0 ? -1 : 0;
    brdf_outline_visit(outline, add, &i);
    double result = fabs(i.sum) / brdf_pi;
    return result > 0 ? fmin(result, 1) : 0;
}

double graze_brdf_polygon(const graze_brdf *brdf, const graze_vec3 *corners, size_t count, graze_vec3 v) {
    const brdf_outline outline = {.corners = corners, .count = count};
    return count < 3 ? 0 : reflect(brdf, &outline, v);
}

double graze_brdf_ellipse(const graze_brdf *brdf, graze_vec3 center, graze_vec3 first, graze_vec3 second,
                          graze_vec3 v) {
    const brdf_outline outline = {.center = center, .first = first, .second = second};
    return reflect(brdf, &outline, v);
}
