/* Scene files: syntax, links, commands, mistakes, and mutated text. */
#include "support.h"

static rad_scene *read_text(const char *text) {
    write_file("scene.rad", text);
    return read_good("scene.rad");
}

static void bad_text(const char *text, messages *m) {
    write_file("scene.rad", text);
    read_bad("scene.rad", m);
}

static void keeps_all_parts(void **state) {
    (void)state;
    rad_scene *scene = read_text("# a comment that is no statement: void plastic\n"
                                 "void plastic red 0 0 5 .7 1e-1 +.05 5.e-2 1.E+1\n"
                                 "\n  red sphere 'a ball'\n 0 0 4 -1 2 3 0.5 # a comment here\n"
                                 "void metal2 br\"ush\"ed\n4 1 \"0 1\" '' .\n0 6 .5 .5 .5 .9 .1 '.2'\n");
    assert_int_equal(primitive_count(scene), 3);
    const rad_primitive *red = primitive_at(scene, 0), *ball = primitive_at(scene, 1), *metal = primitive_at(scene, 2);
    assert_int_equal(red->type, RAD_PLASTIC);
    assert_int_equal(red->modifier, RAD_VOID);
    assert_string_equal(red->id, "red");
    assert_int_equal(red->real_count, 5);
    const double reals[5] = {.7, 1e-1, .05, 5e-2, 10};
    assert_memory_equal(red->reals, reals, sizeof reals);
    assert_int_equal(ball->type, RAD_SPHERE);
    assert_int_equal(ball->modifier, 0);
    assert_string_equal(ball->id, "a ball");
    assert_string_equal(ball->where->file, "scene.rad");
    assert_int_equal(ball->where->line, 4);
    assert_int_equal(ball->where->column, 3);
    assert_null(ball->where->parent);
    assert_string_equal(metal->id, "brushed");
    assert_int_equal(metal->string_count, 4);
    assert_string_equal(metal->strings[1], "0 1");
    assert_string_equal(metal->strings[2], "");
    assert_true(metal->reals[5] == .2);
    rad_scene_destroy(scene);
}

static void latest_modifier_wins(void **state) {
    (void)state;
    rad_scene *scene = read_text("void light a 0 0 3 1 1 1\na sphere s 0 0 4 0 0 0 1\n"
                                 "void light a 0 0 3 2 2 2\na sphere s 0 0 4 0 0 0 1\n"
                                 "void light s 0 0 3 3 3 3\ns sphere s 0 0 4 0 0 0 1\n");
    assert_int_equal(primitive_at(scene, 1)->modifier, 0);
    assert_int_equal(primitive_at(scene, 3)->modifier, 2);
    assert_int_equal(primitive_at(scene, 5)->modifier, 4);
    rad_scene_destroy(scene);
}

static void resolves_aliases(void **state) {
    (void)state;
    rad_scene *scene = read_text("void brightfunc dots 2 f dots.cal 0 0\n"
                                 "dots plastic base 0 0 5 1 1 1 0 0\n"
                                 "inherit alias same base\n"
                                 "void alias bare base\n"
                                 "dots alias dotted bare\n"
                                 "inherit alias chain dotted\n"
                                 "chain sphere s 0 0 4 0 0 0 1\n"
                                 "void metal base 0 0 5 1 1 1 0 0\n"
                                 "void alias late base\n");
    const int modifiers[] = {RAD_VOID, 0, 0, RAD_VOID, 0, 0, 5, RAD_VOID, RAD_VOID};
    const char *const ids[] = {"dots", "base", "same", "bare", "dotted", "chain", "s", "base", "late"};
    for (size_t i = 0; i < 9; ++i) {
        const rad_primitive *p = primitive_at(scene, i);
        assert_int_equal(p->modifier, modifiers[i]);
        assert_string_equal(p->id, ids[i]);
        if (i >= 2 && i <= 5) {
            assert_int_equal(p->type, RAD_PLASTIC);
            assert_int_equal(p->real_count, 5);
            assert_int_equal(p->where->line, (int)i + 1);
        }
    }
    assert_int_equal(primitive_at(scene, 8)->type, RAD_METAL);
    rad_scene_destroy(scene);
}

