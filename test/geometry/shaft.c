/* Lights decided to be seen or hidden as a whole, against shadow rays to many of their points. */
#include "geometry/rooms.h"

#include "geometry/shaft_tree.h"

#define RAYS 48

static void check_sight(const world *w, dice *d, const geometry_sight *sight, score *sum) {
    geometry_visibility found = geometry_sight_of(w->geometry, sight);
    tally t = ask_rays(w, d, sight, RAYS);
    if (found == GEOMETRY_CLEAR && t.stopped)
        fail_msg("light %d is clear from %.17g %.17g %.17g on %jd, but %d of %d rays are stopped", sight->light,
                 sight->point.x, sight->point.y, sight->point.z, (intmax_t)sight->from, t.stopped, t.rays);
    if (found == GEOMETRY_BLOCKED && t.stopped < t.rays)
        fail_msg("light %d is hidden from %.17g %.17g %.17g on %jd, but %d of %d rays get there", sight->light,
                 sight->point.x, sight->point.y, sight->point.z, (intmax_t)sight->from, t.rays - t.stopped, t.rays);
    if (t.rays < RAYS / 2)
        return;
    keep_score(sum, t, found);
}

static void check_world(world *w, dice *d, int queries, score *sum) {
    build(w);
    for (int i = 0; i < queries; i++) {
        geometry_sight sight = {.light = -1};
        if (!roll_receiver(w, d, &sight))
            continue;
        roll_light(w, d, &sight);
        check_sight(w, d, &sight, sum);
    }
    geometry_destroy(w->geometry);
}

static void empty_rooms(void **state) {
    (void)state;
    dice d = {3};
    score sum = {0};
    for (int i = 0; i < 30; i++) {
        world w;
        make_empty_room(&w, &d);
        check_world(&w, &d, 200, &sum);
    }
    assert_useful(&sum, 0.95, 0.5);
}

static void furnished_rooms(void **state) {
    (void)state;
    dice d = {4};
    score sum = {0};
    for (int i = 0; i < 60; i++) {
        world w;
        make_furnished_room(&w, &d, i, 6);
        check_world(&w, &d, 200, &sum);
    }
    assert_useful(&sum, 0.85, 0.7);
}

/* More shapes than are sorted with care. */
static void meshes(void **state) {
    (void)state;
    dice d = {5};
    score sum = {0};
    for (int i = 0; i < 10; i++) {
        world w;
        make_empty_room(&w, &d);
        add_things(&w, &d);
        add_cloth(&w, &d, MOST_CELLS);
        check_world(&w, &d, 500, &sum);
    }
    assert_useful(&sum, 0.8, 0.6);
}

/* Where nothing is said to stand above the horizon, no ray above it meets anything that does not shine. */
static void nothing_above(void **state) {
    (void)state;
    dice d = {6};
    int free = 0;
    for (int i = 0; i < 40; i++) {
        world w;
        place_world(&w, &d);
        if (i % 4 == 0)
            add_room(&w);
        add_lamps(&w, &d);
        if (i % 4 <= 1)
            add(&w, make_sphere(at(&w, 1, 1, 1), 0.2 * w.scale));
        if (i % 2)
            add(&w, face(&w, (double[]){0, 0, 0}, (double[]){4, 3, 2.5}, 4, true));
        build(&w);
        for (int k = 0; k < 200; k++) {
            geometry_sight sight;
            if (!roll_receiver(&w, &d, &sight) ||
                geometry_reflects_above(w.geometry, sight.point, sight.normal, sight.from))
                continue;
            free++;
            for (int j = 0; j < 20; j++) {
                geometry_ray ray = {sight.point, roll_direction(&d), GEOMETRY_FAR, sight.from};
                geometry_hit hit;
                if (vec3_dot(ray.direction, sight.normal) <= 0 || !geometry_intersect(w.geometry, &ray, &hit))
                    continue;
                assert_true(w.shapes[hit.surface].shines);
            }
        }
        geometry_destroy(w.geometry);
    }
    assert_true(free > 500);
}

static void a_plane_and_a_lamp(void **state) {
    (void)state;
    world w = {.scale = 1};
    add_lamp(&w, panel(&w, 1, 1, 2, 1));
    add(&w, face(&w, (double[]){0, 0, 0}, (double[]){4, 3, 2.5}, 4, true));
    build(&w);
    geometry_sight sight = {.point = {0.3, 0.2, 0}, .normal = {0, 0, 1}, .from = 1, .light = 0};
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_CLEAR);
    assert_false(geometry_reflects_above(w.geometry, sight.point, sight.normal, 1));
    sight.normal.z = -1; /* seen through the floor, from below its horizon */
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_CLEAR);
    sight = (geometry_sight){.point = {1.5, 1.5, -1}, .normal = {0, 0, 1}, .from = -1, .light = 0};
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_BLOCKED);
    sight.point.x = -0.7; /* half past the floor's edge */
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_MIXED);
    geometry_destroy(w.geometry);
}

