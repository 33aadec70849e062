/* Parts of outlines in the slope plane: cutting them, and how many points they need. */
#include "brdf/lobe_part.h"

#include <float.h>
#include <math.h>

/* Beyond this distance from the middle, the lobe is nothing: exp(-5.8^2) is 2e-15. */
static const double farthest = 5.8;

/* Rules of 4, 8, 12 and 16 points do for parts of these sizes. */
static const double size_for_4 = .02, size_for_8 = 2, size_for_12 = 6.5, size_for_16 = 14;

/* What matters to a size, relative to the coordinates. */
static const double cost_of_divisor = 16, cost_of_parameter = 12, cost_of_turn = 5, cost_of_misfit = 100;

static void set_coefficients(brdf_part *p, int i, const brdf_lobe_field *f, graze_vec3 e, double distance) {
    p->a[i] = f->a_of_x * e.x + f->a_of_y * e.y + f->a_of_d * distance;
    p->b[i] = f->b_of_x * e.x + f->b_of_y * e.y + f->b_of_d * distance;
    p->c[i] = e.z + f->c_of_d * distance;
}

static graze_vec3 scaled(double scale, graze_vec3 e) {
    return (graze_vec3){scale * e.x, scale * e.y, scale * e.z};
}

static void scale_coefficients(brdf_part *p, int i, double scale) {
    p->a[i] *= scale;
    p->b[i] *= scale;
    p->c[i] *= scale;
}

/* The same curve, by another u; those in the middle are to be divided by the root of `square` first. */
static void standardize(brdf_part *p, double square) {
    double begin = p->c[0], end = p->c[2], inverse = 1 / (begin * end * square);
    const double scales[] = {end * square * inverse, sqrt(inverse), begin * square * inverse};
    for (int i = 0; i < 3; ++i)
        scale_coefficients(p, i, scales[i]);
    if (!p->is_edge)
        for (int i = 0; i < 3; ++i)
            p->arc.c[i] = scaled(scales[i], p->arc.c[i]);
}

static double length_of(graze_vec3 e) {
    return sqrt(e.x * e.x + e.y * e.y + e.z * e.z);
}

static graze_vec3 middle_of(graze_vec3 a, graze_vec3 b) {
    return (graze_vec3){.5 * (a.x + b.x), .5 * (a.y + b.y), .5 * (a.z + b.z)};
}

/* With half the sum of both ends, which is as long as the cosine of half the angle between them. */
brdf_part brdf_part_of_edge(const brdf_lobe_field *f, graze_vec3 from, graze_vec3 to) {
    brdf_part p;
    p.is_edge = true;
    graze_vec3 half = middle_of(from, to);
    double square = half.x * half.x + half.y * half.y + half.z * half.z;
    set_coefficients(&p, 0, f, from, 1);
    set_coefficients(&p, 1, f, half, square);
    set_coefficients(&p, 2, f, to, 1);
    standardize(&p, square);
    return p;
}

/* In the middle of a half, of which distances are interpolated from `begin` by way of `control` to `end`. */
static double misfit_of(const brdf_lobe_field *f, const brdf_arc *half, double begin, double control, double end) {
    graze_vec3 e = brdf_middle_of_arc(half);
    double distance = length_of(e), interpolated = .25 * (begin + end) + .5 * control;
    return fabs(distance - interpolated) / (e.z + f->c_of_d * distance);
}

brdf_part brdf_part_of_arc(const brdf_lobe_field *f, const brdf_arc *arc) {
    brdf_part p;
    p.is_edge = false;
    p.arc = *arc;
    const graze_vec3 *c = arc->c;
    brdf_arc first, second;
    brdf_halve_arc(arc, &first, &second);
    double begin = length_of(c[0]), middle = length_of(second.c[0]), end = length_of(c[2]);
    double control = 2 * middle - .5 * (begin + end);
    set_coefficients(&p, 0, f, c[0], begin);
    set_coefficients(&p, 1, f, c[1], control);
    set_coefficients(&p, 2, f, c[2], end);
    p.misfit = misfit_of(f, &first, begin, .5 * (begin + control), middle) +
               misfit_of(f, &second, middle, .5 * (control + end), end);
    standardize(&p, 1);
    return p;
}

/* De Casteljau's halves. */
static void halve(const double *p, double *first, double *second) {
    double begin = .5 * (p[0] + p[1]), end = .5 * (p[1] + p[2]), middle = .5 * (begin + end);
    first[0] = p[0];
    first[1] = begin;
    first[2] = second[0] = middle;
    second[1] = end;
    second[2] = p[2];
}

