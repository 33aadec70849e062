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
    if (!(fabs(a - b) <= fmax(relative * fabs(b), relative > 1e-8 ? 1e-11 : 1e-14)))
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

/* Gauss's four points in each of count x count fields, in s and t or in the square root of the area and the angle; of
 * the diffuse term where there is no brdf. */
static double by_quadrature(const graze_brdf *brdf, const flat_light *f, graze_vec3 v, int count) {
    static const double points[] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
    static const double weights[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
    graze_vec3 area = cross(f->first, f->second);
    double sum = 0;
    for (int i = 0; i < 4 * count; ++i)
        for (int k = 0; k < 4 * count; ++k) {
            double s = (i / 4 + points[i % 4]) / count, t = (k / 4 + points[k % 4]) / count;
            double weight = weights[i % 4] * weights[k % 4] / count / count;
            if (f->ellipse) {
                weight *= 2 * pi * s;
                double radius = s, angle = 2 * pi * t;
                s = radius * cos(angle);
                t = radius * sin(angle);
            }
            graze_vec3 to = add(add(f->corner, s, f->first), t, f->second);
            double distance = sqrt(dot(to, to));
            graze_vec3 l = {to.x / distance, to.y / distance, to.z / distance};
            double value = brdf ? graze_brdf_value(brdf, l, v) : graze_diffuse_value(l, v);
            sum += weight * value * l.z * fabs(dot(l, area)) / (distance * distance);
        }
    return sum;
}

static void four_corners(const flat_light *f, graze_vec3 corners[4]) {
    corners[0] = f->corner;
    corners[1] = add(f->corner, 1, f->first);
    corners[2] = add(corners[1], 1, f->second);
    corners[3] = add(f->corner, 1, f->second);
}

static double reflected(const graze_brdf *brdf, const flat_light *f, graze_vec3 v) {
    graze_vec3 corners[4];
    four_corners(f, corners);
    if (brdf)
        return f->ellipse ? graze_brdf_ellipse(brdf, f->corner, f->first, f->second, v)
                          : graze_brdf_polygon(brdf, corners, 4, v);
    return f->ellipse ? graze_diffuse_ellipse(f->corner, f->first, f->second) : graze_diffuse_polygon(corners, 4);
}

typedef struct situation {
    graze_brdf brdf;
    graze_vec3 v;
    flat_light light;
} situation;

/* A light of any size near the mirror direction or off it by some roughnesses. */
static situation draw_situation(uint64_t *seed, int i) {
    situation s;
    double cosine = i % 4 == 0 ? .0175 : i % 4 == 1 ? draw_power(seed, 1e-3, 1) : draw(seed);
    double alpha = draw_power(seed, .03, 1);
    s.brdf = (graze_brdf){GRAZE_BRDF_GMD, alpha, i % 2 ? alpha : alpha * draw_between(seed, .3, 3)};
    s.v = direction(cosine, draw_between(seed, 0, 2 * pi));
    double size = draw_power(seed, .05, 2), distance = draw_between(seed, 1, 4);
    graze_vec3 at = {-s.v.x + 2 * alpha * draw_between(seed, -1, 1), -s.v.y + 2 * alpha * draw_between(seed, -1, 1),
                     s.v.z + alpha * draw(seed)};
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

/* Only where quadrature itself is sure, which for sharp lobes it is not. */
static void quadrature(void **state) {
    (void)state;
    uint64_t seed = 1;
    int sure[2] = {0, 0}, count = is_short_run() ? 60 : 400, fine = is_short_run() ? 24 : 40;
    for (int i = 0; i < count; ++i) {
        situation s = draw_situation(&seed, i);
        if (lowest(&s.light) < 1e-3)
            continue;
        for (int diffuse = 0; diffuse < 2; ++diffuse) {
            const graze_brdf *brdf = diffuse ? NULL : &s.brdf;
            double expected = by_quadrature(brdf, &s.light, s.v, fine);
            if (fabs(by_quadrature(brdf, &s.light, s.v, 3 * fine / 4) - expected) > 1e-10 * expected)
                continue;
            assert_near(reflected(brdf, &s.light, s.v), expected, s.light.ellipse ? 1e-6 : 1e-8);
            sure[diffuse]++;
        }
    }
    assert_true(sure[0] > count / 4 && sure[1] > count / 4);
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
        assert_near(graze_brdf_ellipse(&brdf, center, a, b, v), graze_brdf_polygon(&brdf, around, MANY, v), 1e-6);
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
            far[3 - k] = (graze_vec3){1e30 * outer[k].x, 1e30 * outer[k].y, 1e30 * outer[k].z};
        assert_near(graze_brdf_polygon(&brdf, far, 4, v), whole, 1e-9);
    }
    assert_near(graze_diffuse_polygon(seamed, 10), graze_diffuse_polygon(outer, 4) - graze_diffuse_polygon(hole, 4),
                1e-13);
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
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .06, .06};
    for (double angle = 0; angle < 360; angle += 15) {
        flat_light f = {from_degrees(30, 180), {.05, 0, 0}, {0, .05, 0}, false};
        f.corner.x += .5 * cos(angle * pi / 180);
        f.corner.y += .5 * sin(angle * pi / 180);
        graze_vec3 v = from_degrees(30, 0);
        double expected = by_quadrature(&brdf, &f, v, 10);
        assert_true(expected < 1e-4);
        if (!(fabs(reflected(&brdf, &f, v) - expected) <= 1e-6 * expected))
            fail_msg("%g is not %g", reflected(&brdf, &f, v), expected);
    }
}

static const graze_vec3 triangle[] = {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}};

static void nothing(void **state) {
    (void)state;
    const graze_brdf brdf = {GRAZE_BRDF_GMD, .2, .2};
    graze_vec3 v = from_degrees(20, 0), below = {0, 0, -1}, none = {0, 0, 0};
    assert_true(graze_brdf_polygon(&brdf, triangle, 3, v) > 0);
    assert_true(graze_brdf_polygon(&brdf, triangle, 3, below) == 0);
    assert_true(graze_brdf_polygon(&brdf, triangle, 2, v) == 0 && graze_diffuse_polygon(triangle, 2) == 0);
    assert_true(graze_brdf_ellipse(&brdf, triangle[0], none, none, v) == 0);
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
                            graze_diffuse_ellipse(corners[0], corners[1], corners[2])};
        for (int k = 0; k < 4; ++k)
            if (!(results[k] >= 0 && results[k] <= 1))
                fail_msg("result %d of draw %d is %g", k, i, results[k]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quadrature), cmocka_unit_test(whole_sky),         cmocka_unit_test(horizon),
        cmocka_unit_test(identities), cmocka_unit_test(far_from_the_lobe), cmocka_unit_test(nothing),
        cmocka_unit_test(extremes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
