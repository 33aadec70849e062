/* Outlines cut at the horizon: that they are closed, along the light's own, and above the surface. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <float.h>

#include "brdf/common.h"
#include "brdf/outline.h"

/* What has been visited: the ends of all parts, and points of arcs. */
typedef struct chain {
    int edges, arcs;
    graze_vec3 first, last;
    graze_vec3 corners[64], points[64];
    int corner_count, point_count;
} chain;

static graze_vec3 unit(graze_vec3 e) {
    double length = sqrt(dot(e, e));
    return (graze_vec3){e.x / length, e.y / length, e.z / length};
}

static void assert_same(graze_vec3 a, graze_vec3 b, double tolerance) {
    graze_vec3 p = unit(a), q = unit(b);
    if (!(fabs(p.x - q.x) <= tolerance && fabs(p.y - q.y) <= tolerance && fabs(p.z - q.z) <= tolerance))
        fail_msg("%g %g %g is not the direction of %g %g %g", a.x, a.y, a.z, b.x, b.y, b.z);
}

static void extend(chain *c, graze_vec3 from, graze_vec3 to) {
    assert_true(from.z >= 0 && to.z >= 0);
    if (c->edges + c->arcs == 0)
        c->first = from;
    else
        assert_same(from, c->last, 1e-15);
    c->last = to;
    c->corners[c->corner_count++ % 64] = to;
}

static void see_edge(void *context, graze_vec3 from, graze_vec3 to) {
    chain *c = context;
    assert_true(fabs(dot(from, from) - 1) < 1e-15 && fabs(dot(to, to) - 1) < 1e-15);
    extend(c, from, to);
    c->edges++;
}

static void add_points(chain *c, const brdf_arc *arc) {
    for (int i = 0; i <= 8; ++i) {
        double u = i / 8., s = 1 - u, begin = s * s, middle = 2 * s * u, end = u * u;
        c->points[c->point_count++] = (graze_vec3){begin * arc->c[0].x + middle * arc->c[1].x + end * arc->c[2].x,
                                                   begin * arc->c[0].y + middle * arc->c[1].y + end * arc->c[2].y,
                                                   begin * arc->c[0].z + middle * arc->c[1].z + end * arc->c[2].z};
    }
}

static void see_arc(void *context, const brdf_arc *arc) {
    chain *c = context;
    extend(c, arc->c[0], arc->c[2]);
    c->arcs++;
    add_points(c, arc);
}

static chain of_polygon(const graze_vec3 *corners, size_t count) {
    chain c = {0};
    brdf_outline_of_polygon(corners, count, &(brdf_outline_visitor){see_edge, see_arc, &c});
    if (c.edges > 0)
        assert_same(c.first, c.last, 0);
    assert_int_equal(c.arcs, 0);
    return c;
}

static void polygon_above(void **state) {
    (void)state;
    static const graze_vec3 corners[] = {{1, 0, 1}, {0, 2, 1}, {-3, 0, 1}, {0, -1, 4}};
    chain c = of_polygon(corners, 4);
    assert_int_equal(c.edges, 4);
    for (int i = 0; i < 4; ++i)
        assert_same(c.corners[i], corners[(i + 1) % 4], 2e-16);
}

static void polygon_cut(void **state) {
    (void)state;
    static const graze_vec3 corners[] = {{1, 1, -1}, {3, 1, -3}, {2, 2, 1}}, expected[] = {
                                                                                 {9. / 4, 7. / 4, 0},
                                                                                 {2, 2, 1},
                                                                                 {3. / 2, 3. / 2, 0},
                                                                             };
    for (int turn = 0; turn < 3; ++turn) {
        const graze_vec3 turned[] = {corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]};
        chain c = of_polygon(turned, 3);
        assert_int_equal(c.edges, 3);
        for (int i = 0, k = 0; i < 3; ++i) {
            for (k = 0; k < 3 && !(fabs(dot(c.corners[i], unit(expected[k])) - 1) < 1e-15);)
                ++k;
            assert_true(k < 3);
            assert_same(c.corners[(i + 1) % 3], expected[(k + 1) % 3], 4e-16);
        }
    }
    static const graze_vec3 below[] = {{1, 1, -1}, {3, 1, -3}, {2, 2, 0}};
    assert_int_equal(of_polygon(below, 3).edges, 0);
    /* On end, the horizon is joined: a comb of two teeth. */
    static const graze_vec3 comb[] = {{1, 0, -1}, {1, 0, 1}, {2, 1, -.5}, {1, 2, 1}, {0, 1, -1}};
    assert_int_equal(of_polygon(comb, 5).edges, 6);
}

