/* Octrees: frozen, with names of files, damaged. */
#include "binary_writer.h"
#include "support.h"

#include "rad/octree.h"

static void write_binary(const char *name, const binary *b) {
    write_bytes(name, b->bytes, b->length);
}

/* Eight leaves: one full, seven empty. */
static void put_tree(binary *b, int object_size) {
    put_integer(b, 2, 1);
    put_integer(b, 1, 1);
    put_integer(b, 2, object_size);
    put_integer(b, 3, object_size);
    put_integer(b, 4, object_size);
    for (int i = 0; i < 7; i++)
        put_integer(b, 0, 1);
}

static void put_head(binary *b, int type, int64_t modifier, int object_size, const char *name, int strings) {
    put_integer(b, type, 1);
    put_integer(b, modifier, object_size);
    put_text(b, name);
    put_integer(b, strings, 2);
}

static void put_reals(binary *b, int count, const double *reals) {
    put_integer(b, count, 2);
    for (int i = 0; i < count; i++)
        put_real(b, reals[i]);
}

/* The types are in an order of the writer's own. */
static void put_scene(binary *b, int object_size) {
    const char *const types[] = {"sphere", "alias", "plastic", "instance", ""};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        put_text(b, types[i]);
    put_head(b, 2, -1, object_size, "gray", 0);
    put_reals(b, 5, (const double[]){.5, .25, .2, 0, 0});
    put_head(b, 1, 0, object_size, "same", 0);
    put_reals(b, 0, NULL);
    put_head(b, 1, -1, object_size, "other", 1);
    put_text(b, "same");
    put_reals(b, 0, NULL);
    put_head(b, 0, 1, object_size, "ball", 0);
    put_reals(b, 4, (const double[]){-1, 2e-3, 1e6, .7});
    put_head(b, 0, 2, object_size, "ball2", 0);
    put_reals(b, 4, (const double[]){0, 0, 0, 1});
    put_integer(b, 255, 1);
}

static binary frozen(int object_size, int promised) {
    binary b = {.length = 0};
    put_octree_head(&b, object_size);
    put_text(&b, "");
    put_integer(&b, promised, object_size);
    put_tree(&b, object_size);
    put_scene(&b, object_size);
    return b;
}

static bool is_octree(const char *text) {
    char copy[100];
    snprintf(copy, sizeof copy, "%s", text);
    return rad_octree_is(&(whole_file){copy, strlen(copy)});
}

static void knows_octrees(void **state) {
    (void)state;
    assert_true(rad_octree_is_named("a.oct") && rad_octree_is_named("a!.oct") && rad_octree_is_named("a/b.rad.oct"));
    assert_false(rad_octree_is_named("!oconv a.oct") || rad_octree_is_named(".oct") || rad_octree_is_named("a.octs") ||
                 rad_octree_is_named("aoct") || rad_octree_is_named(""));
    assert_true(is_octree("#?RADIANCE\noconv\nFORMAT= Radiance_octree\n\n"));
    assert_false(
        is_octree("#?RADIANCEX\nFORMAT=Radiance_octree\n\n") || is_octree("#?RADIANCE\n\nFORMAT=Radiance_octree\n\n") ||
        is_octree("#?RADIANCE\nFORMAT=Radiance_octrees\n\n") || is_octree("#?RADIANCE\nFORMAT=Radiance_octree\n"));
}

static void reads_a_frozen_octree(void **state) {
    (void)state;
    for (int size = 1; size <= 8; size++) {
        binary b = frozen(size, 5);
        write_binary("frozen.oct", &b);
        rad_scene *scene = read_good("frozen.oct");
        assert_int_equal(primitive_count(scene), 5);
        const rad_primitive *gray = primitive_at(scene, 0), *same = primitive_at(scene, 1);
        const rad_primitive *other = primitive_at(scene, 2), *ball = primitive_at(scene, 3);
        assert_int_equal(gray->type, RAD_PLASTIC);
        assert_int_equal(gray->modifier, RAD_VOID);
        assert_string_equal(gray->id, "gray");
        assert_true(gray->reals[0] == .5 && gray->reals[1] == .25 && gray->reals[3] == 0);
        assert_true(fabs(gray->reals[2] - .2) < 1e-9);
        assert_int_equal(same->type, RAD_PLASTIC);
        assert_string_equal(same->original_id, "gray");
        assert_int_equal(other->type, RAD_PLASTIC);
        assert_string_equal(other->id, "other");
        assert_int_equal(ball->type, RAD_SPHERE);
        assert_int_equal(ball->modifier, 1);
        assert_true(ball->reals[0] == -1 && fabs(ball->reals[1] - 2e-3) < 1e-12 && fabs(ball->reals[2] - 1e6) < 1e-3);
        assert_string_equal(ball->where->file, "frozen.oct");
        rad_scene_destroy(scene);
    }
}

