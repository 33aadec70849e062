/* Whole lights at once: against quadrature over the light with the reflectance function itself, which shares nothing
 * with integrals along outlines; against albedos; and identities. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <float.h>

#include "brdf/common.h"
#include "graze/brdf_light.h"

static graze_vec3 add(graze_vec3 a, double s, graze_vec3 b) {
    return (graze_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static graze_vec3 cross(graze_vec3 a, graze_vec3 b) {
    return (graze_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static void assert_near(double a, double b, double relative) {
    if (!(fabs(a - b) <= fmax(relative * fabs(b), 1e-14)))
        fail_msg("%.17g is not %.17g", a, b);
}

/* A flat light: corner + s first + t second for s, t in [0,1], or the ellipse about `corner`. */
typedef struct flat_light {
    graze_vec3 corner, first, second;
    bool ellipse;
} flat_light;

static double lowest(const flat_light *f) {
    if (f->ellipse)
        return f->corner.z - hypot(f->first.z, f->second.z);
    return f->corner.z + fmin(f->first.z, 0) + fmin(f->second.z, 0);
}

typedef struct situation {
    graze_brdf brdf;
    graze_vec3 v;
    flat_light light;
    bool diffuse;
} situation;

/* What comes from a point of the light, for the measure of s and t, or of the radius and the angle. */
static double reflected_from(const situation *q, double s, double t) {
    const flat_light *f = &q->light;
    double weight = 1;
    if (f->ellipse) {
        double radius = s, angle = 2 * pi * t;
        weight = 2 * pi * radius;
        s = radius * cos(angle);
        t = radius * sin(angle);
    }
    graze_vec3 to = add(add(f->corner, s, f->first), t, f->second);
    double distance = sqrt(dot(to, to));
    graze_vec3 l = {to.x / distance, to.y / distance, to.z / distance};
    double value = q->diffuse ? graze_diffuse_value(l, q->v) : graze_brdf_value(&q->brdf, l, q->v);
    return weight * value * l.z * fabs(dot(l, cross(f->first, f->second))) / (distance * distance);
}

/* By Gauss's five points in s and t, in a square that begins at s and t. */
static double over_square(const situation *q, double s, double t, double side) {
    static const double points[] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                    0.95308992296933200};
    static const double weights[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                     0.11846344252809454};
    double sum = 0;
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 5; ++k)
            sum += weights[i] * weights[k] * reflected_from(q, s + side * points[i], t + side * points[k]);
    return side * side * sum;
}

/* Squares are cut in four until that changes nothing. */
static double refined(const situation *q, double s, double t, double side, double rough, double tolerance, int depth) {
    double half = side / 2, quarters[4], sum = 0;
    for (int i = 0; i < 4; ++i)
        sum += quarters[i] = over_square(q, s + half * (i % 2), t + half * (i / 2), half);
    if (depth >= 14 || (depth >= 4 && fabs(sum - rough) <= tolerance))
        return sum;
    sum = 0;
    for (int i = 0; i < 4; ++i)
        sum += refined(q, s + half * (i % 2), t + half * (i / 2), half, quarters[i], tolerance / 2, depth + 1);
    return sum;
}

/* With the reflectance function itself, which shares nothing with integrals along outlines. */
static double by_quadrature(const situation *q) {
    double rough = refined(q, 0, 0, 1, 0, 1e-3, 0);
    return refined(q, 0, 0, 1, 0, 3e-10 * rough, 0);
}

static void four_corners(const flat_light *f, graze_vec3 corners[4]) {
    corners[0] = f->corner;
    corners[1] = add(f->corner, 1, f->first);
    corners[2] = add(corners[1], 1, f->second);
    corners[3] = add(f->corner, 1, f->second);
}

static double reflected(const situation *s) {
    const flat_light *f = &s->light;
    graze_vec3 corners[4];
    four_corners(f, corners);
    if (s->diffuse)
        return f->ellipse ? graze_diffuse_ellipse(f->corner, f->first, f->second) : graze_diffuse_polygon(corners, 4);
    return f->ellipse ? graze_brdf_ellipse(&s->brdf, f->corner, f->first, f->second, s->v)
                      : graze_brdf_polygon(&s->brdf, corners, 4, s->v);
}