static void many_names(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    FILE *out = fopen("scene.rad", "w");
    assert_non_null(out);
    for (int i = 0; i < COUNT; ++i)
        fprintf(out, "void light m%d 0 0 3 1 1 1\n", i % 10000);
    for (int i = 0; i < COUNT; ++i)
        fprintf(out, "m%d sphere s 0 0 4 0 0 0 1\n", i % 10000);
    assert_int_equal(fclose(out), 0);
    rad_scene *scene = read_good("scene.rad");
    for (size_t i = 0; i < COUNT; ++i)
        assert_int_equal(primitive_at(scene, COUNT + i)->modifier, 10000 + (int)i % 10000);
    rad_scene_destroy(scene);
}

static void knows_every_type(void **state) {
    (void)state;
    for (int t = 0; t < RAD_TYPE_COUNT; ++t) {
        const char *name = rad_type_name((rad_type)t);
        char text[512];
        /* Far too few or too many arguments are told from an unknown type. */
        snprintf(text, sizeof text, "void %s x 0 0 0\nvoid nonsense y 0 0 0\n", name);
        messages m;
        bad_text(text, &m);
        assert_contains(m.text, "scene.rad:2:6: nonsense y: unknown type \"nonsense\"");
        assert_null(strstr(m.text, "scene.rad:1:6"));
    }
    assert_true(rad_type_is_surface(RAD_SOURCE) && rad_type_is_surface(RAD_INSTANCE));
    assert_false(rad_type_is_surface(RAD_LIGHT));
}

