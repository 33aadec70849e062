/* What is written: grammar, comments, names, and what is refused with its place. */
#include "cal/support.h"

static void operators_bind_as_in_the_language(void **state) {
    (void)state;
    static const struct {
        const char *expression;
        double value; /* with $1 = 2, $2 = 3, $3 = 5 */
    } cases[] = {
        {"$1+$2*$3", 17},      {"($1+$2)*$3", 25},  {"$3-$2-$1", 0},     {"$3/$1/$2*6", 5}, {"-$1^2", 4},
        {"-($1^2)", -4},       {"$1^$2^$1", 512},   {"($1^$2)^$1", 64},  {"$1^-1", .5},     {"$3--$2", 8},
        {"$3-+$2", 2},         {"+$3", 5},          {"-(-$3)", 5},       {"$1*-$2", -6},    {"2^-$1", .25},
        {"1.5e1*$1", 30},      {"5.*$1", 10},       {".5*$1", 1},        {"1E+1*$1", 20},   {"007*$1", 14},
        {"{a}$1{b}*{c}$2", 6}, {"$1{ { } }+$2", 5}, {" $ 1\n*\t$2 ", 6}, {"((($1)))", 2},   {"$3-($2-$1)", 4},
        {"$1-$2*$3-1", -14},   {"1/$1+1/$1", 1},    {"$3*0", 0},         {"0^$1+$1^0", 1},  {"1^$1+$1^1", 3},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_value(answer_of("", cases[i].expression, 2, 3, 5), cases[i].value);
}

static void expressions_are_refused_with_their_column(void **state) {
    (void)state;
    static const struct {
        const char *expression, *message;
    } cases[] = {
        {"", "column 1: the expression ends too early"},
        {"$1+", "column 4: the expression ends too early"},
        {"--$1", "column 2: unexpected character"},
        {"($1", "column 4: ')' expected"},
        {"$1)", "column 3: unexpected character"},
        {"sin()", "column 5: unexpected character"},
        {"sin($1", "column 7: ')' expected"},
        {"2x", "column 2: unexpected character"},
        {"$1 $2", "column 4: unexpected character"},
        {".", "column 1: no number can be read here"},
        {"1e400", "column 1: this number is too large"},
        {"$1 {a {b} ", "column 4: this comment has no '}'"},
        {"$123456789", "no channel has such a number"},
        {"1/0", "column 3: division by a constant 0"},
        {"$1/(2-2)", "division by a constant 0"},
        {"sqrt(-1)", "column 1: this constant has no value"},
        {"log(0)", "this constant has no value"},
        {"(-1)^.5", "this power does not exist"},
        {"1e300*1e300", "this constant is out of range"},
    };
    captured c;
    captured_begin(&c);
    cal_program *program = program_of("", &c);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        captured_begin(&c);
        assert_null(compile_expression(program, NULL, cases[i].expression, 3, &c));
        assert_int_equal(c.errors, 1);
        assert_in(c.text, cases[i].message);
    }
    cal_program_destroy(program);
}

static void definitions_are_refused_with_their_line(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"a = 1;\n  b = ;", "test.cal:2:7: unexpected character"},
        {"a 1;", "test.cal:1:3: '=' or ':' expected"},
        {"a = 1 b = 2;", "test.cal:1:7: ';' expected"},
        {"\n\n 1 = 2;", "test.cal:3:2: a name expected"},
        {"$1 = 2;", "channels cannot be set here"},
        {"f() = 2;", "a parameter's name expected"},
        {"f(x y) = 2;", "test.cal:1:5: ')' expected"},
        {"f(x`a) = 2;", "test.cal:1:3: a parameter's name cannot have a context"},
        {"a = 1; { b = 2;\n", "test.cal:1:8: this comment has no '}'"},
        {"f(x) : 1/x;\na = f(0);", "test.cal:2:5: this constant has no value"},
        {"f(x) : g(x);\na = f(2);", "there is no function g()"},
        {"f(x) : x*$1;\na = f(2);", "has no value here"},
        {"A : arg(1);\na = A;", "a constant cannot depend on arg()"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        captured c;
        captured_begin(&c);
        cal_program *program = cal_program_create();
        const place where = {.file = "test.cal"};
        graze_status status =
            cal_program_add_text(program, NULL, cases[i].text, strlen(cases[i].text), &where, &c.report);
        if (status != GRAZE_INPUT_ERROR)
            print_error("%s\n", cases[i].text);
        assert_int_equal(status, GRAZE_INPUT_ERROR);
        assert_in(c.text, cases[i].message);
        cal_program_destroy(program);
    }
}

/* Text that repeats a piece. */
static char *repeated(const char *begin, const char *piece, int times, const char *end) {
    size_t length = strlen(begin) + (size_t)times * strlen(piece) + strlen(end) + 1;
    char *text = malloc(length), *p = text;
    assert_non_null(text);
    p += sprintf(p, "%s", begin);
    for (int i = 0; i < times; i++)
        p += sprintf(p, "%s", piece);
    sprintf(p, "%s", end);
    return text;
}

static void depth_is_bounded_and_length_is_not(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    cal_program *program = program_of("", &c);
    static const char *const deep[][3] = {{"", "(", "1"}, {"", "$1^", "1"}, {"$1", "-$1", ""}, {"", "sin(", "1"}};
    for (int i = 0; i < 4; i++) {
        char *text = repeated(deep[i][0], deep[i][1], 100000, deep[i][2]);
        captured_begin(&c);
        assert_null(compile_expression(program, NULL, text, 3, &c));
        assert_int_equal(c.errors, 1);
        free(text);
    }
    char *text = repeated("1", "+1", 100000, "");
    cal_code *code = compile_expression(program, NULL, text, 3, &c);
    assert_value(run_code(code, NULL), 100001);
    cal_code_destroy(code);
    free(text);
    text = repeated("$1", "+$2*$1", 1000, "");
    assert_value(answer_of("", text, 2, 3, 0), 6002);
    free(text);
    cal_program_destroy(program);
}

static void names_are_cut_where_radiance_cuts_them(void **state) {
    (void)state;
    char *name = repeated("", "a", 127, ""), definition[512], expression[512];
    snprintf(definition, sizeof definition, "%sbcd = 4;", name);
    snprintf(expression, sizeof expression, "%sx + %s", name, name);
    assert_value(answer_of(definition, expression, 0, 0, 0), 8);
    free(name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operators_bind_as_in_the_language),
        cmocka_unit_test(expressions_are_refused_with_their_column),
        cmocka_unit_test(definitions_are_refused_with_their_line),
        cmocka_unit_test(depth_is_bounded_and_length_is_not),
        cmocka_unit_test(names_are_cut_where_radiance_cuts_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
