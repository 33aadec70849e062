/* Hits against brute force in double precision; watertight meshes; edges, corners and coincident faces. */
#include "geometry/make.h"

#include "geometry/few.h"
#include "geometry/geometry.h"
#include "geometry/oracle.h"
#include "geometry/scenes.h"

/* Whether surfaces without area, which no ray meets, are put beside all others, so that Embree is asked of these
 * however few they are. */
static bool crowded;

static const shape *crowd(const shape *shapes, size_t *count) {
    shape *all = arena_allocate(memory, (*count + 2 * GEOMETRY_FEW + 1) * sizeof *all);
    vec3 *nothing = arena_allocate(memory, 3 * sizeof *nothing), lower, upper;
    assert_true(all && nothing);
    shape_bounds(&shapes[0], &lower, &upper);
    nothing[0] = nothing[1] = nothing[2] = lower;
    for (size_t i = 0; i < *count; i++)
        all[i] = shapes[i];
    for (int i = 0; i <= 2 * GEOMETRY_FEW; i++)
        shape_from_triangle(&all[(*count)++], nothing);
    return all;
}

static geometry *build(const shape *shapes, size_t count, int threads) {
    geometry *g;
    if (crowded)
        shapes = crowd(shapes, &count);
    messages m = {0};
    graze_report report = {messages_write, &m};
    if (geometry_build(&g, &(geometry_group){.shapes = shapes, .shape_count = count}, 1, threads, &report) != GRAZE_OK)
        fail_msg("%s", m.last);
    return g;
}

static void empty_scene(void **state) {
    (void)state;
    geometry *g = build(NULL, 0, 1);
    geometry_ray ray = ray_from(vec3_make(0, 0, 0), vec3_make(0, 0, 1), -1);
    geometry_hit hit;
    assert_false(geometry_intersect(g, &ray, &hit));
    assert_int_equal(hit.surface, -1);
    assert_false(geometry_occluded(g, &ray, -1));
    geometry_destroy(g);
    geometry_destroy(NULL);
}

/* Whether the oracle's answer hangs on less than double precision can tell. */
static bool is_doubtful(const oracle_crossing *c, double size) {
    return c->margin < 1e-13 * size;
}

static int compare_with_oracle(const geometry *g, const shape *shapes, const geometry_ray *ray, double size,
                               geometry_hit *hit) {
    oracle_crossing expected = oracle_nearest(shapes, ZOO, ray);
    bool found = geometry_intersect(g, ray, hit);
    assert_true(found == (hit->surface >= 0));
    assert_true(geometry_occluded(g, ray, -1) == found || is_doubtful(&expected, size));
    if (hit->surface != expected.surface) {
        if (!is_doubtful(&expected, size))
            fail_msg("surface %d, not %d at %.17Lg (margin %Lg)", (int)hit->surface, expected.surface,
                     expected.distance, expected.margin);
        return 0;
    }
    if (!found)
        return 0;
    double cosine = fabs(vec3_dot(hit->normal, ray->direction));
    assert_true(expected.front == (vec3_dot(hit->normal, ray->direction) < 0) || cosine < 1e-7);
    if (cosine < 1e-4)
        return 1;
    double tolerance = 1e-12 * hit->distance + 16 * 0x1p-52 * size / cosine;
    if (fabsl(hit->distance - expected.distance) > tolerance)
        fail_msg("surface %d at %.17g, not %.17Lg", (int)hit->surface, hit->distance, expected.distance);
    vec3 along = vec3_add_scaled(ray->origin, hit->distance, ray->direction);
    assert_true(vec3_length(vec3_subtract(along, hit->point)) <= tolerance);
    return 1;
}

static void same_as_brute_force(void **state) {
    (void)state;
    dice d = {11};
    const double scales[] = {1, 1e-3, 1e3}, aways[] = {0, 1e4};
    int hits = 0, second_hits = 0;
    for (int scene = 0; scene < 18; scene++) {
        double scale = scales[scene % 3];
        vec3 at = roll_in_cube(&d, aways[scene / 3 % 2] * scale);
        shape shapes[ZOO];
        roll_zoo(&d, shapes, scale, at);
        geometry *g = build(shapes, ZOO, 1 + scene % 2);
        double size = vec3_max_abs(at) + 4 * scale;
        for (int i = 0; i < 1500; i++) {
            double from_afar = i % 3 ? 2 : 1000;
            vec3 origin = vec3_add(at, roll_in_cube(&d, from_afar * scale));
            vec3 direction = vec3_subtract(vec3_add(at, roll_in_cube(&d, scale)), origin);
            geometry_ray ray = ray_from(origin, direction, -1);
            geometry_hit hit;
            if (!compare_with_oracle(g, shapes, &ray, size + from_afar * scale, &hit))
                continue;
            hits++;
            for (int bounce = 0; bounce < 3; bounce++) {
                ray = ray_from(hit.point, roll_direction(&d), hit.surface);
                if (!compare_with_oracle(g, shapes, &ray, size, &hit))
                    break;
                second_hits++;
            }
        }
        geometry_destroy(g);
    }
    assert_true(hits > 15000 && second_hits > 15000);
}

