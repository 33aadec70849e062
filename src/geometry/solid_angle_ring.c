/* Disks and rings. In polar coordinates around the foot of the point, that is with the azimuth gamma from the direction
 * to the centre and c = height/distance, solid angle is dgamma dc. Every azimuth meets the ring in at most two
 * intervals, over which c is drawn uniformly; the azimuth is drawn by how long they are in c. Unlike the spherical
 * ellipse of I. Guillen et al., "Area-preserving parameterizations for spherical ellipses", 2017, this has no inverse
 * of elliptic integrals in it, takes a hole as it is, and loses no digits near, far and edge-on. */
#include "geometry/solid_angle_shapes.h"
#include "geometry/solid_angle_table.h"

/* How gamma depends on the tabulated x. */
typedef enum azimuth_map {
    PLAIN,   /* gamma = x */
    TANGENT, /* sin(gamma) = q sin(x): regular where gamma is tangent to the circle of radius q offset */
    GRADED,  /* gamma = pi/2 + x |x|: close where the foot is just inside a circle, whose far side is suddenly met there
              */
} azimuth_map;

typedef struct azimuth_range {
    azimuth_map map;
    double q;
    solid_angle_table table;
} azimuth_range;

typedef struct view_ring {
    vec3 to_foot;      /* from the point down to the plane */
    vec3 toward, side; /* unit vectors in the plane: from the foot to the centre, and across */
    double height;     /* of the point above the plane */
    double offset;     /* of the foot from the centre */
    double r0, r1;
    int range_count;
    azimuth_range ranges[3]; /* in the order of gamma */
    double half;             /* half the solid angle: gamma in [0, pi] */
} view_ring;

typedef struct azimuth {
    double sine, cosine;
    double slope; /* dgamma/dx */
} azimuth;

static azimuth azimuth_at(const azimuth_range *range, double x) {
    if (range->map == GRADED)
        return (azimuth){cos(x * x), -sin(x * fabs(x)), 2 * fabs(x)};
    double s = sin(x), c = cos(x);
    if (range->map == PLAIN)
        return (azimuth){s, c, 1};
    double sine = range->q * s, cosine = sqrt((1 - sine) * (1 + sine));
    return (azimuth){sine, cosine, cosine > 0 ? fmax(range->q * c, 0) / cosine : 1};
}

/* The x of a direction in the plane. */
static double place_of(const azimuth_range *range, double sine, double gamma) {
    double past = gamma - 0.5 * PI;
    switch (range->map) {
    case PLAIN:
        break;
    case TANGENT:
        return asin(fmin(sine / range->q, 1));
    case GRADED:
        return copysign(sqrt(fabs(past)), past);
    }
    return gamma;
}

/* Distances from the foot between which a ray in the plane is inside the circle; none where lower = upper. */
typedef struct span {
    double lower, upper;
} span;

static span inside_circle(double radius, double offset, azimuth a) {
    double across = offset * a.sine, along = offset * a.cosine;
    if (!(across < radius))
        return (span){0, 0};
    double half_chord = sqrt((radius - across) * (radius + across));
    /* The ends are along -+ half_chord, and `power` their product. */
    double power = (offset - radius) * (offset + radius);
    if (power <= 0)
        return (span){0, along > 0 ? along + half_chord : half_chord > along ? -power / (half_chord - along) : 0};
    if (along <= 0)
        return (span){0, 0};
    return (span){power / (along + half_chord), along + half_chord};
}

/* c(lower) - c(upper). */
static double span_measure(span s, double height) {
    if (!(s.upper > s.lower))
        return 0;
    double near = sqrt(height * height + s.lower * s.lower), far = sqrt(height * height + s.upper * s.upper);
    return height * (s.upper - s.lower) * (s.upper + s.lower) / (near * far * (near + far));
}

/* The parts of the ray in the plane that lie on the ring. */
static void ring_spans(const view_ring *w, azimuth a, span spans[2], double measures[2]) {
    span outer = inside_circle(w->r1, w->offset, a), inner = {0, 0};
    if (w->r0 > 0)
        inner = inside_circle(w->r0, w->offset, a);
    bool hole = inner.upper > inner.lower;
    spans[0] = hole ? (span){outer.lower, inner.lower} : outer;
    spans[1] = hole ? (span){inner.upper, outer.upper} : (span){0, 0};
    for (int i = 0; i < 2; i++)
        measures[i] = span_measure(spans[i], w->height);
}

static void add_range(view_ring *w, azimuth_map map, double q, double start, double end) {
    azimuth_range *range = &w->ranges[w->range_count++];
    range->map = map;
    range->q = q;
    range->table.start = start;
    range->table.end = end;
    for (int node = 0; node < SOLID_ANGLE_NODES; node++) {
        azimuth a = azimuth_at(range, solid_angle_table_node(&range->table, node));
        span spans[2];
        double measures[2];
        ring_spans(w, a, spans, measures);
        range->table.weight[node] = (measures[0] + measures[1]) * a.slope;
    }
    solid_angle_table_complete(&range->table);
    w->half += solid_angle_table_integral(&range->table);
}

