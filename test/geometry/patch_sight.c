/* Lights decided to be seen or hidden from all points of a patch, against shadow rays from some to many. */
#include "geometry/rooms.h"

#include "geometry/patch_sight.h"

/* Around a point of a polygon, reaching beyond its outline or not. */
static void roll_patch(const world *w, dice *d, const geometry_sight *at, geometry_patch *patch) {
    double size = w->scale * roll_size(d, 1e-3, 0.3);
    frame f = frame_around(w->shapes[at->from].polygon.normal);
    double angle = 2 * PI * roll(d);
    vec3 x = vec3_add(vec3_scale(cos(angle), f.x), vec3_scale(sin(angle), f.y));
    vec3 y = vec3_cross(w->shapes[at->from].polygon.normal, x);
    vec3 first = vec3_scale(size, x), second = vec3_scale(size * roll_between(d, 0.2, 1), y);
    vec3 corner = vec3_add_scaled(vec3_add_scaled(at->point, -roll(d), first), -roll(d), second);
    vec3 next = vec3_add(corner, first);
    *patch = (geometry_patch){.corners = {corner, next, vec3_add(next, second), vec3_add(corner, second)},
                              .surface = (int)at->from,
                              .light = at->light,
                              .axis = at->axis,
                              .half_angle = at->half_angle};
}

/* A point of the patch, if it is one of its surface. */
static bool roll_point(const world *w, dice *d, const geometry_patch *patch, geometry_sight *sight) {
    const vec3 *c = patch->corners;
    double u = roll_place(d), v = roll_place(d);
    vec3 point = vec3_add_scaled(vec3_add_scaled(c[0], u, vec3_subtract(c[1], c[0])), v, vec3_subtract(c[3], c[0]));
    double above = 1e-3 * w->scale;
    geometry_ray ray = {.origin = vec3_add_scaled(point, above, sight->normal),
                        .direction = vec3_negate(sight->normal),
                        .far = GEOMETRY_FAR,
                        .from = -1};
    geometry_hit hit;
    if (!geometry_intersect(w->geometry, &ray, &hit) || hit.surface != patch->surface)
        return false;
    sight->point = hit.point;
    return true;
}

enum { POINTS = 12, RAYS = 12 };

static void check_patch(const world *w, dice *d, const geometry_patch *patch, geometry_sight *sight, score *sum) {
    geometry_visibility found = geometry_sight_of_patch(w->geometry, patch);
    tally all = {0, 0};
    for (int i = 0; i < POINTS; i++) {
        if (!roll_point(w, d, patch, sight))
            continue;
        tally t = ask_rays(w, d, sight, RAYS);
        all.rays += t.rays;
        all.stopped += t.stopped;
        if ((found == GEOMETRY_CLEAR && t.stopped) || (found == GEOMETRY_BLOCKED && t.stopped < t.rays))
            fail_msg("light %d is %s from the patch at %.17g %.17g %.17g on %d, but %d of %d rays are stopped",
                     patch->light, found == GEOMETRY_CLEAR ? "clear" : "hidden", sight->point.x, sight->point.y,
                     sight->point.z, patch->surface, t.stopped, t.rays);
    }
    if (all.rays < POINTS * RAYS / 2)
        return;
    keep_score(sum, all, found);
}

static void check_world(world *w, dice *d, int queries, score *sum) {
    build(w);
    for (int i = 0; i < queries; i++) {
        geometry_sight sight = {.light = -1};
        if (!roll_receiver(w, d, &sight) || sight.from < 0 || w->shapes[sight.from].kind != SHAPE_POLYGON)
            continue;
        geometry_patch patch;
        roll_light(w, d, &sight);
        roll_patch(w, d, &sight, &patch);
        if (patch.light != patch.surface)
            check_patch(w, d, &patch, &sight, sum);
    }
    geometry_destroy(w->geometry);
}

static void empty_rooms(void **state) {
    (void)state;
    dice d = {13};
    score sum = {0};
    for (int i = 0; i < 30; i++) {
        world w;
        make_empty_room(&w, &d);
        check_world(&w, &d, 200, &sum);
    }
    assert_useful(&sum, 0.85, 0.4);
}