/* The counts as they stand in Radiance's manual, not as in the table under test. */
static void checks_argument_counts(void **state) {
    (void)state;
    static const struct {
        const char *type;
        int strings, reals;
        bool good;
    } cases[] = {
        {"source", 0, 4, true},      {"source", 0, 3, false},    {"sphere", 0, 4, true},     {"sphere", 0, 5, false},
        {"bubble", 0, 4, true},      {"polygon", 0, 9, true},    {"polygon", 0, 6, false},   {"polygon", 0, 10, false},
        {"polygon", 0, 12, true},    {"cone", 0, 8, true},       {"cone", 0, 7, false},      {"cup", 0, 8, true},
        {"cylinder", 0, 7, true},    {"cylinder", 0, 8, false},  {"tube", 0, 7, true},       {"ring", 0, 8, true},
        {"ring", 0, 7, false},       {"mesh", 1, 0, true},       {"mesh", 0, 0, false},      {"instance", 1, 0, true},
        {"light", 0, 3, true},       {"light", 0, 4, false},     {"glow", 0, 4, true},       {"glow", 0, 3, false},
        {"spotlight", 0, 7, true},   {"spotlight", 0, 3, false}, {"illum", 1, 3, true},      {"illum", 0, 4, false},
        {"plastic", 0, 5, true},     {"plastic", 0, 4, false},   {"metal", 0, 5, true},      {"metal", 0, 7, false},
        {"trans", 0, 7, true},       {"trans", 0, 5, false},     {"plastic2", 4, 6, true},   {"plastic2", 3, 6, false},
        {"plastic2", 4, 5, false},   {"metal2", 6, 6, true},     {"metal2", 4, 7, false},    {"trans2", 4, 8, true},
        {"trans2", 4, 6, false},     {"ashik2", 4, 8, true},     {"glass", 0, 3, true},      {"glass", 0, 4, true},
        {"glass", 0, 5, false},      {"dielectric", 0, 5, true}, {"interface", 0, 8, true},  {"interface", 0, 5, false},
        {"mirror", 0, 3, true},      {"mirror", 1, 4, false},    {"mist", 0, 0, true},       {"mist", 0, 8, false},
        {"BSDF", 6, 0, true},        {"BSDF", 6, 4, false},      {"BSDF", 5, 0, false},      {"aBSDF", 5, 9, true},
        {"WGMDfunc", 13, 9, true},   {"WGMDfunc", 12, 9, false}, {"WGMDfunc", 13, 8, false}, {"brightfunc", 2, 0, true},
        {"brightfunc", 1, 0, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[512];
        int length = snprintf(text, sizeof text, "void %s x\n%d", cases[i].type, cases[i].strings);
        for (int k = 0; k < cases[i].strings; ++k)
            length += snprintf(text + length, sizeof text - (size_t)length, " s");
        length += snprintf(text + length, sizeof text - (size_t)length, "\n0\n%d", cases[i].reals);
        for (int k = 0; k < cases[i].reals; ++k)
            length += snprintf(text + length, sizeof text - (size_t)length, " 1");
        snprintf(text + length, sizeof text - (size_t)length, "\nvoid light after 0 0 3 1 1 1\n");
        if (cases[i].good) {
            rad_scene *scene = read_text(text);
            assert_int_equal(primitive_count(scene), 2);
            rad_scene_destroy(scene);
        } else {
            messages m;
            bad_text(text, &m);
            assert_int_equal(m.errors, 1);
            assert_contains(m.text, "scene.rad:1:1: ");
            assert_contains(m.text, " x: ");
            assert_contains(m.text, "arguments, but it needs");
        }
    }
}

static void reports_errors_with_places(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"\n none sphere s 0 0 4 0 0 0 1", "error: scene.rad:2:2: sphere s: undefined modifier \"none\"\n"},
        {"void sphere a 0 0 4 0 0 0 1\na sphere b 0 0 4 0 0 0 1",
         "scene.rad:2:1: sphere b: modifier \"a\" is a surface (a sphere)"},
        {"void alias a b", "scene.rad:1:1: alias a: undefined alias target \"b\""},
        {"void sphere a 0 0 4 0 0 0 1\nvoid alias b a", "scene.rad:2:1: alias b: alias target \"a\" is a surface"},
        {"inherit sphere a 0 0 4 0 0 0 1", "sphere a: only an alias can have the modifier \"inherit\""},
        {"void light void 0 0 3 1 1 1", "scene.rad:1:12: \"void\" cannot be the name of a modifier"},
        {"void light inherit 0 0 3 1 1 1", "\"inherit\" cannot be the name of a modifier"},
        {"void light 'a\tb' 0 0 3 1 1 1", "scene.rad:1:12: illegal tab or other control character in name \"a?b\""},
        {"'vo\tid' light a 0 0 3 1 1 1", "scene.rad:1:1: light a: undefined modifier \"vo?id\""},
        {"void light a -1 0 3 1 1 1", "scene.rad:1:14: light a: \"-1\" is not a number of string arguments"},
        {"void light a 0 0 3.5 1 1 1", "scene.rad:1:18: light a: \"3.5\" is not a number of real arguments"},
        {"void light a 0 2 7 8 3 1 1 1", "scene.rad:1:1: light a: 2 integer arguments where there must be none"},
        {"void light a 0 0 3 1 x 1", "scene.rad:1:22: light a: \"x\" is not a number"},
        {"void light a 0 0 3 1 1. .", "scene.rad:1:25: light a: \".\" is not a number"},
        {"void light a 0 0 3 1 0x1 1", "\"0x1\" is not a number"},
        {"void light a 0 0 3 1 nan 1", "\"nan\" is not a number"},
        {"void light a 0 0 3 1 1e999 1", "\"1e999\" is not a number"},
        {"void light a 0 0 3 1 1e 1", "\"1e\" is not a number"},
        {"void light a 0 0 999999999 1 1", "scene.rad:1:1: light a: the text ends before its last real argument"},
        {"void light a 999999999 1 1", "scene.rad:1:1: light a: the text ends before its last string argument"},
        {"void light a 0 0 00000000000000000000000000000003 1 1 1",
         "\"00000000000000000000000000000003\" is too long for a number of real arguments"},
        {"void light a 0 0 999999999999 1 1", "\"999999999999\" is not a number of real arguments"},
        {"void light a 999999999999 1 1", "\"999999999999\" is not a number of string arguments"},
        {"void", "scene.rad:1:1: the text ends before the primitive's type"},
        {"void light", "ends before the primitive's name"},
        {"void light a", "light a: the text ends before its number of string arguments"},
        {"void light 'a 0 0 3 1 1 1", "scene.rad:1:12: quote without end"},
        {"void light a 'b 0 0 3 1 1 1", "scene.rad:1:14: light a: quote without end"},
        {"void \033[31mlight a 0 0 0", "?[31mlight a: unknown type \"?[31mlight\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        messages m;
        bad_text(cases[i].text, &m);
        assert_contains(m.text, cases[i].message);
        assert_int_equal(m.errors, 1);
    }
}

