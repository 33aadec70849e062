/* Crossings against extended precision. */
#include "geometry/make.h"

#include "geometry/crossing.h"
#include "geometry/oracle.h"

#define ULP 0x1p-52

/* Distance of a point to the surface as continued beyond its edges. */
static long double residual(const shape *s, vec3 point) {
    exact3 p = exact(point);
    switch (s->kind) {
    case SHAPE_SPHERE:
        return exact_length(exact_add(p, -1, exact(s->sphere.center))) - s->sphere.radius;
    case SHAPE_CONE: {
        exact3 p0 = exact(s->cone.p0), axis = exact_add(exact(s->cone.p1), -1, p0);
        long double length = exact_length(axis);
        exact3 w = exact_add(p, -1, p0);
        long double z = exact_dot(w, axis) / length, k = (s->cone.r1 - (long double)s->cone.r0) / length;
        return (exact_length(exact_cross(w, axis)) / length - s->cone.r0 - k * z) / sqrtl(1 + k * k);
    }
    case SHAPE_RING:
        return exact_dot(exact(s->ring.normal), exact_add(p, -1, exact(s->ring.center)));
    case SHAPE_POLYGON:
        return exact_dot(exact(s->polygon.normal), exact_add(p, -1, exact(s->polygon.center)));
    }
    return INFINITY;
}

static shape roll_curved(dice *d, int kind, double scale, vec3 at) {
    vec3 p0 = vec3_add(at, roll_in_cube(d, scale)), p1 = vec3_add(at, roll_in_cube(d, scale));
    double r0 = scale * roll_between(d, 0.01, 1), r1 = scale * roll_between(d, 0.01, 1);
    switch (kind) {
    case 0:
        return make_sphere(p0, r0);
    case 1:
        return make_cone(p0, p1, r0, r0);
    case 2:
        return make_cone(p0, p1, r0, r1);
    case 3:
        return make_cone(p0, p1, r0, 0);
    default:
        return make_ring(p0, vec3_subtract(p1, p0), fmin(r0, r1) / 2, fmax(r0, r1));
    }
}

/* Crossings agree with the oracle's in number and distance, and the points pulled onto the surface satisfy its
 * equation, for shapes from a millimetre to a kilometre, also far from the origin, and rays from near and far. */
static void crossings_are_exact(void **state) {
    (void)state;
    dice d = {1};
    const double scales[] = {1e-3, 1, 1e3}, aways[] = {0, 1, 1e4}, ray_aways[] = {1, 100};
    int crossed = 0;
    for (int i = 0; i < 200000; i++) {
        double scale = scales[i % 3], away = aways[i / 3 % 3] * scale, ray_away = ray_aways[i / 9 % 2] * scale;
        vec3 at = roll_in_cube(&d, away);
        shape s = roll_curved(&d, i / 18 % 5, scale, at);
        vec3 origin = vec3_add(at, roll_in_cube(&d, ray_away));
        vec3 direction = vec3_normalize(vec3_subtract(vec3_add(at, roll_in_cube(&d, scale)), origin));
        shape_crossings c = shape_cross(&s, origin, direction, false);
        oracle_crossing expected[2];
        int n = oracle_crossings(&s, exact(origin), exact(direction), expected);
        double size = vec3_max_abs(at) + vec3_max_abs(origin) + 4 * scale;
        long double margin = INFINITY;
        for (int k = 0; k < n; k++)
            margin = fminl(margin, expected[k].margin);
        if (n != c.count) {
            /* Only at an edge may the numbers differ; how near the other side missed it the oracle cannot say. */
            if (n > c.count && margin > 1e-11 * size)
                fail_msg("shape %d: %d crossings, not %d, margin %Lg", i / 18 % 5, c.count, n, margin);
            continue;
        }
        for (int k = 0; k < n; k++) {
            int from = n == 2 && expected[0].distance > expected[1].distance ? 1 - k : k;
            vec3 pulled = shape_pull(&s, vec3_add_scaled(origin, c.distance[k], direction));
            if (fabsl(residual(&s, pulled)) > 4 * ULP * size)
                fail_msg("shape %d: off the surface by %Lg ulp", i / 18 % 5, residual(&s, pulled) / (ULP * size));
            if (margin < 1e-6 * scale)
                continue;
            vec3 normal = shape_normal(&s, pulled);
            double tolerance = 16 * ULP * size / fabs(vec3_dot(normal, direction));
            if (fabsl(c.distance[k] - expected[from].distance) > tolerance)
                fail_msg("shape %d: distance %.17g, not %.17Lg", i / 18 % 5, c.distance[k], expected[from].distance);
            crossed++;
        }
    }
    assert_true(crossed > 50000);
}

