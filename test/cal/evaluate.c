/* What is computed: laziness, faults, recursion and its bounds, any number of threads. */
#include "base/parallel.h"
#include "cal/support.h"

static void only_what_is_needed_is_computed(void **state) {
    (void)state;
    assert_value(answer_of("f(a,b) = if(a,a,b);", "f($1)", 3, 0, 0), 3);
    assert_value(answer_of("f(a,b) = if(a,a,b);", "f($1,none)", 3, 0, 0), 3);
    assert_value(answer_of("x = none(3);", "select(2,x,$1)", 3, 0, 0), 3);
    answer a = answer_of("f(a,b) = if(a,a,b);", "f($1)", -3, 0, 0);
    assert_int_equal(a.outcome, CAL_FAILED);
    assert_in(a.failure, "f() is called with too few arguments");
    a = answer_of("x = 1;\ny = x + none;", "y", 0, 0, 0);
    assert_int_equal(a.outcome, CAL_FAILED);
    assert_in(a.failure, "test.cal:2:9: there is no variable none");
    a = answer_of("f(g) = g(1);", "f(1+$1)", 0, 0, 0);
    assert_in(a.failure, "not the name of a function");
    a = answer_of("x = y; y = x;", "x", 0, 0, 0);
    assert_in(a.failure, "is defined by itself");
    a = answer_of("f(n) = if(n-.5,f(n-1),x); x = f(3)+1;", "x", 0, 0, 0);
    assert_in(a.failure, "defined by itself");
    a = answer_of("f(n) = if(n-.5,f(n-1),x); x = f($1)+1;", "x", 3, 0, 0);
    assert_in(a.failure, "defined by itself");
}

static void assert_fault(const char *expression, double x, double value) {
    answer a = answer_of("", expression, x, 2, 3);
    assert_int_equal(a.outcome, CAL_FAULT);
    assert_true(a.value == value);
}

/* Where a function has no value it is 0; so is one whose arguments had none; but a function that is computed afterwards
 * makes that forgotten. */
static void faults_are_zeros(void **state) {
    (void)state;
    assert_fault("1/$1", 0, 0);
    assert_fault("5+1/$1", 0, 5);
    assert_fault("sqrt($1)+2", -1, 2);
    assert_fault("log($1)+1", 0, 1);
    assert_fault("exp(1000*$1)+1", 1, 1);
    assert_fault("$1^.5+1", -1, 1);
    assert_fault("$1^-1+1", 0, 1);
    assert_fault("$1^2+1", 1e200, 1);
    assert_fault("acos($1)+1", 2, 1);
    assert_fault("sqrt(4+1/$1)", 0, 0);
    assert_fault("if($2,5+1/$1,1)", 0, 0);
    assert_fault("min(1/$1,5)", 0, 0);
    assert_fault("select($1,7,8)", 3, 0);
    assert_fault("select($1,7,8)", -1, 0);
    assert_fault("$3^$2^$1", (double)INFINITY, 0);
    assert_fault("1e308*$1", 10, 0);
    assert_fault("floor(1e308*$1)+1", 10, 1);
    assert_fault("sin($2)*noise3(1e308*$1,0,0)+1", 10, 1);
    assert_value(answer_of("", "1/$1+sin($2)", 0, 2, 0), sin(2));
    assert_value(answer_of("", "atan2(sin($2),1/$1)", 0, 2, 0), 1.5707963267948966);
    assert_value(answer_of("x = 1/$1;", "if(1,x,3)+select(1,x)", 0, 2, 0), 0);
    assert_value(answer_of("", "select($1,7,8)", 0, 0, 0), 2);
    assert_value(answer_of("", "arg($1)+10*arg($2)", 1, 3, 0), 115);
    assert_value(answer_of("", "arg($1)+arg(0)+arg(3)", 0, 3, 0), 17);
    answer a = answer_of("", "arg($1)", 4, 0, 0);
    assert_in(a.failure, "fewer real arguments");
    a = answer_of("", "arg(4)", 4, 0, 0);
    assert_in(a.failure, "the primitive has no real argument 4");
}

static void functions_of_the_library(void **state) {
    (void)state;
    assert_value(answer_of("", "erf($1)+erfc($1)", .7, 0, 0), 1);
    assert_value(answer_of("", "erf($1)", .7, 0, 0), erf(.7));
    assert_value(answer_of("", "log10($1)", 1000, 0, 0), 3);
    assert_value(answer_of("", "ceil($1)+floor($1)", 2.5, 0, 0), 5);
    assert_value(answer_of("", "min($1,$2,$3)+10*max($1,$2,$3)", 4, 2, 3), 42);
    assert_value(answer_of("sin(x) = x+1;", "sin($1)", 4, 2, 3), 5);
    assert_value(answer_of("sin = 3;", "sin+0*sin($1)+cos(0)", 4, 2, 3), 4);
}