static void goes_on_after_errors(void **state) {
    (void)state;
    messages m;
    bad_text("a sphere s 0 0 4 0 0 0 1\n"
             "void wood w 2 x y 0 1 .5\n"
             "w sphere s 0 0 4 0 0 0 1\n" /* w is known, if not as what: no second message */
             "void light l 0 0 3 1 x y\n"
             "l sphere s 0 0 3 0 0 0\n",
             &m);
    assert_int_equal(m.errors, 4);
    assert_contains(m.text, "scene.rad:1:1: ");
    assert_contains(m.text, "scene.rad:2:6: ");
    assert_contains(m.text, "scene.rad:4:22: ");
    assert_contains(m.text, "scene.rad:5:1: ");
}

static void stops_after_twenty_errors(void **state) {
    (void)state;
    FILE *out = fopen("scene.rad", "w");
    assert_non_null(out);
    for (int i = 0; i < 1000; ++i)
        fprintf(out, "none%d sphere s 0 0 4 0 0 0 1\n", i);
    assert_int_equal(fclose(out), 0);
    messages m;
    read_bad("scene.rad", &m);
    assert_int_equal(m.errors, 20);
}

static void rejects_what_is_no_text(void **state) {
    (void)state;
    static const char *const texts[] = {
        "void light\0 a 0 0 3 1 1 1",  "\0", "void light a 0 0 3 1\0 1 1", "!echo \0 a", "'v\0'",
        "void light a 0 0 3 '1\0' 1 1"};
    static const size_t lengths[] = {26, 1, 25, 9, 4, 27};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        write_bytes("scene.rad", texts[i], lengths[i]);
        messages m;
        read_bad("scene.rad", &m);
        assert_int_equal(m.errors, 1);
        assert_contains(m.text, "bytes of value zero");
    }
}

static void names_of_no_scenes_are_input_errors(void **state) {
    (void)state;
    messages m;
    assert_int_equal(read_bad("missing.rad", &m), GRAZE_INPUT_ERROR);
    assert_contains(m.text, "missing.rad");
    assert_int_equal(read_bad(".", &m), GRAZE_INPUT_ERROR);
}

static void warns_of_nothing(void **state) {
    (void)state;
    write_file("scene.rad", "# nothing\n");
    const char *names[] = {"scene.rad"};
    messages m;
    graze_report report = messages_report(&m);
    rad_scene *scene;
    assert_int_equal(rad_scene_read(&scene, names, 1, &report), GRAZE_OK);
    assert_int_equal(primitive_count(scene), 0);
    assert_string_equal(m.text, "warning: scene.rad: no primitives\n");
    rad_scene_destroy(scene);
}