/* False if nothing of the front is seen. Ranges end where an azimuth is tangent to a circle, and all is smooth between.
 */
static bool view(view_ring *w, const shape *s, vec3 from) {
    vec3 to_center = vec3_subtract(s->ring.center, from), normal = s->ring.normal;
    w->height = -vec3_dot(to_center, normal);
    w->r0 = s->ring.r0;
    w->r1 = s->ring.r1;
    if (!(w->height > solid_angle_rounding(from, s->ring.center)))
        return false;
    w->to_foot = vec3_scale(-w->height, normal);
    vec3 lateral = solid_angle_across(to_center, normal);
    w->offset = vec3_length(lateral);
    w->toward = w->offset > 1e-12 * w->r1 ? vec3_scale(1 / w->offset, lateral) : frame_around(normal).x;
    w->side = vec3_cross(normal, w->toward);
    w->range_count = 0;
    w->half = 0;
    const double quarter = 0.5 * PI;
    bool beside_hole = w->r0 > 0 && w->offset > w->r0;
    if (beside_hole)
        add_range(w, TANGENT, w->r0 / w->offset, 0, quarter);
    double around = w->offset > w->r0 ? w->r1 : w->r0, start = beside_hole ? asin(w->r0 / w->offset) : 0;
    if (w->offset > w->r1) {
        add_range(w, TANGENT, w->r1 / w->offset, beside_hole ? asin(w->r0 / w->r1) : 0, quarter);
    } else if (w->offset > 0.8 * around) {
        add_range(w, GRADED, 0, -sqrt(fmax(quarter - start, 0)), 0);
        add_range(w, GRADED, 0, 0, sqrt(quarter));
    } else {
        add_range(w, PLAIN, 0, start, PI);
    }
    return w->half > DBL_MIN;
}

static double azimuth_density(const view_ring *w, double tabulated, double exact) {
    return exact > 0 ? tabulated / (exact * 2 * w->half) : 0;
}

solid_angle_sample solid_angle_ring_draw(const shape *s, vec3 from, double u, double v) {
    view_ring w;
    if (!view(&w, s, from))
        return (solid_angle_sample){{0, 0, 0}, 0, 0};
    /* Azimuths from -pi to pi in their order. */
    double target = fabs(2 * u - 1) * w.half, tabulated;
    const azimuth_range *range = w.ranges, *last = w.ranges + w.range_count - 1;
    while (range < last && target >= solid_angle_table_integral(&range->table))
        target -= solid_angle_table_integral(&range++->table);
    azimuth a = azimuth_at(range, solid_angle_table_find(&range->table, target, &tabulated));
    span spans[2];
    double measures[2];
    ring_spans(&w, a, spans, measures);
    double measure = measures[0] + measures[1], part = v * measure;
    if (!(measure > 0))
        return (solid_angle_sample){{0, 0, 0}, 0, 0};
    int i = part >= measures[0] && measures[1] > 0;
    double share = solid_angle_clamp((part - (i ? measures[0] : 0)) / measures[i], 0, 1);
    double near = sqrt(w.height * w.height + spans[i].lower * spans[i].lower);
    double far = sqrt(w.height * w.height + spans[i].upper * spans[i].upper);
    double distance = near * far / (far - share * (far - near));
    double radius = sqrt(fmax((distance - w.height) * (distance + w.height), 0));
    radius = solid_angle_clamp(radius, spans[i].lower, spans[i].upper);
    vec3 to_point = vec3_add_scaled(w.to_foot, radius * a.cosine, w.toward);
    to_point = vec3_add_scaled(to_point, (u < 0.5 ? -radius : radius) * a.sine, w.side);
    return solid_angle_sample_at(to_point, azimuth_density(&w, tabulated, measure * a.slope));
}

double solid_angle_ring_density(const shape *s, vec3 from, vec3 point) {
    view_ring w;
    if (!view(&w, s, from))
        return 0;
    vec3 in_plane = vec3_subtract(vec3_subtract(point, from), w.to_foot);
    double along = vec3_dot(in_plane, w.toward), across = fabs(vec3_dot(in_plane, w.side));
    double gamma = atan2(across, along), sine = sin(gamma);
    bool toward_hole = gamma < 0.5 * PI && w.offset * sine < w.r0;
    const azimuth_range *range = w.ranges, *last = w.ranges + w.range_count - 1;
    if (w.offset > w.r0 && w.r0 > 0 && !toward_hole)
        range++;
    if (range->map == GRADED && range < last && gamma > 0.5 * PI)
        range++;
    double x = place_of(range, sine, gamma);
    azimuth a = azimuth_at(range, x);
    span spans[2];
    double measures[2];
    ring_spans(&w, a, spans, measures);
    double tabulated = solid_angle_table_weight(&range->table, x);
    return azimuth_density(&w, tabulated, (measures[0] + measures[1]) * a.slope);
}