/* Occlusion before the distance given, with and without a surface excepted, against the oracle. */
static void occlusion_same_as_brute_force(void **state) {
    (void)state;
    dice d = {12};
    shape shapes[ZOO];
    roll_zoo(&d, shapes, 1, vec3_make(0, 0, 0));
    geometry *g = build(shapes, ZOO, 1);
    int occluded = 0, free_ones = 0;
    for (int i = 0; i < 20000; i++) {
        vec3 origin = roll_in_cube(&d, 1.5), to = roll_in_cube(&d, 1.5), direction = vec3_subtract(to, origin);
        geometry_ray ray = ray_from(origin, direction, -1);
        ray.far = vec3_length(direction);
        int target = i % 2 ? (int)(roll(&d) * ZOO) : -1;
        bool expected = false, doubtful = false;
        for (int s = 0; s < ZOO; s++) {
            oracle_crossing c[2];
            int n = s == target ? 0 : oracle_crossings(&shapes[s], exact(ray.origin), exact(ray.direction), c);
            for (int k = 0; k < n; k++) {
                expected |= c[k].distance > 0 && c[k].distance < ray.far;
                doubtful |= is_doubtful(&c[k], 2);
            }
        }
        if (!doubtful)
            assert_true(geometry_occluded(g, &ray, target) == expected);
        occluded += expected;
        free_ones += !expected;
    }
    assert_true(occluded > 5000 && free_ones > 2000);
    geometry_destroy(g);
}

/* Sends rays about inside of a closed convex surface; each must hit the surface's inside, and so must the ray that goes
 * on from there in another direction inwards. Every other ray goes for some corner or the middle of some edge. */
static void check_closed(const shape *shapes, size_t count, vec3 inside, double reach, int rays, uint64_t seed) {
    geometry *g = build(shapes, count, 2);
    dice d = {seed};
    geometry_ray ray = ray_from(inside, vec3_make(0, 0, 1), -1);
    for (int i = 0; i < rays; i++) {
        if (i % 8 == 0)
            ray = ray_from(vec3_add(inside, roll_in_cube(&d, reach)), roll_direction(&d), -1);
        if (i % 2) {
            const shape *s = &shapes[(size_t)(roll(&d) * count)];
            vec3 a = s->polygon.vertices[0], b = s->polygon.vertices[1];
            vec3 at = i % 4 == 1 ? a : vec3_add_scaled(a, 0.5, vec3_subtract(b, a));
            /* A ray along the face that it leaves meets nothing. */
            if (ray.from < 0 ||
                fabs(vec3_dot(shapes[ray.from].polygon.normal, vec3_subtract(at, ray.origin))) > 1e-3 * reach)
                ray = ray_from(ray.origin, vec3_subtract(at, ray.origin), ray.from);
        }
        geometry_hit hit;
        if (!geometry_intersect(g, &ray, &hit))
            fail_msg("ray %d leaks from (%.17g %.17g %.17g) towards (%.17g %.17g %.17g), having left %d", i,
                     ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
                     (int)ray.from);
        if (!geometry_occluded(g, &ray, -1))
            fail_msg("ray %d is not occluded", i);
        vec3 next = roll_direction(&d);
        if (vec3_dot(next, hit.normal) > 0)
            next = vec3_negate(next);
        ray = ray_from(hit.point, next, hit.surface);
        /* On an edge, to its roundings, inwards of one face may be outwards of the other. */
        if (i % 2)
            ray = ray_from(vec3_add_scaled(hit.point, 0.5, vec3_subtract(inside, hit.point)), next, -1);
    }
    geometry_destroy(g);
}

static void no_leaks_in_a_box(void **state) {
    (void)state;
    static shape shapes[12 * 20 * 20];
    size_t count = make_box(shapes, vec3_make(-1, -1, -1), 2, 20);
    check_closed(shapes, count, vec3_make(0, 0, 0), 0.9, 250000, 5);
    vec3 far_away = vec3_make(12345.678, -9876.54321, 333.3333);
    count = make_box(shapes, far_away, 2, 20);
    check_closed(shapes, count, vec3_add(far_away, vec3_make(1, 1, 1)), 0.9, 250000, 6);
}

