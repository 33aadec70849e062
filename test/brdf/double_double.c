/* Arithmetic in sums of two doubles against arbitrary precision: what is exact is, the rest loses less than
 * double_double.h says. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <mpfr.h>

#include "brdf/common.h"
#include "brdf/double_double.h"

/* That of double_double.h. */
#define LOST 0x1p-98

/* Sums and products of the operands here are exact in so many bits. */
enum { BITS = 2000 };

static int cases(void) {
    return is_short_run() ? 30000 : 300000;
}

/* A mantissa next to a power of two, from either side, as often as any. */
static double draw_mantissa(uint64_t *seed) {
    double x = draw(seed), away = floor(draw_power(seed, 1, 0x1p44)) * DBL_EPSILON;
    return x < .4 ? 1 + draw(seed) : x < .6 ? 1 + away : 2 - away;
}

static double draw_number(uint64_t *seed, int least_power, int most_power) {
    double x = ldexp(draw_mantissa(seed), (int)floor(draw_between(seed, least_power, most_power + 1)));
    return draw(seed) < .5 ? -x : x;
}

/* Its lower part is at most two ulp, as a loose one may be, and now and then 0. */
static double_double draw_double_double(uint64_t *seed) {
    double hi = draw_number(seed, -150, 150);
    double ulp = ldexp(DBL_EPSILON, ilogb(hi)), most = draw(seed) < .5 ? 2 : .5;
    double lo = draw(seed) < .1 ? 0 : draw_between(seed, -most, most) * (draw(seed) < .3 ? draw(seed) : 1) * ulp;
    return (double_double){hi, lo};
}

static double_double absolute(double_double a) {
    return a.hi < 0 ? (double_double){-a.hi, -a.lo} : a;
}

static double_double widened(double a) {
    return (double_double){a, 0};
}

static void set(mpfr_t to, double_double a) {
    mpfr_set_d(to, a.hi, MPFR_RNDN);
    mpfr_add_d(to, to, a.lo, MPFR_RNDN);
}

/* The sum of both is `exact` in all bits, and the upper one is that, rounded. */
static void assert_exact(mpfr_t exact, double_double found) {
    mpfr_t sum;
    mpfr_init2(sum, BITS);
    set(sum, found);
    assert_true(mpfr_equal_p(sum, exact) != 0);
    assert_true(found.hi == mpfr_get_d(exact, MPFR_RNDN));
    mpfr_clear(sum);
}

static void sums_are_exact(void **state) {
    (void)state;
    uint64_t seed = 61;
    mpfr_t exact;
    mpfr_init2(exact, BITS);
    for (int i = 0; i < cases(); ++i) {
        int away = i % 2 ? 500 : 60; /* beyond 53, b leaves no trace in the upper part */
        double a = draw_number(&seed, -away, away), b = i % 5 == 0 ? -nextafter(a, 0) : draw_number(&seed, -away, away);
        mpfr_set_d(exact, a, MPFR_RNDN);
        mpfr_add_d(exact, exact, b, MPFR_RNDN);
        double_double sum = exact_sum(a, b), turned = exact_sum(b, a);
        assert_exact(exact, sum);
        assert_memory_equal(&sum, &turned, sizeof sum);
        assert_exact(exact, fabs(a) >= fabs(b) ? exact_ordered_sum(a, b) : exact_ordered_sum(b, a));
        a = fabs(a);
        b = fabs(b);
        mpfr_set_d(exact, a, MPFR_RNDN);
        mpfr_add_d(exact, exact, b, MPFR_RNDN);
        sum = exact_positive_sum(a, b);
        turned = exact_positive_sum(b, a);
        assert_exact(exact, sum);
        assert_memory_equal(&sum, &turned, sizeof sum);
    }
    mpfr_clear(exact);
}

static bool has_26_bits(double a) {
    int power;
    double mantissa = ldexp(frexp(a, &power), 26);
    return mantissa == floor(mantissa);
}

/* Either half of a number fits into 26 bits and a sign, so that products of halves are exact. */
static void halves_have_26_bits(void **state) {
    (void)state;
    uint64_t seed = 62;
    for (int i = 0; i < cases(); ++i) {
        double a = draw_number(&seed, -900, 900), upper = upper_bits(a);
        assert_true(has_26_bits(upper) && has_26_bits(a - upper));
    }
}

/* As far as the error is a normal number. */
static void products_are_exact(void **state) {
    (void)state;
    uint64_t seed = 63;
    mpfr_t exact;
    mpfr_init2(exact, BITS);
    for (int i = 0; i < cases(); ++i) {
        double a = draw_number(&seed, -450, 450), b = i % 8 == 0 ? a : draw_number(&seed, -450, 450);
        mpfr_set_d(exact, a, MPFR_RNDN);
        mpfr_mul_d(exact, exact, b, MPFR_RNDN);
        assert_exact(exact, exact_product(a, b));
    }
    mpfr_clear(exact);
}

