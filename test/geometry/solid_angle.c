/* Sampling by solid angle, against quadrature over the shapes' areas. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/angle.h"
#include "geometry/solid_angle.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* A number of a fixed sequence, in [0,1). */
static double uniform(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    uint64_t x = (*state ^ *state >> 29) * 0xd6e8feb86659fd93u;
    return (double)((x ^ x >> 32) >> 11) * 0x1p-53;
}

static vec3 random_direction(uint64_t *state) {
    double z = 2 * uniform(state) - 1, azimuth = 2 * PI * uniform(state), r = sqrt(fmax(1 - z * z, 0));
    return (vec3){r * cos(azimuth), r * sin(azimuth), z};
}

/* ---- Shapes. All have a size near 1 and their frame at some place off the origin. ---- */

typedef struct subject {
    const char *name;
    shape shape;
    vec3 vertices[8];
    uint32_t triangles[6][3];
} subject;

static const vec3 place_origin = {0.3, -0.7, 1.1};

static vec3 placed_direction(vec3 v) {
    /* An orthonormal frame along nothing in particular. */
    static const vec3 x = {2.0 / 3, -1.0 / 3, 2.0 / 3}, y = {2.0 / 3, 2.0 / 3, -1.0 / 3},
                      z = {-1.0 / 3, 2.0 / 3, 2.0 / 3};
    return vec3_add_scaled(vec3_add_scaled(vec3_scale(v.x, x), v.y, y), v.z, z);
}

static vec3 placed(vec3 p) {
    return vec3_add(place_origin, placed_direction(p));
}

static void make_polygon(subject *s, const char *name, const double (*plane)[2], uint32_t count,
                         const uint32_t (*triangles)[3], uint32_t triangle_count) {
    *s = (subject){.name = name};
    for (uint32_t i = 0; i < count; i++)
        s->vertices[i] = placed((vec3){plane[i][0], plane[i][1], 0});
    memcpy(s->triangles, triangles, triangle_count * sizeof *triangles);
    s->shape.kind = SHAPE_POLYGON;
    s->shape.polygon.vertices = s->vertices;
    s->shape.polygon.vertex_count = count;
    s->shape.polygon.triangles = (const uint32_t(*)[3])s->triangles;
    s->shape.polygon.triangle_count = triangle_count;
    s->shape.polygon.normal = placed_direction((vec3){0, 0, 1});
    s->shape.polygon.offset = vec3_dot(s->shape.polygon.normal, place_origin);
    for (uint32_t i = 0; i < triangle_count; i++) {
        const uint32_t *t = s->triangles[i];
        vec3 ab = vec3_subtract(s->vertices[t[1]], s->vertices[t[0]]);
        vec3 ac = vec3_subtract(s->vertices[t[2]], s->vertices[t[0]]);
        s->shape.polygon.area += 0.5 * vec3_length(vec3_cross(ab, ac));
    }
}

static void make_sphere(subject *s, const char *name, bool inward) {
    *s = (subject){.name = name, .shape = {.kind = SHAPE_SPHERE, .inward = inward}};
    s->shape.sphere.center = place_origin;
    s->shape.sphere.radius = 0.8;
}

static void make_ring(subject *s, const char *name, double r0, double r1) {
    *s = (subject){.name = name, .shape = {.kind = SHAPE_RING}};
    s->shape.ring.center = place_origin;
    s->shape.ring.normal = placed_direction((vec3){0, 0, 1});
    s->shape.ring.r0 = r0;
    s->shape.ring.r1 = r1;
}

static void make_cone(subject *s, const char *name, bool inward, double r0, double r1, double length) {
    *s = (subject){.name = name, .shape = {.kind = SHAPE_CONE, .inward = inward}};
    s->shape.cone.p0 = place_origin;
    s->shape.cone.axis = placed_direction((vec3){0, 0, 1});
    s->shape.cone.p1 = vec3_add_scaled(place_origin, length, s->shape.cone.axis);
    s->shape.cone.r0 = r0;
    s->shape.cone.r1 = r1;
    s->shape.cone.length = length;
}

enum {
    TRIANGLE,
    SLIVER,
    RECTANGLE,
    STRIP,
    QUAD,
    ELL,
    OCTAGON,
    SPHERE,
    BUBBLE,
    DISK,
    RING,
    RIM,
    CYLINDER,
    TUBE,
    CONE,
    FRUSTUM,
    CUP,
    SUBJECTS
};

