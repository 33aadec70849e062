/* Compiled meshes, and which files scenes are made of. */
#include "binary_writer.h"
#include "support.h"

enum { HAS_POINT = 1, HAS_NORMAL = 2, HAS_UV = 4 };

static void write_binary(const char *name, const binary *b) {
    write_bytes(name, b->bytes, b->length);
}

static void put_mesh_head_of(binary *b, const char *x, const char *edge) {
    put_line(b, "#?RADIANCE\nobj2mesh\nFORMAT=Radiance_tmesh\n\n");
    put_integer(b, 319 + 4, 2);
    const char *const cube[] = {x, "-2", "-3", edge};
    for (int i = 0; i < 4; i++)
        put_text(b, cube[i]);
    const double limits[] = {-1, 1, 0, 8};
    for (int i = 0; i < 4; i++)
        put_real(b, limits[i]);
    put_integer(b, 0, 1); /* no tree */
}

static void put_mesh_head(binary *b) {
    put_mesh_head_of(b, "-1", "4");
}

/* Two materials. */
static void put_materials(binary *b) {
    const char *const types[] = {"plastic", "sphere", ""};
    for (int i = 0; i < 3; i++)
        put_text(b, types[i]);
    for (int m = 0; m < 2; m++) {
        put_integer(b, 0, 1);
        put_integer(b, -1, 4);
        put_text(b, m ? "blue" : "red");
        put_integer(b, 0, 2);
        put_integer(b, 5, 2);
        for (int i = 0; i < 5; i++)
            put_real(b, i == 2 * m ? .5 : 0);
    }
    put_integer(b, 255, 1);
}

/* Points in steps of the cube's 2^32 cells: x, y and z of point i are i, 2 i and 3 i quarters of it. */
static void put_points(binary *b, int count, int flags) {
    put_integer(b, flags, 1);
    put_integer(b, count, 2);
    for (int i = 0; i < count; i++)
        for (int k = 1; k <= 3; k++)
            put_integer(b, (int64_t)i * k << 30, 4);
    for (int i = 0; flags & HAS_NORMAL && i < count; i++)
        put_integer(b, i == 1 ? 0 : 8 | 16 | 2, 4); /* (0, -1, 0) */
    for (int i = 0; flags & HAS_UV && i < count; i++) {
        put_integer(b, i == 2 ? 0 : INT64_C(1) << 31, 4);
        put_integer(b, 1 << 29, 4);
    }
}

static void put_bytes(binary *b, int a, int c, int d) {
    put_integer(b, a, 1);
    put_integer(b, c, 1);
    put_integer(b, d, 1);
}

/* Two patches: a triangle of each material, one of one material and all kinds that join. */
static binary good_mesh(void) {
    binary b = {.length = 0};
    put_mesh_head(&b);
    put_materials(&b);
    put_integer(&b, 2, 4);
    put_points(&b, 4, HAS_POINT | HAS_NORMAL | HAS_UV);
    put_integer(&b, 2, 2);
    put_bytes(&b, 0, 1, 2);
    put_bytes(&b, 1, 3, 2);
    put_integer(&b, 2, 2);
    put_integer(&b, 1, 2);
    put_integer(&b, 0, 2);
    put_integer(&b, 1, 2); /* with one point of the other patch */
    put_integer(&b, 1 << 8 | 2, 4);
    put_integer(&b, 0, 1);
    put_integer(&b, 3, 1);
    put_integer(&b, 1, 2);
    put_integer(&b, 0, 2);
    put_points(&b, 3, HAS_POINT);
    put_integer(&b, 1, 2);
    put_bytes(&b, 2, 1, 0);
    put_integer(&b, 1, 2);
    put_integer(&b, 0, 2);
    put_integer(&b, 0, 2);
    put_integer(&b, 1, 2); /* with two points */
    put_integer(&b, 1, 4);
    put_integer(&b, 3, 4);
    put_integer(&b, 1, 1);
    put_integer(&b, 0, 2);
    return b;
}

