/* What names mean: contexts, constants, order; function files. */
#include <stdio.h>
#include <unistd.h>

#include "cal/support.h"

static void later_definitions_win_but_constants_stay(void **state) {
    (void)state;
    assert_value(answer_of("a = 1; b = a+1; a = 5;", "a+10*b", 0, 0, 0), 65);
    assert_value(answer_of("A : 1; b = A+1; A : 5;", "A+10*b", 0, 0, 0), 25);
    assert_value(answer_of("A : 1; f(x) : x+A; A : 5;", "f($1)", 1, 0, 0), 2);
    assert_value(answer_of("f(x) = A*x; A : 5;", "f($1)", 2, 0, 0), 10);
}

static void definitions_that_change_are_told(void **state) {
    (void)state;
    static const struct {
        const char *text, *warning;
    } cases[] = {
        {"a = 1; a = 1;", NULL},
        {"f(x) = x+1; f(y) = y+1;", NULL},
        {"a = 1;\na = 2;", "test.cal:2:1: 'a' is defined again, other than in line 1 of test.cal"},
        {"a : 1; a = 1;", "keeps that constant"},
        {"f(x) = x+1; f(x) = x+2;", "'f' is defined again"},
        {"sin(x) = x;", "this 'sin' hides the library's function"},
        {"sin = 3;", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        captured c;
        captured_begin(&c);
        cal_program_destroy(program_of(cases[i].text, &c));
        assert_int_equal(c.errors, 0);
        assert_int_equal(c.warnings, cases[i].warning != NULL);
        if (cases[i].warning)
            assert_in(c.text, cases[i].warning);
    }
}

typedef struct files {
    const char *directory;
    char path[256];
    int asked;
} files;

static bool find_file(void *user, const char *name, const char **path) {
    files *f = user;
    f->asked++;
    snprintf(f->path, sizeof f->path, "%s/%s", f->directory, name);
    *path = access(f->path, R_OK) == 0 ? f->path : NULL;
    return true;
}

static void write_file(const char *directory, const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    assert_true(fputs(text, out) >= 0);
    assert_int_equal(fclose(out), 0);
}

static double value_in(cal_program *program, const char *file, const char *expression) {
    captured c;
    captured_begin(&c);
    cal_code *code = compile_expression(program, file, expression, 0, &c);
    if (!code)
        print_error("%s\n", c.text);
    assert_non_null(code);
    answer a = run_code(code, NULL);
    if (a.outcome == CAL_FAILED)
        print_error("%s\n", a.failure);
    assert_int_equal(a.outcome, CAL_FINE);
    cal_code_destroy(code);
    return a.value;
}

static void files_are_contexts_and_read_once(void **state) {
    (void)state;
    char directory[] = "/tmp/graze-cal-XXXXXX", command[64];
    assert_non_null(mkdtemp(directory));
    write_file(directory, "one.cal", "x = 1; two = outer*2; outer = 100; late = outer; all = outer`; own = `x;");
    write_file(directory, "a-b.CAL", "x = 2; s = sin`(0)+cos(0); three = x+x`one; undefined = `outer;");
    write_file(directory, "bad.cal", "x = 2;\ny = (;\n");
    files f = {.directory = directory};
    const cal_finder finder = {find_file, &f};
    captured c;
    captured_begin(&c);
    cal_program *program = program_of("outer = 10; x = 7;", &c);
    const place where = {.file = "scene.rad", .line = 4};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(cal_program_use_file(program, "one.cal", &finder, &where, &c.report), GRAZE_OK);
        assert_int_equal(cal_program_use_file(program, "a-b.CAL", &finder, &where, &c.report), GRAZE_OK);
        assert_int_equal(cal_program_use_file(program, ".", &finder, &where, &c.report), GRAZE_OK);
    }
    assert_int_equal(f.asked, 2);
    assert_true(value_in(program, NULL, "x") == 7);
    assert_true(value_in(program, ".", "x") == 7);
    assert_true(value_in(program, "one.cal", "x") == 1);
    assert_true(value_in(program, "one", "x`+10*`x") == 17);
    assert_true(value_in(program, "one.cal", "two") == 20);
    assert_true(value_in(program, "one.cal", "late+all*1000+own*1e6") == 1010100);
    assert_true(value_in(program, "a-b.cal", "x") == 2);
    assert_true(value_in(program, "a-b.cal", "three") == 3);
    assert_true(value_in(program, "a-b.cal", "s") == 1);
    assert_true(value_in(program, NULL, "x`one+x`a_b") == 3);

    captured_begin(&c);
    assert_int_equal(cal_program_use_file(program, "none.cal", &finder, &where, &c.report), GRAZE_INPUT_ERROR);
    assert_in(c.text, "scene.rad:4: there is no function file none.cal along RAYPATH");
    for (int i = 0; i < 2; i++) {
        assert_int_equal(cal_program_use_file(program, "bad.cal", &finder, &where, &c.report), GRAZE_INPUT_ERROR);
        assert_in(c.text, "bad.cal:2:6: unexpected character (from scene.rad:4)");
        assert_int_equal(c.errors, 2);
    }
    cal_program_destroy(program);
    snprintf(command, sizeof command, "rm -r %s", directory);
    assert_int_equal(system(command), 0);
}

