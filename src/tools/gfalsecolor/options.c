/* Reading and checking gfalsecolor's options. */
#include "tools/gfalsecolor/options.h"

#include <math.h>
#include <string.h>

#include "image/color.h"

static const double smallest_scale = 1e-30, largest_scale = 1e30;

/* For an option that takes one word. */
static graze_status check_word(const char *name, const char *suffix, int count, const char *needed,
                               const graze_report *report) {
    if (*suffix)
        return report_error(report, NULL, "unknown option '%s%s'; try --help", name, suffix);
    return count < 1 ? report_error(report, NULL, "option '%s' needs %s", name, needed) : GRAZE_OK;
}

static graze_status take_count(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    count_option *o = target;
    graze_status status = check_word(o->name, suffix, count, "a whole number or auto", report);
    if (status != GRAZE_OK)
        return status;
    *used = 1;
    if (strcmp(words[0], "auto") == 0)
        o->value = AUTOMATIC;
    else if (!text_to_integer(words[0], &o->value) || o->value < 0 || o->value > o->largest)
        return report_error(report, NULL, "option '%s' needs auto or a whole number from 0 to %d, not '%s'", o->name,
                            o->largest, words[0]);
    return GRAZE_OK;
}

static void print_count(void *target, FILE *out) {
    const count_option *o = target;
    if (o->value == AUTOMATIC)
        fprintf(out, "%s auto", o->name);
    else
        fprintf(out, "%s %d", o->name, o->value);
}

static graze_status take_scale(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    false_color_options *o = target;
    graze_status status = check_word("-s", suffix, count, "a number, auto or default", report);
    if (status != GRAZE_OK)
        return status;
    *used = 1;
    /* As in Radiance, the first letter is enough. */
    if (strcmp(words[0], "auto") == 0 || strcmp(words[0], "a") == 0)
        o->scale = SCALE_AUTO;
    else if (strcmp(words[0], "default") == 0)
        o->scale = SCALE_DEFAULT;
    else if (text_to_real(words[0], &o->scale_end) && o->scale_end >= smallest_scale && o->scale_end <= largest_scale)
        o->scale = SCALE_GIVEN;
    else
        return report_error(report, NULL, "option '-s' needs auto, default or a number from %g to %g, not '%s'",
                            smallest_scale, largest_scale, words[0]);
    return GRAZE_OK;
}

static void print_scale(void *target, FILE *out) {
    const false_color_options *o = target;
    char number[NUMBER_TEXT_SIZE];
    number_print_exact(number, o->scale_end);
    fprintf(out, "-s %s", o->scale == SCALE_GIVEN ? number : o->scale == SCALE_AUTO ? "auto" : "default");
}

static const struct {
    char letter;
    image_false_color_style style;
} styles[] = {{'l', IMAGE_FALSE_COLOR_LINES},
              {'b', IMAGE_FALSE_COLOR_BANDS},
              {'p', IMAGE_FALSE_COLOR_POSTER},
              {'0', IMAGE_FALSE_COLOR_NONE}};

static graze_status take_style(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    (void)count, (void)words, (void)used;
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++)
        if (suffix[0] == styles[i].letter && !suffix[1]) {
            *(image_false_color_style *)target = styles[i].style;
            return GRAZE_OK;
        }
    return report_error(report, NULL, "unknown option '-c%s'; known are -cl, -cb, -cp and -c0", suffix);
}

static void print_style(void *target, FILE *out) {
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++)
        if (*(image_false_color_style *)target == styles[i].style)
            fprintf(out, "-c%c", styles[i].letter);
}

static graze_status refuse_expression(void *target, const char *suffix, int count, const char *const *words, int *used,
                                      const graze_report *report) {
    (void)count, (void)words, (void)used;
    if (*suffix)
        return report_error(report, NULL, "unknown option '%s%s'; try --help", (const char *)target, suffix);
    return report_error(report, NULL, "-r, -g and -b, expressions for colours, are not supported; -pal has palettes");
}

false_color_options false_color_options_default(void) {
    return (false_color_options){.decimals = {"-d", 20, AUTOMATIC},
                                 .legend_width = {"-lw", 10000, AUTOMATIC},
                                 .legend_height = {"-lh", 10000, AUTOMATIC},
                                 .multiplier = IMAGE_LUMINOUS_EFFICACY,
                                 .divisions = 8,
                                 .style = IMAGE_FALSE_COLOR_SMOOTH};
}

