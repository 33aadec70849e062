/* Our xform against the program itself: the same commands, done here and by it, must give the same scenes. Needs
 * GRAZE_PEER_BIN, a directory with Radiance's programs; skipped where that is unset. */
#include "support.h"

static const char all_types[] = "void brightfunc pattern 2 dots dots.cal 0 2 1 .5\n"
                                "pattern plastic red 0 0 5 .7 .1 .1 .05 .1\n"
                                "void metal2 brushed 4 1 0 'x + y' . 0 6 .5 .5 .5 .9 .1 .2\n"
                                "void plastic2 turned 8 ux uy uz rot.cal -rz 10 -s 2 0 6 .5 .5 .5 .05 .1 .2\n"
                                "inherit alias also red\nvoid alias bare red\n"
                                "void glow lamp 0 0 4 10 10 8 2.5\n"
                                "void spotlight spot 0 0 7 10 10 10 30 0 1 -2\n"
                                "void dielectric water 0 0 5 .9 .8 .7 1.33 0\n"
                                "void interface surface 0 0 8 .9 .8 .7 1.5 .6 .5 .4 1.33\n"
                                "void mist fog 2 a.sun 'lamp>b' 0 7 .1 .2 .3 .9 .9 .9 .5\n"
                                "void brighttext label 2 helvet.fnt word 0 11 0 0 1 1 0 0 0 -1 0 .5 1\n"
                                "void BSDF glazing 6 0 pane.xml 0 0 1 . 0 0\n"
                                "red polygon face 0 0 12 0 0 0 1 0 0 1 1 .1 0 1 0\n"
                                "also sphere 'the ball' 0 0 4 1 2 3 .5\nbare bubble hollow 0 0 4 -1 2 3 .5\n"
                                "brushed cone c 0 0 8 0 0 0 1 2 3 .5 .25\nbrushed cup d 0 0 8 0 0 0 1 2 3 .5 0\n"
                                "turned cylinder e 0 0 7 0 0 0 1 2 3 .125\nturned tube f 0 0 7 0 0 0 1 2 3 .125\n"
                                "spot ring g 0 0 8 1 1 1 0 .6 -.8 0 .75\n"
                                "lamp source sun 0 0 4 1 2 5 .533\n"
                                "void instance tree 1 tree.oct 0 0\nred mesh statue 5 statue.rtm -t 1 0 0 0 0\n";

static const char *const commands[] = {
    "xform objects.rad",
    "xform -t 1 2 3 objects.rad",
    "xform -rx 30 objects.rad",
    "xform -ry -45.5 objects.rad",
    "xform -rz 1e2 objects.rad",
    "xform -rx 90 -ry 180 -rz 270 -rz -90 objects.rad",
    "xform -s 2.5 objects.rad",
    "xform -s -0.5 objects.rad",
    "xform -mx objects.rad",
    "xform -my -mz objects.rad",
    "xform -mx -my -mz -t .1 .2 .3 objects.rad",
    "xform -t 1 0 0 -rz 30 -s 2 -mx objects.rad",
    "xform -i 3 -t 1 0 0 -rz 10 -i 2 -s 1.5 objects.rad",
    "xform -i 0 -t 1 0 0 -i 1 -rz 10 objects.rad",
    "xform -I objects.rad",
    "xform -I -mx -t 1 1 1 objects.rad",
    "xform -I -I -my objects.rad",
    "xform -n room objects.rad",
    "xform -n a -n b -t 1 0 0 objects.rad",
    "xform -m bare -t 1 0 0 objects.rad",
    "xform -m bare -m void -n x -I objects.rad",
    "xform -a 3 -t 1 0 0 objects.rad",
    "xform -a 2 -t 1 0 0 -a 3 -rz 15 -i 1 -t 0 0 1 objects.rad",
    "xform -n row -a 2 -t 1 0 0 -rz 30 objects.rad",
    "xform -n row -n more -a 2 -t 1 0 0 objects.rad",
    "xform -rz 45 -a 2 -t 1 0 0 objects.rad objects.rad",
    "xform -f lines.txt objects.rad",
    "xform -n x -f lines.txt -a 2 -t 0 0 5 objects.rad",
    "xform -rz 10 sub/part.rad",
    "xform -n p -mz sub/part.rad sub/inner.rad",
    "xform -a 2 -t 10 0 0 sub/part.rad",
    "xform -c -n q -rz 10 top.rad",
    "xform -e -c -s 2 -a 2 -t 1 0 0 top.rad",
    "xform -c -e -rz 10 sub/part.rad",
    "xform -t 1 0 0 from-path.rad",
    "xform -t 1 0 0 ./objects.rad",
    "xform -t 1 0 0 sub/../objects.rad",
    "xform -t 1 0 0 $PWD/sub/part.rad",
    "xform -n 'a b' -t '1' \"0\" 0 sub/inner.rad",
    "xform -t 1 \\\n 0 0 objects.rad",
    "cat objects.rad | xform -t 1 2 3",
    "cat objects.rad | xform -rz 20 -a 2 -t 1 2 3",
    "cat objects.rad | xform -rz 20 | xform -n again -s 2 -mx",
    "xform -rz 20 objects.rad | xform -n again -s 2 -mx -a 2 -t 1 1 1",
    "cat objects.rad | grep -v '|' | sed 's/ball/bill/' | xform -I",
    "genbox red box 1 2 3 -r .1 | xform -rz 15 -t 1 1 1",
    "genbox red box 1 2 3 | xform -mx | xform -my",
    "echo '!xform -t 1 0 0 sub/inner.rad' | xform -rz 90",
    "xform -rz 20 < objects.rad",
    "cat lines.txt | xform -f - objects.rad",
    "cat lines.txt | xform -n x -f - -a 2 -t 0 0 5 objects.rad | xform -mx",
    "xform -f - objects.rad < lines.txt",
    "for i in 1 2; do cat objects.rad; done | xform -s 2",
    "xform -t 1 0 0 sub/part.rad; cat objects.rad | xform -s 3",
};