static void no_leaks_in_a_globe(void **state) {
    (void)state;
    static shape shapes[4 * 40 * 40];
    size_t count = make_globe(shapes, vec3_make(0, 0, 0), 1, 40);
    check_closed(shapes, count, vec3_make(0, 0, 0), 0.5, 250000, 7);
    count = make_globe(shapes, vec3_make(1e3, 7e3, 1e3 / 3), 1e-3, 40);
    check_closed(shapes, count, vec3_make(1e3, 7e3, 1e3 / 3), 5e-4, 250000, 8);
}

/* A globe of triangles half a millimetre large, away from the middle of a site of some kilometres: single precision
 * over the whole scene is as coarse as its triangles. */
static void no_leaks_in_a_small_part_of_a_large_scene(void **state) {
    (void)state;
    static shape shapes[4 * 40 * 40 + 1];
    vec3 center = {700, -400, 0.01};
    size_t count = make_globe(shapes, center, 0.01, 40);
    shapes[count++] = quadrangle(vec3_make(-2e3, -2e3, -1), vec3_make(2e3, -2e3, -1), vec3_make(2e3, 2e3, -1),
                                 vec3_make(-2e3, 2e3, -1));
    geometry *g = build(shapes, count, 1);
    dice d = {9};
    for (int i = 0; i < 10000; i++) {
        geometry_ray ray = ray_from(vec3_add(center, roll_in_cube(&d, 5e-3)), roll_direction(&d), -1);
        geometry_hit hit;
        assert_true(geometry_intersect(g, &ray, &hit));
        if (hit.surface == (int)count - 1)
            fail_msg("ray %d leaks", i);
    }
    geometry_destroy(g);
}

/* Rays that all but lie in the floor end where it meets a wall: which of both is hit first hangs on the last digits,
 * and single precision sees them far apart. */
static void no_leaks_along_the_floor(void **state) {
    (void)state;
    for (int n = 1; n <= 9; n += 4) {
        static shape shapes[12 * 9 * 9];
        size_t count = make_box(shapes, vec3_make(-1, -1, -1), 2, n);
        geometry *g = build(shapes, count, 1);
        dice d = {61};
        for (int i = 0; i < 50000; i++) {
            vec3 origin =
                vec3_make(roll_between(&d, -1, 1), roll_between(&d, -1, 0.9), -1 + pow(10, roll_between(&d, -7, 0)));
            vec3 to = vec3_make(roll_between(&d, -1, 1), 1,
                                -1 + roll_between(&d, -1, 1) * pow(10, roll_between(&d, -17, -6)));
            geometry_ray ray = ray_from(origin, vec3_subtract(to, origin), -1);
            geometry_hit hit;
            if (!geometry_intersect(g, &ray, &hit))
                fail_msg("n %d: ray %d leaks from (%.17g %.17g %.17g) towards (%.17g %.17g %.17g)", n, i, origin.x,
                         origin.y, origin.z, to.x, to.y, to.z);
            assert_true(geometry_occluded(g, &ray, -1));
            assert_true(hit.point.z >= -1 - 1e-15 && hit.point.y <= 1 + 1e-15);
        }
        geometry_destroy(g);
    }
}

/* Nothing is lost right in front of a ray's origin or right before its end, in a scene where single precision sees
 * nothing below a tenth of a millimetre. */
static void close_to_both_ends(void **state) {
    (void)state;
    frame f = frame_around(vec3_normalize(vec3_make(0.3, -0.5, 0.6)));
    vec3 corner[4];
    for (int k = 0; k < 4; k++)
        corner[k] = frame_to_world(&f, vec3_make(k == 1 || k == 2 ? 1e3 : -1e3, k >= 2 ? 1e3 : -1e3, 0));
    shape wall = quadrangle(corner[0], corner[1], corner[2], corner[3]);
    geometry *g = build(&wall, 1, 1);
    dice d = {71};
    for (int i = 0; i < 20000; i++) {
        double slope = roll_between(&d, 0.1, 1), phi = 2 * PI * roll(&d), flat = sqrt(1 - slope * slope);
        vec3 direction = frame_to_world(&f, vec3_make(flat * cos(phi), flat * sin(phi), -slope));
        vec3 foot = frame_to_world(&f, vec3_make(roll_between(&d, -900, 900), roll_between(&d, -900, 900), 0));
        double distance = pow(10, roll_between(&d, -5, 0));
        geometry_ray ray = ray_from(vec3_add_scaled(foot, -distance, direction), direction, -1);
        geometry_hit hit;
        assert_true(geometry_intersect(g, &ray, &hit));
        assert_true(fabs(hit.distance - distance) < 1e-11);
        assert_true(geometry_occluded(g, &ray, -1));
        /* the same seen from afar */
        ray = ray_from(vec3_add_scaled(foot, -500, direction), direction, -1);
        ray.far = 500 + 1e-5;
        assert_true(geometry_occluded(g, &ray, -1));
        ray.far = 500 - 1e-5;
        assert_false(geometry_occluded(g, &ray, -1));
        assert_false(geometry_intersect(g, &ray, &hit));
    }
    geometry_destroy(g);
}

