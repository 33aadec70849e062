/* Parts of outlines: that halves are the same curve, where parts are, and how many points they are said to need. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <float.h>

#include "brdf/common.h"
#include "brdf/lobe_part.h"

static void assert_about(double found, double expected, double tolerance) {
    if (!(fabs(found - expected) <= tolerance * fmax(fabs(expected), 1)))
        fail_msg("%.17g is not %.17g", found, expected);
}

static brdf_lobe_field draw_field(uint64_t *seed) {
    double azimuth = draw_between(seed, 0, 2 * pi), c = cos(azimuth), s = sin(azimuth), ax = draw_between(seed, .1, 1),
           ay = draw_between(seed, .1, 1);
    return (brdf_lobe_field){.lean = draw(seed),
                             .a_of_x = c / ax,
                             .a_of_y = s / ay,
                             .a_of_d = draw(seed),
                             .b_of_x = -s / ax,
                             .b_of_y = c / ay,
                             .b_of_d = draw_between(seed, -1, 1),
                             .c_of_d = draw_between(seed, .1, 1),
                             .side = 1};
}

static graze_vec3 draw_point(uint64_t *seed) {
    return (graze_vec3){draw_between(seed, -1, 1), draw_between(seed, -1, 1), draw_between(seed, .3, 1)};
}

static graze_vec3 unit(graze_vec3 e) {
    double length = sqrt(dot(e, e));
    return (graze_vec3){e.x / length, e.y / length, e.z / length};
}

static double bernstein(const double *p, double u) {
    return (1 - u) * (1 - u) * p[0] + 2 * u * (1 - u) * p[1] + u * u * p[2];
}

/* How far a direction is from an edge's curve. */
static double distance_from_curve(const brdf_lobe_field *f, const brdf_part *p, graze_vec3 e) {
    double d = sqrt(dot(e, e)), c = e.z + f->c_of_d * d;
    double a = (f->a_of_x * e.x + f->a_of_y * e.y + f->a_of_d * d) / c;
    double b = (f->b_of_x * e.x + f->b_of_y * e.y + f->b_of_d * d) / c;
    double low = 0, high = 1, nearest = DBL_MAX;
    for (int pass = 0; pass < 60; ++pass) { /* by thirds, as the distance has one minimum */
        double u[] = {low + (high - low) / 3, high - (high - low) / 3}, distance[2];
        for (int i = 0; i < 2; ++i) {
            double by_c = 1 / bernstein(p->c, u[i]);
            distance[i] = hypot(bernstein(p->a, u[i]) * by_c - a, bernstein(p->b, u[i]) * by_c - b);
            nearest = fmin(nearest, distance[i]);
        }
        if (distance[0] < distance[1])
            high = u[1];
        else
            low = u[0];
    }
    return nearest;
}

static void edges(void **state) {
    (void)state;
    uint64_t seed = 91;
    for (int i = 0; i < 300; ++i) {
        const brdf_lobe_field f = draw_field(&seed);
        graze_vec3 from = draw_point(&seed), to = {from.x + .3 * draw(&seed), from.y - .3 * draw(&seed), from.z};
        brdf_part whole = brdf_part_of_edge(&f, unit(from), unit(to)), halves[2];
        brdf_halve_part(&f, &whole, &halves[0], &halves[1]);
        assert_true(whole.is_edge && halves[0].is_edge && halves[1].is_edge);
        for (int k = 0; k <= 2; k += 2) {
            assert_about(whole.c[k], 1, 1e-15);
            assert_about(halves[0].c[k], 1, 1e-15);
            assert_about(halves[1].c[k], 1, 1e-15);
        }
        assert_about(halves[0].a[0], whole.a[0], 1e-14);
        assert_about(halves[1].b[2], whole.b[2], 1e-14);
        for (int k = 0; k <= 8; ++k) {
            double t = k / 8.;
            graze_vec3 e = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.z};
            assert_true(distance_from_curve(&f, &whole, e) < 1e-8);
            assert_true(fmin(distance_from_curve(&f, &halves[0], e), distance_from_curve(&f, &halves[1], e)) < 1e-8);
        }
        double by_c = 1 / bernstein(whole.c, .5), a = bernstein(whole.a, .5) * by_c, b = bernstein(whole.b, .5) * by_c;
        assert_about(halves[0].a[2], a, 1e-13);
        assert_about(halves[0].b[2], b, 1e-13);
        assert_about(halves[1].a[0], a, 1e-13);
        assert_about(halves[1].b[0], b, 1e-13);
    }
}

