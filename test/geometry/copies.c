/* Copies of groups: hits as if the copies' surfaces stood in the scene themselves. */
#include "geometry/make.h"

#include "base/number.h"
#include "geometry/geometry.h"
#include "geometry/placed.h"
#include "geometry/scenes.h"
#include "geometry/shaft.h"

static geometry *build(const geometry_group *groups, size_t count) {
    geometry *g;
    messages m = {0};
    graze_report report = {messages_write, &m};
    if (geometry_build(&g, groups, count, 2, &report) != GRAZE_OK)
        fail_msg("%s", m.last);
    return g;
}

/* A transform as a scene would write it. */
static rad_transform transform(const char *text) {
    char copy[256], *rest = NULL;
    const char *words[32];
    int count = 0;
    strncpy(copy, text, sizeof copy - 1);
    copy[sizeof copy - 1] = 0;
    for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest))
        words[count++] = word;
    rad_transform t;
    bool in_range;
    assert_int_equal(rad_transform_leading(&t, words, count, &in_range), count);
    assert_true(in_range);
    return t;
}

static geometry_placement placed_at(int group, rad_transform t) {
    return (geometry_placement){.group = group, .transform = t};
}

/* The shape as a scene without copies would have it. */
static shape unfolded(const shape *s, const rad_transform *t) {
    if (s->kind != SHAPE_POLYGON)
        return shape_placed(s, t);
    uint32_t n = s->polygon.vertex_count;
    vec3 v[OUTLINE_LIMIT];
    for (uint32_t i = 0; i < n; i++)
        v[t->mirrored ? n - 1 - i : i] = rad_transform_point(t, s->polygon.vertices[i]);
    return make_polygon(n, v);
}

#define INNER  ZOO
#define MIDDLE 4
#define OUTER  3

/* A zoo; shapes and three copies of the zoo; shapes and copies of both. */
typedef struct nest {
    shape inner[INNER], middle[MIDDLE], outer[OUTER];
    geometry_placement in_middle[3], in_outer[4];
    geometry_group groups[3];
    /* The same without copies, in the order of the surfaces' numbers. */
    shape all[OUTER + 2 * (MIDDLE + 3 * INNER) + 2 * INNER];
    geometry_group flat;
    size_t count;
} nest;

static void unfold(nest *n, int group, const rad_transform *t) {
    const geometry_group *g = &n->groups[group];
    for (size_t i = 0; i < g->shape_count; i++)
        n->all[n->count++] = unfolded(&g->shapes[i], t);
    for (size_t i = 0; i < g->placement_count; i++) {
        rad_transform both = rad_transform_then(&g->placements[i].transform, t);
        unfold(n, g->placements[i].group, &both);
    }
}

static void roll_nest(nest *n, uint64_t seed) {
    dice d = {seed};
    roll_zoo(&d, n->inner, 1, vec3_make(3, 1, -2));
    for (int i = 0; i < MIDDLE; i++)
        n->middle[i] = make_sphere(roll_in_cube(&d, 30), roll_between(&d, 0.5, 3));
    for (int i = 0; i < OUTER; i++)
        n->outer[i] = make_ring(roll_in_cube(&d, 10), roll_direction(&d), 0.5, 4);
    n->in_middle[0] = placed_at(2, transform("-rx 31 -s 2.5 -t 3 -7 4.25"));
    n->in_middle[1] = placed_at(2, transform("-mx -rz 12 -ry -77 -s .31 -t -2 0 4"));
    n->in_middle[2] = placed_at(2, transform("-t -11 5 6"));
    n->in_outer[0] = placed_at(1, transform("-rz 23 -rx 5 -s .125 -t 1 -2 3"));
    n->in_outer[1] = placed_at(2, transform("-my -s 1.7 -t -3 0 0 -rz 45"));
    n->in_outer[2] = placed_at(2, transform("-rx 90 -t 0 4 -4"));
    n->in_outer[3] = placed_at(1, transform("-mz -ry 70 -s .4 -t -3 5 -1"));
    n->groups[0] = (geometry_group){n->outer, OUTER, n->in_outer, 4};
    n->groups[1] = (geometry_group){n->middle, MIDDLE, n->in_middle, 3};
    n->groups[2] = (geometry_group){n->inner, INNER, NULL, 0};
    n->count = 0;
    rad_transform identity = rad_transform_identity();
    unfold(n, 0, &identity);
    n->flat = (geometry_group){n->all, n->count, NULL, 0};
}