static binary of_files(const char *const *names, int promised) {
    binary b = {.length = 0};
    put_octree_head(&b, 4);
    for (; *names; names++)
        put_text(&b, *names);
    put_text(&b, "");
    put_integer(&b, promised, 4);
    put_integer(&b, 0, 1);
    return b;
}

static void reads_the_files_of_an_octree(void **state) {
    (void)state;
    write_file("first.rad", "void plastic gray 0 0 5 .5 .5 .5 0 0\n");
    write_file("second.rad", "gray sphere b 0 0 4 0 0 0 1\n");
    const char *const names[] = {"first.rad", "!echo gray sphere a 0 0 4 0 0 0 1", "second.rad", NULL};
    binary b = of_files(names, 3);
    write_binary("files.oct", &b);
    rad_scene *scene = read_good("files.oct");
    assert_int_equal(primitive_count(scene), 3);
    assert_string_equal(primitive_at(scene, 1)->id, "a");
    assert_string_equal(primitive_at(scene, 2)->id, "b");
    assert_string_equal(primitive_at(scene, 2)->where->parent->file, "files.oct");
    rad_scene_destroy(scene);
}

/* As one argument among others. */
static void octrees_and_files_are_one_scene(void **state) {
    (void)state;
    binary b = frozen(4, 5);
    write_binary("frozen.oct", &b);
    write_file("more.rad", "same sphere more 0 0 4 0 0 0 1\n");
    const char *const names[] = {"frozen.oct", "more.rad"};
    messages m;
    graze_report report = messages_report(&m);
    rad_scene *scene;
    assert_int_equal(rad_scene_read(&scene, names, 2, &report), GRAZE_OK);
    assert_int_equal(primitive_count(scene), 6);
    assert_int_equal(primitive_at(scene, 5)->modifier, 1);
    rad_scene_destroy(scene);
}

static void says_when_an_octree_is_old(void **state) {
    (void)state;
    write_file("first.rad", "void plastic gray 0 0 5 .5 .5 .5 0 0\n");
    binary b = of_files((const char *const[]){"first.rad", NULL}, 7);
    write_binary("old.oct", &b);
    const char *name = "old.oct";
    messages m;
    graze_report report = messages_report(&m);
    rad_scene *scene;
    assert_int_equal(rad_scene_read(&scene, &name, 1, &report), GRAZE_OK);
    assert_int_equal(m.warnings, 1);
    assert_contains(m.text, "old.oct: octree: of 7 primitives, but its files now hold 1");
    rad_scene_destroy(scene);
}

static void assert_refused(const binary *b, const char *message) {
    messages m;
    write_binary("bad.oct", b);
    read_bad("bad.oct", &m);
    assert_contains(m.text, message);
}

