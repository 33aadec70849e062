/* Instances and meshes as scenes have them: names, materials, lights, fingerprints. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <unistd.h>

#include "../rad/binary_writer.h"
#include "scene/fingerprint.h"
#include "scene/surface.h"
#include "support/scene_text.h"

static int enter_directory(void **state) {
    static char name[] = "/tmp/graze-copies-XXXXXX";
    *state = name;
    return mkdtemp(name) ? chdir(name) : -1;
}

static int leave_directory(void **state) {
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", (const char *)*state);
    return chdir("/") || system(command);
}

static void write_file(const char *name, const void *bytes, size_t length) {
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, length, out), length);
    assert_int_equal(fclose(out), 0);
}

/* An octree of one scene file of so many primitives. */
static void write_octree(const char *octree, const char *file, const char *text, int count) {
    const binary b = octree_of_file(file, count);
    write_file(octree, b.bytes, b.length);
    write_file(file, text, strlen(text));
}

/* A mesh of one triangle, in x + y <= 1, with normals; its only material is the text's `type`. */
static void write_mesh(const char *name, const char *type, int material, int normal) {
    binary b = {.length = 0};
    put_line(&b, "#?RADIANCE\nobj2mesh\nFORMAT=Radiance_tmesh\n\n");
    put_integer(&b, 319 + 4, 2);
    for (int i = 0; i < 4; i++)
        put_text(&b, i < 3 ? "0" : "2");
    for (int i = 0; i < 4; i++)
        put_real(&b, 0);
    put_integer(&b, 0, 1);
    put_text(&b, type);
    put_text(&b, "");
    put_integer(&b, 0, 1);
    put_integer(&b, -1, 4);
    put_text(&b, "own");
    put_integer(&b, 0, 2);
    int reals = strcmp(type, "light") ? strcmp(type, "glow") ? 5 : 4 : 3;
    put_integer(&b, reals, 2);
    for (int i = 0; i < reals; i++)
        put_real(&b, i < 3 ? .5 : 0);
    put_integer(&b, 255, 1);
    put_integer(&b, 1, 4);
    put_integer(&b, 3, 1);
    put_integer(&b, 3, 2);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            put_integer(&b, k + 1 == i ? INT64_C(1) << 31 : 0, 4);
    for (int i = 0; i < 3; i++)
        put_integer(&b, normal, 4);
    put_integer(&b, 1, 2);
    for (int i = 0; i < 3; i++)
        put_integer(&b, i, 1);
    put_integer(&b, 1, 2);
    put_integer(&b, material, 2);
    put_integer(&b, 0, 2);
    put_integer(&b, 0, 2);
    write_file(name, b.bytes, b.length);
}

static void assert_refused(const char *text, const char *reason) {
    graze_scene *scene = scene_from_text(text);
    if (scene || !strstr(messages, reason))
        fail_msg("wanted '%s', got: %s", reason, scene ? "no error" : messages);
}

static int64_t hit(const graze_scene *scene, vec3 origin, vec3 direction) {
    geometry_ray ray = {origin, vec3_normalize(direction), GEOMETRY_FAR, -1};
    geometry_hit found;
    (void)geometry_intersect(scene->geometry, &ray, &found);
    return found.surface;
}

#define BASE "void plastic gray 0 0 5 .5 .5 .5 0 0\ngray sphere ball 0 0 4 0 0 9 1\n"

