/* What antimatter cuts: what is known of a ray's points before changes nothing about those further on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "scene/cuts.h"
#include "support/scene_text.h"

/* Overlapping balls along x, each with two smaller ones of the two antimatters in it; one of these cuts the other's
 * bodies, too. */
static graze_scene *row_of_balls(void) {
    char text[8192] = "void plastic gray 0 0 5 .5 .5 .5 0 0\nvoid plastic red 0 0 5 .5 .1 .1 0 0\n"
                      "void antimatter hole 2 gray red 0 0\nvoid antimatter gap 2 red gray 0 0\n";
    size_t length = strlen(text);
    for (int i = 0; i < 20; i++)
        length += (size_t)snprintf(text + length, sizeof text - length,
                                   "%s sphere b%d 0 0 4 %d 0 0 .8\nhole sphere h%d 0 0 4 %d.2 0 .1 .4\n"
                                   "gap sphere g%d 0 0 4 %d.4 .1 0 .3\n",
                                   i % 3 ? "gray" : "red", i, i, i, i, i, i);
    graze_scene *scene = load_scene(text);
    return scene;
}

/* Goes along a ray; counts its points by what is there. */
static void follow(const graze_scene *scene, geometry_ray ray, int found[3]) {
    scene_cuts_walk walk = {.begun = false};
    geometry_hit hit;
    while (geometry_intersect(scene->geometry, &ray, &hit)) {
        scene_cuts_walk none = {.begun = false};
        scene_presence there = scene_cuts_at(scene, &walk, hit.surface, hit.point, ray.direction);
        assert_int_equal(there, scene_cuts_at(scene, &none, hit.surface, hit.point, ray.direction));
        found[there]++;
        ray.origin = hit.point;
        ray.from = hit.surface;
    }
}

static void points_before_change_nothing(void **state) {
    (void)state;
    graze_scene *scene = row_of_balls();
    int found[3] = {0};
    for (int i = 0; i < 400; i++) {
        vec3 origin = {-2, 0.07 * (i % 20) - 0.7, 0.07 * (i / 20) - 0.7};
        vec3 towards = {22, 0.3 * (i % 7) - 1, 0.2 * (i % 11) - 1};
        vec3 direction = vec3_normalize(vec3_subtract(towards, origin));
        follow(scene, (geometry_ray){origin, direction, GEOMETRY_FAR, -1}, found);
        follow(scene, (geometry_ray){towards, vec3_negate(direction), GEOMETRY_FAR, -1}, found);
    }
    assert_true(found[SCENE_THERE] > 1000);
    assert_true(found[SCENE_CUT_AWAY] > 1000);
    assert_true(found[SCENE_CUT_FACE] > 1000);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_before_change_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