/* Interpolated where both ends and the middle are, and the misfit as far off as that is in the quarters. */
static void arcs(void **state) {
    (void)state;
    uint64_t seed = 92;
    for (int i = 0; i < 300; ++i) {
        const brdf_lobe_field f = draw_field(&seed);
        const brdf_arc arc = {{draw_point(&seed), draw_point(&seed), draw_point(&seed)}};
        brdf_part whole = brdf_part_of_arc(&f, &arc);
        assert_true(!whole.is_edge);
        assert_about(whole.c[0], 1, 1e-15);
        assert_about(whole.c[2], 1, 1e-15);
        double scale = dot(whole.arc.c[0], arc.c[0]) / dot(arc.c[0], arc.c[0]);
        double end = dot(whole.arc.c[2], arc.c[2]) / dot(arc.c[2], arc.c[2]);
        assert_about(dot(whole.arc.c[1], arc.c[1]) / dot(arc.c[1], arc.c[1]), sqrt(scale * end), 1e-14);
        /* By the arc before it is scaled: so it is for equal ends. */
        brdf_arc even = arc;
        even.c[2] = even.c[0];
        brdf_part p = brdf_part_of_arc(&f, &even);
        double misfit = 0;
        for (int k = 0; k <= 4; ++k) {
            double u = k / 4., s = 1 - u;
            graze_vec3 e = {(s * s + u * u) * even.c[0].x + 2 * u * s * even.c[1].x,
                            (s * s + u * u) * even.c[0].y + 2 * u * s * even.c[1].y,
                            (s * s + u * u) * even.c[0].z + 2 * u * s * even.c[1].z};
            double by_c = 1 / p.arc.c[0].z * even.c[0].z, d = sqrt(dot(e, e)), c = e.z + f.c_of_d * d;
            double off = fabs(bernstein(p.c, u) * by_c - c) / f.c_of_d;
            if (k % 2)
                misfit += off / c;
            else
                assert_about(bernstein(p.a, u) * by_c, f.a_of_x * e.x + f.a_of_y * e.y + f.a_of_d * d, 1e-13);
        }
        assert_about(p.misfit, misfit, 1e-12);
        brdf_part halves[2];
        brdf_halve_part(&f, &whole, &halves[0], &halves[1]);
        assert_about(halves[0].a[0], whole.a[0], 1e-13);
        assert_about(halves[0].a[2], halves[1].a[0], 1e-13);
        assert_about(halves[1].b[2], whole.b[2], 1e-13);
    }
}

static brdf_part part_within(double a, double b, double w) {
    return (brdf_part){.a = {a - .1, a * w, a + .1}, .b = {b + .1, b * w, b - .1}, .c = {1, w, 1}, .is_edge = true};
}

/* Each of the coefficients counts; a middle one of C that is not positive leaves it open. */
static void places(void **state) {
    (void)state;
    for (double w = .5; w < 3; w += 1) {
        for (int sign = -1; sign <= 1; sign += 2) {
            brdf_part p = part_within(sign * 5.9001, .5, w);
            assert_true(brdf_part_is_beside(&p));
            for (int i = 0; i < 3; ++i) {
                brdf_part q = p;
                q.a[i] = sign * 5.7999 * (i == 1 ? w : 1);
                assert_true(!brdf_part_is_beside(&q));
            }
            p = part_within(.5, sign * 5.9001, w);
            assert_true(brdf_part_is_above(&p, sign) && !brdf_part_is_above(&p, -sign));
            assert_true(brdf_part_is_below(&p, -sign) && !brdf_part_is_below(&p, sign));
            assert_true(!brdf_part_is_beside(&p) && brdf_part_side(&p) == sign);
            for (int i = 0; i < 3; ++i) {
                brdf_part q = p;
                q.b[i] = sign * 5.7999 * (i == 1 ? w : 1);
                assert_true(!brdf_part_is_above(&q, sign) && !brdf_part_is_below(&q, -sign));
                q.b[i] = -sign * .001;
                assert_true(brdf_part_side(&q) == 0);
            }
            p.c[1] = 0;
            assert_true(!brdf_part_is_above(&p, sign) && brdf_part_side(&p) == 0);
        }
    }
    brdf_part p = part_within(0, 0, 1);
    assert_true(brdf_part_distance(&p) == 0);
    p = part_within(3, 0, 1);
    assert_about(brdf_part_distance(&p), 2.9, 1e-15);
    p = part_within(1, 0, 1); /* on either side of 1, and of .5 */
    assert_about(brdf_part_distance(&p), .9, 1e-15);
    p.a[0] = 1.1, p.a[1] = -1, p.a[2] = .9;
    assert_about(brdf_part_distance(&p), .9, 1e-15);
    p = part_within(0, .5, 1);
    assert_true(brdf_part_side(&p) == 1);
    p = part_within(0, -.5, 1);
    assert_true(brdf_part_side(&p) == -1);
    p = part_within(-3, 0, 1);
    assert_about(brdf_part_distance(&p), 2.9, 1e-15);
}

