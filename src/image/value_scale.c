/* Scales and their numbers. */
#include "image/value_scale.h"

#include <math.h>
#include <string.h>

/* More decimals than this read badly; numbers get an exponent then. */
enum { LARGEST_DECIMALS = 5, PRINTED_DIGITS = 6 };
static const double nearly = 1e-9;

double image_scale_position(const image_value_scale *scale, double value) {
    if (scale->decades == 0)
        return (value - scale->low) / (scale->high - scale->low);
    /* What is black is below any scale. */
    return value > 0 ? 1 + log10(value / scale->high) / scale->decades : -1;
}

double image_scale_value(const image_value_scale *scale, int i) {
    double at = (double)i / scale->divisions;
    return scale->decades == 0 ? scale->low + at * (scale->high - scale->low)
                               : scale->high * pow(10, scale->decades * (at - 1));
}

double image_scale_round_up(double value, int divisions) {
    static const double steps[] = {1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    if (!(value > 0))
        return 0;
    double power = pow(10, floor(log10(value / divisions)));
    size_t i = 0;
    while (i + 1 < sizeof steps / sizeof *steps && steps[i] * power * divisions < value * (1 - nearly))
        i++;
    return steps[i] * power * divisions;
}

/* Decimals that tell three digits of the value; negative for large ones. */
static int decimals_of_three_digits(double value) {
    return 2 - (int)floor(log10(fabs(value)));
}

static double round_to(double value, int decimals) {
    double unit = pow(10, -decimals);
    return round(value / unit) * unit;
}

/* As few decimals as write down the step, if that takes no more than three of its digits. */
static int decimals_of_step(double step) {
    int most = decimals_of_three_digits(step), decimals = 0;
    while (decimals < most && fabs(round_to(step, decimals) - step) > nearly * step)
        decimals++;
    return decimals;
}

/* Zeros up to that many decimals, for numbers in a column. */
static void fill_decimals(char text[NUMBER_TEXT_SIZE], int decimals) {
    if (decimals <= 0 || strchr(text, 'e'))
        return;
    size_t length = strlen(text);
    const char *point = strchr(text, '.');
    int there = point ? (int)(text + length - point) - 1 : 0;
    if (!point)
        text[length++] = '.';
    for (; there < decimals && length < NUMBER_TEXT_SIZE - 1; there++)
        text[length++] = '0';
    text[length] = 0;
}

static void print(double value, char *text) {
    number_print(text, PRINTED_DIGITS, value + 0.); /* no negative zero */
}

void image_three_digits_text(double value, char text[IMAGE_SCALE_TEXT]) {
    print(value == 0 || !isfinite(value) ? value : round_to(value, decimals_of_three_digits(value)), text);
}

void image_scale_text(const image_value_scale *scale, int i, int decimals, char text[IMAGE_SCALE_TEXT]) {
    double value = image_scale_value(scale, i);
    if (scale->decades > 0) {
        int own = decimals_of_three_digits(value);
        print(round_to(value, decimals >= 0 && decimals < own ? decimals : own), text);
        return;
    }
    double step = (scale->high - scale->low) / scale->divisions;
    int own = decimals_of_step(step), used = decimals >= 0 && decimals < own ? decimals : own;
    value = round_to(value, used);
    if (scale->low < 0 && value > 0)
        *text++ = '+';
    print(value, text);
    if (used <= LARGEST_DECIMALS)
        fill_decimals(text, used);
}