/* Ordinary, rough, sharp, one roughness a thousand times the other, grazing, small, large, and off the lobe. */
enum { KINDS = 8 };
static situation draw_situation(uint64_t *seed, int kind, int i) {
    double cosine = kind == 4                ? draw_power(seed, 1e-5, .02)
                    : kind == 2 || kind == 3 ? draw_between(seed, .1, 1)
                    : i % 4 == 0             ? .0175
                                             : draw(seed);
    double alpha = kind == 1   ? draw_power(seed, .3, 10)
                   : kind == 2 ? draw_power(seed, 1e-4, .03)
                   : kind == 3 ? draw_power(seed, 1e-4, 1e-2)
                               : draw_power(seed, kind == 6 ? .1 : .03, 1);
    double other = kind == 3 ? 1000 * alpha : i % 2 ? alpha : fmin(alpha * draw_power(seed, .3, 3), 10);
    double size = kind == 5                ? draw_power(seed, 1e-9, .05)
                  : kind == 6              ? draw_power(seed, 2, 20)
                  : kind == 2 || kind == 3 ? fmin(alpha, other) * draw_power(seed, 1, 30)
                                           : draw_power(seed, .05, 2);
    double off = kind == 7 ? 4 : 1, distance = draw_between(seed, 1, 4);
    situation s = {.brdf = {GRAZE_BRDF_GMD, i % 3 ? alpha : other, i % 3 ? other : alpha},
                   .v = direction(cosine, draw_between(seed, 0, 2 * pi))};
    graze_vec3 at = {-s.v.x + 2 * off * s.brdf.alpha_x * draw_between(seed, -1, 1),
                     -s.v.y + 2 * off * s.brdf.alpha_y * draw_between(seed, -1, 1), s.v.z + alpha * draw(seed)};
    s.light.corner = (graze_vec3){distance * at.x, distance * at.y, distance * at.z};
    s.light.ellipse = i % 3 == 0;
    graze_vec3 *axes[] = {&s.light.first, &s.light.second};
    for (int k = 0; k < 2; ++k)
        *axes[k] = (graze_vec3){size * draw_between(seed, -1, 1), size * draw_between(seed, -1, 1),
                                size * draw_between(seed, -1, 1)};
    if (s.light.ellipse) { /* second at right angles */
        double share = -dot(s.light.first, s.light.second) / dot(s.light.first, s.light.first);
        s.light.second = add(s.light.second, share, s.light.first);
    }
    return s;
}

/* What a unit vector's rounding does. */
static double rounding_of(const situation *s) {
    return s->diffuse ? 0 : 4e-16 / (fmin(s->brdf.alpha_x, s->brdf.alpha_y) * s->v.z);
}

static void quadrature(void **state) {
    (void)state;
    uint64_t seed = 1;
    int count = is_short_run() ? 20 : 150;
    for (int kind = 0; kind < KINDS; ++kind) {
        int above = 0;
        for (int i = 0; i < count || above < count / 5; ++i) {
            situation s = draw_situation(&seed, kind, i);
            if (lowest(&s.light) < 0) /* where it is cut, quadrature is not sure */
                continue;
            above++;
            for (int diffuse = 0; diffuse < 2; ++diffuse) {
                s.diffuse = diffuse;
                double found = reflected(&s), expected = by_quadrature(&s);
                double bound = fmax(1e-8 * expected, 1e-14) + rounding_of(&s);
                if (!(fabs(found - expected) <= bound))
                    fail_msg("kind %d, draw %d, %s: %.12g is not %.12g, by %.1g of what is allowed", kind, i,
                             diffuse ? "diffuse" : "lobe", found, expected, fabs(found - expected) / bound);
            }
        }
    }
}

/* A light all over the sky gives the albedo, for any roughness and view. */
static void whole_sky(void **state) {
    (void)state;
    static const graze_vec3 sky[] = {{-1e9, -1e9, 1e-3}, {1e9, -1e9, 1e-3}, {1e9, 1e9, 1e-3}, {-1e9, 1e9, 1e-3}};
    uint64_t seed = 2;
    for (int i = 0; i < 300; ++i) {
        double alpha = draw_power(&seed, 1e-6, 10);
        const graze_brdf brdf = {GRAZE_BRDF_GMD, alpha, i % 2 ? alpha : fmin(draw_power(&seed, .01, 100) * alpha, 10)};
        graze_vec3 v = direction(i % 3 ? draw(&seed) : draw_power(&seed, 1e-6, 1), draw_between(&seed, 0, 2 * pi));
        double rounding = 0x1p-53 / (fmin(alpha, brdf.alpha_y) * v.z);
        assert_near(graze_brdf_polygon(&brdf, sky, 4, v), graze_brdf_albedo(&brdf, v), 1e-8 + 4 * rounding);
    }
    assert_near(graze_diffuse_polygon(sky, 4), 1, 1e-14);
}