static graze_status read_parts(const char *text, rad_scene **scene, messages *m) {
    write_file("scene.rad", text);
    const char *name = "scene.rad";
    graze_report report = messages_report(m);
    graze_status status = rad_scene_read(scene, &name, 1, &report);
    return status ? status : rad_scene_read_parts(*scene, &report);
}

static void reads_a_mesh(void **state) {
    (void)state;
    binary b = good_mesh();
    write_binary("good.rtm", &b);
    messages m;
    rad_scene *scene;
    assert_int_equal(read_parts("void mesh it 3 good.rtm -s 2 0 0\n", &scene, &m), GRAZE_OK);
    size_t count, parts;
    const rad_primitive *primitives = rad_scene_primitives(scene, &count);
    const rad_part *part = rad_scene_parts(scene, &parts);
    assert_int_equal(count, 5);
    assert_int_equal(parts, 2);
    assert_int_equal(part[0].count, 1);
    assert_int_equal(part[0].copies, 1);
    assert_int_equal(part[1].first, 1);
    const rad_copy *copy = rad_scene_copies(scene);
    assert_true(copy->primitive == 0 && copy->part == 1 && copy->transform.scale == 2);
    assert_string_equal(primitives[1].id, "red");
    assert_string_equal(primitives[4].id, "M-Tri");
    assert_int_equal(primitives[4].modifier, 2);

    const rad_mesh *mesh = part[1].mesh;
    assert_int_equal(mesh->point_count, 7);
    assert_int_equal(mesh->triangle_count, 5);
    const uint32_t points[5][3] = {{0, 1, 2}, {1, 3, 2}, {6, 0, 3}, {6, 5, 4}, {1, 3, 5}};
    const int materials[5] = {4, 3, 4, 3, 3};
    for (int i = 0; i < 5; i++) {
        assert_memory_equal(mesh->triangles[i].points, points[i], sizeof points[i]);
        assert_int_equal(mesh->triangles[i].primitive, materials[i]);
    }
    /* cells of the cube, at their middles */
    for (uint32_t i = 0; i < 7; i++) {
        double at = i % 4 / 4.0, half = 0x1p-33;
        double z = fmod(3 * at, 1);
        assert_true(mesh->points[i].x == -1 + 4 * (at + half));
        assert_true(mesh->points[i].y == -2 + 4 * (fmod(2 * at, 1) + half));
        assert_true(mesh->points[i].z == -3 + 4 * (z + half));
    }
    assert_true(mesh->normals[0].y == -1 && mesh->normals[0].x == 0 && mesh->normals[0].z == 0);
    assert_true(mesh->normals[1].y == 0 && mesh->normals[5].y == 0);
    assert_true(mesh->has_uv[0] && !mesh->has_uv[2] && !mesh->has_uv[4]);
    assert_true(fabs(mesh->uv[0][0]) < 1e-9 && fabs(mesh->uv[0][1] - 1) < 1e-8);
    rad_scene_destroy(scene);
}

/* The sizes of two of its coordinates, not the largest, in steps of which 8191.5 are sqrt(1/2). */
static int64_t encode_direction(vec3 d) {
    const double size[] = {fabs(d.x), fabs(d.y), fabs(d.z)}, steps = 8191.5 * sqrt(2);
    const int64_t signs = (d.x < 0) | (d.y < 0) << 1 | (d.z < 0) << 2;
    const bool largest_is_x = size[0] > size[1] && size[0] > size[2], largest_is_y = !largest_is_x && size[1] > size[2];
    const int first = largest_is_x ? 1 : 0, second = largest_is_x || largest_is_y ? 2 : 1;
    return signs | (first == 0) << 3 | (second == 2) << 4 | (int64_t)(size[first] * steps) << 5 |
           (int64_t)(size[second] * steps) << 18;
}

