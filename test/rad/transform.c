/* Transforms against what they must do to points. */
#include "support.h"

#include "rad/transform.h"

static rad_transform parse(int count, const char *const *words) {
    rad_transform t;
    assert_int_equal(rad_transform_parse(&t, words, count, NULL, NULL), GRAZE_OK);
    return t;
}

#define PARSE(...)                                                                                                     \
    parse((int)(sizeof((const char *[]){__VA_ARGS__}) / sizeof(char *)), (const char *const[]){__VA_ARGS__})

static void assert_point(rad_transform t, vec3 from, vec3 to) {
    assert_true(vec3_max_abs(vec3_subtract(rad_transform_point(&t, from), to)) < 1e-15);
}

static void operations(void **state) {
    (void)state;
    vec3 p = {1, 2, 3};
    assert_point(rad_transform_identity(), p, p);
    assert_point(PARSE("-t", "10", "-20", ".5"), p, vec3_make(11, -18, 3.5));
    /* Counter-clockwise, looking down the axis; whole quarter turns are exact. */
    assert_point(PARSE("-rx", "90"), p, vec3_make(1, -3, 2));
    assert_point(PARSE("-ry", "90"), p, vec3_make(3, 2, -1));
    assert_point(PARSE("-rz", "90"), p, vec3_make(-2, 1, 3));
    assert_point(PARSE("-rz", "180"), p, vec3_make(-1, -2, 3));
    assert_point(PARSE("-rz", "-450"), p, vec3_make(2, -1, 3));
    assert_point(PARSE("-rz", "30"), vec3_make(1, 0, 0), vec3_make(sqrt(.75), .5, 0));
    assert_point(PARSE("-s", "-2"), p, vec3_make(-2, -4, -6));
    assert_point(PARSE("-mx"), p, vec3_make(-1, 2, 3));
    assert_point(PARSE("-my"), p, vec3_make(1, -2, 3));
    assert_point(PARSE("-mz"), p, vec3_make(1, 2, -3));
    assert_true(PARSE("-rz", "180").m[0][1] == 0 && PARSE("-rx", "1e9").m[1][2] != 0);
}

static void scale_and_handedness(void **state) {
    (void)state;
    assert_true(PARSE("-s", "-2", "-s", "3").scale == 6);
    assert_true(PARSE("-s", "-2").mirrored);
    assert_true(PARSE("-mx").mirrored);
    assert_false(PARSE("-mx", "-my").mirrored);
    assert_true(PARSE("-mx", "-my", "-mz").mirrored);
    assert_false(PARSE("-mx", "-s", "-1").mirrored);
    assert_true(PARSE("-i", "3", "-mx").mirrored);
}

static void the_largest_and_the_smallest(void **state) {
    (void)state;
    const vec3 unit = {1, 1, 1};
    assert_point(PARSE("-s", "1e100", "-s", "1e-100"), unit, unit);
    assert_true(PARSE("-s", "1e100").scale == 1e100 && PARSE("-s", "1e-100").scale == 1e-100);
    assert_true(PARSE("-t", "1e100", "-1e100", "1e100").m[3][2] == 1e100);
}

static void iteration(void **state) {
    (void)state;
    vec3 origin = {0, 0, 0};
    assert_point(PARSE("-i", "3", "-t", "1", "0", "0"), origin, vec3_make(3, 0, 0));
    assert_point(PARSE("-i", "0", "-t", "1", "0", "0"), origin, origin);
    assert_point(PARSE("-i", "-5", "-t", "1", "0", "0"), origin, origin);
    assert_point(PARSE("-t", "0", "1", "0", "-i", "2", "-t", "1", "0", "0", "-i", "1", "-s", "2"), origin,
                 vec3_make(4, 2, 0));
    /* All that follows a count repeats as one, to the next count. */
    assert_point(PARSE("-i", "2", "-t", "1", "0", "0", "-s", "2"), origin, vec3_make(6, 0, 0));
    assert_point(PARSE("-i", "2000000000", "-mx"), vec3_make(1, 1, 1), vec3_make(1, 1, 1));
}