static void several_files_are_one_scene(void **state) {
    (void)state;
    write_file("materials.rad", "void light m 0 0 3 1 1 1");
    write_file("surfaces.rad", "m sphere s 0 0 4 0 0 0 1");
    const char *names[] = {"materials.rad", "surfaces.rad", "!echo m sphere t 0 0 4 0 0 0 1"};
    messages m;
    graze_report report = messages_report(&m);
    rad_scene *scene;
    assert_int_equal(rad_scene_read(&scene, names, 3, &report), GRAZE_OK);
    assert_int_equal(primitive_count(scene), 3);
    assert_int_equal(primitive_at(scene, 2)->modifier, 0);
    assert_int_equal(m.errors + m.warnings, 0);
    rad_scene_destroy(scene);
    assert_int_equal(rad_scene_read(&scene, names + 1, 1, NULL), GRAZE_INPUT_ERROR);
}

static void runs_commands(void **state) {
    (void)state;
    rad_scene *scene = read_text("void light m 0 0 3 1 1 1\n"
                                 "  !echo 'm sphere s 0 0 4' \\\n0 0 0 1; \\\r\necho '!echo m sphere t 0 0 4 0 0 0 1'\n"
                                 "!cat # must not wait for our standard input\n"
                                 "m sphere last 0 0 4 0 0 0 1\n");
    assert_int_equal(primitive_count(scene), 4);
    const rad_primitive *t = primitive_at(scene, 2);
    assert_string_equal(t->id, "t");
    assert_int_equal(t->where->line, 1);
    assert_string_equal(t->where->file, "!echo m sphere t 0 0 4 0 0 0 1");
    assert_int_equal(t->where->parent->line, 2);
    assert_int_equal(t->where->parent->column, 1);
    assert_string_equal(t->where->parent->parent->file, "scene.rad");
    assert_int_equal(t->where->parent->parent->line, 2);
    assert_int_equal(t->where->parent->parent->column, 3);
    assert_int_equal(primitive_at(scene, 3)->where->line, 6);
    rad_scene_destroy(scene);
}

static void failing_commands_are_errors(void **state) {
    (void)state;
    messages m;
    bad_text("\n!echo void light m 0 0 3 1 1 1; exit 3\n", &m);
    assert_contains(m.text, "scene.rad:2:1: command \"echo void light m 0 0 3 1 1 1; exit 3\" failed with status 3");
    bad_text("!kill -9 $$\n", &m);
    assert_contains(m.text, "was ended by signal 9");
    bad_text("!no-such-command-anywhere 2>/dev/null\n", &m);
    assert_contains(m.text, "failed with status 127");
    bad_text("!echo a b c 0 0 0\n", &m);
    assert_contains(m.text, "error: `!echo a b c 0 0 0`:1:3: b c: unknown type \"b\" (from scene.rad:1:1)");
    bad_text("!echo a b\n", &m);
    assert_contains(m.text, "error: `!echo a b`:1:3: unknown type \"b\" (from scene.rad:1:1)");
    assert_contains(m.text, "`!echo a b`:1:1: the text ends before the primitive's name");
}

static void recursion_is_bounded(void **state) {
    (void)state;
    messages m;
    static const char *const texts[] = {"!cat scene.rad\n", "!xform -t 1 0 0 scene.rad\n",
                                        "\n!cat scene.rad | xform -n a\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        bad_text(texts[i], &m);
        assert_contains(m.text, "scene.rad");
        assert_contains(m.text, ": brings in itself: files and commands are nested more than 64 deep (from ");
        assert_contains(m.text, " more ..., from ");
        assert_int_equal(m.errors, 1);
        assert_true(m.length < 600);
    }
}