static void numbers_are_in_order(void **state) {
    (void)state;
    static nest n;
    roll_nest(&n, 1);
    assert_int_equal(n.count, sizeof n.all / sizeof *n.all);
    geometry *g = build(n.groups, 3);
    for (size_t i = 0; i < n.count; i++) {
        geometry_origin found = geometry_find(g, (int64_t)i);
        assert_true(found.copied == (i >= OUTER));
        shape placed = found.copied ? shape_placed(found.shape, &found.transform) : *found.shape;
        const shape *expected = &n.all[i];
        assert_int_equal(placed.kind, expected->kind);
        vec3 point = expected->kind == SHAPE_POLYGON  ? expected->polygon.center
                     : expected->kind == SHAPE_RING   ? expected->ring.center
                     : expected->kind == SHAPE_SPHERE ? expected->sphere.center
                                                      : expected->cone.p0;
        vec3 there = expected->kind == SHAPE_POLYGON  ? placed.polygon.center
                     : expected->kind == SHAPE_RING   ? placed.ring.center
                     : expected->kind == SHAPE_SPHERE ? placed.sphere.center
                                                      : placed.cone.p0;
        assert_true(vec3_length(vec3_subtract(point, there)) < 1e-12);
        assert_true(fabs(shape_area(&placed) - shape_area(expected)) < 1e-11 * shape_area(expected));
        if (expected->kind == SHAPE_POLYGON)
            assert_true(vec3_dot(expected->polygon.normal, placed.polygon.normal) > 1 - 1e-12);
    }
    int64_t number = OUTER + MIDDLE + INNER + 5;
    assert_int_equal(geometry_descend(g, 0, &number), 0);
    assert_int_equal(geometry_descend(g, 1, &number), 1);
    assert_int_equal(geometry_descend(g, 2, &number), -1);
    assert_int_equal(number, 5);
    geometry_destroy(g);
}

/* True where both agree; they need not where it hangs on roundings. */
static bool compare(const geometry *copies, const geometry *flat, const geometry_ray *ray, geometry_hit *hit) {
    geometry_hit expected;
    bool found = geometry_intersect(copies, ray, hit), wanted = geometry_intersect(flat, ray, &expected);
    assert_true(geometry_occluded(copies, ray, -1) == found);
    if (found != wanted || !found || hit->surface != expected.surface)
        return found == wanted && !found;
    double cosine = fabs(vec3_dot(hit->normal, ray->direction));
    if (cosine < 1e-3)
        return true;
    assert_true(fabs(hit->distance - expected.distance) < 1e-12 / cosine);
    assert_true(vec3_length(vec3_subtract(hit->point, expected.point)) < 1e-12 / cosine);
    assert_true(vec3_length(vec3_subtract(hit->normal, expected.normal)) < 1e-9);
    return true;
}

static void same_as_unfolded(void **state) {
    (void)state;
    static nest n;
    dice d = {77};
    int agreed = 0, hits = 0, in_copies = 0, rays = 0;
    for (uint64_t scene = 1; scene <= 3; scene++) {
        roll_nest(&n, scene);
        geometry *copies = build(n.groups, 3), *flat = build(&n.flat, 1);
        for (int i = 0; i < 20000; i++) {
            geometry_hit hit;
            geometry_ray ray = ray_from(roll_in_cube(&d, i % 3 ? 12 : 1000), vec3_make(0, 0, 1), -1);
            ray.direction = vec3_normalize(vec3_subtract(roll_in_cube(&d, 9), ray.origin));
            for (int bounce = 0; bounce < 4; bounce++, rays++) {
                agreed += compare(copies, flat, &ray, &hit);
                if (hit.surface < 0)
                    break;
                hits++;
                in_copies += hit.surface >= OUTER;
                ray = ray_from(hit.point, roll_direction(&d), hit.surface);
            }
        }
        geometry_destroy(copies);
        geometry_destroy(flat);
    }
    if (hits < 20000 || in_copies < 12000)
        fail_msg("%d hits, %d of them in copies", hits, in_copies);
    if (rays - agreed > 2)
        fail_msg("%d of %d rays differ", rays - agreed, rays);
}