/* The subjects hold pointers into themselves: they are made where they stay. */
static void make_subjects(subject *s) {
    static const uint32_t fan[6][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}};
    static const uint32_t ell_triangles[4][3] = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
    static const double triangle[][2] = {{-0.5, -0.4}, {0.7, -0.3}, {0.1, 0.6}};
    static const double sliver[][2] = {{-0.7, 0}, {0.7, -0.001}, {0.6, 0.002}};
    static const double rectangle[][2] = {{-0.5, -0.3}, {0.4, -0.3}, {0.4, 0.5}, {-0.5, 0.5}};
    static const double strip[][2] = {{-1, -0.01}, {1, -0.01}, {1, 0.01}, {-1, 0.01}};
    static const double quad[][2] = {{-0.5, -0.5}, {0.6, -0.4}, {0.4, 0.6}, {-0.7, 0.3}};
    static const double ell[][2] = {{-0.5, -0.5}, {0.6, -0.5}, {0.6, 0}, {0, 0}, {0, 0.6}, {-0.5, 0.6}};
    static const double octagon[][2] = {{-0.2, -0.6}, {0.3, -0.5}, {0.6, -0.2}, {0.6, 0.3},
                                        {0.2, 0.6},   {-0.3, 0.6}, {-0.5, 0.2}, {-0.5, -0.3}};
    make_polygon(&s[TRIANGLE], "triangle", triangle, 3, fan, 1);
    make_polygon(&s[SLIVER], "sliver", sliver, 3, fan, 1);
    make_polygon(&s[RECTANGLE], "rectangle", rectangle, 4, fan, 2);
    make_polygon(&s[STRIP], "strip", strip, 4, fan, 2);
    make_polygon(&s[QUAD], "quadrilateral", quad, 4, fan, 2);
    make_polygon(&s[ELL], "L", ell, 6, ell_triangles, 4);
    make_polygon(&s[OCTAGON], "octagon", octagon, 8, fan, 6);
    make_sphere(&s[SPHERE], "sphere", false);
    make_sphere(&s[BUBBLE], "bubble", true);
    make_ring(&s[DISK], "disk", 0, 0.8);
    make_ring(&s[RING], "ring", 0.3, 0.8);
    make_ring(&s[RIM], "rim", 0.79, 0.8);
    make_cone(&s[CYLINDER], "cylinder", false, 0.4, 0.4, 1.2);
    make_cone(&s[TUBE], "tube", true, 0.4, 0.4, 1.2);
    make_cone(&s[CONE], "cone", false, 0.5, 0, 0.9);
    make_cone(&s[FRUSTUM], "frustum", false, 0.2, 0.6, 0.7);
    make_cone(&s[CUP], "cup", true, 0.2, 0.6, 0.7);
}

/* ---- The surfaces as patches over the unit square, for quadrature and bins. ---- */

typedef struct element {
    vec3 point, normal;
    double area; /* per unit of the square */
} element;

static int patch_count(const shape *s) {
    return s->kind == SHAPE_POLYGON ? (int)s->polygon.triangle_count : 1;
}

static element patch_at(const shape *s, int patch, double a, double b) {
    double c = cos(2 * PI * b), d = sin(2 * PI * b);
    if (s->kind == SHAPE_POLYGON) {
        const uint32_t *t = s->polygon.triangles[patch];
        vec3 v0 = s->polygon.vertices[t[0]], v1 = s->polygon.vertices[t[1]], v2 = s->polygon.vertices[t[2]];
        vec3 x = vec3_subtract(v1, v0), y = vec3_subtract(v2, v1);
        vec3 point = vec3_add_scaled(vec3_add_scaled(v0, a, x), a * b, y);
        return (element){point, s->polygon.normal, a * vec3_length(vec3_cross(x, y))};
    }
    if (s->kind == SHAPE_SPHERE) {
        double z = 2 * a - 1, r = sqrt(1 - z * z), radius = s->sphere.radius;
        vec3 n = {r * c, r * d, z};
        return (element){vec3_add_scaled(s->sphere.center, radius, n), s->inward ? vec3_negate(n) : n,
                         4 * PI * radius * radius};
    }
    frame f = frame_around(s->kind == SHAPE_RING ? s->ring.normal : s->cone.axis);
    if (s->kind == SHAPE_RING) {
        double inner = s->ring.r0 * s->ring.r0, outer = s->ring.r1 * s->ring.r1, r = sqrt(inner + a * (outer - inner));
        vec3 offset = frame_to_world(&f, (vec3){r * c, r * d, 0});
        return (element){vec3_add(s->ring.center, offset), s->ring.normal, PI * (outer - inner)};
    }
    double taper = s->cone.r1 - s->cone.r0, r = s->cone.r0 + a * taper, slant = hypot(s->cone.length, taper);
    vec3 point = vec3_add(s->cone.p0, frame_to_world(&f, (vec3){r * c, r * d, a * s->cone.length}));
    double sign = (s->inward ? -1 : 1) / slant;
    vec3 n = {c * s->cone.length, d * s->cone.length, -taper};
    return (element){point, vec3_scale(sign, frame_to_world(&f, n)), 2 * PI * r * slant};
}