static void reads_normals_of_all_directions(void **state) {
    (void)state;
    enum { COUNT = 200 };
    vec3 directions[COUNT];
    dice d = {3};
    binary b = {.length = 0};
    put_mesh_head(&b);
    put_materials(&b);
    put_integer(&b, 1, 4);
    put_integer(&b, HAS_POINT | HAS_NORMAL, 1);
    put_integer(&b, COUNT, 2);
    for (int i = 0; i < COUNT; i++) {
        directions[i] = roll_direction(&d);
        for (int k = 0; k < 3; k++)
            put_integer(&b, 1 << 29, 4);
    }
    for (int i = 0; i < COUNT; i++)
        put_integer(&b, encode_direction(directions[i]), 4);
    put_integer(&b, 1, 2);
    put_bytes(&b, 0, 1, 2);
    for (int i = 0; i < 4; i++)
        put_integer(&b, 0, 2);
    write_binary("good.rtm", &b);
    messages m;
    rad_scene *scene;
    assert_int_equal(read_parts("void mesh it 1 good.rtm 0 0\n", &scene, &m), GRAZE_OK);
    size_t parts;
    const rad_mesh *mesh = rad_scene_parts(scene, &parts)[1].mesh;
    assert_int_equal(mesh->point_count, COUNT);
    for (int i = 0; i < COUNT; i++)
        assert_true(vec3_length(vec3_subtract(mesh->normals[i], directions[i])) < 2e-4);
    rad_scene_destroy(scene);
}

static void assert_refused(const char *text, const binary *b, const char *message) {
    messages m;
    rad_scene *scene;
    if (b)
        write_binary("bad.rtm", b);
    assert_int_not_equal(read_parts(text, &scene, &m), GRAZE_OK);
    assert_contains(m.text, message);
    rad_scene_destroy(scene);
}

static void damaged_meshes_are_refused(void **state) {
    (void)state;
    static const char text[] = "void mesh it 1 bad.rtm 0 0\n";
    binary whole = good_mesh(), b;
    for (size_t length = 45; length < whole.length; length++) {
        b = whole;
        b.length = length;
        bool patches = length > 170; /* whose number is known */
        assert_refused(text, &b, patches ? "bad.rtm: mesh: " : "bad.rtm: mesh: the file ends too early (byte ");
    }
    b = whole;
    b.bytes[b.length - 1] = 2;
    assert_refused(text, &b, "damaged: a triangle's material is none of its materials");
    b = whole;
    b.bytes[b.length - 3] = 3;
    assert_refused(text, &b, "damaged: a triangle's corner is none of its points");
    b = whole;
    b.bytes[b.length - 13] = 7;
    assert_refused(text, &b, "too many triangles in a patch");
    b = (binary){.length = 0};
    put_mesh_head_of(&b, "left", "4");
    assert_refused(text, &b, "bad.rtm: mesh: damaged: its cube is not given in numbers");
    b = (binary){.length = 0};
    put_mesh_head_of(&b, "-1", "0");
    assert_refused(text, &b, "bad.rtm: mesh: damaged: its cube has no size");
    assert_refused("void mesh it 1 nowhere.rtm 0 0\n", NULL, "mesh it: cannot find mesh file \"nowhere.rtm\"");
    assert_refused("void mesh it 1 scene.rad 0 0\n", NULL, "not a compiled mesh (from mesh it at scene.rad:1:1)");
    assert_refused("void mesh it 3 bad.rtm -t 1 0 0\n", NULL, "mesh it: bad transform at \"-t\"");
    write_binary("bad.rtm", &whole);
    assert_refused("void mesh a 1 bad.rtm 0 0\nvoid instance b 1 bad.rtm 0 0\n", NULL, "\"bad.rtm\" is a mesh");
    assert_refused("void instance b 1 bad.rtm 0 0\n", NULL, "bad.rtm: not an octree");
}

/* Whatever is changed in it, no harm comes of it. */
static void survives_damage(void **state) {
    (void)state;
    binary whole = good_mesh();
    dice d = {5};
    int good = 0, bad = 0;
    for (int round = 0; round < 3000; round++) {
        binary b = whole;
        for (uint64_t i = 0; i < 1 + roll_bits(&d) % 3; i++)
            b.bytes[45 + roll_bits(&d) % (b.length - 45)] = (char)roll_bits(&d);
        write_binary("bad.rtm", &b);
        messages m;
        rad_scene *scene;
        graze_status status = read_parts("void mesh it 1 bad.rtm 0 0\n", &scene, &m);
        assert_true((status == GRAZE_OK) == (m.errors == 0));
        ++*(status ? &bad : &good);
        rad_scene_destroy(scene);
    }
    assert_true(good > 100 && bad > 500);
}