/* From a point of the floor much closer to the wall than what is ignored of coincident surfaces, the wall is seen. */
static void wall_beside_the_origin(void **state) {
    (void)state;
    static shape shapes[12];
    size_t count = make_box(shapes, vec3_make(-1, -1, -1), 2, 1);
    geometry *g = build(shapes, count, 1);
    geometry_ray down = ray_from(vec3_make(1 - 1e-9, 0.3, 0), vec3_make(0, 0, -1), -1);
    geometry_hit floor_hit, hit;
    assert_true(geometry_intersect(g, &down, &floor_hit));
    geometry_ray ray = ray_from(floor_hit.point, vec3_make(1, 0.1, 0.2), floor_hit.surface);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(hit.normal.x == 1 && hit.distance < 1.1e-9);
    assert_true(geometry_occluded(g, &ray, -1));
    geometry_destroy(g);
}

/* Lines just inside of a shape's bounds, where single precision may see them outside. */
static void curved_shapes_up_to_their_bounds(void **state) {
    (void)state;
    dice d = {81};
    int hits = 0;
    for (int i = 0; i < 2000; i++) {
        vec3 at = roll_in_cube(&d, 10);
        double r = roll_between(&d, 0.01, 1);
        shape shapes[] = {make_sphere(at, r), make_cone(at, vec3_add(at, vec3_make(0, 0, 1)), r, r),
                          make_ring(at, vec3_make(0, 1, 0), 0, r), make_sphere(vec3_make(0, 0, 0), 1e-3),
                          make_sphere(vec3_make(-30, -30, -30), 1)};
        geometry *g = build(shapes, 5, 1);
        for (int k = 0; k < 60; k++) {
            int which = k % 3;
            double inside = pow(10, roll_between(&d, -14, -5));
            vec3 target = vec3_add(at, vec3_make((k & 1 ? 1 : -1) * r * (1 - inside), 0, 0));
            vec3 direction = which == 0 ? vec3_make(0, 0, 1) : which == 1 ? vec3_make(0, 1, 0) : roll_direction(&d);
            if (which == 1)
                target.z += roll(&d);
            geometry_ray ray = {vec3_add_scaled(target, -5, direction), direction, GEOMETRY_FAR, -1};
            shape single = shapes[which];
            oracle_crossing c[2];
            geometry_hit hit;
            int n = oracle_crossings(&single, exact(ray.origin), exact(ray.direction), c);
            if (n == 0 || is_doubtful(&c[0], 100))
                continue;
            assert_true(geometry_occluded(g, &ray, -1));
            assert_true(geometry_intersect(g, &ray, &hit));
            hits++;
        }
        geometry_destroy(g);
    }
    assert_true(hits > 10000);
}

/* A box stands on a floor; its bottom and the floor coincide. */
static void coincident_faces(void **state) {
    (void)state;
    shape shapes[13];
    shapes[0] = quadrangle(vec3_make(-5, -5, 0), vec3_make(5, -5, 0), vec3_make(5, 5, 0), vec3_make(-5, 5, 0));
    size_t count = 1 + make_box(shapes + 1, vec3_make(-1, -1, 0), 2, 1);
    geometry *g = build(shapes, count, 1);
    geometry_hit hit;
    /* From below, the box's bottom faces the ray and the floor does not; from within the box it is the floor. */
    geometry_ray ray = ray_from(vec3_make(0.1, 0.2, -3), vec3_make(0.1, 0, 1), -1);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(hit.surface > 0 && hit.normal.z == -1 && hit.distance > 2.9);
    ray = ray_from(vec3_make(0.1, 0.2, 1), vec3_make(0.1, 0, -1), -1);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_int_equal(hit.surface, 0);
    /* A ray that leaves the floor is not stopped by the bottom at its origin, whichever way it goes. */
    ray = ray_from(hit.point, vec3_make(0, 0.1, 1), 0);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(fabs(hit.point.z - 2) < 1e-15);
    ray = ray_from(ray.origin, vec3_make(0, 0, -1), 0);
    assert_false(geometry_intersect(g, &ray, &hit));
    /* Of a given origin 7 digits count, and no more than Radiance's 1e-6; a surface next to it is at the origin. */
    const struct {
        double x, height;
        bool met;
    } given[] = {{0.2, 1.9e-7, false}, {0.2, 2.1e-7, true}, {2, 9e-7, false}, {2, 1.1e-6, true}, {1e-3, 2e-9, true}};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        ray = ray_from(vec3_make(given[i].x, 0, given[i].height), vec3_make(0, 0, -1), -1);
        assert_true(geometry_intersect(g, &ray, &hit) == given[i].met);
        assert_true(!given[i].met || fabs(hit.distance - given[i].height) < 1e-18);
    }
    geometry_destroy(g);
}