static void tells_of_damage_with_its_place(void **state) {
    (void)state;
    binary whole = frozen(4, 5), b = whole;
    b.length -= 3;
    assert_refused(&b, "bad.oct: octree: the file ends too early (byte ");
    b = (binary){.length = 0};
    put_octree_head(&b, 9);
    assert_refused(&b, "bad.oct: octree: incompatible format (byte 55)");
    const char *const itself[] = {"bad.oct", NULL};
    b = of_files(itself, 1);
    assert_refused(&b, "nested more than");
    const char *const missing[] = {"nowhere.rad", NULL};
    b = of_files(missing, 1);
    assert_refused(&b, "nowhere.rad");

    b = (binary){.length = 0};
    put_octree_head(&b, 4);
    put_text(&b, "");
    put_integer(&b, 1, 4);
    binary start = b;
    put_integer(&b, 3, 1);
    assert_refused(&b, "damaged: a node of unknown kind 3");
    b = start;
    put_integer(&b, 1, 1);
    put_integer(&b, -5, 4);
    assert_refused(&b, "damaged: a leaf with -5 objects");
    b = start;
    put_integer(&b, 1, 1);
    put_integer(&b, 1000, 4);
    assert_refused(&b, "octree: the file ends too early (byte ");
    put_integer(&start, 0, 1);
    put_text(&start, "plastic");
    put_text(&start, "nonsense");
    put_text(&start, "");
    b = start;
    put_integer(&b, 2, 1);
    assert_refused(&b, "damaged: a primitive of unknown type 2");
    b = start;
    put_head(&b, 0, 0, 4, "gray", 0);
    assert_refused(&b, "damaged: a primitive whose modifier is number 0 of 0 before it");
    b = start;
    put_head(&b, 1, -1, 4, "gray", 0);
    put_reals(&b, 0, NULL);
    put_integer(&b, 255, 1);
    assert_refused(&b, "nonsense gray: unknown type \"nonsense\"");
    b = start;
    put_head(&b, 0, -1, 4, "gray", 0);
    put_reals(&b, 1, (const double[]){1});
    put_integer(&b, 255, 1);
    assert_refused(&b, "plastic gray: 1 real arguments, but it needs 5");
}

/* Cut anywhere, one that names files is refused, whatever it is called; one more byte is not. */
static void refuses_octrees_cut_short(void **state) {
    (void)state;
    write_file("first.rad", "void plastic gray 0 0 5 .5 .5 .5 0 0\n");
    binary whole = of_files((const char *const[]){"first.rad", NULL}, 1);
    messages m;
    for (size_t length = 0; length < whole.length; length++) {
        binary b = whole;
        b.length = length;
        write_binary("cut.oct", &b);
        assert_int_equal(read_bad("cut.oct", &m), GRAZE_INPUT_ERROR);
        if (length < 2)
            continue;
        write_binary("cut", &b);
        assert_int_equal(read_bad("cut", &m), GRAZE_INPUT_ERROR);
    }
    write_binary("cut.oct", &whole);
    rad_scene_destroy(read_good("cut.oct"));
}

/* Cut anywhere, an octree is refused or read in part; changed anywhere, it does no harm. */
static void survives_damage(void **state) {
    (void)state;
    binary whole = frozen(4, 5);
    dice d = {9};
    int refused = 0;
    const char *name = "bad.oct";
    for (size_t round = 0; round < 4 * whole.length; round++) {
        binary b = whole;
        if (round < whole.length)
            b.length = round;
        else
            for (uint64_t i = 0; i < 1 + roll_bits(&d) % 3; i++)
                b.bytes[54 + roll_bits(&d) % (b.length - 54)] = (char)roll_bits(&d);
        for (size_t i = 54; i < b.length; i++)
            if (b.bytes[i] == '!')
                b.bytes[i] = '?';
        write_binary(name, &b);
        messages m;
        graze_report report = messages_report(&m);
        rad_scene *scene;
        graze_status status = rad_scene_read(&scene, &name, 1, &report);
        assert_true((status == GRAZE_OK) == (scene != NULL) && (status == GRAZE_OK) == (m.errors == 0));
        refused += !scene;
        if (round >= 56 && round < whole.length)
            assert_null(scene);
        rad_scene_destroy(scene);
    }
    assert_true(refused > 200);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(knows_octrees),
        cmocka_unit_test(reads_a_frozen_octree),
        cmocka_unit_test(reads_the_files_of_an_octree),
        cmocka_unit_test(octrees_and_files_are_one_scene),
        cmocka_unit_test(says_when_an_octree_is_old),
        cmocka_unit_test(refuses_octrees_cut_short),
        cmocka_unit_test(tells_of_damage_with_its_place),
        cmocka_unit_test(survives_damage),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
