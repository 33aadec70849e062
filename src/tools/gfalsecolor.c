/* gfalsecolor: a picture's luminances as colours, in falsecolor's manners. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/false_color.h"
#include "image/hdr.h"
#include "tools/common/tool.h"

/* A number, or `auto`. */
typedef struct automatic {
    const char *name;
    double low, high; /* the range of the number */
    bool given;       /* else by itself */
    double value;
} automatic;

typedef struct false_color_options {
    const char *input, *background, *input_and_background, *reference, *output, *label, *palette;
    automatic scale, decimals, legend_width, legend_height;
    bool scale_is_default, palettes, extrema;
    double decades, multiplier, exposure;
    int divisions;
    image_false_color_style style;
} false_color_options;

static graze_status take_automatic(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    automatic *a = target;
    if (*suffix)
        return report_error(report, NULL, "unknown option '%s%s'; try --help", a->name, suffix);
    if (count < 1)
        return report_error(report, NULL, "option '%s' needs a number, or auto", a->name);
    *used = 1;
    /* As in Radiance, the first letter is enough. */
    a->given = words[0][0] != 'a';
    if (a->given && (!text_to_real(words[0], &a->value) || a->value < a->low || a->value > a->high))
        return report_error(report, NULL, "option '%s' needs auto or a number from %g to %g, not '%s'", a->name, a->low,
                            a->high, words[0]);
    return GRAZE_OK;
}

static void print_automatic(void *target, FILE *out) {
    const automatic *a = target;
    char number[NUMBER_TEXT_SIZE];
    number_print_exact(number, a->value);
    fprintf(out, "%s %s", a->name, a->given ? number : "auto");
}

static graze_status take_scale(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    false_color_options *o = target;
    o->scale_is_default = false;
    return take_automatic(&o->scale, suffix, count, words, used, report);
}