/* A sheet of two polygons back to back shows each side its own, though both shine; shadows end before what coincides
 * with the target. */
static void sheet_of_two_sides(void **state) {
    (void)state;
    vec3 a = {0, 0, 1}, b = {1, 0, 1}, c = {1, 1, 1.5}, e = {0, 1, 1.5};
    for (int kind = 0; kind < 4; kind++) {
        int order = kind % 2;
        shape shapes[2];
        shapes[order] = quadrangle(a, b, c, e);
        shapes[1 - order] = quadrangle(e, c, b, a);
        shapes[0].shines = shapes[1].shines = kind >= 2;
        geometry *g = build(shapes, 2, 1);
        dice d = {3};
        for (int i = 0; i < 2000; i++) {
            vec3 target = vec3_make(roll_between(&d, 0.1, 0.9), roll_between(&d, 0.1, 0.9), 0);
            target.z = 1 + 0.5 * target.y;
            vec3 origin = roll_in_cube(&d, 3);
            double side = vec3_dot(shapes[order].polygon.normal, vec3_subtract(origin, target));
            if (fabs(side) < 1e-2)
                continue;
            geometry_ray ray = ray_from(origin, vec3_subtract(target, origin), -1);
            geometry_hit hit;
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_int_equal(hit.surface, side > 0 ? order : 1 - order);
            ray.far = hit.distance;
            assert_false(geometry_occluded(g, &ray, hit.surface));
            ray = ray_from(hit.point, vec3_subtract(origin, hit.point), hit.surface);
            assert_false(geometry_intersect(g, &ray, &hit));
            assert_false(geometry_occluded(g, &ray, -1));
        }
        geometry_destroy(g);
    }
}

/* In a tilted plane: a ceiling with two lamps that overlap, all facing -z of the frame. */
typedef struct lit_ceiling {
    shape shapes[3];
    int ceiling, square, disk; /* their places among the shapes */
    frame axes;
} lit_ceiling;

#define CEILING_HEIGHT 2.7

static vec3 on_ceiling(const lit_ceiling *c, double x, double y) {
    return frame_to_world(&c->axes, vec3_make(x, y, CEILING_HEIGHT));
}

static shape ceiling_square(const lit_ceiling *c, double half) {
    return quadrangle(on_ceiling(c, -half, -half), on_ceiling(c, -half, half), on_ceiling(c, half, half),
                      on_ceiling(c, half, -half));
}

static lit_ceiling make_lit_ceiling(int order) {
    lit_ceiling c = {.ceiling = order % 3, .axes = frame_around(vec3_normalize(vec3_make(0.3, -0.4, 0.86)))};
    c.square = (c.ceiling + 1 + order / 3) % 3;
    c.disk = (c.ceiling + 2 - order / 3) % 3;
    c.shapes[c.ceiling] = ceiling_square(&c, 4);
    c.shapes[c.square] = ceiling_square(&c, 1);
    c.shapes[c.disk] = make_ring(on_ceiling(&c, 1, 0), vec3_negate(c.axes.z), 0, 0.8);
    c.shapes[c.square].shines = c.shapes[c.disk].shines = true;
    return c;
}

/* A lamp in the plane of the ceiling is hit and not the ceiling, and where lamps overlap one of them, whatever their
 * order; and what is hit is what a shadow ray finds free, so that light is counted once however it is found. */