static void furnished_rooms(void **state) {
    (void)state;
    dice d = {14};
    score sum = {0};
    for (int i = 0; i < 60; i++) {
        world w;
        make_furnished_room(&w, &d, i, i % 8 < 4 ? 6 : MOST_CELLS);
        check_world(&w, &d, 200, &sum);
    }
    assert_useful(&sum, 0.7, 0.5);
}

static void a_screen_before_a_lamp(void **state) {
    (void)state;
    world w = {.scale = 1};
    add_lamp(&w, panel(&w, 1, 1, 2, 1));
    int floor = add(&w, face(&w, (double[]){0, 0, 0}, (double[]){4, 3, 2.5}, 4, true));
    add(&w, panel(&w, 0.9, 0.9, 1.9, 1.2));
    build(&w);
    geometry_patch under = {.corners = {{1.4, 1.4, 0}, {1.6, 1.4, 0}, {1.6, 1.6, 0}, {1.4, 1.6, 0}}, .surface = floor};
    geometry_patch aside = {.corners = {{3.9, 1.4, 0}, {4, 1.4, 0}, {4, 1.6, 0}, {3.9, 1.6, 0}}, .surface = floor};
    assert_int_equal(geometry_sight_of_patch(w.geometry, &under), GEOMETRY_BLOCKED);
    assert_int_equal(geometry_sight_of_patch(w.geometry, &aside), GEOMETRY_MIXED);
    w.shapes[2].passes = true;
    assert_int_equal(geometry_sight_of_patch(w.geometry, &under), GEOMETRY_MIXED);
    geometry_destroy(w.geometry);
}

/* The later of two lamps that coincide shines in place of the earlier one, also where it is farther by less than their
 * coordinates tell, in a box of its own or with one above both. */
static void lamps_in_one_plane(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        world w = {.scale = 1};
        add_lamp(&w, panel(&w, 1, 1, 2, 1));
        add_lamp(&w, panel(&w, 1.5, 1.5, 2 + 4e-7, 1));
        if (k == 1)
            add_lamp(&w, panel(&w, 1.5, 1.5, 2.01, 1));
        int floor = add(&w, face(&w, (double[]){0, 0, 0}, (double[]){4, 3, 2.5}, 4, true));
        build(&w);
        geometry_patch under = {.corners = {{1.4, 1.4, 0}, {1.6, 1.4, 0}, {1.6, 1.6, 0}, {1.4, 1.6, 0}},
                                .surface = floor};
        geometry_ray ray = {.origin = {1.5, 1.5, 0}, .direction = {0.1, 0.1, 1}, .far = 2, .from = floor};
        assert_true(geometry_occluded(w.geometry, &ray, 0));
        assert_int_equal(geometry_sight_of_patch(w.geometry, &under), GEOMETRY_MIXED);
        geometry_destroy(w.geometry);
    }
}

/* A panel shines down: not on what is above it, and on a part of what reaches below it. */
static void a_lamp_from_behind(void **state) {
    (void)state;
    world w = {.scale = 1};
    add_lamp(&w, panel(&w, 1, 1, 2, 1));
    int wall = add(&w, face(&w, (double[]){0, 0, 0}, (double[]){4, 3, 4}, 0, true));
    build(&w);
    geometry_patch above = {.corners = {{0, 1, 2.1}, {0, 2, 2.1}, {0, 2, 3}, {0, 1, 3}}, .surface = wall};
    geometry_patch across = {.corners = {{0, 1, 1.9}, {0, 2, 1.9}, {0, 2, 3}, {0, 1, 3}}, .surface = wall};
    geometry_patch below = {.corners = {{0, 1, 1}, {0, 2, 1}, {0, 2, 1.9}, {0, 1, 1.9}}, .surface = wall};
    assert_int_equal(geometry_sight_of_patch(w.geometry, &above), GEOMETRY_BLOCKED);
    assert_int_equal(geometry_sight_of_patch(w.geometry, &across), GEOMETRY_MIXED);
    assert_int_equal(geometry_sight_of_patch(w.geometry, &below), GEOMETRY_CLEAR);
    geometry_destroy(w.geometry);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_rooms),
        cmocka_unit_test(furnished_rooms),
        cmocka_unit_test(a_screen_before_a_lamp),
        cmocka_unit_test(lamps_in_one_plane),
        cmocka_unit_test(a_lamp_from_behind),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
