/* Polygons, uniformly in solid angle. A polygon is drawn as the spherical triangles that make it up, chosen by their
 * solid angle; u is stretched over the chosen one, so that no third number is needed. A rectangle is drawn as a whole,
 * which keeps a stratified (u, v) stratified.
 *
 * No formula below subtracts nearly equal numbers when the polygon is small, far or seen edge-on: differences are taken
 * between vertices, where they are exact, and points are found on the polygon's edges, not by meeting its plane. So
 * nothing needs to change to area sampling for small solid angles. */
#include "geometry/solid_angle_shapes.h"

/* A triangle as seen from the point. */
typedef struct view_triangle {
    vec3 a, b;   /* displacements from the point to two of the vertices */
    vec3 ab, ac; /* edges */
    double length_a, length_b;
    double volume;       /* det of the displacements to the vertices, so oriented that the front's is positive */
    double cos_ab;       /* of the angle that edge ab subtends */
    double sine, cosine; /* of half the solid angle, but for a common factor; sine > 0 */
} view_triangle;

/* False if nothing of the front is seen. */
static bool view(view_triangle *t, const shape *s, const uint32_t triangle[3], vec3 from) {
    const vec3 *vertices = s->polygon.vertices;
    vec3 va = vertices[triangle[0]], vb = vertices[triangle[1]], vc = vertices[triangle[2]];
    t->a = vec3_subtract(va, from);
    t->ab = vec3_subtract(vb, va);
    t->ac = vec3_subtract(vc, va);
    vec3 normal = vec3_cross(t->ab, t->ac);
    t->volume = -vec3_dot(t->a, normal);
    if (!(t->volume > solid_angle_rounding(from, va) * vec3_length(normal)))
        return false;
    t->b = vec3_subtract(vb, from);
    vec3 c = vec3_subtract(vc, from);
    t->length_a = vec3_length(t->a);
    t->length_b = vec3_length(t->b);
    double length_c = vec3_length(c), lengths = t->length_a * t->length_b * length_c;
    t->cos_ab = vec3_dot(t->a, t->b) / (t->length_a * t->length_b);
    /* A. van Oosterom and J. Strackee, "The solid angle of a plane triangle", 1983. */
    t->sine = t->volume / lengths;
    t->cosine =
        1 + t->cos_ab + vec3_dot(t->b, c) / (t->length_b * length_c) + vec3_dot(t->a, c) / (t->length_a * length_c);
    return t->sine > 0;
}

static double triangle_solid_angle(const view_triangle *t) {
    return 2 * atan2(t->sine, t->cosine);
}

/* The point of the segment from p along `edge` that is seen at the angle from p with this sine and cosine. `along` and
 * `across` are edge's parts along the direction to p and perpendicular to it. */
static double cut_edge(double length_p, double along, double across, double sine, double cosine) {
    double numerator = length_p * sine, denominator = across * cosine - along * sine;
    return numerator < denominator ? numerator / denominator : 1;
}

/* The displacement to the drawn point. J. Arvo, "Stratified sampling of spherical triangles", 1995, in a form of our
 * own: C' on the arc from A to C at the angle phi cuts off a triangle ABC' of solid angle omega' if tan(phi/2) = s (1 +
 * A.B) / (k cos(omega'/2) - s B.T),  s = sin(omega'/2),  k = det(A, B, T), T being the unit tangent at A towards C.
 * Everything here is multiplied by the length of ac's part along T. */
static vec3 draw_triangle(const view_triangle *t, double solid_angle, double u, double v) {
    vec3 unit_a = vec3_scale(1 / t->length_a, t->a), unit_b = vec3_scale(1 / t->length_b, t->b);
    double along = vec3_dot(t->ac, unit_a);
    vec3 tangent = vec3_add_scaled(t->ac, -along, unit_a);
    double across = vec3_length(tangent);
    double volume = t->volume / (t->length_a * t->length_b);
    double s = sin(0.5 * u * solid_angle), c = cos(0.5 * u * solid_angle);
    double x = s * (1 + t->cos_ab) * across, y = volume * c - s * vec3_dot(unit_b, tangent);
    double norm = x * x + y * y;
    double cut = norm > 0 ? cut_edge(t->length_a, along, across, 2 * x * y / norm, (y - x) * (y + x) / norm) : u;
    /* From B to C', the cosine of the angle from B uniformly. */
    vec3 edge = vec3_add_scaled(vec3_negate(t->ab), cut, t->ac);
    vec3 c_cut = vec3_add(t->b, edge);
    along = vec3_dot(edge, unit_b);
    across = vec3_length(vec3_add_scaled(edge, -along, unit_b));
    double length_c = vec3_length(c_cut);
    if (!(length_c > 0))
        return t->b;
    double cosine = vec3_dot(c_cut, unit_b) / length_c, sine = across / length_c;
    double lowered = v * (cosine > 0 ? sine * sine / (1 + cosine) : 1 - cosine);
    cut = cut_edge(t->length_b, along, across, sqrt(lowered * fmax(2 - lowered, 0)), 1 - lowered);
    return vec3_add_scaled(t->b, cut, edge);
}