/* What lies below the surface is cut off, wherever the outline begins, and an ellipse is a polygon of many corners. */
static void horizon(void **state) {
    (void)state;
    enum { MANY = 20000 };
    static graze_vec3 around[MANY];
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .1, .3};
    for (int i = 0; i < 24; ++i) {
        double azimuth = pi / 12 * i, c = cos(azimuth), s = sin(azimuth);
        graze_vec3 v = from_degrees(i % 2 ? 85 : 60, 15 * i + 180);
        graze_vec3 whole[4] = {{2, -1, -1}, {3, 1, -1}, {3, 1, 1}, {2, -1, 1}}, upper[4];
        for (int k = 0; k < 4; ++k) {
            graze_vec3 p = whole[k];
            whole[k] = (graze_vec3){c * p.x - s * p.y, s * p.x + c * p.y, p.z};
            upper[k] = whole[k];
            upper[k].z = fmax(upper[k].z, 0);
        }
        for (int k = 0; k < 4; ++k) {
            const graze_vec3 turned[] = {whole[k], whole[(k + 1) % 4], whole[(k + 2) % 4], whole[(k + 3) % 4]};
            assert_near(graze_brdf_polygon(&brdf, turned, 4, v), graze_brdf_polygon(&brdf, upper, 4, v), 1e-9);
            assert_near(graze_diffuse_polygon(turned, 4), graze_diffuse_polygon(upper, 4), 1e-14);
        }
        graze_vec3 center = {2 * c, 2 * s, .2}, first = {-s, c, 0}, second = {.3 * c, .3 * s, 1};
        double turn = i; /* so that it begins above, below, and on either side */
        for (int k = 0; k < MANY; ++k)
            around[k] = add(add(center, cos(turn + 2 * pi * k / MANY), first), sin(turn + 2 * pi * k / MANY), second);
        graze_vec3 a = add((graze_vec3){0, 0, 0}, cos(turn), first), b = add((graze_vec3){0, 0, 0}, -sin(turn), first);
        a = add(a, sin(turn), second);
        b = add(b, cos(turn), second);
        assert_near(graze_brdf_ellipse(&brdf, center, a, b, v), graze_brdf_polygon(&brdf, around, MANY, v), 1e-7);
        assert_near(graze_diffuse_ellipse(center, a, b), graze_diffuse_polygon(around, MANY), 1e-7);
        center.z = -2;
        assert_true(graze_brdf_ellipse(&brdf, center, a, b, v) == 0 && graze_diffuse_ellipse(center, a, b) == 0);
    }
}