static void modifiers_of_instances_replace_those_within(void **state) {
    (void)state;
    write_octree("inner.oct", "inner.rad", "void plastic own 0 0 5 .1 .1 .1 0 0\nown sphere in 0 0 4 0 0 0 1\n", 2);
    write_octree("outer.oct", "outer.rad",
                 "void plastic red 0 0 5 .9 .1 .1 0 0\nvoid instance a 1 inner.oct 0 0\n"
                 "red instance b 5 inner.oct -t 3 0 0 0 0\n",
                 3);
    graze_scene *scene = load_scene(BASE "void instance x 1 outer.oct 0 0\ngray instance y 5 outer.oct -t 0 5 0 0 0\n");
    const struct {
        double x, y;
        const char *surface, *modifier;
    } cases[] = {{0, 0, "in", "own"}, {3, 0, "b", "red"}, {0, 5, "y", "gray"}, {3, 5, "y", "gray"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t number = hit(scene, vec3_make(cases[i].x, cases[i].y, -5), vec3_make(0, 0, 1));
        assert_true(number >= 1);
        scene_surface s = scene_surface_at(scene, number);
        assert_string_equal(scene_name(scene, s.primitive), cases[i].surface);
        assert_string_equal(scene_modifier_name(scene, s.primitive), cases[i].modifier);
        assert_int_equal(s.light, -1);
        rad_transform t;
        bool moved = scene_material_is_moved(scene, number, &t);
        assert_true(moved == (cases[i].y == 0));
    }
    graze_scene_destroy(scene);
}

static void a_surface_across_its_orientation_is_warned_about_in_copies(void **state) {
    (void)state;
    write_octree("across.oct", "across.rad",
                 "void metal2 m 4 0 0 1 . 0 6 1 1 1 .5 .1 .2\n"
                 "m ring r 0 0 8 0 0 0 0 0 1 0 1 m ring s 0 0 8 0 0 0 0 1 0 0 1\n",
                 3);
    graze_scene *scene = load_scene(BASE "void instance x 1 across.oct 0 0\n");
    assert_non_null(strstr(messages, "ring r: lies across"));
    assert_null(strstr(messages, "ring s"));
    graze_scene_destroy(scene);
}

static void lights_in_copies_are_only_seen(void **state) {
    (void)state;
    write_octree("lamp.oct", "lamp.rad",
                 "void light l 0 0 3 2 2 2\nl sphere a 0 0 4 0 0 0 1\nl sphere b 0 0 4 3 0 0 1\n"
                 "void glow g 0 0 4 1 1 1 0\ng sphere c 0 0 4 6 0 0 1\nl source s 0 0 4 0 0 1 1\n",
                 6);
    graze_scene *scene = load_scene(BASE "void instance x 1 lamp.oct 0 0\n");
    assert_int_equal(scene->light_count, 1); /* the glow */
    assert_int_equal(scene->seen_light_count, 2);
    assert_false(scene->meets_glows);
    const char *first = strstr(messages, "sphere a: shines, but lights nothing");
    assert_non_null(first);
    assert_null(strstr(messages, "sphere b"));
    assert_null(strstr(messages, "sphere c"));
    assert_non_null(strstr(messages, "source s: a source in an instance does nothing"));
    int light = scene_surface_at(scene, hit(scene, vec3_make(3, 0, -5), vec3_make(0, 0, 1))).light;
    assert_int_equal(light, 1);
    assert_true(scene->lights[light].only_seen && scene->lights[light].radiance.r == 2);
    graze_scene_destroy(scene);
    assert_refused(BASE "void light l 0 0 3 1 1 1\nl instance x 1 lamp.oct 0 0\n",
                   "instance x: instances cannot be lights");
    assert_null(strstr(messages, "instance x: shines"));
    write_mesh("lamp.rtm", "plastic", 0, 0);
    assert_refused(BASE "void light l 0 0 3 1 1 1\nl mesh x 1 lamp.rtm 0 0\n", "mesh x: meshes cannot be lights");
    graze_scene_destroy(load_scene(BASE "void glow l 0 0 4 1 1 1 0\nl mesh x 1 lamp.rtm 0 0\n"));
}

/* Each copy of a glow that lights what is about is a light by itself, before the sources, in the order of numbers. */
static void glows_in_copies_are_lights_where_they_stand(void **state) {
    (void)state;
    write_octree("inner.oct", "inner.rad",
                 "void glow g 0 0 4 1 1 1 0\nvoid glow seen 0 0 4 1 1 1 -1\nvoid plastic p 0 0 5 .5 .5 .5 0 0\n"
                 "p sphere a 0 0 4 0 0 0 .1\ng sphere b 0 0 4 1 0 0 .1\nseen sphere c 0 0 4 2 0 0 .1\n"
                 "g polygon d 0 0 12 3 -.1 0 3 .1 0 3.2 .1 0 3.2 -.1 0\n",
                 7);
    write_octree("outer.oct", "outer.rad",
                 "void glow w 0 0 4 2 2 2 0\nw sphere e 0 0 4 0 -1 0 .1\nvoid instance x 1 inner.oct 0 0\n"
                 "void plastic q 0 0 5 .5 .5 .5 0 0\nq instance y 5 inner.oct -t 0 1 0 0 0\n",
                 5);
    graze_scene *scene =
        load_scene(BASE "void glow own 0 0 4 3 3 3 0\nown sphere o 0 0 4 0 0 20 1\nown source s 0 0 4 0 0 1 1\n"
                        "own instance k 5 inner.oct -t 0 10 0 0 0\nvoid instance l 6 outer.oct -mx -t 0 20 0 0 0\n");
    const struct {
        double x, y;
        int light; /* where it is to be found: behind the scene's own and the source */
    } cases[] = {{0, 10, 2},  {1, 10, 3},   {2, 10, 4},    {3.1, 10, 5}, {0, 19, 6},
                 {-1, 20, 7}, {-2, 20, 10}, {-3.1, 20, 8}, {-1, 21, -1}};
    assert_int_equal(scene->light_count, 9);
    assert_int_equal(scene->first_source, 1);
    assert_int_equal(scene->first_copied, 2);
    assert_false(scene->meets_glows);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t number = hit(scene, vec3_make(cases[i].x, cases[i].y, -5), vec3_make(0, 0, 1));
        assert_true(number >= 2);
        int light = scene_surface_at(scene, number).light;
        if (cases[i].light >= 9 ? light < 9 : light != cases[i].light)
            fail_msg("light %d at %g %g, not %d", light, cases[i].x, cases[i].y, cases[i].light);
        if (light < 0 || light >= 9)
            continue;
        vec3 lower, upper;
        shape_bounds(scene->lights[light].shape, &lower, &upper);
        vec3 middle = vec3_scale(.5, vec3_add(lower, upper)), at = vec3_make(cases[i].x, cases[i].y, 0);
        assert_true(scene->lights[light].surface == number);
        assert_true(vec3_length(vec3_subtract(middle, at)) < 1e-9);
    }
    graze_scene_destroy(scene);
}

