/* Fuzz target: function files. Whatever they say is compiled or refused, and what is compiled comes to an end, the same
 * whatever was in memory before.
 *
 * The text up to the first zero byte is definitions in the context of a file, what follows is one expression, or the
 * name of a function, for two channels. */
#include <math.h>
#include <string.h>

#include "cal/compile.h"
#include "fuzz/target.h"

static void count_message(void *user, graze_severity severity, const char *text) {
    MUST(*text);
    *(int *)user += severity == GRAZE_ERROR;
}

static void check_code(const cal_code *code) {
    static const double channels[][2] = {{0, 1}, {-2.5, 1e10}, {3, .5}};
    size_t size = cal_memory_size(code);
    char *memory = malloc(size);
    MUST(memory && (cal_code_channels(code) & ~CAL_CHANNEL_BITS(1, 2)) == 0);
    for (int i = 0; i < 3; i++) {
        double values[2] = {NAN, NAN};
        cal_outcome outcomes[2];
        for (int k = 0; k < 2; k++) {
            memset(memory, k ? 0xff : 0x01, size);
            outcomes[k] = cal_evaluate(code, channels[i], &values[k], memory);
            if (outcomes[k] == CAL_FAILED) {
                MUST(*cal_failure(code, memory));
                break;
            }
            MUST(isfinite(values[k]));
        }
        if (outcomes[0] == CAL_FAILED)
            break;
        /* Less memory is enough, or said not to be. */
        bool cramped;
        double value = NAN;
        memset(memory, 0x7f, size);
        cal_outcome outcome =
            cal_evaluate_within(code, channels[i], &value, memory, size < 2048 ? size : 2048, &cramped);
        MUST(cramped ? size > 2048 : outcome == outcomes[0] && memcmp(&value, &values[0], sizeof value) == 0);
        MUST(outcomes[0] == outcomes[1] && memcmp(&values[0], &values[1], sizeof values[0]) == 0);
    }
    free(memory);
}

static void check_expression(cal_program *program, const char *text, int argument_count, const graze_report *report,
                             const int *errors) {
    const double reals[] = {1, -2};
    const cal_expression expression = {text, argument_count, 1};
    const cal_request request = {.file = "file.cal",
                                 .expressions = &expression,
                                 .expression_count = 1,
                                 .reals = reals,
                                 .real_count = 2,
                                 .channels = CAL_CHANNEL_BITS(1, 2)};
    cal_code *code;
    int before = *errors;
    graze_status status = cal_compile(&code, program, &request, report);
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST((*errors > before) == (status != GRAZE_OK) && (code != NULL) == (status == GRAZE_OK));
    if (code)
        check_code(code);
    cal_code_destroy(code);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    int errors = 0;
    const graze_report report = {count_message, &errors};
    char *text = malloc(size + 1);
    cal_program *program = cal_program_create();
    MUST(text && program);
    if (size)
        memcpy(text, data, size);
    text[size] = 0;
    size_t length = strlen(text);
    MUST(cal_program_add_scene_names(program, &report) == GRAZE_OK);
    graze_status status = cal_program_add_text(program, "file.cal", text, length, NULL, &report);
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST((errors > 0) == (status != GRAZE_OK));
    if (length < size) {
        check_expression(program, text + length + 1, 0, &report, &errors);
        check_expression(program, text + length + 1, 2, &report, &errors);
    }
    cal_program_destroy(program);
    free(text);
    return 0;
}