static void lamps_in_one_plane(void **state) {
    (void)state;
    world w = {.scale = 1};
    add_lamp(&w, panel(&w, 1, 1, 2, 1));
    add_lamp(&w, panel(&w, 1.5, 1.5, 2 + 4e-7, 1));
    int floor = add(&w, face(&w, (double[]){0, 0, 0}, (double[]){4, 3, 2.5}, 4, true));
    build(&w);
    geometry_sight sight = {.point = {1.5, 1.5, 0}, .normal = {0, 0, 1}, .from = floor, .light = 0};
    geometry_ray ray = {.origin = sight.point, .direction = {0.1, 0.1, 1}, .far = 2, .from = floor};
    assert_true(geometry_occluded(w.geometry, &ray, 0));
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_MIXED);
    geometry_destroy(w.geometry);
}

/* What the only light's shadow rays say. */
static void check_alone(world *w, vec3 normal) {
    dice d = {7};
    score sum = {0};
    geometry_sight sight = {.point = w->corner, .normal = normal, .from = -1, .light = w->lights[0]};
    build(w);
    check_sight(w, &d, &sight, &sum);
    geometry_destroy(w->geometry);
}

/* A lamp before a ball, neither of them behind the other's plane; and one behind. */
static void a_lamp_and_a_ball(void **state) {
    (void)state;
    for (int i = 0; i < 40; i++) {
        world w = {.scale = 1};
        double z = 0.1 * (i + 5);
        add_lamp(&w,
                 quadrangle(&w, (double[4][3]){
                                    {-.1, -.1, z - .15}, {-.1, .1, z - .15}, {.1, .1, z + .15}, {.1, -.1, z + .15}}));
        add(&w, make_sphere(vec3_make(0, 0, 2), 1));
        check_alone(&w, vec3_make(0, 0, 1));
    }
}

/* Lamps and balls on one line with the point, up to roundings: a lamp in its globe, and one behind a ball. */
static void lamps_and_balls_in_line(void **state) {
    (void)state;
    dice d = {11};
    score sum = {0};
    for (int i = 0; i < 300; i++) {
        world w = {.scale = roll_size(&d, 1e-3, 1e3)};
        vec3 way = vec3_make(roll_between(&d, -1, 1), roll_between(&d, -1, 1), roll_between(&d, 0.2, 1));
        vec3 lamp = vec3_scale(w.scale, way), normal = vec3_normalize(way), ball = lamp;
        double distance = vec3_length(lamp), size = 0.05 * distance;
        if (i % 2)
            ball = vec3_scale(roll_between(&d, 0.3, 0.8), lamp);
        if (i % 3 == 0)
            add_lamp(&w, make_sphere(lamp, size));
        else if (i % 3 == 1)
            add_lamp(&w, make_ring(lamp, vec3_negate(normal), 0, size));
        else
            add_lamp(&w, quadrangle(&w, (double[4][3]){{way.x, way.y, way.z},
                                                       {way.x, way.y + .05, way.z},
                                                       {way.x + .05, way.y + .05, way.z},
                                                       {way.x + .05, way.y, way.z}}));
        add(&w, make_sphere(ball, size * roll_between(&d, 1.2, 4)));
        build(&w);
        geometry_sight sight = {.point = w.corner, .normal = normal, .from = -1, .light = w.lights[0]};
        check_sight(&w, &d, &sight, &sum);
        geometry_destroy(w.geometry);
    }
    assert_true(sum.hidden > 200);
}

/* All light is hidden from a point that a globe keeps apart from the lamp; what touches it may be seen. */
static void globes_without_a_gap(void **state) {
    (void)state;
    dice d = {12};
    score sum = {0};
    for (int i = 0; i < 600; i++) {
        world w = {.scale = roll_size(&d, 1e-3, 1e3)};
        vec3 way = vec3_make(roll_between(&d, -1, 1), roll_between(&d, -1, 1), roll_between(&d, 0.2, 1));
        vec3 lamp = vec3_scale(w.scale, way), normal = vec3_normalize(way);
        double size = vec3_length(lamp), near = roll_between(&d, 0.01, 0.1) * size;
        geometry_sight sight = {.point = w.corner, .normal = normal, .from = -1, .light = i % 4 == 3 ? -1 : 0};
        if (i % 4 == 0)
            add_lamp(&w, make_sphere(lamp, near));
        else if (i % 4 == 1)
            add_lamp(&w, make_ring(lamp, vec3_negate(normal), 0, near));
        else
            add_lamp(&w, quadrangle(&w, (double[4][3]){{way.x, way.y, way.z},
                                                       {way.x, way.y + .05, way.z},
                                                       {way.x + .05, way.y + .05, way.z},
                                                       {way.x + .05, way.y, way.z}}));
        sight.axis = normal;
        sight.half_angle = 0.3;
        bool around_lamp = i % 8 < 4 && i % 4 != 3;
        vec3 middle = vec3_add_scaled(around_lamp ? lamp : w.corner, 0.3 * near, roll_direction(&d));
        add(&w, make_sphere(middle, (i % 16 < 8 ? 3 : 1.25) * near));
        build(&w);
        check_sight(&w, &d, &sight, &sum);
        geometry_destroy(w.geometry);
    }
    assert_true(sum.hidden > 500);
    assert_useful(&sum, 0, 0.85);
}