static void composition(void **state) {
    (void)state;
    rad_transform a = PARSE("-rx", "20", "-s", "2", "-t", "1", "2", "3"),
                  b = PARSE("-mz", "-ry", "75", "-t", "0", "4", "0");
    rad_transform both = rad_transform_then(&a, &b);
    vec3 p = {.3, -.7, 1.1};
    assert_point(both, p, rad_transform_point(&b, rad_transform_point(&a, p)));
    assert_true(both.mirrored && both.scale == 2);
    vec3 v = rad_transform_vector(&both, p);
    vec3 difference = vec3_subtract(rad_transform_point(&both, p), rad_transform_point(&both, vec3_make(0, 0, 0)));
    assert_true(vec3_max_abs(vec3_subtract(v, difference)) < 1e-14);
    assert_true(fabs(vec3_length(v) - 2 * vec3_length(p)) < 1e-14);
}

static void and_back(void **state) {
    (void)state;
    rad_transform t = PARSE("-rx", "20", "-t", "1", "-2", "3", "-s", "-2.5", "-my", "-rz", "50");
    vec3 point = {.3, -4, 5}, direction = vec3_normalize(vec3_make(1, 2, -3));
    vec3 there = rad_transform_direction(&t, direction);
    assert_true(fabs(vec3_length(there) - 1) < 1e-15);
    assert_true(vec3_max_abs(vec3_subtract(rad_transform_direction_back(&t, there), direction)) < 1e-15);
    vec3 back = rad_transform_point_back(&t, rad_transform_point(&t, point));
    assert_true(vec3_max_abs(vec3_subtract(back, point)) < 1e-14);
    rad_transform inverse = rad_transform_inverse(&t);
    back = rad_transform_point_back(&inverse, point);
    assert_true(vec3_max_abs(vec3_subtract(back, rad_transform_point(&t, point))) < 1e-13);
}

static void errors(void **state) {
    (void)state;
    static const struct {
        const char *words[4];
        int count;
        const char *message;
    } cases[] = {
        {{"-t", "1", "2"}, 3, "bad transform at '-t'"},
        {{"-t", "1", "2", "x"}, 4, "bad transform at '-t'"},
        {{"-mx", "-mw"}, 2, "bad transform at '-mw'"},
        {{"-mx", "file"}, 2, "bad transform at 'file'"},
        {{"-rx", "inf"}, 2, "bad transform at '-rx'"},
        {{"-s", "0"}, 2, "bad transform at '-s'"},
        {{"-i", "1.5"}, 2, "bad transform at '-i'"},
        {{""}, 1, "bad transform at ''"},
        {{"-"}, 1, "bad transform at '-'"},
        {{"-r"}, 1, "bad transform at '-r'"},
        /* What stands behind the words is not theirs. */
        {{"-t", "1", "2", "3"}, 3, "bad transform at '-t'"},
        {{"-s", "2"}, 1, "bad transform at '-s'"},
        {{"-rx", "2"}, 1, "bad transform at '-rx'"},
        {{"-mx", "-s", "2"}, 2, "bad transform at '-s'"},
        {{"-i", "2"}, 1, "bad transform at '-i'"},
        {{"-mx", "-mx", "2"}, 3, "bad transform at '2'"},
        {{"-rw", "90"}, 2, "bad transform at '-rw'"},
        {{"-r{", "90"}, 2, "bad transform at '-r{'"},
        {{"-m{"}, 1, "bad transform at '-m{'"},
        {{"-s", "1e-200"}, 2, "transform out of range"},
        {{"-s", "1.0001e100"}, 2, "transform out of range"},
        {{"-s", "-.9999e-100"}, 2, "transform out of range"},
        {{"-t", "1.0001e100", "0", "0"}, 4, "transform out of range"},
        {{"-t", "0", "0", "-1.0001e100"}, 4, "transform out of range"},
        {{"-i", "2000000000", "-s", "2"}, 4, "transform out of range"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        messages m;
        graze_report report = messages_report(&m);
        rad_transform t;
        place where = {.file = "f", .line = 1, .column = 2};
        assert_int_equal(rad_transform_parse(&t, cases[i].words, cases[i].count, &where, &report), GRAZE_INPUT_ERROR);
        assert_contains(m.text, cases[i].message);
        assert_contains(m.text, "f:1:2: ");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations),
        cmocka_unit_test(scale_and_handedness),
        cmocka_unit_test(the_largest_and_the_smallest),
        cmocka_unit_test(iteration),
        cmocka_unit_test(composition),
        cmocka_unit_test(and_back),
        cmocka_unit_test(errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
