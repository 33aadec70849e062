/* Fuzz target: numbers from text against a grammar spelled out here and against strtod; and printed, against printf. */
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "fuzz/number_text.h"
#include "fuzz/target.h"

/* `text` has exactly `size` bytes, with nothing behind them. */
static void scan(const char *text, size_t size) {
    double value = -12345;
    const char *end = number_scan(text, text + size, &value);
    size_t length = number_text_length(text, size);
    MUST(end == (length > 0 ? text + length : NULL));
    if (!end)
        return;
    char *copy = malloc(length + 1);
    if (!copy)
        return;
    memcpy(copy, text, length);
    copy[length] = 0;
    MUST(number_text_same_bits(value, strtod(copy, NULL)));
    double real = -12345;
    MUST(text_to_real(copy, &real) == (isfinite(value) != 0));
    MUST(number_text_same_bits(real, isfinite(value) ? value : -12345));
    free(copy);
}

static void print(double value) {
    char ours[NUMBER_TEXT_SIZE], theirs[NUMBER_TEXT_SIZE];
    if (!isfinite(value))
        return;
    for (int digits = 0; digits <= 17; digits++) {
        size_t length = number_print(ours, digits, value);
        if (digits > 0)
            snprintf(theirs, sizeof theirs, "%.*g", digits, value);
        else
            snprintf(theirs, sizeof theirs, "%e", value);
        MUST(length == strlen(ours) && strcmp(ours, theirs) == 0);
    }
    double again;
    size_t length = number_print_exact(ours, value);
    MUST(length == strlen(ours) && number_scan(ours, ours + length, &again) == ours + length &&
         number_text_same_bits(again, value));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    scan((const char *)data, size);
    /* Every text within, too: the quick way reads eight bytes at a time. */
    for (size_t i = 1; i < size && i < 64; i++)
        scan((const char *)data + i, size - i);
    double value;
    for (size_t i = 0; i + sizeof value <= size && i < 64; i += sizeof value) {
        memcpy(&value, data + i, sizeof value);
        print(value);
    }
    return 0;
}