static void write_scene_files(void) {
    write_file("objects.rad", all_types);
    assert_int_equal(system("mkdir -p sub library"), 0);
    write_file("sub/part.rad", "!xform -t 0 0 1 inner.rad\n!cat inner.rad | xform -n piped -s 2\n!cat inner.rad\n"
                               "!xform -n deep -a 2 -t 5 0 0 ../sub/inner.rad\n!xform -rx 90 ../objects.rad\n");
    write_file("sub/inner.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 4 1 0 0 .25\n");
    write_file("top.rad", "!cat objects.rad\n!xform -n sub -t 1 2 3 sub/part.rad\n!cat sub/inner.rad | xform -mx\n");
    write_file("lines.txt", "# places\n-t 1 0 0 -rz 10\n\n!xform -n sub -t 0 2 0\n-mx -t 0 \\\n 0 1\n");
    write_file("library/sibling.rad", "l sphere q 0 0 4 0 0 0 1\n");
    write_file("library/from-path.rad",
               "void light l 0 0 3 1 1 1\nl polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n!xform -n deep sibling.rad\n");
}

/* How the program prints a primitive's numbers. */
static double precision_of(const rad_primitive *p) {
    return p->type == RAD_MIST || p->type == RAD_DIELECTRIC || p->type == RAD_INTERFACE ? 1e-5 : 2e-11;
}

static void assert_same_reals(const char *command, const rad_primitive *ours, const rad_primitive *theirs) {
    double largest = 1;
    for (uint32_t i = 0; i < theirs->real_count; ++i)
        largest = fmax(largest, fabs(theirs->reals[i]));
    for (uint32_t i = 0; i < theirs->real_count; ++i) {
        bool same = fabs(ours->reals[i] - theirs->reals[i]) <= precision_of(ours) * largest;
        if (!same)
            print_error("%s: %s %s: real %u is %.17g, not %.17g\n", command, rad_type_name(ours->type), ours->id, i,
                        ours->reals[i], theirs->reals[i]);
        assert_true(same);
    }
}

static void assert_same_scenes(const char *command, const rad_scene *ours, const rad_scene *theirs) {
    if (primitive_count(ours) != primitive_count(theirs))
        print_error("%s\n", command);
    assert_int_equal(primitive_count(ours), primitive_count(theirs));
    for (size_t i = 0; i < primitive_count(ours); ++i) {
        const rad_primitive *a = primitive_at(ours, i), *b = primitive_at(theirs, i);
        if (a->type != b->type || a->string_count != b->string_count || strcmp(a->id, b->id))
            print_error("%s: %s %s, not %s %s\n", command, rad_type_name(a->type), a->id, rad_type_name(b->type),
                        b->id);
        assert_int_equal(a->type, b->type);
        assert_int_equal(a->modifier, b->modifier);
        assert_string_equal(a->id, b->id);
        assert_int_equal(a->string_count, b->string_count);
        for (uint32_t k = 0; k < a->string_count; ++k)
            assert_string_equal(a->strings[k], b->strings[k]);
        assert_int_equal(a->real_count, b->real_count);
        assert_same_reals(command, a, b);
    }
}

static rad_scene *read_made_by(const char *command, const char *name) {
    messages m;
    graze_report report = messages_report(&m);
    rad_scene *scene;
    if (rad_scene_read(&scene, &name, 1, &report))
        print_error("%s: %s", command, m.text);
    assert_non_null(scene);
    return scene;
}

static void does_what_xform_does(void **state) {
    (void)state;
    const char *peer = getenv("GRAZE_PEER_BIN");
    static char path[4096];
    snprintf(path, sizeof path, "%s:%s", peer, getenv("PATH"));
    setenv("PATH", path, 1);
    setenv("RAYPATH", ":library", 1);
    write_scene_files();
    for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
        char theirs_text[4096];
        char ours_text[4096];
        snprintf(ours_text, sizeof ours_text, "%s\n!%s\n", all_types, commands[i]);
        write_file("ours.rad", ours_text);
        /* What -c has left unexpanded the last xform expands. */
        FILE *script = fopen("theirs.sh", "w");
        assert_non_null(script);
        fprintf(script, "{ %s\n} | xform -e\n", commands[i]);
        assert_int_equal(fclose(script), 0);
        snprintf(theirs_text, sizeof theirs_text, "%s\n!sh theirs.sh\n", all_types);
        write_file("theirs.rad", theirs_text);
        rad_scene *ours = read_made_by(commands[i], "ours.rad");
        rad_scene *theirs = read_made_by(commands[i], "theirs.rad");
        assert_same_scenes(commands[i], ours, theirs);
        rad_scene_destroy(ours);
        rad_scene_destroy(theirs);
    }
}

int main(void) {
    if (!getenv("GRAZE_PEER_BIN")) {
        puts("1..0 # SKIP GRAZE_PEER_BIN is not set");
        return 0;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(does_what_xform_does)};
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
