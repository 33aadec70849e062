/* Cells of surfaces: what is said of one holds for shadow rays from its points; and which surfaces have some. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/light.h"
#include "scene/sight_cells.h"
#include "support/dice.h"
#include "support/scene_text.h"

/* A room with an L-shaped floor, turned about the upright, with a table, a three-cornered shelf and a partition; a
 * lamp, a window and a sun. */
#define ROOM                                                                                                           \
    "void plastic wall 0 0 5 .5 .5 .5 0 0\n"                                                                           \
    "void light lamp 0 0 3 10 10 10\n"                                                                                 \
    "void glow window 0 0 4 3 3 4 0\n"                                                                                 \
    "wall polygon floor 0 0 18 0 0 0 3.2 2.4 0 1.4 4.8 0 -.2 3.6 0 .4 2.8 0 -1.2 1.6 0\n"                              \
    "wall polygon table 0 0 12 .6 1.2 .7 1.4 1.8 .7 .8 2.6 .7 0 2 .7\n"                                                \
    "wall polygon partition 0 0 12 .4 2.8 0 1.2 3.4 0 1.2 3.4 1.5 .4 2.8 1.5\n"                                        \
    "wall polygon shelf 0 0 9 2 1.7 .4 .2 2.9 .4 -.4 1.4 .4\n"                                                         \
    "wall sphere ball 0 0 4 1.6 2 .3 .3\n"                                                                             \
    "lamp polygon panel 0 0 12 .5 1 2.5 .2 1.4 2.5 .6 1.7 2.5 .9 1.3 2.5\n"                                            \
    "window polygon pane 0 0 12 3.2 2.4 1 3.2 2.4 2 1.4 4.8 2 1.4 4.8 1\n"                                             \
    "lamp source sun 0 0 4 1 -1 2 .5\n"

static geometry_visibility sees(const graze_scene *scene, int64_t surface, vec3 point, int light) {
    return sight_cell_sees(scene, sight_cells_at(scene, surface, point), light);
}

static int surface_named(const graze_scene *scene, const char *name) {
    for (size_t i = 0; i < scene->surface_count; i++)
        if (strcmp(scene_name(scene, scene->surfaces[i].primitive), name) == 0)
            return (int)i;
    fail_msg("no %s", name);
    return -1;
}

/* Shadow rays from a point to a light's front. */
static void check_light(const graze_scene *scene, dice *d, int surface, vec3 point, vec3 normal, int light,
                        int found[3]) {
    geometry_visibility seen = sees(scene, surface, point, light);
    assert_int_equal(sees(scene, surface, point, light), seen);
    found[seen]++;
    for (int i = 0; i < 8; i++) {
        light_sample sample = light_draw(scene, point, 0, light, (double[2]){roll(d), roll(d)});
        if (sample.light < 0 || vec3_dot(sample.direction, normal) <= 0)
            continue;
        geometry_ray ray = {point, sample.direction, sample.distance, surface};
        bool occluded = geometry_occluded(scene->geometry, &ray, scene->lights[light].surface);
        assert_false(seen == GEOMETRY_CLEAR && occluded);
        assert_false(seen == GEOMETRY_BLOCKED && !occluded);
    }
}

/* From points that rays from above find. */
static void check_surface(const graze_scene *scene, const char *name, int found[3]) {
    int surface = surface_named(scene, name), points = 0;
    dice d = {1};
    while (points < 4000) {
        geometry_ray ray = {.origin = {roll_between(&d, -1.3, 3.2), roll_between(&d, 0, 5), 2.4},
                            .direction = {0, 0, -1},
                            .far = GEOMETRY_FAR,
                            .from = -1};
        geometry_hit hit;
        if (!geometry_intersect(scene->geometry, &ray, &hit) || hit.surface != surface)
            continue;
        points++;
        for (int light = 0; light < (int)scene->light_count; light++)
            check_light(scene, &d, surface, hit.point, hit.normal, light, found);
    }
}

static void as_shadow_rays_say(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(ROOM);
    assert_non_null(scene);
    int floor[3] = {0}, table[3] = {0}, shelf[3] = {0};
    check_surface(scene, "floor", floor);
    check_surface(scene, "table", table);
    check_surface(scene, "shelf", shelf);
    /* Of 12,000 answers each, most are useful; on the shelf, which is all in shadows, many. */
    assert_true(floor[GEOMETRY_CLEAR] > 4000);
    assert_true(floor[GEOMETRY_BLOCKED] > 500);
    assert_true(table[GEOMETRY_CLEAR] > 7000);
    assert_true(shelf[GEOMETRY_CLEAR] > 1000);
    assert_true(shelf[GEOMETRY_BLOCKED] > 100);
    graze_scene_destroy(scene);
}

