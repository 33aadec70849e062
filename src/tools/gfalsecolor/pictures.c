/* Choosing and reading pictures. */
#include "tools/gfalsecolor/pictures.h"

#include <string.h>

#include "image/hdr.h"

static bool is_standard_input(const char *file) {
    return file && strcmp(file, "-") == 0;
}

static graze_status read_picture(image **picture, const char *file, const graze_report *report) {
    return is_standard_input(file) ? image_read_hdr(picture, stdin, "standard input", report)
                                   : image_read(picture, file, report);
}

/* A picture that has to be as large as the input; null: none. */
static graze_status read_second(image **picture, const char *file, const image *input, const graze_report *report) {
    if (!file)
        return GRAZE_OK;
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
    int standard = is_standard_input(*file) + is_standard_input(o->background) + is_standard_input(o->reference);
    return standard > 1 ? report_error(report, NULL, "standard input can be only one of the pictures") : GRAZE_OK;
}

graze_status false_color_pictures_read(false_color_pictures *p, const false_color_options *o,
                                       const tool_arguments *arguments, const graze_report *report) {
    const char *input = NULL;
    *p = (false_color_pictures){NULL, NULL, NULL};
    graze_status status = choose_input(o, arguments, &input, report);
    if (status == GRAZE_OK)
        status = read_picture(&p->input, input, report);
    if (status == GRAZE_OK)
        status = read_second(&p->background, o->background, p->input, report);
    if (status == GRAZE_OK)
        status = read_second(&p->reference, o->reference, p->input, report);
    return status;
}

void false_color_pictures_destroy(false_color_pictures *p) {
    image_destroy(p->input);
    image_destroy(p->background);
    image_destroy(p->reference);
}