static void tells_the_commands_on_the_way(void **state) {
    (void)state;
    messages m;
    write_file("part.rad", "void light l 0 0 3 1 1 1\nl sphere s 0 0 3 0 0 0\n");
    write_file("parts.rad", "\n  !cat part.rad\n");
    bad_text("!xform -n a parts.rad", &m);
    assert_string_equal(m.text, "error: `!cat part.rad`:2:1: sphere s: 3 real arguments, but it needs 4 (from "
                                "parts.rad:2:3, from `!xform -n a parts.rad`, from scene.rad:1:1)\n");
    bad_text("!cat part.rad | xform -n a", &m);
    assert_contains(m.text,
                    "error: `!cat part.rad`:2:1: sphere s: 3 real arguments, but it needs 4 (from scene.rad:1:1)");
}

static void warns_of_what_means_nothing(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"void sphere s 1 a 0 4 0 0 0 1",
         "warning: scene.rad:1:1: sphere s: string argument 1, \"a\", has no meaning\n"},
        {"void light l 0 0 3 1 1 1 void plastic p 2 a b 0 5 1 1 1 0 0",
         "warning: scene.rad:1:26: plastic p: string argument 1, \"a\", has no meaning\n"},
        {"void illum i 1 void 0 3 1 1 1", ""},
        {"void mirror i 2 void x 0 3 1 1 1",
         "warning: scene.rad:1:1: mirror i: string argument 2, \"x\", has no meaning\n"},
        {"void mist i 3 a b c 0 0", ""},
        {"void instance i 1 a.oct 0 1 5", "warning: scene.rad:1:1: instance i: real arguments have no meaning\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_file("scene.rad", cases[i].text);
        const char *name = "scene.rad";
        messages m;
        graze_report report = messages_report(&m);
        rad_scene *scene;
        assert_int_equal(rad_scene_read(&scene, &name, 1, &report), GRAZE_OK);
        assert_string_equal(m.text, cases[i].message);
        rad_scene_destroy(scene);
    }
}

static void messages_of_primitives(void **state) {
    (void)state;
    rad_scene *scene = read_text("void light m 0 0 3 1 1 1\n  m sphere s 0 0 4 0 0 0 1");
    messages m;
    graze_report report = messages_report(&m);
    assert_int_equal(rad_primitive_error(&report, primitive_at(scene, 1), "%s %d", "no", 5), GRAZE_INPUT_ERROR);
    rad_primitive_warning(&report, primitive_at(scene, 0), "hm");
    assert_string_equal(m.text, "error: scene.rad:2:3: sphere s: no 5\nwarning: scene.rad:1:1: light m: hm\n");
    rad_scene_destroy(scene);
}

static void numbers_round_correctly(void **state) {
    (void)state;
    dice d = {0x9e3779b97f4a7c15u};
    for (int block = 0; block < 40; ++block) {
        enum { COUNT = 500 };
        static char text[COUNT * 48 + 100];
        static char words[COUNT][48];
        size_t length = (size_t)sprintf(text, "void plasfunc x 2 a b 0 %d", COUNT);
        for (int i = 0; i < COUNT; ++i) {
            /* Digits, a point somewhere or nowhere, an exponent often small: all paths of the conversion. */
            uint64_t bits = roll_bits(&d);
            int digits = 1 + (int)(bits % 24), point = (int)(bits >> 8 & 31), range = (bits >> 16 & 1) ? 30 : 330;
            char *w = words[i];
            if (bits >> 20 & 1)
                *w++ = '-';
            for (int k = 0; k < digits; ++k) {
                if (k == point)
                    *w++ = '.';
                *w++ = (char)('0' + roll_bits(&d) % 10);
            }
            *w = 0;
            if (bits >> 24 & 1)
                sprintf(w, "e%d", (int)(bits >> 32) % range - digits);
            if (isinf(strtod(words[i], NULL)))
                strcpy(words[i], "9007199254740993");
            length += (size_t)sprintf(text + length, " %s", words[i]);
        }
        rad_scene *scene = read_text(text);
        const rad_primitive *p = primitive_at(scene, 0);
        for (int i = 0; i < COUNT; ++i) {
            double wanted = strtod(words[i], NULL);
            if (memcmp(&p->reals[i], &wanted, sizeof wanted))
                print_error("%s: %.17g instead of %.17g\n", words[i], p->reals[i], wanted);
            assert_memory_equal(&p->reals[i], &wanted, sizeof wanted);
        }
        rad_scene_destroy(scene);
    }
}