static void functions_call_themselves_and_each_other(void **state) {
    (void)state;
    assert_value(answer_of("f(n) = if(n-1,n*f(n-1),1);", "f($1)", 10, 0, 0), 3628800);
    assert_value(answer_of("f(n) : if(n-1,n*f(n-1),1);", "f(10)", 10, 0, 0), 3628800);
    assert_value(answer_of("e(n) = if(n-.5,o(n-1),1); o(n) = if(n-.5,e(n-1),-1);", "e($1)", 301, 0, 0), -1);
    assert_value(answer_of("s(f,n) = if(n-.5,f(n)+s(f,n-1),0); q(x) = x*x;", "s(q,$1)+s(floor,$1)", 10, 0, 0), 440);
    assert_value(answer_of("a(f,g,n) = if(n-.5,f(a(g,f,n-1)),n); p(x) = x+1; q(x) = x*2;", "a(p,q,$1)", 3, 0, 0),
                 4 - 1);
    /* Arguments are computed in their caller, once, however deep the need. */
    assert_value(answer_of("d(n,x) = if(n-.5,d(n-1,x+x),x);", "d($1,$2)", 1000, 1e-300, 0), ldexp(1e-300, 1000));
    assert_value(answer_of("y = $2+1; f(n) = if(n-.5,f(n-1)+y*y,0);", "f($1)+y", 4, 2, 0), 39);
    assert_value(answer_of("v(i) = select(i,$1,$2,$3); dot(a,b) = a(1)*b(1)+a(2)*b(2)+a(3)*b(3);", "dot(v,v)", 1, 2, 3),
                 14);
}

static void what_does_not_end_is_ended(void **state) {
    (void)state;
    answer a = answer_of("f(x) = f(x+1)+1;", "f($1)", 1, 0, 0);
    assert_int_equal(a.outcome, CAL_FAILED);
    assert_in(a.failure, "too deeply");
    a = answer_of("f(n) = if(n,f(n-1)+f(n-1),$2);", "f($1)", 60, 1, 0);
    assert_int_equal(a.outcome, CAL_FAILED);
    assert_in(a.failure, "do not come to an end");
    a = answer_of("w(f,x) = f(f,x);", "w(w,$1)", 60, 1, 0);
    assert_int_equal(a.outcome, CAL_FAILED);
    /* Twice as long with each definition: what is built is bounded, and what is computed. */
    char text[4096] = "f0(x) = sin(x)+1;", *end = text + strlen(text);
    for (int i = 1; i < 60; i++)
        end += sprintf(end, "f%d(x) = f%d(x)+f%d(x+1);", i, i - 1, i - 1);
    a = answer_of(text, "f59($1)", 1, 0, 0);
    assert_in(a.failure, "do not come to an end");
}

enum { POINTS = 2000, PIECES = 8 };

typedef struct shared {
    const cal_code *code;
    double values[POINTS];
} shared;

static void evaluate_piece(void *user, size_t piece, int worker) {
    shared *s = user;
    void *memory = malloc(cal_memory_size(s->code));
    (void)worker;
    for (size_t i = piece; i < POINTS; i += PIECES) {
        const double channels[3] = {(double)i * .01, (double)(i % 7) - 3, (double)(i % 5)};
        if (cal_evaluate(s->code, channels, &s->values[i], memory) == CAL_FAILED)
            s->values[i] = -1;
    }
    free(memory);
}

static void threads_share_code(void **state) {
    (void)state;
    captured c;
    captured_begin(&c);
    cal_program *program = program_of("x = sin($1)*$2; f(n) = if(n-.5,f(n-1)+x/n+noise3($1,$2,n),0);", &c);
    static shared one, four;
    one.code = four.code = compile_expression(program, NULL, "f($3)+noise3x($1,$2,0)*x", 3, &c);
    cal_program_destroy(program); /* code stands alone */
    parallel_for(1, PIECES, evaluate_piece, &one);
    parallel_for(4, PIECES, evaluate_piece, &four);
    assert_memory_equal(one.values, four.values, sizeof one.values);
    cal_code_destroy((cal_code *)one.code);
}

static void noise_is_smooth_and_its_differences_are_its_own(void **state) {
    (void)state;
    /* Nothing at corners of the lattice; the period is 256. */
    assert_value(answer_of("", "noise3(floor($1),2,3)+1", 7.5, 0, 0), 1);
    assert_value(answer_of("", "noise3($1,$2,$3)-noise3($1+256,$2-512,$3)", 7.5, .25, -3.125), 0);
    for (int i = 0; i < 100; i++) {
        double x = i * .37 - 9, y = i * .11, z = 5 - i * .23;
        double by_hand = answer_of("", "(noise3($1,$2,$3)-noise3($1-5e-4,$2,$3))/5e-4", x, y, z).value;
        assert_true(fabs(answer_of("", "noise3x($1,$2,$3)", x, y, z).value - by_hand) < 1e-9);
        assert_true(fabs(answer_of("", "noise3($1,$2,$3)", x, y, z).value) <= 1);
        assert_true(fabs(answer_of("", "fnoise3($1,$2,$3)", x, y, z).value) <= 2);
    }
    assert_int_equal(answer_of("", "fnoise3($1,$2,$3)+noise3($1,$2,$3)", 1e300, -1e300, 1e18).outcome, CAL_FINE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_is_needed_is_computed),
        cmocka_unit_test(faults_are_zeros),
        cmocka_unit_test(functions_of_the_library),
        cmocka_unit_test(functions_call_themselves_and_each_other),
        cmocka_unit_test(what_does_not_end_is_ended),
        cmocka_unit_test(threads_share_code),
        cmocka_unit_test(noise_is_smooth_and_its_differences_are_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