static void patch_coordinates(const shape *s, vec3 point, int *patch, double *a, double *b) {
    *patch = 0;
    if (s->kind == SHAPE_POLYGON) {
        double best = -DBL_MAX;
        for (int i = 0; i < patch_count(s); i++) {
            const uint32_t *t = s->polygon.triangles[i];
            vec3 v0 = s->polygon.vertices[t[0]];
            vec3 x = vec3_subtract(s->polygon.vertices[t[1]], v0), y = vec3_subtract(s->polygon.vertices[t[2]], v0);
            vec3 n = vec3_cross(x, y), p = vec3_subtract(point, v0);
            double weight1 = vec3_dot(vec3_cross(p, y), n) / vec3_dot(n, n);
            double weight2 = vec3_dot(vec3_cross(x, p), n) / vec3_dot(n, n);
            double inside = fmin(fmin(weight1, weight2), 1 - weight1 - weight2);
            if (inside > best) {
                best = inside;
                *patch = i;
                *a = weight1 + weight2;
                *b = *a > 0 ? weight2 / *a : 0;
            }
        }
        return;
    }
    vec3 center = s->kind == SHAPE_SPHERE ? s->sphere.center : s->kind == SHAPE_RING ? s->ring.center : s->cone.p0;
    vec3 local = vec3_subtract(point, center);
    if (s->kind != SHAPE_SPHERE) {
        frame f = frame_around(s->kind == SHAPE_RING ? s->ring.normal : s->cone.axis);
        local = frame_to_local(&f, local);
    }
    double azimuth = atan2(local.y, local.x) / (2 * PI), r2 = local.x * local.x + local.y * local.y;
    *b = azimuth < 0 ? azimuth + 1 : azimuth;
    if (s->kind == SHAPE_SPHERE)
        *a = 0.5 * (local.z / s->sphere.radius + 1);
    else if (s->kind == SHAPE_CONE)
        *a = local.z / s->cone.length;
    else
        *a = (r2 - s->ring.r0 * s->ring.r0) / (s->ring.r1 * s->ring.r1 - s->ring.r0 * s->ring.r0);
}

/* The element at a point, or at a point of the shape close by. */
static element element_at(const shape *s, vec3 point) {
    if (s->kind == SHAPE_SPHERE) {
        vec3 n = vec3_normalize(vec3_subtract(point, s->sphere.center));
        return (element){vec3_add_scaled(s->sphere.center, s->sphere.radius, n), s->inward ? vec3_negate(n) : n, 0};
    }
    int patch;
    double a = 0, b = 0;
    patch_coordinates(s, point, &patch, &a, &b);
    return patch_at(s, patch, fmin(fmax(a, 0), 1), fmin(fmax(b, 0), 1));
}

/* Whether the ray from `from` meets the front at the element before anything else of the shape. For inward sides:
 * whether the segment meets the side at a second point, by all roots of the quadratic. */
static bool front_seen(const shape *s, vec3 from, element e) {
    vec3 to_point = vec3_subtract(e.point, from);
    if (!(vec3_dot(to_point, e.normal) < 0))
        return false;
    if (!s->inward)
        return true;
    if (s->kind == SHAPE_SPHERE)
        return vec3_length(vec3_subtract(from, s->sphere.center)) <= s->sphere.radius;
    vec3 start = vec3_subtract(from, s->cone.p0);
    double z = vec3_dot(start, s->cone.axis), dz = vec3_dot(to_point, s->cone.axis);
    vec3 lateral = vec3_add_scaled(start, -z, s->cone.axis), step = vec3_add_scaled(to_point, -dz, s->cone.axis);
    double taper = (s->cone.r1 - s->cone.r0) / s->cone.length, r = s->cone.r0 + taper * z, dr = taper * dz;
    double qa = vec3_dot(step, step) - dr * dr, qb = vec3_dot(lateral, step) - r * dr;
    /* One root is 1, the sum of both -2 qb/qa. */
    double other = -2 * qb / qa - 1, other_z = z + other * dz;
    return !(other > 0 && other < 1 && other_z >= 0 && other_z <= s->cone.length);
}

/* ---- Quadrature: of f dOmega over the part of a patch's square, Gauss in cells that shrink towards the point. ---- */

typedef double (*integrand)(const shape *, vec3 from, element e);

static double one(const shape *s, vec3 from, element e) {
    (void)s, (void)from, (void)e;
    return 1;
}

static double density_there(const shape *s, vec3 from, element e) {
    return solid_angle_density(s, from, vec3_normalize(vec3_subtract(e.point, from)), e.point, e.normal);
}