/* What stands for a copy and is only seen keeps its light where others are put before that. */
static void only_seen_beside_glows_in_copies(void **state) {
    (void)state;
    write_octree("thing.oct", "thing.rad", "void plastic p 0 0 5 .5 .5 .5 0 0\np sphere a 0 0 4 0 0 0 1\n", 2);
    write_octree("glow.oct", "glow.rad", "void glow g 0 0 4 1 1 1 0\ng sphere b 0 0 4 0 0 0 1\n", 2);
    graze_scene *scene =
        load_scene("void glow seen 0 0 4 5 5 5 -1\nseen instance x 1 thing.oct 0 0\n"
                   "void glow too 0 0 4 7 7 7 -1\ntoo instance w 5 thing.oct -t -3 0 0 0 0\n"
                   "void instance y 5 glow.oct -t 3 0 0 0 0\nvoid instance z 5 glow.oct -t 6 0 0 0 0\n");
    assert_int_equal(scene->light_count, 2);
    for (int i = 0; i < 2; i++) {
        int light = scene_surface_at(scene, hit(scene, vec3_make(-3 * i, 0, -5), vec3_make(0, 0, 1))).light;
        assert_in_range(light, 2, scene->light_count + scene->seen_light_count - 1);
        assert_true(scene->lights[light].only_seen && scene->lights[light].radiance.r == 5 + 2 * i);
        int as = scene->lights[i].seen_as;
        assert_in_range(as, 2, scene->light_count + scene->seen_light_count - 1);
        assert_true(scene->lights[as].radiance.r == 1);
    }
    graze_scene_destroy(scene);
}

/* 64 to the third copies of a glow, or of a thing that a glow stands for. */
static void too_many_glows_in_copies_are_none(void **state) {
    (void)state;
    enum { WIDTH = 64, LEVELS = 3 };
    static char text[WIDTH * 64];
    write_octree("level0.oct", "level0.rad", "void glow g 0 0 4 1 1 1 0\ng sphere a 0 0 4 0 0 0 .1\n", 2);
    for (int level = 1; level <= LEVELS; level++) {
        char octree[32], file[32];
        size_t end = 0;
        snprintf(octree, sizeof octree, "level%d.oct", level);
        snprintf(file, sizeof file, "level%d.rad", level);
        for (int i = 0; i < WIDTH; i++)
            end +=
                (size_t)snprintf(text + end, sizeof text - end, "void instance i 3 level%d.oct -s 1 0 0\n", level - 1);
        write_octree(octree, file, text, WIDTH);
    }
    for (int replaced = 0; replaced < 2; replaced++) {
        snprintf(text, sizeof text, BASE "void glow h 0 0 4 1 1 1 0\n%s instance x 1 level%d.oct 0 0\n",
                 replaced ? "h" : "void", LEVELS);
        graze_scene *scene = load_scene(text);
        assert_int_equal(scene->light_count, 0);
        assert_true(scene->meets_glows);
        graze_scene_destroy(scene);
    }
}

