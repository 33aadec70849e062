/* What the new model's lobe reflects of a whole light: integrals along the light's outline. */
#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "brdf/constants.h"
#include "brdf/kernels.h"
#include "brdf/lobe_part.h"
#include "brdf/outline.h"
#include "brdf/parameters.h"
#include "graze/brdf_light.h"

/* A smaller cosine of the view would change little: the weight (15) is 2, but next to the horizon. */
static const double least_cosine = 1e-7;

/* Of the view's slope times the roughness, squared: less is nothing, and might not be a normal number. */
static const double least_square = 1e-290;

/* Less than this may be a small difference. */
static const double dim = 1e-3;

/* No more pieces than this are cut in two, whatever comes. */
static const int most_cuts = 300;

typedef struct field_integral {
    brdf_lobe_field field;
    const brdf_kernels *kernels;
    int cuts, count;
    brdf_piece *pieces; /* BRDF_MOST_PIECES */
    double sum;
    double above, below; /* the least |a|, about, of parts that are so */
} field_integral;

static void add_up(field_integral *i) {
    i->sum += i->kernels->field_along_pieces(&i->field, i->pieces, i->count);
    i->count = 0;
}

static void put(field_integral *i, const brdf_part *p, int points) {
    brdf_piece_of_part(&i->pieces[i->count++], p, points);
    if (i->count == BRDF_MOST_PIECES)
        add_up(i);
}

static void cut(field_integral *i, const brdf_part *p);

/* The first part within reach says from which side the field is to begin: the whole light may be there, as dim as it
 * is. */
static void integrate(field_integral *i, const brdf_part *p) {
    brdf_lobe_field *f = &i->field;
    if (brdf_part_is_beside(p))
        return;
    if (f->side == 0)
        f->side = brdf_part_side(p);
    if (brdf_part_is_above(p, f->side)) {
        i->above = fmin(i->above, brdf_part_distance(p));
        return;
    }
    int points = brdf_part_points(brdf_part_size(f, p));
    if (points > BRDF_MOST_GAUSS_POINTS && i->cuts < most_cuts) {
        cut(i, p);
        return;
    }
    if (f->side == 0)
        f->side = p->b[1] < 0 ? -1 : 1;
    if (brdf_part_is_below(p, f->side))
        i->below = fmin(i->below, brdf_part_distance(p));
    put(i, p, points < BRDF_MOST_GAUSS_POINTS ? points : BRDF_MOST_GAUSS_POINTS);
}

static void cut(field_integral *i, const brdf_part *p) {
    brdf_part first, second;
    i->cuts++;
    brdf_halve_part(&i->field, p, &first, &second);
    integrate(i, &first);
    integrate(i, &second);
}

static void add_edge(void *context, graze_vec3 from, graze_vec3 to) {
    field_integral *i = context;
    brdf_part p = brdf_part_of_edge(&i->field, from, to);
    integrate(i, &p);
}

static void add_arc(void *context, const brdf_arc *arc) {
    field_integral *i = context;
    brdf_part p = brdf_part_of_arc(&i->field, arc);
    integrate(i, &p);
}

/* In the coordinates of slope_plane.h. */
static void prepare_field(brdf_lobe_field *f, double ax, double ay, graze_vec3 v) {
    double x = ax * v.x, y = ay * v.y, square = x * x + y * y, length = sqrt(square);
    bool has_azimuth = square > least_square;
    double cosine = has_azimuth ? x / length : 1, sine = has_azimuth ? y / length : 0;
    f->lean = length / v.z;
    f->aa = ax * cosine * (ax * cosine) + ay * sine * (ay * sine);
    f->ab = (ay - ax) * (ay + ax) * cosine * sine;
    f->bb = ax * sine * (ax * sine) + ay * cosine * (ay * cosine);
    f->a_of_x = cosine / ax;
    f->a_of_y = sine / ay;
    f->b_of_x = -sine / ax;
    f->b_of_y = cosine / ay;
    f->a_of_d = f->a_of_x * v.x + f->a_of_y * v.y;
    f->b_of_d = f->b_of_x * v.x + f->b_of_y * v.y;
    f->c_of_d = v.z;
}

/* A polygon, or, without corners, an ellipse. */
typedef struct light {
    const graze_vec3 *corners;
    size_t count;
    graze_vec3 center, first, second;
} light;

static double integrate_along(field_integral *i, double side, const light *of) {
    const brdf_outline_visitor visitor = {add_edge, add_arc, i};
    i->field.side = side;
    i->cuts = i->count = 0;
    i->sum = 0;
    i->above = i->below = DBL_MAX;
    if (of->corners)
        brdf_outline_of_polygon(of->corners, of->count, &visitor);
    else
        brdf_outline_of_ellipse(of->center, of->first, of->second, &visitor);
    add_up(i);
    return fabs(i->sum) / brdf_pi;
}

/* Where the light turned out to be dim, and mostly on the side where the field does not vanish, the other is better. */
static double reflect(const graze_brdf *brdf, const light *of, graze_vec3 v) {
    if (!(v.z > 0))
        return 0;
    brdf_piece pieces[BRDF_MOST_PIECES];
    field_integral i = {.kernels = brdf_kernels_best(), .pieces = pieces};
    v.z = fmax(v.z, least_cosine);
    prepare_field(&i.field, roughness_in_range(brdf->alpha_x), roughness_in_range(brdf->alpha_y), v);
    double result = integrate_along(&i, 0, of);
    if (result < dim && i.below < i.above)
        result = integrate_along(&i, -i.field.side, of);
    return result > 0 ? fmin(result, 1) : 0;
}

double graze_brdf_polygon(const graze_brdf *brdf, const graze_vec3 *corners, size_t count, graze_vec3 v) {
    const light polygon = {.corners = corners, .count = count};
    return count < 3 ? 0 : reflect(brdf, &polygon, v);
}

double graze_brdf_ellipse(const graze_brdf *brdf, graze_vec3 center, graze_vec3 first, graze_vec3 second,
                          graze_vec3 v) {
    const light ellipse = {.center = center, .first = first, .second = second};
    return reflect(brdf, &ellipse, v);
}