static void ellipse(void **state) {
    (void)state;
    uint64_t seed = 81;
    int whole = 0, cut = 0, below = 0;
    for (int i = 0; i < 1000; ++i) {
        graze_vec3 center = {draw_between(&seed, -2, 2), draw_between(&seed, -2, 2), draw_between(&seed, -1, 2)};
        graze_vec3 axes[2] = {{draw(&seed), draw(&seed), i % 5 == 0 ? 0 : draw_between(&seed, -1, 1)},
                              {draw(&seed), -draw(&seed), i % 5 == 0 ? 0 : draw_between(&seed, -1, 1)}};
        chain c = {0};
        brdf_outline_of_ellipse(center, axes[0], axes[1], &(brdf_outline_visitor){see_edge, see_arc, &c});
        double rise = hypot(axes[0].z, axes[1].z);
        int expected = center.z <= -rise ? 0 : 4;
        assert_int_equal(c.arcs, expected);
        assert_int_equal(c.edges, expected > 0 && center.z < rise);
        whole += expected == 4 && c.edges == 0;
        cut += c.edges;
        below += expected == 0;
        if (expected == 0)
            continue;
        assert_same(c.first, c.last, 1e-15);
        /* e = k (center + x first + y second) with x^2 + y^2 = 1: (1, x, y) k by Cramer's rule */
        graze_vec3 f = axes[0], s = axes[1];
        graze_vec3 fs = {f.y * s.z - f.z * s.y, f.z * s.x - f.x * s.z, f.x * s.y - f.y * s.x};
        double determinant = dot(center, fs);
        double before = 0, swept = 0;
        for (int k = 0; k < c.point_count; ++k) {
            graze_vec3 e = c.points[k];
            graze_vec3 ce = {center.y * e.z - center.z * e.y, center.z * e.x - center.x * e.z,
                             center.x * e.y - center.y * e.x};
            double scale = dot(e, fs), x = -dot(ce, s), y = dot(ce, f);
            if (!(fabs(x * x + y * y - scale * scale) <= 1e-12 * (x * x + y * y) / fmin(fabs(determinant), 1)))
                fail_msg("a point is off the ellipse: %g and %g", hypot(x, y), scale);
            double angle = atan2(y / scale, x / scale), step = angle - before;
            if (k > 0)
                swept += step - 2 * pi * floor(step / (2 * pi) + .5);
            before = angle;
        }
        double half = center.z >= rise ? pi : acos(-center.z / rise);
        if (!(fabs(fabs(swept) - 2 * half) < 1e-9 / fabs(determinant)))
            fail_msg("%g of %g are swept", swept, 2 * half);
    }
    assert_true(whole > 100 && cut > 100 && below > 100);
}

static void turn(void **state) {
    (void)state;
    for (double angle = .1; angle < 1.5; angle += .1) {
        double c = cos(angle / 2), s = sin(angle / 2), middle = (1 + c) / 2;
        const brdf_arc arc = {{{c, -s, 0}, {1, 0, 0}, {c, s, 0}}};
        assert_true(fabs(brdf_turn_of_arc(&arc) / (4 * s * s / pow(middle, 4)) - 1) < 1e-14);
        const brdf_arc even = {{{0, 0, 1}, {s, 0, 1}, {0, 0, 1}}};
        assert_true(fabs(brdf_turn_of_arc(&even) / (4 * s * s + 2 * s) - 1) < 1e-14);
        for (int i = 0; i < 2; ++i) {
            brdf_arc uneven = even;
            uneven.c[2 * i].z = 2;
            assert_true(fabs(brdf_turn_of_arc(&uneven) / (16 * s * s + 3 * s) - 1) < 1e-14);
        }
    }
    for (int i = 0; i < 3; ++i) {
        brdf_arc wide = {{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}};
        wide.c[i] = (graze_vec3){1, -1.001, 0};
        assert_true(brdf_turn_of_arc(&wide) == DBL_MAX);
    }
    const brdf_arc first = {{{1, 0, 0}, {-.5, 1, 0}, {1, 1, 0}}}, last = {{{1, 1, 0}, {-.5, 1, 0}, {1, 0, 0}}};
    assert_true(brdf_turn_of_arc(&first) == DBL_MAX && brdf_turn_of_arc(&last) == DBL_MAX);
    const brdf_arc opposite = {{{-1, 0, 1}, {0, 0, 1}, {1.001, 0, 1}}};
    assert_true(brdf_turn_of_arc(&opposite) == DBL_MAX);
}

/* Halves are the same curve. */
static void halves(void **state) {
    (void)state;
    const brdf_arc arc = {{{1, 2, 3}, {-2, 5, 1}, {4, 4, 2}}};
    brdf_arc parts[2];
    brdf_halve_arc(&arc, &parts[0], &parts[1]);
    chain c = {0};
    add_points(&c, &arc);
    add_points(&c, &parts[0]);
    add_points(&c, &parts[1]);
    for (int i = 0; i <= 4; ++i) {
        assert_same(c.points[9 + 2 * i], c.points[i], 1e-15);
        assert_same(c.points[18 + 2 * i], c.points[4 + i], 1e-15);
    }
    assert_same(brdf_middle_of_arc(&arc), c.points[4], 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygon_above), cmocka_unit_test(polygon_cut), cmocka_unit_test(ellipse),
        cmocka_unit_test(turn),          cmocka_unit_test(halves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