/* Sends rays about in a closed surface, a copy: each must hit it, and towards corners and middles of edges, too. */
static void check_closed(const char *placed, const shape *around, vec3 inside, double reach, uint64_t seed) {
    static shape shapes[4 * 40 * 40];
    size_t count = make_globe(shapes, inside, reach, 40);
    geometry_placement placement = placed_at(1, transform(placed));
    geometry_group groups[] = {{around, around ? 1 : 0, &placement, 1}, {shapes, count, NULL, 0}};
    geometry *g = build(groups, 2);
    const rad_transform *t = &placement.transform;
    vec3 center = rad_transform_point(t, inside);
    double radius = t->scale * reach;
    int64_t first = around ? 1 : 0;
    dice d = {seed};
    geometry_ray ray = ray_from(center, vec3_make(0, 0, 1), -1);
    for (int i = 0; i < 60000; i++) {
        if (i % 8 == 0)
            ray = ray_from(vec3_add(center, roll_in_cube(&d, radius / 2)), roll_direction(&d), -1);
        if (i % 2) {
            const shape *s = &shapes[(size_t)(roll(&d) * (double)count)];
            vec3 a = rad_transform_point(t, s->polygon.vertices[0]), b = rad_transform_point(t, s->polygon.vertices[1]);
            vec3 at = i % 4 == 1 ? a : vec3_add_scaled(a, 0.5, vec3_subtract(b, a));
            if (ray.from < 0)
                ray = ray_from(ray.origin, vec3_subtract(at, ray.origin), -1);
        }
        geometry_hit hit;
        if (!geometry_intersect(g, &ray, &hit) || hit.surface < first)
            fail_msg("ray %d leaks from (%.17g %.17g %.17g) towards (%.17g %.17g %.17g), having left %d", i,
                     ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
                     (int)ray.from);
        assert_true(around || geometry_occluded(g, &ray, -1));
        vec3 next = roll_direction(&d);
        if (vec3_dot(next, hit.normal) > 0)
            next = vec3_negate(next);
        ray = ray_from(hit.point, next, hit.surface);
        if (i % 2)
            ray = ray_from(vec3_add_scaled(hit.point, 0.5, vec3_subtract(center, hit.point)), next, -1);
    }
    geometry_destroy(g);
}

static void no_leaks_in_a_copy(void **state) {
    (void)state;
    check_closed("-rx 17 -ry 35 -rz 71 -t 5 -3 1", NULL, vec3_make(0, 0, 0), 1, 3);
    check_closed("-mx -ry 35 -s 300 -t 1e4 -3 1", NULL, vec3_make(12, 0, -7), 0.1, 4);
}

static void no_leaks_in_a_small_copy_in_a_large_scene(void **state) {
    (void)state;
    shape ground = quadrangle(vec3_make(-2e3, -2e3, -1), vec3_make(2e3, -2e3, -1), vec3_make(2e3, 2e3, -1),
                              vec3_make(-2e3, 2e3, -1));
    check_closed("-rz 33 -s .01 -t 700 -400 .01", &ground, vec3_make(0, 0, 0), 1, 5);
    check_closed("-rz 33 -s .0003 -t -1700 1400 3", &ground, vec3_make(0, 0, 0), 1, 6);
}