void brdf_halve_part(const brdf_lobe_field *f, const brdf_part *p, brdf_part *first, brdf_part *second) {
    if (p->is_edge) {
        first->is_edge = second->is_edge = true;
        halve(p->a, first->a, second->a);
        halve(p->b, first->b, second->b);
        halve(p->c, first->c, second->c);
        standardize(first, 1);
        standardize(second, 1);
    } else {
        brdf_arc begin, end;
        brdf_halve_arc(&p->arc, &begin, &end);
        *first = brdf_part_of_arc(f, &begin);
        *second = brdf_part_of_arc(f, &end);
    }
}

static bool is_beyond(const brdf_part *p, const double *coordinate, double sign, double least) {
    return p->c[1] > 0 && sign * coordinate[0] > least && sign * coordinate[1] > least * p->c[1] &&
           sign * coordinate[2] > least;
}

bool brdf_part_is_beside(const brdf_part *p) {
    return is_beyond(p, p->a, 1, farthest) || is_beyond(p, p->a, -1, farthest);
}

bool brdf_part_is_above(const brdf_part *p, double side) {
    return is_beyond(p, p->b, side, farthest);
}

bool brdf_part_is_below(const brdf_part *p, double side) {
    return is_beyond(p, p->b, -side, farthest);
}

double brdf_part_side(const brdf_part *p) {
    return is_beyond(p, p->b, 1, 0) ? 1 : is_beyond(p, p->b, -1, 0) ? -1 : 0;
}

double brdf_part_distance(const brdf_part *p) {
    return (p->a[0] > 0) == (p->a[2] > 0) ? fmin(fabs(p->a[0]), fabs(p->a[2])) : 0;
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

double brdf_part_size(const brdf_lobe_field *f, const brdf_part *p) {
    double lean = f->lean, c = p->c[1];
    double begin_a = p->a[1] - c * p->a[0], end_a = c * p->a[2] - p->a[1];
    double speed = larger(begin_a * begin_a, end_a * end_a), bend = fabs(p->a[0] - 2 * p->a[1] + p->a[2]);
    if (!brdf_part_is_below(p, f->side)) {
        double begin_b = p->b[1] - c * p->b[0], end_b = c * p->b[2] - p->b[1];
        speed = larger(begin_a * begin_a + begin_b * begin_b, end_a * end_a + end_b * end_b);
        bend += fabs(p->b[0] - 2 * p->b[1] + p->b[2]);
    }
    double first = 1 + lean * p->a[0], middle = c + lean * p->a[1], last = 1 + lean * p->a[2];
    if (c <= 0 || middle <= 0)
        return DBL_MAX;
    double divisor = lean * lean * c * larger(begin_a * begin_a * last, end_a * end_a * first);
    double parameter = c < 1 ? (1 - c) * (2 - c) : c - 1;
    double size =
        4 * speed + bend + cost_of_divisor * (divisor / (first * middle * last)) + cost_of_parameter * parameter;
    if (!p->is_edge)
        size +=
            cost_of_turn * brdf_turn_of_arc(&p->arc) + cost_of_misfit * p->misfit * (fabs(f->a_of_d) + fabs(f->b_of_d));
    return size;
}

int brdf_part_points(double size) {
    return size < size_for_4 ? 4 : size < size_for_8 ? 8 : size < size_for_12 ? 12 : size > size_for_16 ? 20 : 16;
}

static void to_powers(double *powers, const double *p) {
    powers[0] = p[0];
    powers[1] = 2 * (p[1] - p[0]);
    powers[2] = p[0] - 2 * p[1] + p[2];
}

void brdf_piece_of_part(brdf_piece *piece, const brdf_part *p, int points) {
    piece->points = points;
    piece->is_edge = p->is_edge;
    if (p->is_edge) {
        const double change[] = {2 * (p->a[1] * p->c[0] - p->a[0] * p->c[1]), p->a[2] * p->c[0] - p->a[0] * p->c[2],
                                 2 * (p->a[2] * p->c[1] - p->a[1] * p->c[2])};
        to_powers(piece->polynomials[0], p->a);
        to_powers(piece->polynomials[1], p->b);
        to_powers(piece->polynomials[2], p->c);
        to_powers(piece->polynomials[3], change);
    } else {
        const graze_vec3 *c = p->arc.c;
        to_powers(piece->polynomials[0], (double[]){c[0].x, c[1].x, c[2].x});
        to_powers(piece->polynomials[1], (double[]){c[0].y, c[1].y, c[2].y});
        to_powers(piece->polynomials[2], (double[]){c[0].z, c[1].z, c[2].z});
    }
}