static void lamps_in_the_ceiling(void **state) {
    (void)state;
    for (int order = 0; order < 6; order++) {
        lit_ceiling c = make_lit_ceiling(order);
        geometry *g = build(c.shapes, 3, 1);
        dice d = {91};
        int hits[3] = {0};
        for (int i = 0; i < 5000; i++) {
            double x = roll_between(&d, -2, 2), y = roll_between(&d, -2, 2);
            bool in_square = fabs(x) < 1 && fabs(y) < 1, in_disk = hypot(x - 1, y) < 0.8;
            int expected = in_square && in_disk ? (c.square > c.disk ? c.square : c.disk)
                           : in_square          ? c.square
                           : in_disk            ? c.disk
                                                : c.ceiling;
            vec3 target = on_ceiling(&c, x, y);
            vec3 origin = frame_to_world(&c.axes, vec3_make(roll_between(&d, -9, 9), roll_between(&d, -9, 9), 0));
            geometry_ray ray = ray_from(origin, vec3_subtract(target, origin), -1);
            geometry_hit hit;
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_int_equal(hit.surface, expected);
            hits[expected]++;
            ray.far = vec3_length(vec3_subtract(target, origin));
            if (in_square)
                assert_true(geometry_occluded(g, &ray, c.square) == (expected != c.square));
            if (in_disk)
                assert_true(geometry_occluded(g, &ray, c.disk) == (expected != c.disk));
            assert_true(geometry_occluded(g, &ray, c.ceiling) == (expected != c.ceiling));
            assert_false(geometry_occluded(g, &ray, -1));
        }
        assert_true(hits[0] > 100 && hits[1] > 100 && hits[2] > 100);
        geometry_destroy(g);
    }
}

/* A lamp that shines counts for more than the ceiling only where both coincide. */
static void lamps_behind_the_ceiling(void **state) {
    (void)state;
    for (int order = 0; order < 2; order++) {
        shape shapes[2];
        shape *lamp = &shapes[order], *ceiling = &shapes[1 - order];
        *ceiling = quadrangle(vec3_make(-4, -4, 1), vec3_make(-4, 4, 1), vec3_make(4, 4, 1), vec3_make(4, -4, 1));
        const double above[] = {-1e-5, -5e-7, 5e-7, 1e-5};
        for (int i = 0; i < 4; i++) {
            *lamp = make_ring(vec3_make(0, 0, 1 + above[i]), vec3_make(0, 0, -1), 0, 1);
            lamp->shines = true;
            geometry *g = build(shapes, 2, 1);
            geometry_ray ray = ray_from(vec3_make(0.1, 0.2, 0), vec3_make(0, 0, 1), -1);
            geometry_hit hit;
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_int_equal(hit.surface, i < 3 ? order : 1 - order);
            ray.far = 1 + above[i];
            assert_true(geometry_occluded(g, &ray, order) == (i == 3));
            /* Its back does not shine. */
            ray = ray_from(vec3_make(0.1, 0.2, 2), vec3_make(0, 0, -1), -1);
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_int_equal(hit.surface, i < 2 ? 1 - order : order);
            geometry_destroy(g);
        }
    }
}

/* Tiles of one plane do not shadow each other, at any angle; nor do those of a gently convex roof. */
static void neighbours_do_not_shadow(void **state) {
    (void)state;
    static shape shapes[2 * 30 * 30];
    for (int bend = 0; bend < 3; bend++) {
        double bow = bend * 1e-3;
        frame f = frame_around(vec3_normalize(vec3_make(0.3, 0.4, 0.87)));
        int count = 0;
        for (int i = 0; i < 30; i++)
            for (int j = 0; j < 30; j++) {
                vec3 v[4];
                for (int k = 0; k < 4; k++) {
                    double x = (i + (k == 1 || k == 2)) / 30.0, y = (j + (k >= 2)) / 30.0;
                    v[k] = frame_to_world(&f, vec3_make(x + 37.1, y - 11.3, 5 - bow * (x * x + y * y)));
                }
                shapes[count++] = triangle(v[0], v[1], v[2]);
                shapes[count++] = triangle(v[0], v[2], v[3]);
            }
        geometry *g = build(shapes, (size_t)count, 1);
        dice d = {4};
        for (int i = 0; i < 20000; i++) {
            double x = roll(&d), y = roll(&d);
            if (i % 4 == 0) /* right beside the edge of a tile */
                x = floor(x * 30) / 30 + 1e-9 * roll(&d);
            vec3 above = frame_to_world(&f, vec3_make(x + 37.1, y - 11.3, 6));
            geometry_ray ray = ray_from(above, vec3_negate(f.z), -1);
            geometry_hit hit;
            if (!geometry_intersect(g, &ray, &hit))
                continue;
            double phi = 2 * PI * roll(&d), slope = pow(10, roll_between(&d, -6, 0));
            frame tile = frame_around(hit.normal);
            vec3 direction = frame_to_world(&tile, vec3_make(cos(phi), sin(phi), slope));
            ray = ray_from(hit.point, direction, hit.surface);
            if (geometry_intersect(g, &ray, &hit))
                fail_msg("bend %d, slope %g: hit at %g", bend, slope, hit.distance);
            assert_false(geometry_occluded(g, &ray, -1));
        }
        geometry_destroy(g);
    }
}