static double quadrature(const shape *s, int patch, vec3 from, const double box[4], int least, int depth, integrand f) {
    double nearest = DBL_MAX, size = 0;
    element middle = patch_at(s, patch, 0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]));
    for (int i = 0; i < 9; i++) {
        double a = box[0] + (box[1] - box[0]) * (i % 3) / 2, b = box[2] + (box[3] - box[2]) * (i / 3) / 2;
        vec3 p = patch_at(s, patch, a, b).point;
        nearest = fmin(nearest, vec3_length(vec3_subtract(p, from)));
        size = fmax(size, vec3_length(vec3_subtract(p, middle.point)));
    }
    double sum = 0;
    if (least > 0 || (depth < 30 && size > 0.4 * nearest)) {
        for (int i = 0; i < 4; i++) {
            double a = 0.5 * (box[0] + box[1]), b = 0.5 * (box[2] + box[3]);
            double part[4] = {i & 1 ? a : box[0], i & 1 ? box[1] : a, i & 2 ? b : box[2], i & 2 ? box[3] : b};
            sum += quadrature(s, patch, from, part, least - 1, depth + 1, f);
        }
        return sum;
    }
    static const double node[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
    static const double weight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            double a = box[0] + (box[1] - box[0]) * node[i], b = box[2] + (box[3] - box[2]) * node[j];
            element e = patch_at(s, patch, a, b);
            if (!front_seen(s, from, e))
                continue;
            vec3 to_point = vec3_subtract(e.point, from);
            double d = vec3_length(to_point), cosine = -vec3_dot(to_point, e.normal) / d;
            sum += weight[i] * weight[j] * e.area * cosine / (d * d) * f(s, from, e);
        }
    }
    return sum * (box[1] - box[0]) * (box[3] - box[2]);
}

/* Curved shapes have an edge where the front ends, at which the integrand is cut off: they get small cells everywhere.
 */
static double whole_quadrature(const shape *s, vec3 from, integrand f) {
    double sum = 0;
    int least = s->kind == SHAPE_POLYGON || s->kind == SHAPE_RING ? 2 : 6;
    for (int patch = 0; patch < patch_count(s); patch++)
        sum += quadrature(s, patch, from, (const double[4]){0, 1, 0, 1}, least, 0, f);
    return sum;
}

/* ---- Points to look from: in the shape's frame, near and far, before and behind, inside and out. ---- */

static const vec3 viewpoints[] = {
    {0.05, 0.03, 0.5},  {0.02, -0.01, 1.5}, {0, 0, 2},          {1.5, 0.4, 0.3},   {-2, 1, 0.01},
    {0.1, 0.2, 0.02},   {0.9, -0.2, 0.4},   {0.3, 0.3, 0.35},   {-0.6, 0.5, 0.6},  {10, 5, 20},
    {0, 0, -1},         {0.15, 0, 0.6},     {0.79, 0.05, 0.01}, {0, 0.8001, 0.02}, {0.4, 0.4, -0.5},
    {0.402, 0.01, 0.3}, {1e3, -2e3, 500},   {0.1, -0.1, 3},     {3, 0, 1e-3},      {0.35, -0.1, 0.2},
};

/* ---- The tests ---- */

static bool is_exactly_uniform(const shape *s) {
    return s->kind == SHAPE_POLYGON || s->kind == SHAPE_SPHERE;
}

/* Whether the point is beyond the ends of an inward side, which then hides parts of itself. */
static bool hides_itself(const shape *s, vec3 from) {
    double z = s->kind == SHAPE_CONE ? vec3_dot(vec3_subtract(from, s->cone.p0), s->cone.axis) : 0;
    return s->kind == SHAPE_CONE && s->inward && (z < 0 || z > s->cone.length);
}

/* Checks what holds for every draw, and returns 1/density, or 0 for a miss. */
static double checked_share(const shape *s, vec3 from, solid_angle_sample drawn) {
    assert_true(isfinite(drawn.density) && drawn.density >= 0);
    assert_true(isfinite(drawn.distance) && drawn.distance >= 0);
    assert_true(isfinite(drawn.direction.x + drawn.direction.y + drawn.direction.z));
    if (drawn.density == 0)
        return 0;
    assert_true(fabs(vec3_length(drawn.direction) - 1) < 1e-14);
    vec3 point = vec3_add_scaled(from, drawn.distance, drawn.direction);
    double scale = 1 + vec3_max_abs(from);
    assert_true(vec3_length(vec3_subtract(element_at(s, point).point, point)) < 1e-12 * scale);
    return 1 / drawn.density;
}

/* The solid angle of the front, as a grid of draws has it: the mean of 1/density. */
static double drawn_solid_angle(const shape *s, vec3 from) {
    enum { GRID = 40 };
    double sum = 0;
    for (int i = 0; i < GRID * GRID; i++)
        sum += checked_share(s, from, solid_angle_draw(s, from, (i % GRID + 0.5) / GRID, (i / GRID + 0.5) / GRID));
    return sum / (GRID * GRID);
}

/* The same where all draws have one density: by a single one. */
static double uniform_solid_angle(const shape *s, vec3 from) {
    return checked_share(s, from, solid_angle_draw(s, from, 0.3, 0.6));
}

/* A draw's point is on the shape, its density what solid_angle_density gives there, and the mean of 1/density the solid
 * angle. */