static void meshes_need_materials(void **state) {
    (void)state;
    write_mesh("bare.rtm", "plastic", -1, 0);
    assert_refused(BASE "void mesh x 1 bare.rtm 0 0\n", "mesh x: its modifier is void, but \"");
    graze_scene *scene = load_scene(BASE "gray mesh x 1 bare.rtm 0 0\n");
    scene_surface s = scene_surface_at(scene, hit(scene, vec3_make(.2, .2, -1), vec3_make(0, 0, 1)));
    assert_string_equal(scene_name(scene, s.primitive), "x");
    graze_scene_destroy(scene);
}

static void normals_of_meshes_turn_with_them(void **state) {
    (void)state;
    write_mesh("smooth.rtm", "plastic", 0, 8 | 16 | 2); /* (0, -1, 0) */
    graze_scene *scene = load_scene(BASE "void mesh x 10 smooth.rtm -mx -rz 90 -s 3 -t 0 0 1 0 0\n");
    /* x of the triangle goes to -y of the scene, y to -x */
    int64_t number = hit(scene, vec3_make(-.5, -.5, -1), vec3_make(0, 0, 1));
    assert_true(number >= 1);
    scene_surface s = scene_surface_at(scene, number);
    assert_string_equal(scene_name(scene, s.primitive), "M-Tri");
    assert_string_equal(scene_modifier_name(scene, s.primitive), "own");
    scene_mesh_point m = scene_mesh_point_at(scene, number, vec3_make(-.5, -.5, 1));
    assert_true(m.has_normal && !m.has_uv);
    assert_true(vec3_length(vec3_subtract(m.normal, vec3_make(1, 0, 0))) < 1e-3);
    bool flat;
    assert_true(fabs(scene_surface_area(scene, number, &flat) - 4.5) < 1e-6 && flat);
    graze_scene_destroy(scene);
}

static uint64_t fingerprint(const char *text) {
    graze_scene *scene = load_scene(text);
    uint64_t f = scene_fingerprint(scene);
    graze_scene_destroy(scene);
    return f;
}

static void fingerprints_know_all_files(void **state) {
    (void)state;
    const char *octree = BASE "void instance x 1 inner.oct 0 0\n", *mesh = BASE "void mesh x 1 print.rtm 0 0\n";
    write_octree("inner.oct", "inner.rad", "void plastic own 0 0 5 .1 .1 .1 0 0\nown sphere in 0 0 4 0 0 0 1\n", 2);
    uint64_t before = fingerprint(octree);
    assert_true(before == fingerprint(octree));
    write_octree("inner.oct", "inner.rad", "void plastic own 0 0 5 .1 .1 .1 0 0\nown sphere in 0 0 4 0 0 0 2\n", 2);
    assert_true(before != fingerprint(octree));
    write_mesh("print.rtm", "plastic", 0, 8);
    before = fingerprint(mesh);
    assert_true(before == fingerprint(mesh));
    write_mesh("print.rtm", "plastic", 0, 16);
    assert_true(before != fingerprint(mesh));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modifiers_of_instances_replace_those_within),
        cmocka_unit_test(a_surface_across_its_orientation_is_warned_about_in_copies),
        cmocka_unit_test(lights_in_copies_are_only_seen),
        cmocka_unit_test(glows_in_copies_are_lights_where_they_stand),
        cmocka_unit_test(only_seen_beside_glows_in_copies),
        cmocka_unit_test(too_many_glows_in_copies_are_none),
        cmocka_unit_test(meshes_need_materials),
        cmocka_unit_test(normals_of_meshes_turn_with_them),
        cmocka_unit_test(fingerprints_know_all_files),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