/* From inside of a sphere the ray that leaves it hits it again; from outside it never does. */
static void leaving_a_sphere(void **state) {
    (void)state;
    shape s = make_sphere(vec3_make(10, 20, 30), 2.5);
    geometry *g = build(&s, 1, 1);
    dice d = {21};
    for (int i = 0; i < 20000; i++) {
        vec3 point = shape_pull(&s, vec3_add(s.sphere.center, roll_direction(&d)));
        vec3 normal = shape_normal(&s, point), direction = roll_direction(&d);
        /* Every other one close to the tangent plane: light comes in at none of these either. */
        double cosine = i % 2 ? vec3_dot(direction, normal) : copysign(pow(10, -12 * roll(&d)), roll(&d) - 0.5);
        direction = vec3_add_scaled(direction, cosine - vec3_dot(direction, normal), normal);
        direction = vec3_normalize(direction);
        cosine = vec3_dot(direction, normal);
        geometry_ray ray = ray_from(point, direction, 0);
        geometry_hit hit;
        bool found = geometry_intersect(g, &ray, &hit);
        assert_true(found == (cosine < 0) || fabs(cosine) < 1e-14);
        assert_true(geometry_occluded(g, &ray, -1) == found);
        assert_false(geometry_occluded(g, &ray, 0));
        if (found)
            assert_true(fabs(hit.distance + 5 * cosine) < 1e-13);
    }
    geometry_destroy(g);
}

/* The far end: hits at it count, beyond it do not; a light's own surface at it is not in its way. */
static void far_end(void **state) {
    (void)state;
    shape shapes[] = {quadrangle(vec3_make(-1, -1, 2), vec3_make(1, -1, 2), vec3_make(1, 1, 2), vec3_make(-1, 1, 2)),
                      make_sphere(vec3_make(0, 0, 5), 1)};
    geometry *g = build(shapes, 2, 1);
    geometry_ray ray = ray_from(vec3_make(0.1, 0, 0), vec3_make(0, 0, 1), -1);
    geometry_hit hit;
    ray.far = 2;
    assert_true(geometry_intersect(g, &ray, &hit));
    ray.far = nextafter(2, 0);
    assert_false(geometry_intersect(g, &ray, &hit));
    ray.far = 2.001;
    assert_true(geometry_occluded(g, &ray, -1));
    assert_false(geometry_occluded(g, &ray, 0));
    ray.far = GEOMETRY_FAR;
    assert_true(geometry_occluded(g, &ray, 1));
    assert_true(geometry_occluded(g, &ray, 0));
    ray.origin.z = 3;
    assert_false(geometry_occluded(g, &ray, 1));
    geometry_destroy(g);
}

static void rays_that_are_none_hit_nothing(void **state) {
    (void)state;
    shape s = make_sphere(vec3_make(0, 0, 0), 1);
    geometry *g = build(&s, 1, 1);
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e308};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 6; k++) {
            double v[6] = {0, 0, 0, 0, 0, 1};
            v[k] = bad[i];
            geometry_ray ray = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, GEOMETRY_FAR, -1};
            geometry_hit hit;
            assert_false(geometry_intersect(g, &ray, &hit));
            assert_false(geometry_occluded(g, &ray, -1));
        }
    geometry_ray ray = {{0, 0, 0}, {0, 0, 0}, GEOMETRY_FAR, -1};
    geometry_hit hit;
    assert_false(geometry_intersect(g, &ray, &hit));
    ray = ray_from(vec3_make(0, 0, 0), vec3_make(0, 0, 1), -1);
    ray.far = NAN;
    assert_false(geometry_intersect(g, &ray, &hit));
    /* From as far as double precision can aim */
    ray = ray_from(vec3_make(0, 0, -9e9), vec3_make(0, 0, 1), -1);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(hit.distance == 9e9 - 1);
    geometry_destroy(g);
}

/* Scenes far smaller and larger than single precision's squares. */
static void extreme_scales(void **state) {
    (void)state;
    for (double scale = 1e-4; scale <= 1e9; scale *= 10) {
        shape shapes[12];
        size_t count = make_box(shapes, vec3_make(-scale, -scale, -scale), 2 * scale, 1);
        geometry *g = build(shapes, count, 1);
        dice d = {31};
        for (int i = 0; i < 200; i++) {
            geometry_ray ray = ray_from(roll_in_cube(&d, 0.9 * scale), roll_direction(&d), -1);
            ray.far = 1e100;
            geometry_hit hit;
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_true(fabs(vec3_max_abs(hit.point) - scale) <= 1e-15 * scale);
        }
        geometry_destroy(g);
    }
}