static void print_scale(void *target, FILE *out) {
    print_automatic(&((false_color_options *)target)->scale, out);
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
    (void)count, (void)words;
    *used = 0;
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

/* --- Pictures ------------------------------------------------------------------------------------------------------
 */

typedef struct pictures {
    image *input, *background, *reference;
} pictures;

static bool is_standard_input(const char *file) {
    return !strcmp(file, "-");
}

static graze_status read_picture(image **picture, const char *file, const graze_report *report) {
    return is_standard_input(file) ? image_read_hdr(picture, stdin, "standard input", report)
                                   : image_read(picture, file, report);
}

/* A picture that has to be as large as the input. */
static graze_status read_second(image **picture, const char *file, const image *input, const graze_report *report) {
    graze_status status = read_picture(picture, file, report);
    if (status != GRAZE_OK)
        return status;
    if ((*picture)->width != input->width || (*picture)->height != input->height)
        return report_error(report, &(place){.file = file}, "the picture is %d x %d pixels large, the input %d x %d",
                            (*picture)->width, (*picture)->height, input->width, input->height);
    return GRAZE_OK;
}

/* The one picture whose values are shown. */
static graze_status choose_input(const false_color_options *o, const tool_arguments *arguments, const char **file,
                                 const graze_report *report) {
    int count = (o->input != NULL) + (o->input_and_background != NULL) + arguments->operand_count;
    if (count > 1)
        return report_error(report, NULL, "only one picture can be shown, and options stand before it; try --help");
    *file = o->input                       ? o->input
            : o->input_and_background      ? o->input_and_background
            : arguments->operand_count > 0 ? arguments->operands[0]
                                           : "-";
    int standard = is_standard_input(*file) + (o->background && is_standard_input(o->background)) +
                   (o->reference && is_standard_input(o->reference));
    return standard > 1 ? report_error(report, NULL, "standard input can be only one of the pictures") : GRAZE_OK;
}

static graze_status read_pictures(pictures *p, const false_color_options *o, const char *input,
                                  const graze_report *report) {
    graze_status status = read_picture(&p->input, input, report);
    if (status == GRAZE_OK && o->background)
        status = read_second(&p->background, o->background, p->input, report);
    if (status == GRAZE_OK && o->reference)
        status = read_second(&p->reference, o->reference, p->input, report);
    if (p->background)
        p->background->display_exposure = o->exposure;
    else if (p->input)
        p->input->display_exposure = o->exposure;
    return status;
}

/* --- Drawing -------------------------------------------------------------------------------------------------------
 */

static graze_status check_options(const false_color_options *o, const image_palette **palette,
                                  const graze_report *report) {
    const char *name = o->palette ? o->palette : o->reference ? "diverging" : "def";
    *palette = image_palette_find(name);
    if (!*palette) {
        char known[256];
        image_palette_list(known, sizeof known);
        return report_error(report, NULL, "unknown palette '%s'; known are %s", name, known);
    }
    if (o->reference && o->decades > 0)
        return report_error(report, NULL, "-log is not for --relative-difference, which may be negative");
    if (o->background && o->input_and_background)
        return report_error(report, NULL, "-p and -ip both name the picture to draw on");
    return o->output ? image_check_writable(o->output, report) : GRAZE_OK;
}

/* Around 0, as far as -s says or as nearly all values go. */
static bool difference_scale(const false_color_options *o, const image_values *values, image_value_scale *scale) {
    /* Where there is no difference at all, a hundredth would be one. */
    static const double least = 0.01;
    double usual = o->scale.value;
    if (o->scale_is_default || !o->scale.given) {
        if (!image_values_usual_size(values, &usual))
            return false;
        usual = image_scale_round_up(2 * fmax(usual, least), o->divisions) / 2;
    }
    *scale = (image_value_scale){-usual, usual, 0, o->divisions};
    return true;
}

static image_value_scale luminance_scale(const false_color_options *o, const image_values *values) {
    double high = o->scale.value;
    if (!o->scale.given) {
        double largest = image_values_largest(values);
        high = largest > 0 ? image_scale_round_up(largest, o->divisions) : 1;
    }
    return (image_value_scale){0, high, o->decades, o->divisions};
}

static bool draw_values(image_canvas *canvas, const false_color_options *o, const pictures *p,
                        const image_palette *palette, const image_values *values) {
    image_false_color f = {.style = o->style,
                           .palette = palette,
                           .label = o->label       ? o->label
                                    : o->reference ? "(A-B)/B"
                                                   : "cd/m2",
                           .decimals = o->decimals.given ? (int)o->decimals.value : -1,
                           .legend_width = o->legend_width.given ? (int)o->legend_width.value : -1,
                           .legend_height = o->legend_height.given ? (int)o->legend_height.value : -1,
                           .extrema = o->extrema,
                           .missing = "B = 0"};
    if (!o->reference)
        f.scale = luminance_scale(o, values);
    else if (!difference_scale(o, values, &f.scale))
        return false;
    return image_draw_false_color(canvas, values, o->input_and_background ? p->input : p->background, &f);
}

static bool draw(image_canvas *canvas, const false_color_options *o, const pictures *p, const image_palette *palette) {
    image_values values;
    bool good = o->reference ? image_relative_difference(&values, p->input, p->reference)
                             : image_values_of(&values, p->input, o->multiplier);
    if (!good)
        return false;
    good = draw_values(canvas, o, p, palette, &values);
    image_values_free(&values);
    return good;
}

static graze_status write_canvas(const image_canvas *canvas, const false_color_options *o, double pixel_aspect,
                                 const tool_arguments *arguments, const graze_report *report) {
    char command[2000];
    options_command_line(command, sizeof command, arguments->argc, arguments->argv);
    image header = {.pixel_aspect = pixel_aspect, .command = command, .software = "Graze " GRAZE_VERSION};
    return o->output ? image_canvas_write(canvas, &header, o->output, report)
                     : image_canvas_write_hdr(canvas, &header, stdout, "standard output", report);
}

static graze_status show_palettes(const false_color_options *o, const tool_arguments *arguments,
                                  const graze_report *report) {
    image_canvas canvas;
    graze_status status =
        image_draw_palettes(&canvas) ? write_canvas(&canvas, o, 1, arguments, report) : report_out_of_memory(report);
    image_canvas_free(&canvas);
    return status;
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *report) {
    const false_color_options *o = user;
    const image_palette *palette;
    const char *input = NULL;
    pictures p = {NULL, NULL, NULL};
    image_canvas canvas = {0, 0, NULL};
    graze_status status = check_options(o, &palette, report);
    if (status == GRAZE_OK && o->palettes)
        return show_palettes(o, arguments, report);
    if (status == GRAZE_OK)
        status = choose_input(o, arguments, &input, report);
    if (status == GRAZE_OK)
        status = read_pictures(&p, o, input, report);
    if (status == GRAZE_OK && !draw(&canvas, o, &p, palette))
        status = report_out_of_memory(report);
    if (status == GRAZE_OK)
        status = write_canvas(&canvas, o, p.input->pixel_aspect, arguments, report);
    image_canvas_free(&canvas);
    image_destroy(p.input);
    image_destroy(p.background);
    image_destroy(p.reference);
    return status;
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("gfalsecolor");
    false_color_options o = {.scale = {"-s", 1e-30, 1e30, true, 1000},
                             .scale_is_default = true,
                             .decimals = {"-d", 0, 20, false, 0},
                             .legend_width = {"-lw", 0, 10000, false, 0},
                             .legend_height = {"-lh", 0, 10000, false, 0},
                             .multiplier = 179,
                             .divisions = 8,
                             .style = IMAGE_FALSE_COLOR_SMOOTH};
    const option table[] = {
        {"", OPTION_HEADING, NULL, NULL, "Pictures", 0, 0, NULL, NULL},
        {"-i", OPTION_TEXT, &o.input, "FILE", "the picture whose values are shown; also given as operand", 0, 0, NULL,
         NULL},
        {"-p", OPTION_TEXT, &o.background, "FILE", "the picture that lines and bands are drawn on", 0, 0, NULL, NULL},
        {"-ip", OPTION_TEXT, &o.input_and_background, "FILE", "one picture for both", 0, 0, NULL, NULL},
        {"--relative-difference", OPTION_TEXT, &o.reference, "FILE", "show (A-B)/B, with B this picture", 0, 0, NULL,
         NULL},
        {"-o", OPTION_TEXT, &o.output, "FILE", "write FILE.png, .hdr ... instead of HDR to standard output", 0, 0, NULL,
         NULL},
        {"", OPTION_HEADING, NULL, NULL, "Values", 0, 0, NULL, NULL},
        {"-s", OPTION_CUSTOM, &o, "V", "the scale's upper end, or auto: by the picture", 0, 0, take_scale, print_scale},
        {"-log", OPTION_REAL, &o.decades, "D", "logarithmic, over D powers of ten; 0: linear", 0, 60, NULL, NULL},
        {"-m", OPTION_REAL, &o.multiplier, "M", "values are M times brightness", 1e-30, 1e30, NULL, NULL},
        {"-n", OPTION_INTEGER, &o.divisions, "N", "divisions of the scale", 1, 256, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Looks", 0, 0, NULL, NULL},
        {"-c", OPTION_CUSTOM, &o.style, "X", "-cl lines, -cb bands, -cp steps of colour, -c0 no colour", 0, 0,
         take_style, print_style},
        {"-pal", OPTION_TEXT, &o.palette, "NAME", "def spec pm3d hot eco tbo viridis gray diverging", 0, 0, NULL, NULL},
        {"-palettes", OPTION_FLAG, &o.palettes, NULL, "show all palettes, and nothing else", 0, 0, NULL, NULL},
        {"-e", OPTION_FLAG, &o.extrema, NULL, "mark the brightest and the darkest pixel", 0, 0, NULL, NULL},
        {"--exposure", OPTION_REAL, &o.exposure, "E", "factor for the picture drawn on; 0: by the picture", 0, INFINITY,
         NULL, NULL},
        {"-l", OPTION_TEXT, &o.label, "TEXT", "the legend's label", 0, 0, NULL, NULL},
        {"-lw", OPTION_CUSTOM, &o.legend_width, "N", "the legend's width; 0: none; auto", 0, 0, take_automatic,
         print_automatic},
        {"-lh", OPTION_CUSTOM, &o.legend_height, "N", "the legend's height; 0: none; auto", 0, 0, take_automatic,
         print_automatic},
        {"-d", OPTION_CUSTOM, &o.decimals, "N", "decimals in the legend, at most; auto", 0, 0, take_automatic,
         print_automatic},
        {"-r", OPTION_CUSTOM, "-r", NULL, NULL, 0, 0, refuse_expression, NULL},
        {"-g", OPTION_CUSTOM, "-g", NULL, NULL, 0, 0, refuse_expression, NULL},
        {"-b", OPTION_CUSTOM, "-b", NULL, NULL, 0, 0, refuse_expression, NULL},
    };
    option_table options = {.program = "gfalsecolor",
                            .synopsis = "[options] [picture]",
                            .summary = "Shows a picture's luminances, or how two pictures differ, as colours.",
                            .options = table,
                            .count = sizeof table / sizeof *table};
    return tool_main(&options, argc, argv, &report, run, &o);
}