static void draws_agree_with_density_and_quadrature(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    enum { GRID = 40 };
    for (int i = 0; i < SUBJECTS; i++) {
        const shape *s = &subjects[i].shape;
        for (size_t j = 0; j < COUNT(viewpoints); j++) {
            vec3 from = placed(viewpoints[j]);
            double exact = whole_quadrature(s, from, one), sum = 0, least = DBL_MAX, most = 0;
            for (int k = 0; k < GRID * GRID; k++) {
                solid_angle_sample drawn = solid_angle_draw(s, from, (k % GRID + 0.5) / GRID, (k / GRID + 0.5) / GRID);
                double share = checked_share(s, from, drawn);
                if (share == 0)
                    continue;
                sum += share / (GRID * GRID);
                vec3 point = vec3_add_scaled(from, drawn.distance, drawn.direction);
                vec3 normal = element_at(s, point).normal;
                double again = solid_angle_density(s, from, drawn.direction, point, normal);
                assert_true(fabs(again / drawn.density - 1) < 1e-9);
                assert_true(vec3_dot(normal, drawn.direction) < 0);
                assert_true(solid_angle_density(s, from, drawn.direction, point, vec3_negate(normal)) == 0);
                least = fmin(least, drawn.density);
                most = fmax(most, drawn.density);
            }
            if (exact == 0) {
                assert_true(sum == 0);
                continue;
            }
            /* What the quadrature of a cut-off front, the grid of draws and the tables leave, in this order. */
            double slack = s->kind == SHAPE_POLYGON            ? 3e-6
                           : i == RIM || hides_itself(s, from) ? 1e-2
                           : s->kind == SHAPE_RING             ? 3e-3
                                                               : 2e-4;
            assert_true(fabs(sum / exact - 1) < slack);
            assert_true(most / least - 1 < (is_exactly_uniform(s) ? 1e-12 : i == RIM ? 0.25 : 0.1));
        }
    }
}