/* A star that is drawn in one stroke is open in its middle. */
static void a_star(void **state) {
    (void)state;
    world w = {.scale = 1};
    vec3 star[5];
    for (int i = 0; i < 5; i++)
        star[i] = vec3_make(cos(4 * PI / 5 * i), sin(4 * PI / 5 * i), 1);
    add_lamp(&w, panel(&w, -0.1, -0.1, 2, 0.2));
    add(&w, make_polygon(5, star));
    check_alone(&w, vec3_make(0, 0, 1));
}

static void assert_same_nodes(const shaft_tree *a, uint32_t i, const shaft_tree *b, uint32_t k, size_t *leaves) {
    const shaft_node *x = &a->nodes[i], *y = &b->nodes[k];
    assert_memory_equal(&x->lower, &y->lower, sizeof x->lower);
    assert_memory_equal(&x->upper, &y->upper, sizeof x->upper);
    assert_int_equal(x->reflects, y->reflects);
    assert_int_equal(x->count, y->count);
    if (x->count > 0) {
        assert_int_equal(x->first, y->first);
        ++*leaves;
        return;
    }
    for (uint32_t child = 0; child < 2; child++)
        assert_same_nodes(a, x->first + child, b, y->first + child, leaves);
}

static void trees_by_threads_are_the_same(void **state) {
    (void)state;
    enum { MANY = 50000 };
    shape *shapes = malloc(MANY * sizeof *shapes);
    assert_non_null(shapes);
    dice d = {1};
    for (int i = 0; i < MANY; i++) {
        double spread = i % 3 ? 1 : 1e-4; /* crowded in places */
        shapes[i] = make_sphere(roll_in_cube(&d, spread), roll_size(&d, 1e-4, i % 1000 ? 1e-2 : 1));
        shapes[i].shines = i % 7 == 0;
    }
    const vec3 lower = {-2, -2, -2}, upper = {2, 2, 2};
    shaft_tree alone, together;
    assert_true(shaft_tree_build(&alone, shapes, MANY, lower, upper, 1));
    assert_true(shaft_tree_build(&together, shapes, MANY, lower, upper, 4));
    size_t leaves = 0;
    assert_same_nodes(&alone, 0, &together, 0, &leaves);
    assert_true(leaves > MANY / 8);
    assert_int_equal(alone.node_count, 2 * leaves - 1);
    assert_int_equal(together.node_count, 2 * leaves - 1);
    assert_memory_equal(alone.order, together.order, MANY * sizeof *alone.order);
    shaft_tree_free(&alone);
    shaft_tree_free(&together);
    free(shapes);
}

static void unprepared(void **state) {
    (void)state;
    world w = {.scale = 1};
    geometry_sight sight = {.normal = {0, 0, 1}, .from = -1, .light = 0};
    messages m = {0};
    graze_report report = {messages_write, &m};
    add_lamp(&w, panel(&w, 1, 1, 2, 1));
    assert_int_equal(
        geometry_build(&w.geometry, &(geometry_group){.shapes = w.shapes, .shape_count = 1}, 1, 1, &report), GRAZE_OK);
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_MIXED);
    assert_true(geometry_reflects_above(w.geometry, sight.point, sight.normal, -1));
    geometry_destroy(w.geometry);
    assert_int_equal(geometry_build(&w.geometry, &(geometry_group){0}, 1, 1, &report), GRAZE_OK);
    assert_int_equal(geometry_prepare_sights(w.geometry, &report), GRAZE_OK);
    /* Nothing is in the way where there is nothing. */
    sight = (geometry_sight){.normal = {0, 0, 1}, .from = -1, .light = -1, .axis = {0, 0, 1}, .half_angle = 0.1};
    assert_int_equal(geometry_sight_of(w.geometry, &sight), GEOMETRY_CLEAR);
    geometry_destroy(w.geometry);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_rooms),
        cmocka_unit_test(furnished_rooms),
        cmocka_unit_test(meshes),
        cmocka_unit_test(nothing_above),
        cmocka_unit_test(a_plane_and_a_lamp),
        cmocka_unit_test(lamps_in_one_plane),
        cmocka_unit_test(a_lamp_and_a_ball),
        cmocka_unit_test(lamps_and_balls_in_line),
        cmocka_unit_test(globes_without_a_gap),
        cmocka_unit_test(a_star),
        cmocka_unit_test(trees_by_threads_are_the_same),
        cmocka_unit_test(unprepared),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