/* No input may crash, hang, leak, or pass without either a scene or a message. */
static void survives_mutations(void **state) {
    (void)state;
    static const char good[] =
        "# header\nvoid plastic2 p 4 1 0 0 . 0 6 .5 .5 .5 .9 .1 '.2'\nvoid light 'l m' 0 0 3 1 1 1\n"
        "inherit alias q p\nq polygon f 0 0 9 0 0 0 1e0 0 0 1 1 -0.5\n\"l m\" sphere s 0 0 4 0 0 0 1\n";
    static const char *const pieces[] = {
        "\"", "'",  " 999999999999 ", "\\\n", "#",      "void", "alias", "-", "e", ".", "\r",
        "\n", "\t", "inherit",        " 0 ",  "polygon"};
    dice d = {1};
    int read = 0, refused = 0;
    for (int round = 0; round < 3000; ++round) {
        char text[sizeof good + 200];
        size_t length = sizeof good - 1;
        memcpy(text, good, length);
        for (int change = 1 + (int)(roll_bits(&d) % 3); change > 0; --change) {
            size_t at = roll_bits(&d) % length;
            const char *piece = pieces[roll_bits(&d) % (sizeof pieces / sizeof *pieces)];
            switch (roll_bits(&d) % 4) {
            case 0:
                text[at] = (char)roll_bits(&d);
                break;
            case 1:
                length = at + 1;
                break;
            case 2:
                memmove(text + at, text + at + 1, length - at - 1);
                length -= length > 1;
                break;
            default:
                memmove(text + at + strlen(piece), text + at, length - at);
                memcpy(text + at, piece, strlen(piece));
                length += strlen(piece);
            }
        }
        for (size_t i = 0; i < length; ++i) /* a chance command could do anything */
            if (text[i] == '!')
                text[i] = '?';
        write_bytes("scene.rad", text, length);
        const char *name = "scene.rad";
        messages m;
        graze_report report = messages_report(&m);
        rad_scene *scene;
        graze_status status = rad_scene_read(&scene, &name, 1, &report);
        assert_true((status == GRAZE_OK) == (scene != NULL) && (status == GRAZE_OK) == (m.errors == 0));
        assert_true(m.errors <= 20);
        ++*(scene ? &read : &refused);
        rad_scene_destroy(scene);
    }
    assert_true(read > 100 && refused > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_all_parts),
        cmocka_unit_test(latest_modifier_wins),
        cmocka_unit_test(resolves_aliases),
        cmocka_unit_test(many_names),
        cmocka_unit_test(knows_every_type),
        cmocka_unit_test(checks_argument_counts),
        cmocka_unit_test(reports_errors_with_places),
        cmocka_unit_test(goes_on_after_errors),
        cmocka_unit_test(stops_after_twenty_errors),
        cmocka_unit_test(rejects_what_is_no_text),
        cmocka_unit_test(names_of_no_scenes_are_input_errors),
        cmocka_unit_test(warns_of_nothing),
        cmocka_unit_test(several_files_are_one_scene),
        cmocka_unit_test(runs_commands),
        cmocka_unit_test(failing_commands_are_errors),
        cmocka_unit_test(recursion_is_bounded),
        cmocka_unit_test(tells_the_commands_on_the_way),
        cmocka_unit_test(warns_of_what_means_nothing),
        cmocka_unit_test(messages_of_primitives),
        cmocka_unit_test(numbers_round_correctly),
        cmocka_unit_test(survives_mutations),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