/* Girard's theorem, with angles by vectors of extended precision. */
static double triangle_excess(const vec3 p[3], vec3 from) {
    long double v[3][3], sum = 0;
    for (int i = 0; i < 3; i++) {
        v[i][0] = (long double)p[i].x - from.x;
        v[i][1] = (long double)p[i].y - from.y;
        v[i][2] = (long double)p[i].z - from.z;
    }
    for (int i = 0; i < 3; i++) {
        const long double *a = v[i], *b = v[(i + 1) % 3], *c = v[(i + 2) % 3];
        long double n[3], m[3], cross[3], a_length = sqrtl(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        for (int k = 0; k < 3; k++) {
            n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
            m[k] = a[(k + 1) % 3] * c[(k + 2) % 3] - a[(k + 2) % 3] * c[(k + 1) % 3];
        }
        for (int k = 0; k < 3; k++)
            cross[k] = n[(k + 1) % 3] * m[(k + 2) % 3] - n[(k + 2) % 3] * m[(k + 1) % 3];
        long double sine = (cross[0] * a[0] + cross[1] * a[1] + cross[2] * a[2]) / a_length;
        sum += fabsl(atan2l(sine, n[0] * m[0] + n[1] * m[1] + n[2] * m[2]));
    }
    return (double)(sum - 3.14159265358979323846264338327950288L);
}

static void triangles_match_their_spherical_excess(void **state) {
    (void)state;
    static const uint32_t indices[1][3] = {{0, 1, 2}};
    uint64_t random = 1;
    for (int i = 0; i < 3000; i++) {
        vec3 p[3], from = {0, 0, 0};
        for (int k = 0; k < 3; k++)
            p[k] = vec3_scale(exp(4 * uniform(&random) - 2), random_direction(&random));
        /* Every other one is nearly all of a hemisphere, or small. */
        vec3 middle = vec3_scale(1.0 / 3, vec3_add(p[0], vec3_add(p[1], p[2])));
        vec3 normal = vec3_normalize(vec3_cross(vec3_subtract(p[1], p[0]), vec3_subtract(p[2], p[0])));
        if (i % 2)
            from = vec3_add_scaled(middle, exp(12 * uniform(&random) - 7), normal);
        shape s = {.kind = SHAPE_POLYGON};
        s.polygon.vertices = p;
        s.polygon.vertex_count = 3;
        s.polygon.triangles = indices;
        s.polygon.triangle_count = 1;
        double estimate = uniform_solid_angle(&s, from), height = vec3_dot(normal, vec3_subtract(from, p[0]));
        if (height < 1e-9) {
            assert_true(estimate == 0 || height > -1e-9);
            continue;
        }
        double exact = triangle_excess(p, from);
        assert_true(fabs(estimate - exact) <= 1e-12 * exact + 1e-17 + 4e-16 * exact / height);
    }
}

/* The solid angle of a disk from over its middle. */
static double disk_solid_angle(double radius, double height) {
    double distance = hypot(radius, height);
    return 2 * PI * radius * radius / (distance * (distance + height));
}

static void closed_forms_hold(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    for (int i = -24; i <= 24; i++) {
        double h = pow(10, 0.25 * i);
        vec3 above = placed((vec3){0, 0, h});
        double rounding = 1e-12 + 1e-15 / h;
        double disk = disk_solid_angle(0.8, h);
        assert_true(fabs(uniform_solid_angle(&subjects[DISK].shape, above) / disk - 1) < rounding);
        /* From over its apex a cone fills the same directions as its base; its sides are seen the more obliquely, and
         * with the more rounding, the farther off. */
        vec3 over_apex = placed((vec3){0, 0, 0.9 + h});
        double cone = disk_solid_angle(0.5, 0.9 + h);
        assert_true(fabs(uniform_solid_angle(&subjects[CONE].shape, over_apex) / cone - 1) < rounding + 1e-15 * h);
        /* The rectangle's corners are at -0.5, 0.4 and -0.3, 0.5. */
        double rectangle = 0;
        for (int k = 0; k < 4; k++) {
            double x = k & 1 ? 0.4 : 0.5, y = k & 2 ? 0.5 : 0.3;
            rectangle += atan2(x * y, h * sqrt(x * x + y * y + h * h));
        }
        assert_true(fabs(uniform_solid_angle(&subjects[RECTANGLE].shape, above) / rectangle - 1) < rounding);
        vec3 outside = placed((vec3){0, 0, 0.8 + h});
        double limb = 0.8 / (0.8 + h), sphere = 2 * PI * limb * limb / (1 + sqrt(h * (1.6 + h)) / (0.8 + h));
        assert_true(fabs(uniform_solid_angle(&subjects[SPHERE].shape, outside) / sphere - 1) < 1e-12 + 1e-15 / sqrt(h));
    }
}

/* ---- Chi-square: draws counted in bins of the surface, against the integral of the density over each. ---- */

enum { SIDE = 6 };

static int bin_of(const shape *s, vec3 point) {
    int patch;
    double a = 0, b = 0;
    patch_coordinates(s, point, &patch, &a, &b);
    int column = (int)fmin(fmax(a * SIDE, 0), SIDE - 1), row = (int)fmin(fmax(b * SIDE, 0), SIDE - 1);
    return (patch * SIDE + row) * SIDE + column;
}

/* The probability of chi-square being larger, as a normal deviate: E. Wilson and M. Hilferty, 1931. */
static double chi_square_deviate(double chi_square, int freedom) {
    double spread = 2.0 / (9 * freedom);
    return (cbrt(chi_square / freedom) - (1 - spread)) / sqrt(spread);
}

static void check_bins(const shape *s, vec3 from, uint64_t *random) {
    enum { DRAWS = 20000, MOST = 6 * SIDE * SIDE };
    int counts[MOST] = {0}, bins = patch_count(s) * SIDE * SIDE, hits = 0;
    for (int i = 0; i < DRAWS; i++) {
        double u = uniform(random), v = uniform(random);
        solid_angle_sample drawn = solid_angle_draw(s, from, u, v);
        if (drawn.density == 0)
            continue;
        hits++;
        counts[bin_of(s, vec3_add_scaled(from, drawn.distance, drawn.direction))]++;
    }
    /* Rings are too near uniform for this many draws to tell. */
    bool uniformly = is_exactly_uniform(s) || s->kind == SHAPE_RING;
    double scale = uniformly ? 1 / whole_quadrature(s, from, one) : 1;
    double chi_square = 0, rest = 0, total = 0;
    int freedom = -1, rest_count = 0;
    for (int bin = 0; bin < bins; bin++) {
        double a = bin % SIDE, b = bin / SIDE % SIDE;
        double box[4] = {a / SIDE, (a + 1) / SIDE, b / SIDE, (b + 1) / SIDE};
        int least = s->kind == SHAPE_POLYGON || s->kind == SHAPE_RING ? 0 : 3;
        double part = quadrature(s, bin / (SIDE * SIDE), from, box, least, 0, uniformly ? one : density_there);
        double expected = DRAWS * scale * part;
        total += expected;
        rest += expected;
        rest_count += counts[bin];
        if (rest < 10)
            continue;
        chi_square += (rest_count - rest) * (rest_count - rest) / rest;
        freedom++;
        rest = rest_count = 0;
    }
    assert_true(freedom > 3);
    /* Without misses every draw is in a bin, which takes a degree of freedom; with them the number of hits is a bin
     * more. */
    if (hits < DRAWS) {
        double misses = DRAWS - total;
        chi_square += (DRAWS - hits - misses) * (DRAWS - hits - misses) / misses;
        freedom++;
    }
    assert_true(fabs(chi_square_deviate(chi_square, freedom)) < 3.9);
}

static void draws_fill_bins_by_their_density(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    static const int chosen[] = {0, 1, 4, 6, 7, 9, 12, 17};
    uint64_t random = 2;
    for (int i = 0; i < SUBJECTS; i++) {
        for (size_t j = 0; j < COUNT(chosen); j++) {
            vec3 from = placed(viewpoints[chosen[j]]);
            if (drawn_solid_angle(&subjects[i].shape, from) > 0)
                check_bins(&subjects[i].shape, from, &random);
        }
    }
}

/* ---- Random aims ---- */

static element random_element(const shape *s, uint64_t *random) {
    int patch = (int)(uniform(random) * patch_count(s));
    double a = uniform(random), b = uniform(random);
    return patch_at(s, patch, a, b);
}

/* From anywhere at any distance: where the front is seen, and only there, the density is positive. */
static void every_direction_to_the_front_can_be_drawn(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    uint64_t random = 3;
    int seen = 0, unseen = 0;
    for (int i = 0; i < SUBJECTS; i++) {
        const shape *s = &subjects[i].shape;
        for (int k = 0; k < 1500; k++) {
            vec3 around = random_element(s, &random).point, aside = random_direction(&random);
            double distance = pow(10, 6 * uniform(&random) - (k % 3 ? 1 : 6));
            vec3 from = vec3_add_scaled(around, distance, aside);
            element e = random_element(s, &random);
            vec3 direction = vec3_normalize(vec3_subtract(e.point, from));
            /* Nearer to edge-on, coordinates of a far point decide nothing. */
            if (fabs(vec3_dot(direction, e.normal)) < 1e-9 * (1 + distance))
                continue;
            bool visible = front_seen(s, from, e);
            double density = solid_angle_density(s, from, direction, e.point, e.normal);
            assert_true(isfinite(density));
            assert_true((density > 0) == visible);
            seen += visible;
            unseen += !visible;
        }
    }
    assert_true(seen > 5000 && unseen > 5000);
}

/* ---- Extremes ---- */

static void check_corners(const shape *s, vec3 from) {
    static const double ends[] = {0, 0x1p-53, 1e-9, 0.25, 0.5, 1 - 1e-9, 1 - 0x1p-53};
    for (size_t i = 0; i < COUNT(ends); i++) {
        for (size_t j = 0; j < COUNT(ends); j++) {
            solid_angle_sample drawn = solid_angle_draw(s, from, ends[i], ends[j]);
            double share = checked_share(s, from, drawn);
            assert_true(isfinite(share) && (!is_exactly_uniform(s) || share < 4 * PI * (1 + 1e-14)));
        }
    }
}

static void extremes_stay_finite_and_on_the_shape(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    uint64_t random = 4;
    for (int i = 0; i < SUBJECTS; i++) {
        const shape *s = &subjects[i].shape;
        for (int k = 0; k < 120; k++) {
            element e = random_element(s, &random);
            double distance = pow(10, 12 * uniform(&random) - 6);
            check_corners(s, e.point);
            check_corners(s, vec3_add_scaled(e.point, distance, e.normal));
            check_corners(s, vec3_add_scaled(e.point, -distance, e.normal));
            check_corners(s, vec3_add_scaled(e.point, distance, random_direction(&random)));
            vec3 tangent = vec3_normalize(vec3_cross(e.normal, random_direction(&random)));
            check_corners(s, vec3_add_scaled(e.point, distance, tangent));
        }
        if (s->kind == SHAPE_POLYGON)
            check_corners(s, s->polygon.vertices[0]);
    }
    check_corners(&subjects[SPHERE].shape, place_origin);
    check_corners(&subjects[BUBBLE].shape, place_origin);
    check_corners(&subjects[CONE].shape, vec3_add_scaled(place_origin, 0.9, subjects[CONE].shape.cone.axis));
    check_corners(&subjects[CYLINDER].shape, place_origin);
    check_corners(&subjects[TUBE].shape, place_origin);
}

/* In the plane nothing is seen. Thin shapes are missing: rounding their vertices tilts them. */
static void nothing_is_seen_from_the_plane(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    uint64_t random = 5;
    static const int flat[] = {TRIANGLE, RECTANGLE, QUAD, ELL, OCTAGON, DISK, RING, RIM};
    for (size_t i = 0; i < COUNT(flat); i++) {
        const shape *s = &subjects[flat[i]].shape;
        for (int k = 0; k < 500; k++) {
            vec3 from = placed((vec3){3 * uniform(&random) - 1.5, 3 * uniform(&random) - 1.5, 0});
            vec3 normal = placed_direction((vec3){0, 0, 1});
            vec3 above = vec3_add_scaled(from, 1e-6, normal), below = vec3_add_scaled(from, -1e-6, normal);
            double u = uniform(&random), v = uniform(&random);
            assert_true(solid_angle_draw(s, from, u, v).density == 0);
            assert_true(solid_angle_draw(s, below, u, v).density == 0);
            assert_true(solid_angle_draw(s, above, u, v).density > 0);
        }
    }
}

/* Close to the surface it fills half of all directions; far off its solid angle is the projected area's. */
static void limits_near_and_far(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    static const int solid[] = {TRIANGLE, RECTANGLE, QUAD, ELL, OCTAGON, SPHERE, DISK, RING, CYLINDER, CONE, FRUSTUM};
    for (size_t i = 0; i < COUNT(solid); i++) {
        const shape *s = &subjects[solid[i]].shape;
        element e = patch_at(s, 0, 0.52, 0.47);
        double near = drawn_solid_angle(s, vec3_add_scaled(e.point, 1e-6, e.normal));
        /* The table of a cone's side is that coarse where the side's limb is this near. */
        assert_true(fabs(near / (2 * PI) - 1) < (s->kind == SHAPE_CONE ? 0.02 : 0.002));
        if (s->kind != SHAPE_POLYGON && s->kind != SHAPE_RING)
            continue;
        for (double distance = 1e4; distance < 1e7; distance *= 10) {
            vec3 away = vec3_normalize(vec3_add(e.normal, placed_direction((vec3){0.5, 1, 0})));
            double area =
                s->kind == SHAPE_RING ? PI * (s->ring.r1 * s->ring.r1 - s->ring.r0 * s->ring.r0) : s->polygon.area;
            double projected = area * vec3_dot(away, e.normal) / (distance * distance);
            double far = drawn_solid_angle(s, vec3_add_scaled(e.point, distance, away));
            assert_true(fabs(far / projected - 1) < 6 / distance + 1e-4 * (s->kind == SHAPE_RING));
        }
    }
}

/* A point of an inward side, to rounding, sees the rest of it, and no more of what is below its horizon. */
static void the_inside_is_seen_from_its_own_surface(void **state) {
    (void)state;
    static subject subjects[SUBJECTS];
    make_subjects(subjects);
    uint64_t random = 7;
    for (int k = 0; k < 40; k++) {
        const shape *s = &subjects[k % 2 ? TUBE : CUP].shape;
        element e = patch_at(s, 0, 0.1 + 0.8 * uniform(&random), uniform(&random));
        /* A little above, no less of the rest is seen, and the quadrature has no rounding to fear. */
        vec3 above = vec3_add_scaled(e.point, 1e-5, e.normal);
        double exact = whole_quadrature(s, above, one) - 2 * PI;
        assert_true(fabs(drawn_solid_angle(s, e.point) / exact - 1) < 3e-3);
    }
}

/* ---- Cones of directions ---- */

static void cones_of_directions_are_uniform(void **state) {
    (void)state;
    uint64_t random = 6;
    static const double half_angles[] = {1e-9, 0.00465, 0.7, PI / 2, 3, PI};
    for (size_t i = 0; i < COUNT(half_angles); i++) {
        double half = half_angles[i], solid_angle = solid_angle_of_cone(half);
        double exact = 2 * PI * (half < 1e-3 ? 0.5 * half * half : 1 - cos(half));
        assert_true(fabs(solid_angle / exact - 1) < 1e-10);
        vec3 axis = random_direction(&random);
        frame f = frame_around(axis);
        enum { RINGS = 5, SECTORS = 8, DRAWS = 20000 };
        int counts[RINGS][SECTORS] = {{0}};
        for (int k = 0; k < DRAWS; k++) {
            double u = uniform(&random), v = uniform(&random);
            vec3 drawn = solid_angle_draw_cone(axis, half, u, v);
            assert_true(fabs(vec3_length(drawn) - 1) < 1e-14);
            vec3 local = frame_to_local(&f, drawn);
            /* sin^2 of half the angle to the axis is uniform. */
            double away = vec3_length(vec3_subtract(drawn, axis)) / 2, limb = sin(0.5 * half);
            double part = away * away / (limb * limb);
            assert_true(part <= 1 + (half < 1e-6 ? 1e-6 : 1e-12));
            int ring = (int)fmin(part * RINGS, RINGS - 1),
                sector = (int)((atan2(local.y, local.x) / PI + 1) * SECTORS / 2);
            counts[ring][sector == SECTORS ? 0 : sector]++;
        }
        double chi_square = 0, expected = (double)DRAWS / (RINGS * SECTORS);
        for (int k = 0; k < RINGS * SECTORS; k++) {
            double difference = counts[k / SECTORS][k % SECTORS] - expected;
            chi_square += difference * difference / expected;
        }
        assert_true(fabs(chi_square_deviate(chi_square, RINGS * SECTORS - 1)) < 3.9);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_agree_with_density_and_quadrature),
        cmocka_unit_test(triangles_match_their_spherical_excess),
        cmocka_unit_test(closed_forms_hold),
        cmocka_unit_test(draws_fill_bins_by_their_density),
        cmocka_unit_test(every_direction_to_the_front_can_be_drawn),
        cmocka_unit_test(extremes_stay_finite_and_on_the_shape),
        cmocka_unit_test(nothing_is_seen_from_the_plane),
        cmocka_unit_test(limits_near_and_far),
        cmocka_unit_test(the_inside_is_seen_from_its_own_surface),
        cmocka_unit_test(cones_of_directions_are_uniform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