/* A floor whose first side is nothing, or next to nothing and leads out of its plane. */
static void short_sides(void **state) {
    (void)state;
    const char *second[] = {"-3 -3 0", "-2.99999999 -3 .00000001"};
    for (int i = 0; i < 2; i++) {
        char text[1024];
        (void)snprintf(text, sizeof text,
                       "void plastic wall 0 0 5 .5 .5 .5 0 0\n"
                       "void light lamp 0 0 3 10 10 10\n"
                       "lamp sphere bulb 0 0 4 1 1 3 .1\n"
                       "wall polygon shelf 0 0 12 0 0 1 2 0 1 2 2 1 0 2 1\n"
                       "wall polygon floor 0 0 15 -3 -3 0 %s 5 -3 0 5 5 0 -3 5 0\n",
                       second[i]);
        graze_scene *scene = scene_from_text(text);
        assert_non_null(scene);
        int found[3] = {0};
        check_surface(scene, "floor", found);
        assert_true(found[GEOMETRY_CLEAR] > 1000);
        graze_scene_destroy(scene);
    }
}

/* Points beside the surface, as roundings may put them, are taken for its edge. */
static void beyond_the_edge(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(ROOM);
    assert_non_null(scene);
    int table = surface_named(scene, "table");
    const vec3 corner = {.6, 1.2, .7}, far = {-1e30, 1e30, .7};
    const shape *s = &scene->shapes[table];
    for (uint32_t k = 0; k < 4 * 16; k++) {
        /* Along the edges, a little inside and outside. */
        vec3 v = s->polygon.vertices[k / 16], edge = vec3_subtract(s->polygon.vertices[(k / 16 + 1) % 4], v);
        v = vec3_add_scaled(v, (k % 16 + .5) / 16, edge);
        vec3 out = vec3_subtract(v, s->polygon.center);
        vec3 inside = vec3_add_scaled(v, -1e-6, out), outside = vec3_add_scaled(v, 1e-6, out);
        for (int light = 0; light < (int)scene->light_count; light++)
            assert_int_equal(sees(scene, table, inside, light), sees(scene, table, outside, light));
    }
    for (int light = 0; light < (int)scene->light_count; light++)
        (void)sees(scene, table, far, light);
    assert_int_equal(sees(scene, -1, corner, 0), GEOMETRY_MIXED);
    assert_int_equal(sees(scene, (int64_t)scene->surface_count, corner, 0), GEOMETRY_MIXED);
    assert_int_equal(sees(scene, surface_named(scene, "ball"), corner, 0), GEOMETRY_MIXED);
    graze_scene_destroy(scene);
}

static void many_lights_have_none(void **state) {
    (void)state;
    char text[4096] = ROOM;
    for (int i = 0; i < 6; i++) {
        size_t end = strlen(text);
        (void)snprintf(text + end, sizeof text - end, "lamp sphere extra%d 0 0 4 %d 9 9 .1\n", i, i);
    }
    graze_scene *scene = scene_from_text(text);
    assert_non_null(scene);
    assert_int_equal(scene->light_count, 9);
    assert_null(scene->sight_cells);
    assert_int_equal(sees(scene, surface_named(scene, "table"), vec3_make(.7, 1.8, .7), 0), GEOMETRY_MIXED);
    graze_scene_destroy(scene);
}

/* Of many surfaces the largest have cells: here those of the room, and none of the many small ones. */
static void the_largest_have_cells(void **state) {
    (void)state;
    enum { SMALL = 3000 };
    size_t room = 100 * SMALL + sizeof ROOM;
    char *text = malloc(room);
    assert_non_null(text);
    size_t end = (size_t)snprintf(text, room, "%s", ROOM);
    for (int i = 0; i < SMALL; i++)
        end +=
            (size_t)snprintf(text + end, room - end, "wall polygon p%d 0 0 9 %d 9 0 %d.1 9 0 %d 9.1 0\n", i, i, i, i);
    graze_scene *scene = scene_from_text(text);
    assert_non_null(scene);
    assert_int_not_equal(scene->surfaces[surface_named(scene, "floor")].cells, 0);
    assert_int_not_equal(scene->surfaces[surface_named(scene, "partition")].cells, 0);
    assert_int_equal(scene->surfaces[surface_named(scene, "p7")].cells, 0);
    assert_int_equal(scene->surfaces[surface_named(scene, "panel")].cells, 0);
    graze_scene_destroy(scene);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_shadow_rays_say),     cmocka_unit_test(short_sides),
        cmocka_unit_test(beyond_the_edge),        cmocka_unit_test(many_lights_have_none),
        cmocka_unit_test(the_largest_have_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