/* A line that leaves a point of the shape has at most the other crossing, where the oracle sees it. */
static void leaving_divides_the_origin_out(void **state) {
    (void)state;
    dice d = {2};
    int seen = 0;
    for (int i = 0; i < 100000; i++) {
        shape s = roll_curved(&d, i % 4, 1, vec3_make(0, 0, 0));
        vec3 origin = roll_in_cube(&d, 3), direction = vec3_normalize(vec3_subtract(roll_in_cube(&d, 1), origin));
        shape_crossings c = shape_cross(&s, origin, direction, false);
        if (!c.count)
            continue;
        vec3 point = shape_pull(&s, vec3_add_scaled(origin, c.distance[0], direction));
        vec3 next = roll_direction(&d);
        if (i % 5 == 0) /* almost tangent */
            next = vec3_normalize(vec3_add_scaled(vec3_cross(next, shape_normal(&s, point)), 1e-7, next));
        shape_crossings left = shape_cross(&s, point, next, true);
        assert_true(left.count <= 1);
        oracle_crossing expected[2];
        int n = oracle_crossings(&s, exact(point), exact(next), expected);
        if (n == 2) {
            long double other =
                fabsl(expected[0].distance) > fabsl(expected[1].distance) ? expected[0].distance : expected[1].distance;
            double cosine = fabs(vec3_dot(shape_normal(&s, point), next));
            /* A chord is 2 r cos; close to the tangent the origin's rounding counts for more and more of it. */
            if (cosine > 1e-9 && expected[0].margin > 1e-14 && expected[1].margin > 1e-14) {
                assert_int_equal(left.count, 1);
                if (fabsl(left.distance[0] - other) > 100 * ULP * 4 * fmaxl(1, fabsl(other)) / cosine)
                    fail_msg("shape %d: %.17g, not %.17Lg (cosine %g)", i % 4, left.distance[0], other, cosine);
                seen++;
            }
        }
    }
    if (seen < 10000)
        fail_msg("only %d seen", seen);
}

static void flat_shapes_are_not_crossed_again(void **state) {
    (void)state;
    shape ring = make_ring(vec3_make(0, 0, 0), vec3_make(0, 0, 1), 0, 1);
    assert_int_equal(shape_cross(&ring, vec3_make(0.1, 0, 0), vec3_make(0.6, 0, 0.8), true).count, 0);
    assert_int_equal(shape_cross(&ring, vec3_make(0.1, 0, 0), vec3_make(0.6, 0, 0.8), false).count, 1);
    assert_int_equal(shape_cross(&ring, vec3_make(0.1, 0, 0), vec3_make(1, 0, 0), false).count, 0);
    assert_int_equal(shape_cross(&ring, vec3_make(0.1, 0, 1), vec3_make(1, 0, 0), false).count, 0);
}

/* Along the axis, along a generator, through the apex: where the quadratic degenerates. */
static void degenerate_lines(void **state) {
    (void)state;
    shape cylinder = make_cone(vec3_make(0, 0, 0), vec3_make(0, 0, 2), 1, 1);
    assert_int_equal(shape_cross(&cylinder, vec3_make(0.5, 0, -1), vec3_make(0, 0, 1), false).count, 0);
    shape cone = make_cone(vec3_make(0, 0, 0), vec3_make(0, 0, 1), 0, 1);
    shape_crossings c = shape_cross(&cone, vec3_make(0.5, 0, -1), vec3_make(0, 0, 1), false);
    assert_int_equal(c.count, 1);
    assert_true(fabs(c.distance[0] - 1.5) < 4 * ULP);
    /* parallel to the generator y = 0, x = z */
    vec3 generator = vec3_normalize(vec3_make(1, 0, 1));
    c = shape_cross(&cone, vec3_make(0, 0, 0.5), generator, false);
    assert_int_equal(c.count, 1);
    assert_true(fabs(c.distance[0] + sqrt(2) / 4) < 4 * ULP);
    c = shape_cross(&cone, vec3_make(0.25, 0, 0.25), generator, true);
    assert_int_equal(c.count, 0);
    c = shape_cross(&cone, vec3_make(0, 0, -1), vec3_make(0, 0, 1), false);
    for (int i = 0; i < c.count; i++)
        assert_true(fabs(c.distance[i] - 1) < 4 * ULP);
    shape sphere = make_sphere(vec3_make(0, 0, 0), 1);
    c = shape_cross(&sphere, vec3_make(0, 0, 0), vec3_make(0, 0, 1), false);
    assert_int_equal(c.count, 2);
    assert_true(c.distance[0] == -1 && c.distance[1] == 1);
    assert_int_equal(shape_cross(&sphere, vec3_make(0, 1 + ULP, -5), vec3_make(0, 0, 1), false).count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossings_are_exact),
        cmocka_unit_test(leaving_divides_the_origin_out),
        cmocka_unit_test(flat_shapes_are_not_crossed_again),
        cmocka_unit_test(degenerate_lines),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
