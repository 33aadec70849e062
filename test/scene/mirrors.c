/* Lights in mirrors and panes: none that a point sees there is left out, and panes of one plane are one. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "scene/light.h"
#include "scene/mirrors.h"
#include "support/dice.h"
#include "support/scene_text.h"

/* A window of four panes, one of them turned and one nearly where its plane is; another pane that is parallel to it,
 * and one across; and two mirrors in one plane, which stay two. */
static void panes_of_one_plane_are_one(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void glass g 0 0 3 .9 .9 .9\nvoid mirror m 0 0 3 .9 .9 .9\n"
                                    "void light l 0 0 3 1 1 1\nl sphere lamp 0 0 4 9 9 9 1\n"
                                    "g polygon a 0 0 12 0 0 0 1 0 0 1 0 1 0 0 1\n"
                                    "m polygon e 0 0 9 0 0 5 1 0 5 1 1 5\n"
                                    "g polygon b 0 0 12 1.1 0 1 2 0 1 2 0 0 1.1 0 0\n"
                                    "m polygon f 0 0 9 2 0 5 3 0 5 3 1 5\n"
                                    "g polygon h 0 0 12 0 .02 0 1 .02 0 1 .02 1 0 .02 1\n"
                                    "g ring c 0 0 8 .5 0 2 0 1 0 0 .5\n"
                                    "g polygon d 0 0 9 1.1 1e-6 1.1 2 0 1.1 2 0 2.1\n"
                                    "g polygon i 0 0 9 0 0 0 0 1 0 0 0 3\n"
                                    "g sphere s 0 0 4 5 5 5 1\n");
    assert_int_equal(scene->mirror_count, 5);
    int sizes[5];
    for (size_t i = 0; i < scene->mirror_count; i++) {
        const scene_mirror *m = &scene->mirrors[i];
        sizes[i] = m->count;
        assert_true(m->pane == (i >= 2));
        for (int k = m->first; k < m->first + m->count; k++) {
            const shape *s = &scene->shapes[scene->mirror_surfaces[k]];
            assert_ptr_equal(scene_mirror_of(scene, scene->mirror_surfaces[k]), m);
            for (uint32_t j = 0; s->kind == SHAPE_POLYGON && j < s->polygon.vertex_count; j++)
                assert_true(vec3_length(vec3_subtract(s->polygon.vertices[j], m->middle)) <= m->radius);
        }
    }
    assert_true(sizes[0] == 1 && sizes[1] == 1 && sizes[2] == 4 && sizes[3] == 1 && sizes[4] == 1);
    graze_scene_destroy(scene);
}

/* Of more planes than are worth it the largest are kept. */
static void small_panes_are_left_out(void **state) {
    (void)state;
    char text[8000];
    int length = snprintf(text, sizeof text,
                          "void glass g 0 0 3 .9 .9 .9\nvoid light l 0 0 3 1 1 1\n"
                          "l sphere lamp 0 0 4 9 9 9 1\n");
    for (int i = 0; i < 40; i++)
        length += snprintf(text + length, sizeof text - (size_t)length, "g ring r%d 0 0 8 0 0 %d 0 0 1 0 %d\n", i, i,
                           1 + i * 7 % 40);
    graze_scene *scene = load_scene(text);
    assert_int_equal(scene->mirror_count, 32);
    assert_int_equal(scene->mirror_surface_count, 32);
    for (size_t i = 0; i < scene->surface_count; i++)
        if (scene->shapes[i].kind == SHAPE_RING)
            assert_true(scene->surfaces[i].mirrors == (scene->shapes[i].ring.r1 > 8));
    graze_scene_destroy(scene);
}

/* Points of lights that a point sees in mirrors are in lights that these may show to it. */
static void what_is_seen_may_be_shown(void **state) {
    (void)state;
    graze_scene *scene = load_scene("void glass g 0 0 3 .9 .9 .9\nvoid mirror m 0 0 3 .9 .9 .9\n"
                                    "void light l 0 0 3 1 1 1\nvoid glow s 0 0 4 1 1 1 0\n"
                                    "g polygon a 0 0 12 0 0 0 1 0 0 1 0 1 0 0 1\ng polygon b 0 0 9 1 0 1 2 0 1 2 0 2\n"
                                    "m ring c 0 0 8 0 1 0 0 0 1 .2 .8\nm polygon d 0 0 9 -1 -1 -1 -1 1 -1 -1 0 1\n"
                                    "l sphere e 0 0 4 .5 .5 .7 .3\nl polygon f 0 0 12 1 1 2 1 2 2 2 2 2 2 1 2\n"
                                    "l ring h 0 0 8 -.5 0 .5 1 0 .5 .1 .4\nl cylinder i 0 0 7 0 -1 1 .5 -1 1.5 .1\n"
                                    "l source j 0 0 4 1 1 1 .5\ns source k 0 0 4 1 0 1 60\ns source n 0 0 4 0 0 1 180\n"
                                    "s source o 0 0 4 0 0 1 300\n");
    assert_non_null(scene->mirrored_lights);
    dice d = {7};
    int seen = 0, never = 0, asked = 0;
    for (int i = 0; i < 200000; i++) {
        const vec3 point = roll_in_cube(&d, 2), normal = roll_direction(&d);
        const scene_mirror *m = &scene->mirrors[roll_below(&d, (int)scene->mirror_count)];
        int light = roll_below(&d, (int)scene->light_count);
        const double random[2] = {roll(&d), roll(&d)};
        scene_mirror_sight sight;
        bool sees = scene_mirror_see(m, point, normal, &sight);
        bool shows = sees && scene_mirror_shows(&sight, &scene->mirrored_lights[light]) > 0;
        asked++;
        never += !shows;
        vec3 n = m->plane.normal;
        double height = vec3_dot(n, vec3_subtract(point, m->plane.point));
        if (height == 0 || (height < 0 && !m->pane))
            continue;
        const vec3 image = vec3_add_scaled(point, -2 * height, n);
        const light_sample sample = light_draw(scene, image, 0, light, random);
        if (sample.light < 0)
            continue;
        double way = -vec3_dot(n, vec3_subtract(image, m->plane.point)) / vec3_dot(n, sample.direction);
        vec3 at = vec3_add_scaled(image, way, sample.direction);
        if (!(way > 0 && way < sample.distance) || scene_mirror_at(scene, m, at) < 0 ||
            vec3_dot(vec3_subtract(at, point), normal) <= 0)
            continue;
        seen++;
        assert_true(shows);
        assert_true(vec3_length(vec3_subtract(sight.image, image)) < 1e-12);
    }
    /* And most of what is not seen is known not to be. */
    assert_true(seen > 500);
    assert_true(never > 0.5 * asked);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(panes_of_one_plane_are_one),
        cmocka_unit_test(small_panes_are_left_out),
        cmocka_unit_test(what_is_seen_may_be_shown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
