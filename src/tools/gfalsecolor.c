/* gfalsecolor: a picture's luminances as colours, in falsecolor's manners. */
#include "image/palette_chart.h"
#include "tools/common/picture_header.h"
#include "tools/gfalsecolor/drawing.h"

static graze_status write_canvas(const image_canvas *canvas, const false_color_options *o, double pixel_aspect,
                                 const tool_arguments *arguments, const graze_report *report) {
    image header = {.pixel_aspect = pixel_aspect};
    picture_header text;
    picture_header_set(&text, &header, arguments);
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

static graze_status show_pictures(const false_color_options *o, const image_palette *palette,
                                  const tool_arguments *arguments, const graze_report *report) {
    false_color_pictures pictures;
    image_canvas canvas = {0, 0, NULL};
    graze_status status = false_color_pictures_read(&pictures, o, arguments, report);
    if (status == GRAZE_OK && !false_color_draw(&canvas, o, &pictures, palette))
        status = report_out_of_memory(report);
    if (status == GRAZE_OK)
        status = write_canvas(&canvas, o, pictures.input->pixel_aspect, arguments, report);
    image_canvas_free(&canvas);
    false_color_pictures_destroy(&pictures);
    return status;
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *report) {
    const false_color_options *o = user;
    const image_palette *palette = false_color_options_palette(o, report);
    if (!palette)
        return GRAZE_INPUT_ERROR;
    graze_status status = false_color_options_check(o, report);
    if (status != GRAZE_OK)
        return status;
    return o->palettes ? show_palettes(o, arguments, report) : show_pictures(o, palette, arguments, report);
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("gfalsecolor");
    false_color_options o = false_color_options_default();
    option table[FALSE_COLOR_OPTION_COUNT];
    false_color_options_table(&o, table);
    option_table options = {.program = "gfalsecolor",
                            .synopsis = "[options] [picture]",
                            .summary = "Shows a picture's luminances, or how two pictures differ, as colours.",
                            .options = table,
                            .count = FALSE_COLOR_OPTION_COUNT};
    return tool_main(&options, argc, argv, &report, run, &o);
}