/* A hole with a seam; the way round; parts that make a whole; scale. */
static void identities(void **state) {
    (void)state;
    static const graze_vec3 outer[] = {{-2, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {-2, 1, 1}},
                            hole[] = {{-1.8, -.5, 1}, {-1.8, .5, 1}, {-1.2, .5, 1}, {-1.2, -.5, 1}},
                            seamed[] = {{-2, -1, 1},    {-1, -1, 1},   {-1, 1, 1},    {-2, 1, 1},     {-2, -1, 1},
                                        {-1.8, -.5, 1}, {-1.8, .5, 1}, {-1.2, .5, 1}, {-1.2, -.5, 1}, {-1.8, -.5, 1}},
                            left[] = {{-2, -1, 1}, {-2, 1, 1}, {-1.4, 1, 1}, {-1.4, -1, 1}},
                            right[] = {{-1.4, -1, 1}, {-1.4, 1, 1}, {-1, 1, 1}, {-1, -1, 1}};
    for (int i = 0; i < 9; ++i) {
        const graze_brdf brdf = {GRAZE_BRDF_GMD, .05 * (i + 1), .1};
        graze_vec3 v = from_degrees(10 * i + 5, 20);
        double whole = graze_brdf_polygon(&brdf, outer, 4, v), inner = graze_brdf_polygon(&brdf, hole, 4, v);
        assert_near(graze_brdf_polygon(&brdf, seamed, 10, v), whole - inner, 1e-8);
        assert_near(graze_brdf_polygon(&brdf, left, 4, v) + graze_brdf_polygon(&brdf, right, 4, v), whole, 1e-8);
        graze_vec3 far[4];
        for (int k = 0; k < 4; ++k)
            far[k] = (graze_vec3){1e30 * outer[k].x, 1e30 * outer[k].y, 1e30 * outer[k].z};
        assert_near(graze_brdf_polygon(&brdf, far, 4, v), whole, 1e-13);
    }
    assert_near(graze_diffuse_polygon(seamed, 10), graze_diffuse_polygon(outer, 4) - graze_diffuse_polygon(hole, 4),
                1e-13);
    /* Seen from straight above, as from next to it. */
    const graze_brdf lobe = {GRAZE_BRDF_GMD, .2, .5};
    const graze_vec3 above = {0, 0, 1}, beside = {1e-10, 1e-10, 1};
    assert_near(graze_brdf_polygon(&lobe, outer, 4, above), graze_brdf_polygon(&lobe, outer, 4, beside), 1e-8);
    assert_true(graze_brdf_polygon(&lobe, outer, 4, above) > 1e-3);
    /* Exactly: a square seen from below its middle, and a disk. */
    static const graze_vec3 square[] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    assert_near(graze_diffuse_polygon(square, 4), 4 / (pi * sqrt(2)) * atan(1 / sqrt(2)), 1e-14);
    for (double radius = 1e-3; radius < 1e3; radius *= 3)
        assert_near(
            graze_diffuse_ellipse((graze_vec3){0, 0, 2}, (graze_vec3){radius, 0, 0}, (graze_vec3){0, radius, 0}),
            radius * radius / (radius * radius + 4), 1e-9);
}

/* A light that the lobe hardly reaches is as dim as it ought to be: nothing that cancels is left. */
static void far_from_the_lobe(void **state) {
    (void)state;
    for (double angle = 0; angle < 360; angle += 15) {
        situation s = {.brdf = {GRAZE_BRDF_GMD, .06, .06},
                       .v = from_degrees(30, 0),
                       .light = {from_degrees(30, 180), {.05, 0, 0}, {0, .05, 0}, false}};
        s.light.corner.x += .5 * cos(angle * pi / 180);
        s.light.corner.y += .5 * sin(angle * pi / 180);
        double expected = by_quadrature(&s);
        assert_true(expected < 1e-4);
        if (!(fabs(reflected(&s) - expected) <= 1e-6 * expected))
            fail_msg("%g is not %g", reflected(&s), expected);
    }
}

/* The panel where it stands in space, by a frame whose third axis is the surface's normal there. */
static double in_space(const graze_vec3 *corners, uint64_t *seed) {
    graze_vec3 n = direction(draw_between(seed, -1, 1), draw_between(seed, 0, 2 * pi));
    graze_vec3 x = cross(n, fabs(n.x) < .5 ? (graze_vec3){1, 0, 0} : (graze_vec3){0, 1, 0}), placed[4];
    x = add((graze_vec3){0, 0, 0}, 1 / sqrt(dot(x, x)), x);
    graze_vec3 y = cross(n, x), point = {draw(seed), draw(seed), draw(seed)};
    for (int k = 0; k < 4; ++k)
        placed[k] = add(add(add(point, corners[k].x, x), corners[k].y, y), corners[k].z, n);
    return graze_diffuse_quadrangle(point, n, placed);
}

/* A polygon with a share of it cut off: from some point of one edge to one of another. */
static void parts_and_order(void **state) {
    (void)state;
    uint64_t seed = 6;
    for (int i = 0; i < (is_short_run() ? 800 : 20000); ++i) {
        situation s = draw_situation(&seed, i % KINDS, i);
        double allowed = rounding_of(&s), share = draw(&seed), other = draw(&seed);
        graze_vec3 c[4], turned[4], mirrored[4];
        four_corners(&s.light, c);
        graze_vec3 p = add(c[0], share, s.light.first), q = add(c[3], other, s.light.first);
        const graze_vec3 left[] = {c[0], p, q, c[3]}, right[] = {p, c[1], c[2], q};
        for (int k = 0; k < 4; ++k) {
            turned[k] = c[(k + 1 + i / KINDS) % 4];
            mirrored[k] = c[3 - k];
        }
        double whole = graze_brdf_polygon(&s.brdf, c, 4, s.v);
        double parts = graze_brdf_polygon(&s.brdf, left, 4, s.v) + graze_brdf_polygon(&s.brdf, right, 4, s.v);
        double bound = fmax(1e-8 * whole, 2e-14) + 2 * allowed;
        double from_another = graze_brdf_polygon(&s.brdf, turned, 4, s.v);
        double the_other_way = graze_brdf_polygon(&s.brdf, mirrored, 4, s.v);
        if (!(fabs(parts - whole) <= bound && fabs(from_another - whole) <= bound &&
              fabs(the_other_way - whole) <= bound))
            fail_msg("draw %d: %.12g, in parts %.12g, from another corner %.12g, the other way %.12g", i, whole, parts,
                     from_another, the_other_way);
        double flat = graze_diffuse_polygon(c, 4);
        assert_near(graze_diffuse_polygon(left, 4) + graze_diffuse_polygon(right, 4), flat, 1e-13);
        assert_near(graze_diffuse_polygon(turned, 4), flat, 1e-13);
        assert_near(graze_diffuse_polygon(mirrored, 4), flat, 1e-13);
        assert_near(in_space(c, &seed), flat, 1e-13);
    }
}

/* Rings are the difference of two disks, as exact as the larger one is. */
static void thin_rings(void **state) {
    (void)state;
    enum { MANY = 4000 };
    uint64_t seed = 7;
    for (int i = 0; i < 200; ++i) {
        situation s = draw_situation(&seed, 0, i);
        double width = draw_power(&seed, 1e-4, .5);
        if (!s.light.ellipse || lowest(&s.light) < 0)
            continue;
        const flat_light *f = &s.light;
        graze_vec3 first = add((graze_vec3){0, 0, 0}, 1 - width, f->first),
                   second = add((graze_vec3){0, 0, 0}, 1 - width, f->second);
        double ring = 0;
        for (int k = 0; k < MANY; ++k) /* the midpoint rule around, Gauss's two points across */
            for (int side = 0; side < 2; ++side)
                ring += width / (2 * MANY) *
                        reflected_from(&s, 1 - width * (side ? .2113248654 : .7886751346), (k + .5) / MANY);
        double outer = reflected(&s), inner = graze_brdf_ellipse(&s.brdf, f->corner, first, second, s.v);
        if (width < 1e-2 && !(fabs(outer - inner - ring) <= fmax(1e-8 * outer, 1e-14)))
            fail_msg("a ring of width %g: %g - %g is not %g", width, outer, inner, ring);
    }
}

static const graze_vec3 triangle[] = {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}};