static void write_octree(const char *name, const char *file) {
    const binary b = octree_of_file(file, 1);
    write_binary(name, &b);
}

/* Each file is read once, users come before what they use, and modifiers are each file's own. */
static void parts_in_order(void **state) {
    (void)state;
    write_file("leaf.rad", "void plastic own 0 0 5 1 1 1 0 0\nown sphere leaf 0 0 4 0 0 0 1\n");
    write_file("twig.rad", "void instance a 1 leaf.oct 0 0\nvoid instance b 4 leaf.oct -t 1 0 0 0 0\n");
    write_file("tree.rad", "void instance c 1 leaf.oct 0 0\nvoid instance d 1 twig.oct 0 0\n");
    write_octree("leaf.oct", "leaf.rad");
    write_octree("twig.oct", "twig.rad");
    write_octree("tree.oct", "tree.rad");
    messages m;
    rad_scene *scene;
    write_file("twig.rad", "void instance a 1 leaf.oct 0 0\nvoid instance b 5 leaf.oct -t 1 0 0 0 0\n");
    assert_int_equal(read_parts("void plastic own 0 0 5 0 0 0 0 0\nvoid instance x 1 leaf.oct 0 0\n"
                                "own instance y 1 twig.oct 0 0\nvoid instance z 1 tree.oct 0 0\n",
                                &scene, &m),
                     GRAZE_OK);
    size_t parts, count;
    const rad_part *part = rad_scene_parts(scene, &parts);
    const rad_copy *copies = rad_scene_copies(scene);
    const rad_primitive *primitives = rad_scene_primitives(scene, &count);
    assert_int_equal(parts, 4);
    assert_int_equal(count, 4 + 2 + 2 + 2);
    const char *const paths[] = {"./tree.oct", "./twig.oct", "./leaf.oct"};
    for (int i = 0; i < 3; i++)
        assert_string_equal(part[i + 1].path + (part[i + 1].path[0] == '.' ? 2 : 0), paths[i] + 2);
    for (size_t i = 0; i < parts; i++)
        for (size_t k = part[i].first_copy; k < part[i].first_copy + part[i].copies; k++) {
            assert_true(copies[k].part > (int)i);
            assert_true((size_t)copies[k].primitive >= part[i].first &&
                        (size_t)copies[k].primitive < part[i].first + part[i].count);
        }
    assert_int_equal(primitives[part[3].first + 1].modifier, part[3].first);
    rad_scene_destroy(scene);
}

static void circles_are_refused(void **state) {
    (void)state;
    write_file("egg.rad", "void instance it 1 hen.oct 0 0\n");
    write_file("hen.rad", "void instance it 1 egg.oct 0 0\n");
    write_octree("egg.oct", "egg.rad");
    write_octree("hen.oct", "hen.rad");
    assert_refused("void instance x 1 egg.oct 0 0\n", NULL,
                   "hen.rad:1:1: instance it: \"egg.oct\" holds copies of itself");
    char name[32], text[64];
    for (int i = 0; i < 40; i++) {
        snprintf(name, sizeof name, "n%d.rad", i);
        snprintf(text, sizeof text, i < 39 ? "void instance it 1 n%d.oct 0 0\n" : "# %d\n", i + 1);
        write_file(name, text);
        char octree[32];
        snprintf(octree, sizeof octree, "n%d.oct", i);
        write_octree(octree, name);
    }
    assert_refused("void instance x 1 n0.oct 0 0\n", NULL, "nested more than 32 deep");
    messages m;
    rad_scene *scene;
    assert_int_equal(read_parts("void instance x 1 n10.oct 0 0\n", &scene, &m), GRAZE_OK);
    rad_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_a_mesh),
        cmocka_unit_test(reads_normals_of_all_directions),
        cmocka_unit_test(damaged_meshes_are_refused),
        cmocka_unit_test(survives_damage),
        cmocka_unit_test(parts_in_order),
        cmocka_unit_test(circles_are_refused),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