/* A box in a copy stands on the floor, and one box, turned, on top of the other. */
static void surfaces_of_copies_coincide(void **state) {
    (void)state;
    shape box[12], floor;
    floor = quadrangle(vec3_make(-5, -5, 0), vec3_make(5, -5, 0), vec3_make(5, 5, 0), vec3_make(-5, 5, 0));
    size_t count = make_box(box, vec3_make(-1, -1, 0), 2, 1);
    geometry_placement placements[] = {placed_at(1, transform("-rz 30 -s .1 -t .7 .3 0")),
                                       placed_at(1, transform("-rz 60 -s .1 -t .7 .3 .2"))};
    geometry_group groups[] = {{&floor, 1, placements, 2}, {box, count, NULL, 0}};
    geometry *g = build(groups, 2);
    geometry_hit hit;
    /* From below, the box's bottom faces the ray and the floor does not; from within it is the floor. */
    geometry_ray ray = ray_from(vec3_make(0.71, 0.32, -3), vec3_make(0.001, 0, 1), -1);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(hit.surface >= 1 && hit.surface < 13 && hit.normal.z == -1);
    ray = ray_from(vec3_make(0.71, 0.32, 0.1), vec3_make(0.001, 0, -1), -1);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_int_equal(hit.surface, 0);
    /* A ray that leaves either is not stopped by the other at its origin. */
    ray = ray_from(hit.point, vec3_make(0.01, 0, 1), 0);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(fabs(hit.point.z - 0.2) < 1e-15);
    assert_true(hit.surface >= 1);
    /* Up from the lower box's lid, through the upper one's bottom, to its lid. */
    ray = ray_from(hit.point, vec3_make(0.01, 0, 1), hit.surface);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_true(hit.surface >= 13 && fabs(hit.point.z - 0.4) < 1e-15);
    ray = ray_from(hit.point, vec3_make(0, 0, 1), hit.surface);
    assert_false(geometry_intersect(g, &ray, &hit));
    geometry_destroy(g);
}

static void shafts_know_copies(void **state) {
    (void)state;
    shape own[2], ball = make_sphere(vec3_make(0, 0, 0), 0.3);
    own[0] = quadrangle(vec3_make(-1, -1, 5), vec3_make(-1, 1, 5), vec3_make(1, 1, 5), vec3_make(1, -1, 5));
    own[0].shines = true;
    own[1] = quadrangle(vec3_make(-9, -9, 0), vec3_make(9, -9, 0), vec3_make(9, 9, 0), vec3_make(-9, 9, 0));
    assert_true(shape_prepare_light(&own[0], memory));
    geometry_placement placements[400];
    size_t count = 0;
    for (int k = 0; k < 20; k++)
        for (int i = 0; i < 20; i++) {
            placements[count] = placed_at(1, rad_transform_identity());
            placements[count].transform.m[3][0] = i - 9.5;
            placements[count].transform.m[3][1] = k ? k - 9.5 : 0;
            placements[count++].transform.m[3][2] = i < 10 ? 1 : 7;
        }
    for (int few = 0; few < 2; few++) {
        geometry_group groups[] = {{own, 2, placements, few ? 20 : count}, {&ball, 1, NULL, 0}};
        geometry *g = build(groups, 2);
        messages m = {0};
        graze_report report = {messages_write, &m};
        assert_int_equal(geometry_prepare_sights(g, &report), GRAZE_OK);
        geometry_sight sight = {.normal = {0, 0, 1}, .from = 1, .light = 0};
        dice d = {4};
        int seen[3] = {0};
        for (int i = 0; i < 300; i++) {
            sight.point = vec3_make(roll_between(&d, -8, 8), roll_between(&d, -8, 8), 0);
            geometry_visibility v = geometry_sight_of(g, &sight);
            seen[v]++;
            for (int k = 0; v != GEOMETRY_MIXED && k < 50; k++) {
                vec3 at = vec3_make(roll_between(&d, -1, 1), roll_between(&d, -1, 1), 5);
                vec3 way = vec3_subtract(at, sight.point);
                geometry_ray ray = {sight.point, vec3_normalize(way), vec3_length(way), 1};
                assert_true(geometry_occluded(g, &ray, 0) == (v == GEOMETRY_BLOCKED));
            }
        }
        if (seen[GEOMETRY_CLEAR] < 30 || seen[GEOMETRY_MIXED] < 10)
            fail_msg("clear: %d, mixed: %d", seen[GEOMETRY_CLEAR], seen[GEOMETRY_MIXED]);
        assert_true(geometry_reflects_above(g, vec3_make(8, 0, 0), vec3_make(0, 0, 1), 1));
        assert_false(geometry_reflects_above(g, vec3_make(0, 0, 8), vec3_make(0, 0, 1), -1));
        geometry_destroy(g);
    }
    /* Nothing but copies. */
    geometry_group groups[] = {{NULL, 0, placements, 1}, {&ball, 1, NULL, 0}};
    geometry *g = build(groups, 2);
    messages m = {0};
    graze_report report = {messages_write, &m};
    assert_int_equal(geometry_prepare_sights(g, &report), GRAZE_OK);
    geometry_sight source = {.normal = {0, 0, 1}, .from = -1, .light = -1, .axis = {0, 0, 1}, .half_angle = 0.01};
    source.point = vec3_make(-9.5, 0, 0);
    assert_int_equal(geometry_sight_of(g, &source), GEOMETRY_MIXED);
    source.point = vec3_make(9.5, -9.5, 0);
    assert_int_equal(geometry_sight_of(g, &source), GEOMETRY_CLEAR);
    geometry_destroy(g);
}