typedef struct complex_number {
    double re, im;
} complex_number;

static complex_number times(complex_number a, complex_number b) {
    return (complex_number){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* Both series to 2^-58 up to this angle, which takes a fraction of what libm's functions do for any. */
#define SMALL_ANGLE 0.5

static complex_number direction_at(double angle) {
    if (!(angle < SMALL_ANGLE))
        return (complex_number){cos(angle), sin(angle)};
    double x = angle * angle, x2 = x * x, x4 = x2 * x2;
    double c = ((1 - x / 2) + x2 * (1. / 24 - x * (1. / 720))) +
               x4 * ((1. / 40320 - x * (1. / 3628800)) + x2 * (1. / 479001600 - x * (1. / 87178291200)));
    double s = ((1 - x * (1. / 6)) + x2 * (1. / 120 - x * (1. / 5040))) +
               x4 * ((1. / 362880 - x * (1. / 39916800)) + x2 * (1. / 6227020800 - x * (1. / 1307674368000)));
    return (complex_number){c, angle * s};
}

/* The argument, in 0 .. 2 pi: where it is small, twice the arc tangent of that of its half, as a series. */
static double argument(complex_number a) {
    double half = a.im / (sqrt(a.re * a.re + a.im * a.im) + a.re), x = -half * half;
    if (!(half > 0 && a.re > 0 && x > -0.0625)) {
        double angle = atan2(a.im, a.re);
        return angle < 0 ? angle + 2 * PI : angle;
    }
    double x2 = x * x, x4 = x2 * x2;
    double low = (1 + x * (1. / 3)) + x2 * (1. / 5 + x * (1. / 7));
    double middle = (1. / 9 + x * (1. / 11)) + x2 * (1. / 13 + x * (1. / 15));
    double high = (1. / 17 + x * (1. / 19)) + x2 * (1. / 21 + x * (1. / 23));
    return 2 * half * ((low + x4 * middle) + x4 * x4 * (high + x4 * (1. / 25)));
}

/* A rectangle seen from the origin of the frame x, y, normal: [x0, x1] times [y0, y1] at z = -height. */
typedef struct view_rectangle {
    const shape_rectangle *sides;
    vec3 corner; /* from the point to the first corner */
    double x0, x1, y0, y1, height;
    double reach0, reach1; /* |(y0, height)|, |(y1, height)| */
    double solid_angle;
    complex_number start; /* its argument is the solid angle between the lines x = 0 and x = x0, y in [y0, y1] */
} view_rectangle;

/* The argument is the solid angle of [0, x] times [0, y]: the tangent of that is x y / (height r). */
static complex_number corner_term(double x, double y, double height) {
    return (complex_number){height * sqrt(x * x + y * y + height * height), x * y};
}

static complex_number conjugate(complex_number a) {
    return (complex_number){a.re, -a.im};
}

/* Whether the polygon is a rectangle whose solid angle and shape suit draw_rectangle. Corner terms cancel where the
 * solid angle is small, and x is lost where it is far greater than the height; triangles do better there. */
static bool view_as_rectangle(view_rectangle *r, shape_rectangle *room, const shape *s, vec3 from) {
    r->sides = s->polygon.rectangle;
    if (!r->sides) {
        if (!shape_is_rectangle(s, room))
            return false;
        r->sides = room;
    }
    r->corner = vec3_subtract(s->polygon.vertices[0], from);
    r->x0 = vec3_dot(r->corner, r->sides->x);
    r->y0 = vec3_dot(r->corner, r->sides->y);
    r->x1 = r->x0 + r->sides->length_x;
    r->y1 = r->y0 + r->sides->length_y;
    r->height = -vec3_dot(r->corner, vec3_cross(r->sides->x, r->sides->y));
    double h = r->height, most = 1e3 * h;
    if (!(r->x0 > -most && r->x1 < most && r->y0 > -most && r->y1 < most))
        return false;
    r->reach0 = sqrt(r->y0 * r->y0 + h * h);
    r->reach1 = sqrt(r->y1 * r->y1 + h * h);
    r->start = times(corner_term(r->x0, r->y1, h), conjugate(corner_term(r->x0, r->y0, h)));
    complex_number end = times(corner_term(r->x1, r->y1, h), conjugate(corner_term(r->x1, r->y0, h)));
    complex_number whole = times(end, conjugate(r->start));
    r->solid_angle = argument(whole);
    return r->solid_angle > 1e-5;
}

/* How far the distance along the drawn direction may be taken for the length of what leads there: the sine of the
 * elevation, and how many times farther the first corner may be, for roundings to stay below 1e-14. */
#define TAME_SINE   0.8
#define TAME_CORNER 2.0

/* After C. Urena, M. Fajardo and A. King, "An area-preserving parametrization for spherical rectangles", 2013, with an
 * inversion of our own: with X = x/|(x, height)| and Y_i = y_i/|(y_i, height)| the solid angle between the lines 0 and
 * x is asin(X Y1) - asin(X Y0), and setting that to tau gives X = sin(tau) / sqrt(Y0^2 + Y1^2 - 2 Y0 Y1 cos(tau)).
 * Numerator and denominator are multiplied by both lengths, and tau is turned on from where it starts. */
static solid_angle_sample draw_rectangle(const view_rectangle *r, double u, double v) {
    const shape_rectangle *sides = r->sides;
    double h = r->height, both = r->reach0 * r->reach1, turn = u * r->solid_angle;
    complex_number tau = times(r->start, direction_at(turn));
    double size = (r->x0 * r->x0 + h * h) * both; /* of `start` */
    double sine = both * tau.im / size, cosine = tau.re / size;
    double a = r->y0 * r->reach1, b = r->y1 * r->reach0, side2 = a * a + b * b - 2 * a * b * cosine;
    double rest = side2 - sine * sine, x = rest > 0 ? h * sine / sqrt(rest) : sine > 0 ? r->x1 : r->x0;
    /* x^2 + h^2, without waiting for the root where x is not on an edge */
    double reach2 = h * h * side2 / rest;
    if (!(x > r->x0 && x < r->x1)) {
        x = solid_angle_clamp(x, r->x0, r->x1);
        reach2 = x * x + h * h;
    }
    /* On the line x the sine of the elevation in y's direction uniformly. */
    double y0 = r->y0 / sqrt(r->y0 * r->y0 + reach2), y1 = r->y1 / sqrt(r->y1 * r->y1 + reach2);
    double y_sine = y0 + v * (y1 - y0);
    double cosine2 = (1 - y_sine) * (1 + y_sine), distance2 = reach2 / cosine2, distance = sqrt(distance2);
    double y = solid_angle_clamp(y_sine * distance, r->y0, r->y1);
    vec3 to_point = vec3_add_scaled(vec3_add_scaled(r->corner, x - r->x0, sides->x), y - r->y0, sides->y);
    if (fabs(y_sine) < TAME_SINE && vec3_dot(r->corner, r->corner) < TAME_CORNER * TAME_CORNER * distance2)
        return (solid_angle_sample){vec3_scale(1 / distance, to_point), distance, 1 / r->solid_angle};
    return solid_angle_sample_at(to_point, 1 / r->solid_angle);
}

double solid_angle_polygon(const shape *s, vec3 from) {
    view_rectangle r;
    shape_rectangle room;
    if (view_as_rectangle(&r, &room, s, from))
        return r.solid_angle;
    double sum = 0;
    for (uint32_t i = 0; i < s->polygon.triangle_count; i++) {
        view_triangle t;
        if (view(&t, s, s->polygon.triangles[i], from))
            sum += triangle_solid_angle(&t);
    }
    return sum > DBL_MIN ? sum : 0;
}

/* The triangles of small polygons are kept between adding them up and choosing one. */
enum { KEPT = 4 };

typedef struct kept_triangle {
    view_triangle view;
    double solid_angle; /* 0 where nothing of the front is seen */
} kept_triangle;

static void keep(kept_triangle *k, const shape *s, uint32_t triangle, vec3 from) {
    k->solid_angle = view(&k->view, s, s->polygon.triangles[triangle], from) ? triangle_solid_angle(&k->view) : 0;
}

static solid_angle_sample draw_triangles(const shape *s, vec3 from, double u, double v) {
    kept_triangle kept[KEPT + 1], *last = &kept[KEPT];
    uint32_t count = s->polygon.triangle_count;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        kept_triangle *k = i < KEPT ? &kept[i] : last;
        keep(k, s, i, from);
        sum += k->solid_angle;
    }
    if (!(sum > DBL_MIN))
        return (solid_angle_sample){{0, 0, 0}, 0, 0};
    double rest = u * sum;
    kept_triangle chosen = {.solid_angle = 0};
    for (uint32_t i = 0; i < count; i++) {
        kept_triangle *k = i < KEPT ? &kept[i] : last;
        if (k == last)
            keep(k, s, i, from);
        if (!(k->solid_angle > 0))
            continue;
        rest -= chosen.solid_angle;
        chosen = *k;
        if (rest < chosen.solid_angle)
            break;
    }
    double within = fmin(rest / chosen.solid_angle, 1);
    return solid_angle_sample_at(draw_triangle(&chosen.view, chosen.solid_angle, within, v), 1 / sum);
}

solid_angle_sample solid_angle_polygon_draw(const shape *s, vec3 from, double u, double v) {
    view_rectangle r;
    shape_rectangle room;
    if (view_as_rectangle(&r, &room, s, from))
        return draw_rectangle(&r, u, v);
    return draw_triangles(s, from, u, v);
}
