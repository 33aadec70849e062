/* From options and pictures to values, their scale, and a drawing. */
#include "tools/gfalsecolor/drawing.h"

#include <math.h>

static const double default_luminance = 1000; /* cd/m^2, as in Radiance */

static image_value_scale luminance_scale(const false_color_options *o, const image_values *values) {
    double high = o->scale == SCALE_GIVEN ? o->scale_end : default_luminance;
    if (o->scale == SCALE_AUTO) {
        double largest = image_values_largest(values);
        high = largest > 0 ? image_scale_round_up(largest, o->divisions) : 1;
    }
    return (image_value_scale){0, high, o->decades, o->divisions};
}

/* Around 0, as far as -s says or as nearly all values go. */
static bool difference_scale(const false_color_options *o, const image_values *values, image_value_scale *scale) {
    /* Where there is no difference at all, a hundredth would be one. */
    static const double least = 0.01;
    double end = o->scale_end, usual;
    if (o->scale != SCALE_GIVEN) {
        if (!image_values_usual_size(values, &usual))
            return false;
        end = image_scale_round_up(2 * fmax(usual, least), o->divisions) / 2;
    }
    *scale = (image_value_scale){-end, end, 0, o->divisions};
    return true;
}

static bool draw_values(image_canvas *canvas, const false_color_options *o, const false_color_pictures *p,
                        const image_palette *palette, const image_values *values) {
    image *background = o->input_and_background ? p->input : p->background;
    image_false_color f = {.style = o->style,
                           .palette = palette,
                           .label = o->label       ? o->label
                                    : o->reference ? "(A-B)/B"
                                                   : "cd/m2",
                           .decimals = o->decimals.value,
                           .legend_width = o->legend_width.value,
                           .legend_height = o->legend_height.value,
                           .extrema = o->extrema,
                           .missing = "B = 0"};
    if (background)
        background->display_exposure = o->exposure;
    if (!o->reference)
        f.scale = luminance_scale(o, values);
    else if (!difference_scale(o, values, &f.scale))
        return false;
    return image_draw_false_color(canvas, values, background, &f);
}

bool false_color_draw(image_canvas *canvas, const false_color_options *o, const false_color_pictures *p,
                      const image_palette *palette) {
    image_values values;
    bool drawn = o->reference ? image_relative_difference(&values, p->input, p->reference)
                              : image_values_of(&values, p->input, o->multiplier);
    if (!drawn)
        return false;
    drawn = draw_values(canvas, o, p, palette, &values);
    image_values_free(&values);
    return drawn;
}