static void copies_of_nothing(void **state) {
    (void)state;
    geometry_placement placements[] = {placed_at(1, rad_transform_identity()), placed_at(2, rad_transform_identity())};
    shape ball = make_sphere(vec3_make(0, 0, 0), 1);
    geometry_group groups[] = {{NULL, 0, placements, 2}, {NULL, 0, NULL, 0}, {&ball, 1, NULL, 0}};
    geometry *g = build(groups, 3);
    geometry_hit hit;
    geometry_ray ray = ray_from(vec3_make(0, 0, -3), vec3_make(0, 0, 1), -1);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_int_equal(hit.surface, 0);
    assert_true(hit.distance == 2);
    geometry_destroy(g);
    /* The number of a copy's surface is no index into shapes that are not there, if it is not 0. */
    placements[0] = placed_at(2, transform("-t 9 0 0"));
    g = build(groups, 3);
    assert_true(geometry_intersect(g, &ray, &hit));
    assert_int_equal(hit.surface, 1);
    geometry_destroy(g);
    placements[0] = placed_at(1, rad_transform_identity());
    groups[0].placement_count = 1;
    g = build(groups, 2);
    assert_false(geometry_intersect(g, &ray, &hit));
    geometry_destroy(g);
}

/* A lamp of the scene, and a copy in a copy of another that coincides with it: the later one that shines is hit, and
 * one that the outer copy replaces is what that says. Of polygons and of curved ones. */
static void copies_are_of_other_materials(void **state) {
    (void)state;
    const vec3 up = {0, 0, 1}, square[4] = {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
    const geometry_ray ray = {{0.25, 0.5, 5}, {0, 0, -1}, GEOMETRY_FAR, -1},
                       to_lamp = {ray.origin, ray.direction, 3, -1};
    for (int curved = 0; curved < 2; curved++) {
        shape lamp = curved ? make_ring((vec3){0, 0, 2}, up, 0, 1) : make_polygon(4, square);
        lamp.shines = true;
        for (int k = 0; k < 4; k++) {
            const bool replaces = k > 0, shines = k == 1, passes = k == 3;
            const geometry_placement inner = {2, rad_transform_identity(), true, !shines, !passes},
                                     plain = {2, rad_transform_identity(), false, false, false},
                                     outer = {1, rad_transform_identity(), replaces, shines, passes};
            const geometry_group groups[3] = {
                {&lamp, 1, &outer, 1}, {NULL, 0, replaces ? &inner : &plain, 1}, {&lamp, 1, NULL, 0}};
            geometry *g = build(groups, 3);
            geometry_hit hit;
            geometry_panes panes;
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_int_equal(hit.surface, k < 2);
            assert_true(geometry_shines(g, 0) && geometry_shines(g, 1) == (k < 2));
            assert_true(!geometry_passes(g, 0) && geometry_passes(g, 1) == passes);
            assert_true(geometry_occluded(g, &to_lamp, 0) == (k < 2));
            assert_true(geometry_occluded_but_for_panes(g, &ray, -1, NULL));
            assert_true(geometry_occluded_but_for_panes(g, &to_lamp, 0, &panes) == (k < 2) && panes.count == 0);
            geometry_destroy(g);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_in_order),        cmocka_unit_test(same_as_unfolded),
        cmocka_unit_test(no_leaks_in_a_copy),          cmocka_unit_test(no_leaks_in_a_small_copy_in_a_large_scene),
        cmocka_unit_test(surfaces_of_copies_coincide), cmocka_unit_test(shafts_know_copies),
        cmocka_unit_test(copies_of_nothing),           cmocka_unit_test(copies_are_of_other_materials),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
