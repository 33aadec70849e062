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

/* Gauss's points do for a piece of an arc that goes nowhere faster than this, in all that a `change` tells, over
 * u from one end to the other; and where one half of a piece that long is not so many times as long as the other. */
static const double fastest = 1.5, fastest_uneven = .15, uneven = 2;

/* Beyond this distance from the middle, the lobe is nothing: exp(-6.5^2) is 4e-19. */
static const double farthest = 6.5;

/* No more pieces than this are cut in two, whatever comes. */
static const int most_cuts = 300;

/* A point of an arc: its coordinates in the slope plane, and how the field goes there. */
typedef struct place {
    double u, a, b;
    double near_a, near_b, divisor; /* 1 + lean a */
    graze_vec3 direction;
} place;

/* How far what the field along an arc depends on goes from one place to another: the coordinates within reach, the
 * logarithm of the divisor, about, and the direction, twice. */
enum { FEATURES = 6 };
typedef struct change {
    double by[FEATURES];
} change;

typedef struct field_integral {
    brdf_lobe_field field;
    const brdf_kernels *kernels;
    double lowest, highest; /* b of the arcs' ends */
    int cuts;
    double sum;
} field_integral;

/* Further out, the field does not change any more. */
static double within_reach(double x) {
    x = x < farthest ? x : farthest;
    return x > -farthest ? x : -farthest;
}

static place place_at(const brdf_lobe_field *f, const brdf_arc *arc, double u) {
    graze_vec3 e = brdf_arc_at(arc, u);
    double per_distance = 1 / sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
    graze_vec3 l = {e.x * per_distance, e.y * per_distance, e.z * per_distance};
    double per_height = 1 / (l.z + f->v.z), x = (l.x + f->v.x) * per_height, y = (l.y + f->v.y) * per_height;
    place p = {.u = u, .a = f->a_of_x * x + f->a_of_y * y, .b = f->b_of_x * x + f->b_of_y * y, .direction = l};
    p.near_a = within_reach(p.a);
    p.near_b = within_reach(p.b);
    p.divisor = 1 + f->plane.lean * p.near_a;
    return p;
}

static void measure(void *context, const brdf_arc *arc, double from, double to) {
    field_integral *i = context;
    (void)to;
    double b = place_at(&i->field, arc, from).b;
    i->lowest = fmin(i->lowest, b);
    i->highest = fmax(i->highest, b);
}

static change change_between(const place *from, const place *to) {
    return (change){{to->near_a - from->near_a, to->near_b - from->near_b,
                     2 * (to->divisor - from->divisor) / (to->divisor + from->divisor),
                     2 * (to->direction.x - from->direction.x), 2 * (to->direction.y - from->direction.y),
                     2 * (to->direction.z - from->direction.z)}};
}

static double square_of(const change *c) {
    double sum = 0;
    for (int i = 0; i < FEATURES; ++i)
        sum += c->by[i] * c->by[i];
    return sum;
}

/* The speed, squared, with which a piece begins that goes so far in its first and in its second half, on the parabola
 * through both. */
static double square_of_speed(const change *first, const change *second) {
    double sum = 0;
    for (int i = 0; i < FEATURES; ++i) {
        double speed = 3 * first->by[i] - second->by[i];
        sum += speed * speed;
    }
    return sum;
}

static bool is_smooth(const place *from, const place *middle, const place *to) {
    change first = change_between(from, middle), second = change_between(middle, to);
    double begins = square_of_speed(&first, &second), ends = square_of_speed(&second, &first);
    double a = square_of(&first), b = square_of(&second);
    bool is_uneven = a > uneven * uneven * b || b > uneven * uneven * a;
    double limit = is_uneven ? fastest_uneven : fastest;
    return begins <= limit * limit && ends <= limit * limit;
}

static double least(double a, double b, double c) {
    double smaller = a < b ? a : b;
    return smaller < c ? smaller : c;
}

/* Whether there is nothing of the field as near to the three as they are to each other. */
static bool is_nothing(double base, const place *from, const place *middle, const place *to) {
    double length =
        fabs(middle->a - from->a) + fabs(middle->b - from->b) + fabs(to->a - middle->a) + fabs(to->b - middle->b);
    double reach = farthest + length;
    return least(from->a, middle->a, to->a) > reach || least(-from->a, -middle->a, -to->a) > reach ||
           (base > 0 && least(from->b, middle->b, to->b) > reach) ||
           (base < 0 && least(-from->b, -middle->b, -to->b) > reach);
}

static double integrate(field_integral *i, const brdf_arc *arc, const place *from, const place *to) {
    place middle = place_at(&i->field, arc, (from->u + to->u) / 2);
    if (is_nothing(i->field.base, from, &middle, to))
        return 0;
    if (i->cuts < most_cuts && !is_smooth(from, &middle, to)) {
        i->cuts++;
        double first = integrate(i, arc, from, &middle);
        return first + integrate(i, arc, &middle, to);
    }
    return i->kernels->field_along_arc(&i->field, arc, from->u, to->u);
}

static void add(void *context, const brdf_arc *arc, double from, double to) {
    field_integral *i = context;
    place begin = place_at(&i->field, arc, from), end = place_at(&i->field, arc, to);
    i->sum += integrate(i, arc, &begin, &end);
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
