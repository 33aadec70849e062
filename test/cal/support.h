/* What the tests of src/cal share: programs from text, expressions of them. */
#ifndef TEST_CAL_SUPPORT_H
#define TEST_CAL_SUPPORT_H

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/captured_report.h"
#include "cal/compile.h"

static inline cal_program *program_of(const char *text, captured *c) {
    cal_program *program = cal_program_create();
    const place where = {.file = "test.cal"};
    assert_non_null(program);
    assert_int_equal(cal_program_add_text(program, NULL, text, strlen(text), &where, &c->report), GRAZE_OK);
    return program;
}

/* Compiles one expression with these channels; null where that is refused. */
static inline cal_code *compile_expression(cal_program *program, const char *file, const char *text, int channels,
                                           captured *c) {
    const cal_expression expression = {.text = text};
    static const double reals[] = {5, 7, 11};
    const cal_request request = {.file = file,
                                 .expressions = &expression,
                                 .expression_count = 1,
                                 .reals = reals,
                                 .real_count = 3,
                                 .channels = channels ? CAL_CHANNEL_BITS(1, channels) : 0,
                                 .where = NULL};
    cal_code *code = NULL;
    graze_status status = cal_compile(&code, program, &request, &c->report);
    assert_int_equal(status == GRAZE_OK, code != NULL);
    return code;
}

typedef struct answer {
    cal_outcome outcome;
    double value;
    char failure[512];
} answer;

static inline answer run_code(const cal_code *code, const double *channels) {
    answer a = {.value = -1};
    void *memory = malloc(cal_memory_size(code));
    assert_non_null(memory);
    /* Nothing may depend on what is in it. */
    memset(memory, 0xa5, cal_memory_size(code));
    a.outcome = cal_evaluate(code, channels, &a.value, memory);
    if (a.outcome == CAL_FAILED)
        snprintf(a.failure, sizeof a.failure, "%s", cal_failure(code, memory));
    free(memory);
    return a;
}

/* The answer of an expression of $1, $2, $3 behind definitions. */
static inline answer answer_of(const char *definitions, const char *expression, double x, double y, double z) {
    captured c;
    captured_begin(&c);
    cal_program *program = program_of(definitions, &c);
    cal_code *code = compile_expression(program, NULL, expression, 3, &c);
    if (!code)
        print_error("%s: %s\n", expression, c.text);
    assert_non_null(code);
    const double channels[3] = {x, y, z};
    answer a = run_code(code, channels);
    cal_code_destroy(code);
    cal_program_destroy(program);
    return a;
}

static inline void assert_value(answer a, double value) {
    if (a.outcome == CAL_FAILED)
        print_error("%s\n", a.failure);
    assert_int_equal(a.outcome, CAL_FINE);
    assert_true(fabs(a.value - value) <= 1e-14 * fabs(value));
}

static inline void assert_in(const char *text, const char *wanted) {
    if (!strstr(text, wanted)) {
        print_error("\"%s\" is not in: %s\n", wanted, text);
        fail();
    }
}

#endif
