/* xform done here: what the shell keeps, what arrays and directories do, and what is refused. That the numbers are the
 * program's own is xform_peer.c's matter. */
#include "support.h"

#include "rad/pipeline.h"

static rad_scene *read_text(const char *text) {
    write_file("scene.rad", text);
    return read_good("scene.rad");
}

static void assert_reals(const rad_primitive *p, const double *wanted, uint32_t count) {
    assert_int_equal(p->real_count, count);
    for (uint32_t i = 0; i < count; ++i)
        assert_true(fabs(p->reals[i] - wanted[i]) < 1e-15);
}

static void splits_pipelines(void **state) {
    (void)state;
    static const struct {
        const char *command, *front;
        int stages;
        const char *last_word;
    } cases[] = {
        {"xform -t 1 0 0 a.rad", NULL, 1, "a.rad"},
        {"  /usr/bin/xform\t-t 1 0 0   a.rad ", NULL, 1, "a.rad"},
        {"xform -n 'a  b' \"c d\"", NULL, 1, "c d"},
        {"xform a\\ b.rad", NULL, 1, "a b.rad"},
        {"xform \\\n-mx a.r\\\nad", NULL, 1, "a.rad"},
        {"xform ''", NULL, 1, ""},
        {"genbox a b 1 1 1 | xform -mx", "genbox a b 1 1 1 ", 1, "-mx"},
        {"cat a|xform -mx|xform -my", "cat a", 2, "-my"},
        {"xform a | xform -my", NULL, 2, "-my"},
        {"grep '|' a | xform -my", "grep '|' a ", 1, "-my"},
        {"grep \\| a < b | xform -my", "grep \\| a < b ", 1, "-my"},
        {"xform $a | xform -my", "xform $a ", 1, "-my"},
        {"cat $FILES | xform -my", "cat $FILES ", 1, "-my"},
        {"xform a | cat", "xform a | cat", 0, NULL},
        {"xforms a", "xforms a", 0, NULL},
        {"xform *.rad", "xform *.rad", 0, NULL},
        {"xform ~/a", "xform ~/a", 0, NULL},
        {"xform a > b", "xform a > b", 0, NULL},
        {"xform < b", "xform < b", 0, NULL},
        {"xform a # b", "xform a # b", 0, NULL},
        {"xform a; xform b", "xform a; xform b", 0, NULL},
        {"cat a; cat b | xform -mx", "cat a; cat b | xform -mx", 0, NULL},
        {"cat a || cat b | xform -mx", "cat a || cat b | xform -mx", 0, NULL},
        {"(cat a) | xform -mx", "(cat a) | xform -mx", 0, NULL},
        {"cat `ls` | xform -mx", "cat `ls` | xform -mx", 0, NULL},
        {"cat \"$(ls | head)\" | xform -mx", "cat \"$(ls | head)\" | xform -mx", 0, NULL},
        {"cat a >| xform", "cat a >| xform", 0, NULL},
        {"cat a # | xform", "cat a # | xform", 0, NULL},
        {"xform \"$a\"", "xform \"$a\"", 0, NULL},
        {"xform 'a", "xform 'a", 0, NULL},
        {"xform a\\", "xform a\\", 0, NULL},
        {"cat a | xform -f - b", "cat a ", 1, "b"},
        {"cat a | xform c | xform -f - b | xform -mx", "cat a | xform c ", 2, "-mx"},
        {"| xform", "| xform", 0, NULL},
        {"cat a | xform |", "cat a | xform |", 0, NULL},
        {"cat a\ncat b | xform", "cat a\ncat b | xform", 0, NULL},
        {"", "", 0, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        arena *memory = arena_create();
        rad_pipeline pipeline;
        assert_true(rad_pipeline_split(&pipeline, cases[i].command, memory));
        if (pipeline.stage_count != cases[i].stages)
            print_error("%s\n", cases[i].command);
        assert_int_equal(pipeline.stage_count, cases[i].stages);
        if (cases[i].front)
            assert_string_equal(pipeline.front, cases[i].front);
        else
            assert_null(pipeline.front);
        if (cases[i].stages) {
            const rad_stage *last = &pipeline.stages[cases[i].stages - 1];
            assert_string_equal(last->words[last->count - 1], cases[i].last_word);
        }
        arena_destroy(memory);
    }
}

/* No text may send the splitter out of bounds; and it hands on all of what it does not take. */
static void splits_anything(void **state) {
    (void)state;
    static const char *const pieces[] = {"xform ", " | ", "cat ", " ",    "'",           "\"",
                                         "\\",     "a",   "$a",   "\\\n", "| xform -mx", "#"};
    dice d = {7};
    int taken = 0;
    for (int round = 0; round < 20000; ++round) {
        char text[256] = "";
        for (int n = (int)(roll_bits(&d) % 12); n > 0; --n)
            strcat(text, pieces[roll_bits(&d) % (sizeof pieces / sizeof *pieces)]);
        char *exact = malloc(strlen(text) + 1); /* so that a sanitizer sees the end */
        assert_non_null(exact);
        strcpy(exact, text);
        arena *memory = arena_create();
        rad_pipeline pipeline;
        assert_true(rad_pipeline_split(&pipeline, exact, memory));
        if (pipeline.stage_count == 0)
            assert_string_equal(pipeline.front, text);
        else if (pipeline.front)
            assert_memory_equal(pipeline.front, text, strlen(pipeline.front));
        taken += pipeline.stage_count;
        arena_destroy(memory);
        free(exact);
    }
    assert_true(taken > 1000);
}

static void transforms_every_surface(void **state) {
    (void)state;
    write_file("all.rad", "void light l 0 0 3 1 1 1\n"
                          "l polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n"
                          "l sphere s 0 0 4 1 2 3 .5\n"
                          "l cone c 0 0 8 0 0 0 0 0 1 1 .5\n"
                          "l tube t 0 0 7 0 0 0 0 0 1 1\n"
                          "l ring r 0 0 8 0 0 1 0 0 1 .5 1\n"
                          "l source u 0 0 4 0 1 1 .5\n");
    rad_scene *scene = read_text("!xform -s 2 -rz 90 -t 10 0 0 -mx all.rad");
    assert_reals(primitive_at(scene, 1), (double[]){-8, 0, 0, -10, 2, 0, -10, 0, 0}, 9);
    assert_reals(primitive_at(scene, 2), (double[]){-6, 2, 6, 1}, 4);
    assert_reals(primitive_at(scene, 3), (double[]){-10, 0, 0, -10, 0, 2, 2, 1}, 8);
    assert_reals(primitive_at(scene, 4), (double[]){-10, 0, 0, -10, 0, 2, 2}, 7);
    assert_reals(primitive_at(scene, 5), (double[]){-10, 0, 2, 0, 0, 2, 1, 2}, 8);
    assert_reals(primitive_at(scene, 6), (double[]){2, 0, 2, .5}, 4);
    rad_scene_destroy(scene);
    scene = read_text("!xform -I all.rad");
    assert_reals(primitive_at(scene, 1), (double[]){0, 1, 0, 1, 0, 0, 0, 0, 0}, 9);
    assert_int_equal(primitive_at(scene, 2)->type, RAD_BUBBLE);
    assert_int_equal(primitive_at(scene, 3)->type, RAD_CUP);
    assert_int_equal(primitive_at(scene, 4)->type, RAD_CYLINDER);
    assert_reals(primitive_at(scene, 5), (double[]){0, 0, 1, 0, 0, -1, .5, 1}, 8);
    assert_reals(primitive_at(scene, 6), (double[]){0, 1, 1, .5}, 4);
    rad_scene_destroy(scene);
}

static void transforms_modifiers(void **state) {
    (void)state;
    write_file("all.rad", "void glow g 0 0 4 1 2 3 5\nvoid spotlight p 0 0 7 1 1 1 30 0 1 0\n"
                          "void metal2 m 6 1 0 0 . -rz 5 0 6 1 1 1 1 .1 .2\nvoid plastic q 0 0 5 1 1 1 1 .1\n");
    rad_scene *scene = read_text("!xform -n x -m y -rz 90 -s -2 all.rad");
    assert_reals(primitive_at(scene, 0), (double[]){1, 2, 3, 10}, 4);
    assert_reals(primitive_at(scene, 1), (double[]){1, 1, 1, 30, 2, 0, 0}, 7);
    const rad_primitive *metal = primitive_at(scene, 2);
    static const char *const strings[] = {"1", "0", "0", ".", "-rz", "5", "-i", "1", "-rz", "90", "-s", "-2"};
    assert_int_equal(metal->string_count, 12);
    for (int i = 0; i < 12; ++i)
        assert_string_equal(metal->strings[i], strings[i]);
    assert_string_equal(metal->id, "m");
    assert_int_equal(metal->modifier, RAD_VOID);
    rad_scene_destroy(scene);
}

static void makes_arrays(void **state) {
    (void)state;
    write_file("ball.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 0 0 0 1\n!echo l sphere t 0 0 4 0 0 1 1");
    rad_scene *scene = read_text("!xform -n r -a 3 -t 1 0 0 -a 2 -t 0 5 0 -i 1 -t .5 0 0 ball.rad");
    assert_int_equal(primitive_count(scene), 18);
    for (size_t i = 0; i < 6; ++i) {
        char id[16];
        snprintf(id, sizeof id, "r.%d.%d.s", (int)i / 2, (int)i % 2);
        assert_string_equal(primitive_at(scene, 3 * i + 1)->id, id);
        assert_int_equal(primitive_at(scene, 3 * i + 1)->modifier, (int)(3 * i));
        assert_reals(primitive_at(scene, 3 * i + 1), (double[]){(double)(i / 2) + .5, 5 * (double)(i % 2), 0, 1}, 4);
    }
    assert_string_equal(primitive_at(scene, 17)->id, "r.2.1.t");
    const place *where = primitive_at(scene, 17)->where;
    assert_string_equal(where->parent->file, "ball.rad");
    assert_string_equal(where->parent->parent->file, "!xform -n r -a 3 -t 1 0 0 -a 2 -t 0 5 0 -i 1 -t .5 0 0 ball.rad");
    assert_int_equal(where->parent->parent->line, 0);
    assert_string_equal(where->parent->parent->parent->file, "scene.rad");
    rad_scene_destroy(scene);
}

static void finds_files_from_files(void **state) {
    (void)state;
    assert_int_equal(system("mkdir -p one/two path"), 0);
    write_file("one/outer.rad", "!xform -t 1 0 0 two/inner.rad\n!cat two/inner.rad\n");
    write_file("one/two/inner.rad", "void light l 0 0 3 1 1 1\n!pwd | sed 's/.*/void light & 0 0 3 1 1 1/'\n");
    write_file("path/found.rad", "void light l 0 0 3 1 1 1\n!xform inner.rad\n");
    write_file("path/inner.rad", "void light l 0 0 3 1 1 1\n");
    rad_scene *scene = read_text("!xform one/outer.rad\n");
    assert_int_equal(primitive_count(scene), 4);
    const char *directory = primitive_at(scene, 1)->id;
    assert_string_equal(directory + strlen(directory) - 8, "/one/two");
    directory = primitive_at(scene, 3)->id;
    assert_string_equal(directory + strlen(directory) - 4, "/one");
    rad_scene_destroy(scene);

    setenv("RAYPATH", ":nowhere:path", 1);
    scene = read_text("!xform found.rad\n");
    assert_int_equal(primitive_count(scene), 2);
    rad_scene_destroy(scene);
    messages m;
    write_file("scene.rad", "!xform ./found.rad\n");
    assert_int_equal(read_bad("scene.rad", &m), GRAZE_INPUT_ERROR);
    assert_contains(m.text, "scene.rad:1:1: xform: cannot find file \"./found.rad\"");
    unsetenv("RAYPATH");
}

static void keeps_commands_where_they_are(void **state) {
    (void)state;
    assert_int_equal(system("mkdir -p part"), 0);
    write_file("part/f.rad", "!pwd | sed 's/.*/void light & 0 0 3 1 1 1/'\n");
    rad_scene *expanded = read_text("!xform part/f.rad\n"), *kept = read_text("!xform -c part/f.rad\n");
    const char *inner = primitive_at(expanded, 0)->id, *outer = primitive_at(kept, 0)->id;
    assert_int_equal(strlen(inner), strlen(outer) + 5);
    assert_memory_equal(inner, outer, strlen(outer));
    rad_scene_destroy(expanded);
    rad_scene_destroy(kept);
}

static void reads_argument_files(void **state) {
    (void)state;
    write_file("ball.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 0 0 0 1\n");
    write_file("lines", "# comment\n-t 1 0 0\n\n!xform -t 2 0 \\\n 0\n");
    rad_scene *scene = read_text("!xform -f lines ball.rad\n");
    assert_int_equal(primitive_count(scene), 4);
    assert_string_equal(primitive_at(scene, 1)->id, "i0.s");
    assert_string_equal(primitive_at(scene, 3)->id, "i1.s");
    assert_true(primitive_at(scene, 3)->reals[0] == 2);
    rad_scene_destroy(scene);
    write_file("names", "-m void\n");
    scene = read_text("!cat ball.rad | xform -f names -n r\n");
    assert_string_equal(primitive_at(scene, 1)->id, "r.0.s");
    rad_scene_destroy(scene);
    /* The same file again behind its own lines is no recursion. */
    scene = read_text("!xform -f lines -f lines ball.rad\n");
    assert_int_equal(primitive_count(scene), 8);
    assert_true(primitive_at(scene, 7)->reals[0] == 4);
    rad_scene_destroy(scene);
}

/* Where what is transformed comes on standard input, options may be the last words. */
static void options_need_nothing_behind_them(void **state) {
    (void)state;
    write_file("ball.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 0 0 0 1\n");
    rad_scene *scene =
        read_text("!cat ball.rad | xform -n a\n!cat ball.rad | xform -m void\n!cat ball.rad | xform -t 1 0 0 -i 3\n");
    assert_int_equal(primitive_count(scene), 6);
    assert_string_equal(primitive_at(scene, 1)->id, "a.s");
    assert_int_equal(primitive_at(scene, 3)->modifier, RAD_VOID);
    assert_true(primitive_at(scene, 5)->reals[0] == 1);
    rad_scene_destroy(scene);
}

static void refuses_bad_commands(void **state) {
    (void)state;
    write_file("ball.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 0 0 0 1\n");
    write_file("itself.rad", "!xform -t 1 0 0 itself.rad\n!xform -t 1 0 0 itself.rad\n");
    write_file("empty", "# nothing\n");
    write_file("again", "-t 1 0 0 -f ./again\n-t 2 0 0 -f again\n");
    write_file("first", "-f second\n");
    write_file("second", "-f first\n");
    write_file("wrong", "-t 1 0 0\n# no command\n-t 1 q 0\n");
    write_file("lost", "missing.rad\n");
    write_file("open", "-t 1 0 0\n-n \"a\n");
    assert_int_equal(system("printf -- '-t 1 0 0\\n-\\0n' >zero"), 0);
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"!xform -q ball.rad", "scene.rad:1:1: xform: command line error at '-q': there is no such transform"},
        {"!xform -t 1 2 ball.rad", "command line error at '-t'"},
        {"!xform -t nan 0 0 ball.rad", "command line error at '-t': three numbers"},
        {"!xform -s 0 ball.rad", "command line error at '-s': a number that is not 0"},
        {"!xform -rx ball.rad", "command line error at '-rx': an angle"},
        {"!xform -t 1 2 3 -n a ball.rad", "command line error at '-n': this belongs before"},
        {"!xform -t 1 2 3 -m a ball.rad", "command line error at '-m': this belongs before"},
        {"!xform -s 1e90 -s 1e90 ball.rad", "xform: transform out of range"},
        {"!xform -i 1000000000 -s 2 ball.rad", "xform: transform out of range"},
        {"!xform -a ball.rad", "missing count for -a option"},
        {"!xform -a 0 ball.rad", "missing count for -a option"},
        {"!xform -a -3 ball.rad", "missing count for -a option"},
        {"!xform -a 3.5 ball.rad", "missing count for -a option"},
        {"!xform -a 20000000000 ball.rad", "more than 10000000 instances"},
        {"!xform -a 10000001 -t 1 0 0 missing.rad", "more than 10000000 instances"},
        {"!xform -a 10000000 -t 1 0 0 missing.rad", "cannot find file \"missing.rad\""},
        {"!xform -a 1000000000 -t 1 0 0 missing.rad", "more than 10000000 instances"},
        {"!xform -a 4000 -t 1 0 0 -a 4000 -t 0 1 0 -i 1 missing.rad", "more than 10000000 instances"},
        {"!xform -f", "missing file for -f option"},
        {"!xform -f empty ball.rad", "empty argument file \"empty\""},
        {"!xform -f open ball.rad", "bad line in argument file: -n \"a"},
        {"!xform -f zero ball.rad", "xform: zero is no argument file"},
        {"!xform -f again ball.rad", "xform: argument file ./again names itself"},
        {"!xform -f first ball.rad", "xform: argument file first names itself"},
        {"!xform -f first ball.rad", "error: second:1:1: xform: argument file first names itself (from first:1:1, from "
                                     "scene.rad:1:1)"},
        {"!xform -f wrong ball.rad", "error: wrong:3:1: xform: command line error at '-t': three numbers are to follow "
                                     "(from scene.rad:1:1)"},
        {"!xform -a 2 -t 1 0 0 -f lost", "error: lost:1:1: xform: cannot find file \"missing.rad\": "},
        {"!echo '-f -' | xform -f - ball.rad", "xform: argument file standard input names itself"},
        {"!xform missing.rad", "cannot find file \"missing.rad\""},
        {"!xform itself.rad", "nested more than 64 deep"},
        {"!echo 'void light l 0 0 3' | xform", "ends before"},
        {"!exit 4 | xform", "failed with status 4"},
        {"!echo 'void glow g 0 0 4 1 1 1 1e300' | xform -s 1e90",
         "glow g: real argument 4 is out of range after xform"},
        {"!echo 'void dielectric g 0 0 5 -.5 1 1 1 1' | xform -s 3", "real argument 1 is out of range"},
        {"!echo 'none sphere s 0 0 4 0 0 0 1' | xform", "undefined modifier \"none\""},
        {"!echo 'void light l 0 0 3 1 1 1 l sphere s 0 0 4 0 0 0 1' | xform -m inherit", "only an alias can"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        messages m;
        write_file("scene.rad", cases[i].text);
        read_bad("scene.rad", &m);
        assert_contains(m.text, cases[i].message);
        assert_int_equal(m.errors, 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splits_pipelines),
        cmocka_unit_test(splits_anything),
        cmocka_unit_test(transforms_every_surface),
        cmocka_unit_test(transforms_modifiers),
        cmocka_unit_test(makes_arrays),
        cmocka_unit_test(finds_files_from_files),
        cmocka_unit_test(keeps_commands_where_they_are),
        cmocka_unit_test(reads_argument_files),
        cmocka_unit_test(options_need_nothing_behind_them),
        cmocka_unit_test(refuses_bad_commands),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