void false_color_options_table(false_color_options *o, option table[FALSE_COLOR_OPTION_COUNT]) {
    const option options[FALSE_COLOR_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "Pictures", 0, 0, NULL, NULL},
        {"-i", OPTION_TEXT, &o->input, "FILE", "the picture whose values are shown; also given as operand", 0, 0, NULL,
         NULL},
        {"-p", OPTION_TEXT, &o->background, "FILE", "the picture that -cl, -cb or -c0 draw on", 0, 0, NULL, NULL},
        {"-ip", OPTION_TEXT, &o->input_and_background, "FILE", "one picture for both", 0, 0, NULL, NULL},
        {"--relative-difference", OPTION_TEXT, &o->reference, "FILE", "show (A-B)/B, with B this picture", 0, 0, NULL,
         NULL},
        {"-o", OPTION_TEXT, &o->output, "FILE", "write FILE.png, .hdr ... instead of HDR to standard output", 0, 0,
         NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Values", 0, 0, NULL, NULL},
        {"-s", OPTION_CUSTOM, o, "V|auto|default",
         "the scale's end; auto: by the picture; default: 1000, in differences auto", 0, 0, take_scale, print_scale},
        {"-log", OPTION_REAL, &o->decades, "D", "logarithmic, over D powers of ten; 0: linear; not for differences", 0,
         60, NULL, NULL},
        {"-m", OPTION_REAL, &o->multiplier, "M", "values are M times brightness; differences are the same for any",
         1e-30, 1e30, NULL, NULL},
        {"-n", OPTION_INTEGER, &o->divisions, "N", "divisions of the scale", 1, 256, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Looks", 0, 0, NULL, NULL},
        {"-c", OPTION_SUFFIX, &o->style, "X", "-cl lines, -cb bands, -cp steps of colour, -c0 no colour", 0, 0,
         take_style, print_style},
        {"-pal", OPTION_TEXT, &o->palette, "NAME",
         "def, in differences diverging; spec pm3d hot eco tbo viridis gray vivid", 0, 0, NULL, NULL},
        {"-palettes", OPTION_FLAG, &o->palettes, NULL, "show all palettes, and nothing else", 0, 0, NULL, NULL},
        {"-e", OPTION_FLAG, &o->extrema, NULL, "mark the largest and the smallest value", 0, 0, NULL, NULL},
        {"--exposure", OPTION_REAL, &o->exposure, "E", "factor for the picture drawn on; 0: by the picture", 0,
         INFINITY, NULL, NULL},
        {"-l", OPTION_TEXT, &o->label, "TEXT", "the legend's label; else cd/m2, in differences (A-B)/B", 0, 0, NULL,
         NULL},
        {"-lw", OPTION_CUSTOM, &o->legend_width, "N|auto", "the legend's width; 0: no legend", 0, 0, take_count,
         print_count},
        {"-lh", OPTION_CUSTOM, &o->legend_height, "N|auto", "the legend's height; 0: no legend", 0, 0, take_count,
         print_count},
        {"-d", OPTION_CUSTOM, &o->decimals, "N|auto", "decimals in the legend, at most", 0, 0, take_count, print_count},
        {"-r", OPTION_CUSTOM, "-r", NULL, NULL, 0, 0, refuse_expression, NULL},
        {"-g", OPTION_CUSTOM, "-g", NULL, NULL, 0, 0, refuse_expression, NULL},
        {"-b", OPTION_CUSTOM, "-b", NULL, NULL, 0, 0, refuse_expression, NULL},
    };
    memcpy(table, options, sizeof options);
}

/* What is drawn on must be there, and be seen. */
static graze_status check_background(const false_color_options *o, const graze_report *report) {
    bool seen = o->style == IMAGE_FALSE_COLOR_LINES || o->style == IMAGE_FALSE_COLOR_BANDS ||
                o->style == IMAGE_FALSE_COLOR_NONE;
    if (o->background && o->input_and_background)
        return report_error(report, NULL, "-p and -ip both name the picture to draw on");
    if (o->background && !seen)
        return report_error(report, NULL, "-p would not be seen: it needs -cl, -cb or -c0, which leave it visible");
    if (o->exposure > 0 && (!seen || (!o->background && !o->input_and_background)))
        return report_error(report, NULL,
                            "--exposure is for the picture drawn on: it needs -p or -ip, and -cl, -cb "
                            "or -c0, which leave it visible");
    return GRAZE_OK;
}

graze_status false_color_options_check(const false_color_options *o, const graze_report *report) {
    graze_status status = check_background(o, report);
    if (status != GRAZE_OK)
        return status;
    if (o->reference && o->decades > 0)
        return report_error(report, NULL, "-log is not for --relative-difference, which may be negative");
    return o->output ? image_check_writable(o->output, report) : GRAZE_OK;
}

const image_palette *false_color_options_palette(const false_color_options *o, const graze_report *report) {
    const char *name = o->palette ? o->palette : o->reference ? "diverging" : "def";
    const image_palette *palette = image_palette_find(name);
    if (!palette) {
        char known[256];
        image_palette_list(known, sizeof known);
        report_error(report, NULL, "unknown palette '%s'; known are %s", name, known);
    }
    return palette;
}
