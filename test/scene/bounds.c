/* Bodies of a material in copies, in copies of copies, and those that copies become by their own modifier. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "../rad/binary_writer.h"
#include "scene/bounds.h"
#include "scene/surface.h"
#include "support/close.h"
#include "support/scene_text.h"

/* Surfaces are small balls along x. */
#define RADIUS     0.1
#define INNER      BODY(m) "p sphere a 0 0 4 0 0 0 .1 m sphere b 0 0 4 1 0 0 .1 "
#define BODY(name) "void plastic p 0 0 5 .5 .5 .5 0 0 void antimatter " #name " 1 p 0 0 "

static int material_named(const graze_scene *scene, const char *name) {
    for (size_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].primitive >= 0 && !strcmp(scene_name(scene, scene->materials[i].primitive), name))
            return (int)i;
    fail_msg("no material %s", name);
    return -1;
}

/* Where a ray along x enters and leaves the bodies: balls around these places, in this order. */
static void assert_bodies(const graze_scene *scene, const char *name, const double *at, int count) {
    int material = material_named(scene, name);
    shape own[4];
    size_t own_count = 0;
    for (size_t i = 0; i < scene->surface_count; i++)
        if (scene->surfaces[i].material == material)
            own[own_count++] = scene->shapes[i];
    scene_bounds bounds;
    const graze_report report = {NULL, NULL};
    assert_int_equal(scene_bounds_build(&bounds, scene, material, own, own_count, 1, &report), GRAZE_OK);
    geometry_ray ray = {.origin = {-5, 0, 0}, .direction = {1, 0, 0}, .far = GEOMETRY_FAR, .from = -1};
    geometry_hit hit;
    for (int i = 0; i < 2 * count; i++) {
        if (!geometry_intersect(bounds.geometry, &ray, &hit))
            fail_msg("%s ends before %g", name, at[i / 2]);
        assert_close(hit.point.x, at[i / 2] + (i % 2 ? RADIUS : -RADIUS), 1e-9);
        ray.origin = hit.point;
        ray.from = hit.surface;
    }
    if (geometry_intersect(bounds.geometry, &ray, &hit))
        fail_msg("%s is also at %g", name, hit.point.x);
    scene_bounds_destroy(&bounds);
}

static void of_each_material(void **state) {
    (void)state;
    static const double m[] = {31, 51}, w[] = {35, 37, 38}, fog[] = {0, 10, 11, 20, 21, 25, 27, 28};
    const written_file inner_text = written_file_make(INNER, strlen(INNER));
    const binary inner = octree_of_file(inner_text.name, 4);
    const written_file inner_file = written_file_make(inner.bytes, inner.length);
    char text[1024];
    (void)snprintf(text, sizeof text,
                   BODY(w) "w sphere e 0 0 4 5 0 0 .1 void instance x 1 %s 0 0 w instance y 5 %s -t 7 0 0 0 0 ",
                   inner_file.name, inner_file.name);
    const written_file outer_text = written_file_make(text, strlen(text));
    const binary outer = octree_of_file(outer_text.name, 5);
    const written_file outer_file = written_file_make(outer.bytes, outer.length);
    (void)snprintf(text, sizeof text,
                   BODY(fog) "fog sphere o 0 0 4 0 0 0 .1 fog instance k 5 %s -t 10 0 0 0 0 "
                             "fog instance l 5 %s -t 20 0 0 0 0 void instance n 5 %s -t 30 0 0 0 0 "
                             "void instance q 5 %s -t 50 0 0 0 0 ",
                   inner_file.name, outer_file.name, outer_file.name, inner_file.name);
    graze_scene *scene = load_scene(text);
    assert_bodies(scene, "m", m, 2);
    assert_bodies(scene, "w", w, 3);
    assert_bodies(scene, "fog", fog, 8);
    graze_scene_destroy(scene);
    unlink(inner_text.name);
    unlink(inner_file.name);
    unlink(outer_text.name);
    unlink(outer_file.name);
}

static void without_copies(void **state) {
    (void)state;
    static const double fog[] = {3};
    graze_scene *scene = scene_from_text(BODY(fog) "fog sphere o 0 0 4 3 0 0 .1 " BODY(m) "m sphere p 0 0 4 5 0 0 .1");
    assert_non_null(scene);
    assert_bodies(scene, "fog", fog, 1);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_each_material),
        cmocka_unit_test(without_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