/* The formula of lobe_part.h once more. */
static void sizes(void **state) {
    (void)state;
    uint64_t seed = 93;
    for (int i = 0; i < 2000; ++i) {
        const brdf_lobe_field f = {
            .lean = draw(&seed), .a_of_d = draw_between(&seed, -1, 1), .b_of_d = draw_between(&seed, -1, 1), .side = 1};
        double w = draw_between(&seed, .1, 3), a[3], b[3];
        brdf_part p = {.c = {1, w, 1}, .is_edge = i % 2};
        for (int k = 0; k < 3; ++k) {
            a[k] = draw_between(&seed, -.9, 2);
            b[k] = draw_between(&seed, -2, 2) - (i % 3 == 0 ? 8 : 0);
            p.a[k] = a[k] * (k == 1 ? w : 1);
            p.b[k] = b[k] * (k == 1 ? w : 1);
            p.arc.c[k] = (graze_vec3){draw(&seed), draw(&seed), 1};
        }
        p.misfit = draw(&seed);
        double speed = 0, divisor = 0, bend = fabs(a[0] - 2 * w * a[1] + a[2]);
        for (int k = 0; k < 2; ++k) {
            double da = a[k + 1] - a[k], db = i % 3 == 0 ? 0 : b[k + 1] - b[k];
            speed = fmax(speed, pow(2 * w * hypot(da, db), 2));
            divisor = fmax(divisor, pow(4 * f.lean * w * da, 2) / ((1 + f.lean * a[k]) * (1 + f.lean * a[k + 1])));
        }
        if (i % 3 != 0)
            bend += fabs(b[0] - 2 * w * b[1] + b[2]);
        double expected = speed + bend + divisor + 12 * (w < 1 ? (1 - w) * (2 - w) : w - 1);
        if (!p.is_edge)
            expected += 5 * brdf_turn_of_arc(&p.arc) + 100 * p.misfit * (fabs(f.a_of_d) + fabs(f.b_of_d));
        assert_about(brdf_part_size(&f, &p), expected, 1e-12);
        brdf_part degenerate = p;
        degenerate.c[1] = 0;
        assert_true(brdf_part_size(&f, &degenerate) == DBL_MAX);
        degenerate = p;
        degenerate.a[1] = -w / f.lean - .001;
        assert_true(brdf_part_size(&f, &degenerate) == DBL_MAX);
    }
}

static void points(void **state) {
    (void)state;
    static const double limits[] = {.02, 2, 6.5, 14};
    for (int i = 0; i < 4; ++i) {
        assert_int_equal(brdf_part_points(limits[i] * .9999), 4 + 4 * i);
        assert_int_equal(brdf_part_points(limits[i] * 1.0001), 8 + 4 * i);
    }
    assert_int_equal(brdf_part_points(NAN), 16); /* not to be cut again and again */
}

/* As polynomials of powers; the last is A'C - AC'. */
static void pieces(void **state) {
    (void)state;
    const brdf_part edge = {.a = {1, 3, -2}, .b = {2, -1, 4}, .c = {1, 2, 1}, .is_edge = true};
    brdf_piece piece;
    brdf_piece_of_part(&piece, &edge, 12);
    assert_true(piece.is_edge && piece.points == 12);
    for (double u = 0; u <= 1; u += .125) {
        double found[4], slope = 2 * ((1 - u) * (3 - 1) + u * (-2 - 3)),
                         c_slope = 2 * ((1 - u) * (2 - 1) + u * (1 - 2));
        for (int i = 0; i < 4; ++i)
            found[i] = piece.polynomials[i][0] + u * (piece.polynomials[i][1] + u * piece.polynomials[i][2]);
        assert_about(found[0], bernstein(edge.a, u), 1e-14);
        assert_about(found[1], bernstein(edge.b, u), 1e-14);
        assert_about(found[2], bernstein(edge.c, u), 1e-14);
        assert_about(found[3], slope * bernstein(edge.c, u) - bernstein(edge.a, u) * c_slope, 1e-14);
    }
    const brdf_part arc = {.arc = {{{1, 2, 3}, {3, -1, 5}, {-2, 4, 6}}}};
    brdf_piece_of_part(&piece, &arc, 8);
    assert_true(!piece.is_edge && piece.points == 8);
    for (double u = 0; u <= 1; u += .125)
        for (int i = 0; i < 3; ++i) {
            const double p[] = {i == 0 ? 1 : 1. + i, i == 0 ? 3 : i == 1 ? -1 : 5, i == 0 ? -2 : i == 1 ? 4 : 6};
            assert_about(piece.polynomials[i][0] + u * (piece.polynomials[i][1] + u * piece.polynomials[i][2]),
                         bernstein(p, u), 1e-14);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges), cmocka_unit_test(arcs),   cmocka_unit_test(places),
        cmocka_unit_test(sizes), cmocka_unit_test(points), cmocka_unit_test(pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