static void nothing(void **state) {
    (void)state;
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .2, .2};
    graze_vec3 v = from_degrees(20, 0), below = {0, 0, -1}, none = {0, 0, 0};
    assert_true(graze_brdf_polygon(&brdf, triangle, 3, v) > 0 && graze_diffuse_polygon(triangle, 3) > 0);
    assert_true(graze_brdf_polygon(&brdf, triangle, 3, below) == 0);
    assert_true(graze_brdf_polygon(&brdf, triangle, 2, v) == 0 && graze_diffuse_polygon(triangle, 2) == 0);
    assert_near(graze_brdf_ellipse(&brdf, triangle[0], none, none, v), 0, 0);
    assert_true(graze_brdf_ellipse(&brdf, triangle[0], none, none, below) == 0);
    assert_true(graze_diffuse_ellipse(triangle[0], none, none) == 0);
}

/* Whatever comes, results are in 0 .. 1. */
static void extremes(void **state) {
    (void)state;
    static const double numbers[] = {0,     -0.,   1,       -1,       1e-9,      -1e-9, 1e-150, 1e9, -1e9,
                                     1e150, 1e300, DBL_MAX, INFINITY, -INFINITY, NAN,   .5,     .7,  DBL_MIN};
    const int count = sizeof numbers / sizeof *numbers;
    uint64_t seed = 5;
    for (int i = 0; i < (is_short_run() ? 3000 : 30000); ++i) {
        graze_vec3 corners[5];
        double *components = &corners[0].x;
        for (int k = 0; k < 15; ++k)
            components[k] = draw(&seed) < .5 ? draw_between(&seed, -1, 1) : numbers[(int)(draw(&seed) * count)];
        const graze_brdf brdf = {(graze_brdf_model)(i % 5), numbers[(int)(draw(&seed) * count)], draw(&seed)};
        graze_vec3 v = i % 2 ? corners[4] : direction(draw_power(&seed, 1e-200, 1), 7 * draw(&seed));
        double results[] = {graze_brdf_polygon(&brdf, corners, 4, v), graze_diffuse_polygon(corners, 4),
                            graze_brdf_ellipse(&brdf, corners[0], corners[1], corners[2], v),
                            graze_diffuse_ellipse(corners[0], corners[1], corners[2]),
                            graze_diffuse_quadrangle(corners[4], v, corners)};
        for (int k = 0; k < 5; ++k)
            if (!(results[k] >= 0 && results[k] <= 1))
                fail_msg("result %d of draw %d is %g", k, i, results[k]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quadrature), cmocka_unit_test(whole_sky),         cmocka_unit_test(horizon),
        cmocka_unit_test(identities), cmocka_unit_test(far_from_the_lobe), cmocka_unit_test(parts_and_order),
        cmocka_unit_test(thin_rings), cmocka_unit_test(nothing),           cmocka_unit_test(extremes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
