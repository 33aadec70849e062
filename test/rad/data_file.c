/* Data files: what is read, what is refused, and the values in between. */
#include "rad/data_file.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/written_file.h"

/* Reads a data file of this text; null where that is refused. */
static rad_data *read_text(arena *memory, const char *text) {
    written_file file = written_file_make(text, strlen(text));
    rad_data *data = arena_allocate(memory, sizeof *data);
    messages[0] = 0;
    graze_status status = rad_data_read(data, memory, file.name, "grid.dat", NULL, &remembering);
    unlink(file.name);
    return status ? NULL : data;
}

static void assert_value(const rad_data *data, double x, double y, double expected) {
    const double point[2] = {x, y};
    double value;
    rad_data_values(data, &data->values, 1, point, &value);
    if (!(fabs(value - expected) <= 1e-6))
        fail_msg("at %g %g: %.9g, not %.9g", x, y, value, expected);
}

static void test_even_line(void **state) {
    (void)state;
    arena *memory = arena_create();
    const rad_data *d = read_text(memory, "1 # one\n0 3 4\n1 2 4 8 # values\n");
    assert_non_null(d);
    assert_value(d, 0, 0, 1);
    assert_value(d, 0.5, 0, 1.5);
    assert_value(d, 2.25, 0, 5);
    assert_value(d, 3, 0, 8);
    /* One step outside it goes on; then by the reciprocal: at the step's far end 2 ends - beginning. */
    assert_value(d, 4, 0, 12);
    assert_value(d, -1, 0, 0);
    arena_destroy(memory);
}

static void test_taper(void **state) {
    (void)state;
    arena *memory = arena_create();
    const rad_data *d = read_text(memory, "1\n0 3 4\n1 2 4 8\n");
    assert_non_null(d);
    /* Beyond 4: shares 1/(i - 1 - x) of 4 and -2/(i - 1 - x) of 8, where i = 2 is the last step. */
    assert_value(d, 6, 0, 4 / -5. + 8 * 2 / 5.);
    assert_value(d, 1001, 0, 4 / -1000. + 8 * 2 / 1000.);
    /* Below -1: shares 1/(x - i) of the second and -2/(x - i) of the first, i = 0. */
    d = read_text(memory, "1\n0 3 4\n3 5 4 9\n");
    assert_non_null(d);
    assert_value(d, -1, 0, 1);
    assert_value(d, -1.5, 0, 5 / -1.5 + 3 * 2 / 1.5);
    assert_value(d, -4, 0, 5 / -4. + 3 * 2 / 4.);
    assert_value(d, 4, 0, 14);
    assert_value(d, 4.5, 0, 4 / -3.5 + 9 * 2 / 3.5);
    arena_destroy(memory);
}

static void test_plane(void **state) {
    (void)state;
    arena *memory = arena_create();
    const rad_data *d = read_text(memory, "2\n0 2 2\n0 0 3 1 2 4\n1 2 3\n5 6 8\n");
    assert_non_null(d);
    assert_int_equal(d->dimensions, 2);
    assert_value(d, 0, 1, 1);
    assert_value(d, 0, 3, 2.5);
    assert_value(d, 2, 3, 7);
    assert_value(d, 1, 2, 4);
    assert_value(d, 0.5, 1.5, 0.75 * 1.5 + 0.25 * 5.5);
    d = read_text(memory, "2\n0 2 3\n0 1 2\n1 2\n3 5\n8 4\n");
    assert_non_null(d);
    assert_value(d, 1.5, 0, 5.5);
    assert_value(d, 2, 1, 4);
    arena_destroy(memory);
}

static void test_places(void **state) {
    (void)state;
    arena *memory = arena_create();
    const rad_data *even = read_text(memory, "1 3 1 3 10 20 40"), *uneven = read_text(memory, "1 0 0 3 3 2 1 10 20 40");
    const rad_data *rising = read_text(memory, "1 0 0 3 .1 .3 .4 10 20 40");
    assert_non_null(even);
    assert_non_null(uneven);
    assert_true(uneven->axes[0].begin == 3 && uneven->axes[0].length == -2);
    for (double x = 0.2; x < 4; x += 0.3) {
        double expected = x >= 2 ? 20 - 10 * (x - 2) : 20 + 20 * (2 - x);
        assert_value(even, x, 0, expected);
        assert_value(uneven, x, 0, expected);
    }
    assert_non_null(rising);
    assert_value(rising, 0.15, 0, 12.5);
    assert_value(rising, 0.35, 0, 30);
    arena_destroy(memory);
}

static void assert_refused(const char *text, const char *why) {
    arena *memory = arena_create();
    if (read_text(memory, text))
        fail_msg("'%s' is read", text);
    if (!strstr(messages, why))
        fail_msg("'%s': %s", text, messages);
    arena_destroy(memory);
}

static void test_refused(void **state) {
    (void)state;
    assert_refused("", "grid.dat:1:1: the data file ends where the number of dimensions should be");
    assert_refused("7", "the number of dimensions must be a whole number from 1 to 6");
    assert_refused("1\n0 1 1\n1", "grid.dat:2:5: the number of places of a dimension must be a whole number from 2");
    assert_refused("1\n0 1 9\n1", "the data file has fewer values than its 9 places");
    assert_refused("1\n0 1 2\n1 #", "grid.dat:3:4: the data file ends where a value should be");
    assert_refused("1\n0 1 2\n1 2x", "grid.dat:3:3: a value should be here, and be a number");
    assert_refused("1\n0 1 2\n1 1e999", "a value is too large");
    assert_refused("1\n0 0 3 1 1 2\n1 2 3", "grid.dat:2:9: the places of a dimension must rise, or fall");
    assert_refused("1\n0 0 3 1 3 2\n1 2 3", "the places of a dimension must rise, or fall");
    assert_refused("1\n0 0 4e9 1 3 2\n1 2 3", "fewer places");
    assert_refused("5\n0 1 1e6\n0 1 1e6\n0 1 1e6\n0 1 1e6\n0 1 1e6\n1", "too many values");
}

static void test_rest_is_told(void **state) {
    (void)state;
    arena *memory = arena_create();
    assert_non_null(read_text(memory, "1\n0 1 2\n1 2\n3"));
    assert_non_null(strstr(messages, "warning: grid.dat:4:1: what is behind the data file's 2 values is not used"));
    arena_destroy(memory);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_even_line), cmocka_unit_test(test_taper),   cmocka_unit_test(test_plane),
        cmocka_unit_test(test_places),    cmocka_unit_test(test_refused), cmocka_unit_test(test_rest_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