/* What is told of panes on the way is what rays meet there, one after another. */
static void panes_on_the_way(void **state) {
    (void)state;
    enum { PANES = 8 };
    shape shapes[PANES];
    dice d = {43};
    int counts[3] = {0, 0, 0}, occluded = 0;
    for (int i = 0; i < PANES; i++) {
        vec3 a = roll_in_cube(&d, 1), u = roll_in_cube(&d, 1), v = roll_in_cube(&d, 1);
        shapes[i] =
            i == 5 ? make_sphere(a, 0.3) : quadrangle(a, vec3_add(a, u), vec3_add(vec3_add(a, u), v), vec3_add(a, v));
        shapes[i].passes = i != 2;
    }
    geometry *g = build(shapes, PANES, 1);
    for (int i = 0; i < 5000; i++) {
        vec3 origin = roll_in_cube(&d, 1.5), way = vec3_subtract(roll_in_cube(&d, 1.5), origin);
        geometry_ray ray = ray_from(origin, way, -1), left;
        ray.far = vec3_length(way);
        geometry_hit first = {.surface = -1}, hit;
        int met = 0;
        bool shut = false, curved = false;
        for (left = ray; geometry_intersect(g, &left, &hit); left.origin = hit.point, left.from = hit.surface) {
            first = met++ ? first : hit;
            shut = shut || hit.surface == 2;
            curved = curved || hit.surface == 5;
            left.far -= hit.distance;
        }
        geometry_panes panes;
        assert_int_equal(geometry_occluded_but_for_panes(g, &ray, -1, &panes), shut);
        assert_int_equal(geometry_occluded_but_for_panes(g, &ray, -1, NULL), shut);
        assert_int_equal(panes.count, shut ? 0 : curved || met > 1 ? 2 : met);
        counts[panes.count]++;
        occluded += shut;
        if (panes.count == 1)
            assert_true(panes.only.surface == first.surface && panes.only.distance == first.distance &&
                        vec3_is_same(panes.only.point, first.point) && vec3_is_same(panes.only.normal, first.normal));
    }
    assert_true(counts[0] > 500 && counts[1] > 500 && counts[2] > 200 && occluded > 100);
    geometry_destroy(g);
}

/* Large enough for the building's threads to come in; the answers must not depend on them. */
static void threads_change_nothing(void **state) {
    (void)state;
    enum { SIDE = 60 };
    shape *shapes = malloc(12 * SIDE * SIDE * sizeof *shapes);
    assert_non_null(shapes);
    size_t count = make_box(shapes, vec3_make(0, 0, 0), 1, SIDE);
    assert_true(count > 40000);
    geometry *one = build(shapes, count, 1), *many = build(shapes, count, 4);
    dice d = {41};
    for (int i = 0; i < 50000; i++) {
        geometry_ray ray = ray_from(roll_in_cube(&d, 2), roll_direction(&d), -1);
        geometry_hit a, b;
        assert_true(geometry_intersect(one, &ray, &a) == geometry_intersect(many, &ray, &b));
        assert_int_equal(a.surface, b.surface);
        if (a.surface >= 0)
            assert_true(a.distance == b.distance);
    }
    geometry_destroy(one);
    geometry_destroy(many);
    free(shapes);
}

static int set_up_crowd(void **state) {
    crowded = true;
    return set_up(state);
}

int main(void) {
    const struct CMUnitTest large[] = {
        cmocka_unit_test(empty_scene),
        cmocka_unit_test(same_as_brute_force),
        cmocka_unit_test(occlusion_same_as_brute_force),
        cmocka_unit_test(no_leaks_in_a_box),
        cmocka_unit_test(no_leaks_in_a_globe),
        cmocka_unit_test(no_leaks_in_a_small_part_of_a_large_scene),
        cmocka_unit_test(no_leaks_along_the_floor),
        cmocka_unit_test(threads_change_nothing),
    };
    const struct CMUnitTest small[] = {
        cmocka_unit_test(close_to_both_ends),
        cmocka_unit_test(wall_beside_the_origin),
        cmocka_unit_test(curved_shapes_up_to_their_bounds),
        cmocka_unit_test(coincident_faces),
        cmocka_unit_test(sheet_of_two_sides),
        cmocka_unit_test(lamps_in_the_ceiling),
        cmocka_unit_test(lamps_behind_the_ceiling),
        cmocka_unit_test(neighbours_do_not_shadow),
        cmocka_unit_test(leaving_a_sphere),
        cmocka_unit_test(far_end),
        cmocka_unit_test(rays_that_are_none_hit_nothing),
        cmocka_unit_test(extreme_scales),
        cmocka_unit_test(panes_on_the_way),
    };
    int failed = cmocka_run_group_tests(large, set_up, tear_down);
    failed += cmocka_run_group_tests(small, set_up, tear_down);
    return failed + cmocka_run_group_tests_name("crowded", small, set_up_crowd, tear_down);
}