/* a - q b, for q the quotient, or an ulp more or less, and for roots. */
static void remainders_are_rounded_once(void **state) {
    (void)state;
    uint64_t seed = 64;
    mpfr_t exact;
    mpfr_init2(exact, BITS);
    for (int i = 0; i < cases(); ++i) {
        double a = draw_number(&seed, -200, 200), b = draw_number(&seed, -200, 200), q = a / b;
        q = i % 4 == 0 ? nextafter(q, HUGE_VAL) : i % 4 == 1 ? nextafter(q, -HUGE_VAL) : q;
        if (i % 4 == 2) {
            a = fabs(a);
            b = q = sqrt(a);
        }
        mpfr_set_d(exact, q, MPFR_RNDN);
        mpfr_mul_d(exact, exact, -b, MPFR_RNDN);
        mpfr_add_d(exact, exact, a, MPFR_RNDN);
        assert_true(remainder_of(a, q, b) == mpfr_get_d(exact, MPFR_RNDN));
    }
    mpfr_clear(exact);
}

enum { ADD, SUBTRACT, MULTIPLY, MULTIPLY_DOUBLE, DIVIDE, RECIPROCAL, SQUARE_ROOT, OPERATIONS };
static const char *const names[OPERATIONS] = {
    "dd_add", "dd_subtract", "dd_multiply", "dd_multiply_double", "dd_divide", "dd_reciprocal", "dd_sqrt",
};

static double_double result_of(int operation, double_double a, double_double b) {
    switch (operation) {
    case ADD:
        return dd_add(a, b);
    case SUBTRACT:
        return dd_subtract(a, b);
    case MULTIPLY:
        return dd_multiply(a, b);
    case MULTIPLY_DOUBLE:
        return dd_multiply_double(a, b.hi);
    case DIVIDE:
        return dd_divide(a, b);
    case RECIPROCAL:
        return dd_reciprocal(a);
    default:
        return dd_sqrt(a);
    }
}

/* The true result, into x, which is a; y is b. */
static void exact_result(int operation, mpfr_t x, mpfr_t y) {
    switch (operation) {
    case ADD:
        mpfr_add(x, x, y, MPFR_RNDN);
        break;
    case SUBTRACT:
        mpfr_sub(x, x, y, MPFR_RNDN);
        break;
    case MULTIPLY:
    case MULTIPLY_DOUBLE:
        mpfr_mul(x, x, y, MPFR_RNDN);
        break;
    case DIVIDE:
        mpfr_div(x, x, y, MPFR_RNDN);
        break;
    case RECIPROCAL:
        mpfr_ui_div(x, 1, x, MPFR_RNDN);
        break;
    default:
        mpfr_sqrt(x, x, MPFR_RNDN);
    }
}

/* What is lost, of the result, or of the larger operand. */
static double lost(int operation, double_double a, double_double b) {
    mpfr_t x, y, found;
    mpfr_inits2(BITS, x, y, found, (mpfr_ptr)NULL);
    double_double result = result_of(operation, a, b);
    assert_true(fabs(result.lo) <= DBL_EPSILON * fabs(result.hi));
    set(x, a);
    set(y, b);
    set(found, result);
    exact_result(operation, x, y);
    mpfr_sub(found, found, x, MPFR_RNDN);
    if (operation == ADD || operation == SUBTRACT)
        mpfr_set_d(x, fmax(fabs(a.hi), fabs(b.hi)), MPFR_RNDN);
    mpfr_div(found, found, x, MPFR_RNDN);
    double part = fabs(mpfr_get_d(found, MPFR_RNDN));
    mpfr_clears(x, y, found, (mpfr_ptr)NULL);
    return part;
}

/* Half of all sums are of numbers that differ by a few powers of two, or cancel: as b is drawn, or as -a is. */
static void operations_lose_little(void **state) {
    (void)state;
    uint64_t seed = 65;
    double worst[OPERATIONS] = {0};
    for (int i = 0; i < cases(); ++i)
        for (int operation = 0; operation < OPERATIONS; ++operation) {
            double_double a = draw_double_double(&seed), b = draw_double_double(&seed);
            if (operation <= SUBTRACT && i % 2 == 0) {
                int power = ilogb(a.hi) - ilogb(b.hi) - (int)(draw(&seed) * 4);
                b = (double_double){ldexp(b.hi, power), ldexp(b.lo, power)};
                if (i % 4 == 0)
                    b = (double_double){operation == ADD ? -a.hi : a.hi, b.lo};
            }
            if (operation == MULTIPLY_DOUBLE)
                b = widened(b.hi);
            if (operation == SQUARE_ROOT)
                a = absolute(a);
            double part = lost(operation, a, b);
            worst[operation] = fmax(worst[operation], part);
            if (!(part < LOST))
                fail_msg("%s loses %a of the result for %a + %a and %a + %a", names[operation], part, a.hi, a.lo, b.hi,
                         b.lo);
        }
    for (int operation = 0; operation < OPERATIONS; ++operation)
        assert_true(worst[operation] > LOST / 128); /* a bound far above would be none */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_exact),         cmocka_unit_test(halves_have_26_bits),
        cmocka_unit_test(products_are_exact),     cmocka_unit_test(remainders_are_rounded_once),
        cmocka_unit_test(operations_lose_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