static void scenes_have_their_names(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    cal_program *program = cal_program_create();
    assert_int_equal(cal_program_add_scene_names(program, &c.report), GRAZE_OK);
    assert_int_equal(c.warnings, 0);
    double channels[CAL_SCENE_CHANNELS];
    for (int i = 0; i < CAL_SCENE_CHANNELS; i++)
        channels[i] = i + 1;
    cal_code *code = compile_expression(program, NULL, "Px+100*Dz+1e4*DzA+1e6*A2+1e8*AC", CAL_SCENE_CHANNELS, &c);
    assert_true(run_code(code, channels).value == 7 + 300 + 370000 + 7e6 + 3e8);
    assert_true(cal_code_channels(code) ==
                (CAL_CHANNEL_BIT(CAL_PX) | CAL_CHANNEL_BIT(CAL_DZ) | CAL_CHANNEL_BIT(CAL_DZA)));
    cal_code_destroy(code);
    /* What a material does not give is told where it is needed. */
    code = compile_expression(program, NULL, "if(Px,1,NxP)", CAL_RAY_CHANNELS, &c);
    assert_true(run_code(code, channels).value == 1);
    channels[CAL_PX - 1] = 0;
    answer a = run_code(code, channels);
    assert_int_equal(a.outcome, CAL_FAILED);
    assert_in(a.failure, "NxP has no value here");
    cal_code_destroy(code);
    cal_program_destroy(program);
}

static void functions_are_called_with_channels(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    cal_program *program = program_of("f(a,b) = a-b*$1; g(h) = h;", &c);
    const cal_expression expressions[] = {{"f", 2, 2}, {"f($3,1)", 0, 0}, {"atan2", 2, 1}, {"f", 1, 2}, {"none", 1, 1}};
    const double channels[] = {2, 30, 4};
    for (size_t i = 0; i < 5; i++) {
        const cal_request request = {
            .expressions = &expressions[i], .expression_count = 1, .channels = CAL_CHANNEL_BITS(1, 3)};
        cal_code *code;
        assert_int_equal(cal_compile(&code, program, &request, &c.report), GRAZE_OK);
        answer a = run_code(code, channels);
        if (i < 3) {
            assert_value(a, i == 0 ? 22 : i == 1 ? 2 : atan2(2, 30));
        } else {
            assert_int_equal(a.outcome, CAL_FAILED);
            assert_in(a.failure, i == 3 ? "f() is called with too few arguments" : "there is no function none()");
        }
        cal_code_destroy(code);
    }
    cal_program_destroy(program);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(later_definitions_win_but_constants_stay), cmocka_unit_test(definitions_that_change_are_told),
        cmocka_unit_test(files_are_contexts_and_read_once),         cmocka_unit_test(scenes_have_their_names),
        cmocka_unit_test(functions_are_called_with_channels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
