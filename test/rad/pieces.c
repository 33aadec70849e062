/* Large texts read by several threads: the same primitives, places and messages as by one. */
#include "rad/support.h"

enum { BYTES = 3 << 20 };

/* Text that is hard to divide: lines that look like primitives within quotes and arguments, long primitives, commands,
 * comments. `errors`: some primitives are wrong. */
static void write_hard_text(const char *name, bool errors, uint64_t seed) {
    static const char *const statements[] = {
        "m sphere s%d 0 0 4 0 0 0 1\n",
        "m sphere\n\n  s%d 0 0\n4 0 0 0\n1 # no comment here\n",
        "  # void polygon it is not %d 0 0\n",
        "void colorfunc f%d 4 1 'a\nm sphere s 0 0 4 0 0 0 1\nm sphere s 0 0 4 0 0 0 1\n' 1 .\n0 0\n",
        "void antimatter a%d 13\nm sphere s 0 0 4 0 0 0 1\nm sphere m\n0 0\n",
        "!echo m sphere c%d 0 0 4 0 0 0 1\n",
        "m polygon p%d 0 0 9 \t0 0 0  1e-3 0 0 -.5 1 2 m sphere t 0 0 4 0 0 0 '1' void alias m m\n",
    };
    static const char *const wrong[] = {"m sphere w%d 0 0 3 0 0 0\n", "m sphere w%d 0 0 4 0 0 x 1\n",
                                        "none sphere w%d 0 0 4 0 0 0 1\n"};
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    dice d = {seed};
    fputs("\n \nvoid light m 0 0 3 1 1 1\n", out);
    for (int i = 0; ftell(out) < BYTES; i++) {
        int kind = roll_below(&d, 6000);
        if (errors && kind < 6)
            fprintf(out, wrong[kind % 3], i);
        else if (kind < 20)
            fprintf(out, statements[5], i);
        else if (kind < 22) {
            fprintf(out, "void antimatter long%d 90000\n", i);
            for (int k = 0; k < 15000; k++)
                fputs("m sphere s 0 0 4\n", out);
            fputs("0 0\n", out);
        } else
            fprintf(out, statements[kind % 5 == 4 ? 6 : kind % 5], i);
    }
    assert_int_equal(fclose(out), 0);
}

static graze_status read_by(int threads, const char *name, rad_scene **scene, messages *m) {
    graze_report report = messages_report(m);
    return rad_scene_read_by(threads, scene, &name, 1, &report);
}

static void assert_same_place(const place *a, const place *b) {
    for (; a && b; a = a->parent, b = b->parent) {
        assert_string_equal(a->file, b->file);
        assert_int_equal(a->line, b->line);
        assert_int_equal(a->column, b->column);
    }
    assert_true(!a && !b);
}

static void assert_same_scenes(const rad_scene *one, const rad_scene *other) {
    size_t count, other_count;
    const rad_primitive *a = rad_scene_primitives(one, &count), *b = rad_scene_primitives(other, &other_count);
    assert_int_equal(count, other_count);
    for (size_t i = 0; i < count; i++, a++, b++) {
        assert_int_equal(a->type, b->type);
        assert_int_equal(a->modifier, b->modifier);
        assert_string_equal(a->id, b->id);
        assert_int_equal(a->string_count, b->string_count);
        for (uint32_t k = 0; k < a->string_count; k++)
            assert_string_equal(a->strings[k], b->strings[k]);
        assert_int_equal(a->real_count, b->real_count);
        if (a->real_count)
            assert_memory_equal(a->reals, b->reals, a->real_count * sizeof *a->reals);
        assert_same_place(a->where, b->where);
    }
}

static void threads_change_nothing(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        write_hard_text("hard.rad", false, seed);
        messages m;
        rad_scene *alone, *together;
        graze_status status = read_by(1, "hard.rad", &alone, &m);
        assert_string_equal(m.text, "");
        assert_int_equal(status, GRAZE_OK);
        for (int threads = 2; threads <= 5; threads += 3) {
            assert_int_equal(read_by(threads, "hard.rad", &together, &m), GRAZE_OK);
            assert_same_scenes(alone, together);
            rad_scene_destroy(together);
        }
        assert_int_equal(read_by(3, "!xform -n x -t 1 0 0 hard.rad", &together, &m), GRAZE_OK);
        rad_scene *moved;
        assert_int_equal(read_by(1, "!xform -n x -t 1 0 0 hard.rad", &moved, &m), GRAZE_OK);
        assert_same_scenes(moved, together);
        rad_scene_destroy(moved);
        rad_scene_destroy(together);
        rad_scene_destroy(alone);
    }
}

static void messages_are_the_same(void **state) {
    (void)state;
    messages alone, together;
    rad_scene *scene;
    write_hard_text("wrong.rad", true, 4);
    assert_int_equal(read_by(1, "wrong.rad", &scene, &alone), GRAZE_INPUT_ERROR);
    assert_int_equal(alone.errors, 20);
    assert_int_equal(read_by(4, "wrong.rad", &scene, &together), GRAZE_INPUT_ERROR);
    assert_string_equal(alone.text, together.text);

    write_hard_text("cut.rad", false, 5);
    assert_int_equal(truncate("cut.rad", BYTES - 17), 0);
    assert_int_equal(read_by(1, "cut.rad", &scene, &alone), GRAZE_INPUT_ERROR);
    assert_int_equal(read_by(4, "cut.rad", &scene, &together), GRAZE_INPUT_ERROR);
    assert_string_equal(alone.text, together.text);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_change_nothing),
                                       cmocka_unit_test(messages_are_the_same)};
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
