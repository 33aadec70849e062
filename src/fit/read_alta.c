/* ALTA's text: `#DIM nx ny`, `#PARAM_IN NAME`, `#PARAM_OUT NAME`, `#VS kind`, then a line a point: nx inputs, ny
 * values, and what #VS says of the values' intervals, which is left alone. Angles are in radians, the view comes before
 * the light but where the name says otherwise. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "fit/half_difference.h"
#include "fit/reader.h"

enum { INPUTS_MAX = 6, OUTPUTS_MAX = 4096, NAME_SIZE = 32 };

typedef struct alta alta;
struct alta {
    fit_reader *reader;
    size_t inputs, outputs;
    void (*convert)(alta *, const double *inputs, vec3 *light, vec3 *view); /* null: #PARAM_IN not seen */
    const char *kinds; /* of inputs: t polar angle, p azimuth, x component */
    fit_quantity quantity;
    bool colour; /* #PARAM_OUT names a colour, or nothing we know */
    char names[3];
    bool *chosen;
    double *values;
};

static void from_spherical(alta *a, const double *x, vec3 *light, vec3 *view) {
    *light = fit_reader_direction(a->reader, x[0], x[1]);
    *view = fit_reader_direction(a->reader, x[2], x[3]);
}

static void from_isotropic(alta *a, const double *x, vec3 *light, vec3 *view) {
    *view = fit_reader_direction(a->reader, x[0], 0);
    *light = fit_reader_direction(a->reader, x[1], x[2]);
}

static void from_cartesian(alta *a, const double *x, vec3 *light, vec3 *view) {
    (void)a;
    *view = vec3_make(x[0], x[1], x[2]);
    *light = vec3_make(x[3], x[4], x[5]);
}

static void from_half(alta *a, const double *x, vec3 *light, vec3 *view) {
    double half[2], difference[2];
    for (int i = 0; i < 2; i++) {
        half[i] = fit_reader_radians(a->reader, x[i]);
        difference[i] = fit_reader_radians(a->reader, x[2 + i]);
    }
    fit_from_half_difference(half, difference, view, light);
}

static void from_isotropic_half(alta *a, const double *x, vec3 *light, vec3 *view) {
    from_half(a, (const double[]){x[0], 0, x[1], x[2]}, light, view);
}

static const struct {
    const char *name;
    const char *kinds;
    void (*convert)(alta *, const double *, vec3 *, vec3 *);
} inputs_known[] = {
    {"SPHERICAL_TL_PL_TV_PV", "tptp", from_spherical}, {"ISOTROPIC_TV_TL_DPHI", "ttp", from_isotropic},
    {"CARTESIAN", "xxxxxx", from_cartesian},           {"RUSIN_TH_PH_TD_PD", "tptp", from_half},
    {"RUSIN_TH_TD_PD", "ttp", from_isotropic_half},
};

static graze_status read_input_name(alta *a, const fit_word *name) {
    fit_reader *r = a->reader;
    for (size_t i = 0; i < sizeof inputs_known / sizeof *inputs_known; i++) {
        if (!fit_word_is(name, inputs_known[i].name))
            continue;
        a->convert = inputs_known[i].convert;
        a->kinds = inputs_known[i].kinds;
        if (a->inputs != strlen(a->kinds))
            return report_error(r->report, &r->where, "%s has %zu inputs, but #DIM says %zu", inputs_known[i].name,
                                strlen(a->kinds), a->inputs);
        fit_reader_set_unit(r, a->kinds[0] == 'x' ? FIT_COMPONENTS : FIT_RADIANS, FIT_OF_FORMAT);
        return GRAZE_OK;
    }
    return fit_reader_error(
        r, name,
        "expected SPHERICAL_TL_PL_TV_PV, ISOTROPIC_TV_TL_DPHI, RUSIN_TH_PH_TD_PD, RUSIN_TH_TD_PD or "
        "CARTESIAN");
}

static graze_status read_output_name(alta *a, const fit_word *name) {
    if (fit_word_is(name, "INV_STERADIAN_COSINE_FACTOR"))
        a->quantity = FIT_TIMES_COSINE_VIEW;
    else if (fit_word_is(name, "INV_STERADIAN") || fit_word_is(name, "RGB_COLOR") || fit_word_is(name, "XYZ_COLOR"))
        a->quantity = FIT_BRDF;
    else
        return fit_reader_error(a->reader, name,
                                "expected INV_STERADIAN, INV_STERADIAN_COSINE_FACTOR, RGB_COLOR or XYZ_COLOR");
    a->colour = fit_word_is(name, "RGB_COLOR") || fit_word_is(name, "XYZ_COLOR");
    for (size_t i = 0; i < 3; i++)
        a->names[i] = fit_word_is(name, "XYZ_COLOR") ? "XYZ"[i] : "RGB"[i];
    return GRAZE_OK;
}

static graze_status read_dimensions(alta *a) {
    double inputs, outputs;
    if (a->inputs)
        return report_error(a->reader->report, &a->reader->where, "a second #DIM");
    graze_status status = fit_reader_number(a->reader, "number of inputs", &inputs);
    if (status == GRAZE_OK)
        status = fit_reader_number(a->reader, "number of values", &outputs);
    if (status != GRAZE_OK)
        return status;
    if (!(inputs >= 1 && inputs <= INPUTS_MAX) || !(outputs >= 1 && outputs <= OUTPUTS_MAX))
        return report_error(a->reader->report, &a->reader->where, "#DIM must be 1 .. %d inputs and 1 .. %d values",
                            INPUTS_MAX, OUTPUTS_MAX);
    a->inputs = (size_t)inputs;
    a->outputs = (size_t)outputs;
    return GRAZE_OK;
}

static graze_status read_comment(alta *a) {
    fit_word key, value;
    fit_reader *r = a->reader;
    if (!fit_reader_word(r, &key))
        return GRAZE_OK;
    if (fit_word_is(&key, "#DIM"))
        return read_dimensions(a);
    if (!fit_reader_word(r, &value))
        return GRAZE_OK;
    if (fit_word_is(&key, "#PARAM_IN"))
        return a->inputs ? read_input_name(a, &value)
                         : report_error(r->report, &r->where, "#PARAM_IN must come behind #DIM");
    if (fit_word_is(&key, "#PARAM_OUT"))
        return read_output_name(a, &value);
    if (fit_word_is(&key, "#FORMAT") && fit_word_is(&value, "binary"))
        return report_error(r->report, &r->where, "ALTA's binary files cannot be read, only its text");
    return GRAZE_OK;
}

/* Before the first point: what has been said by then holds. */
static graze_status begin_points(alta *a) {
    fit_reader *r = a->reader;
    if (!a->convert)
        return report_error(r->report, &r->where, "data before #DIM and #PARAM_IN");
    fit_reader_set_quantity(r, a->quantity ? a->quantity : FIT_BRDF, a->quantity ? FIT_OF_FILE : FIT_ASSUMED);
    fit_reader_set_light(r, FIT_LIGHT_INCIDENT, FIT_OF_FORMAT);
    fit_reader_set_mirror(r, FIT_MIRROR_OPPOSITE, FIT_OF_FORMAT);
    fit_word *names = calloc(a->outputs, sizeof *names);
    char *numbers = calloc(a->outputs, NAME_SIZE);
    a->chosen = calloc(a->outputs, sizeof *a->chosen);
    a->values = calloc(a->outputs, sizeof *a->values);
    graze_status status = GRAZE_OK;
    if (!names || !numbers || !a->chosen || !a->values)
        status = report_out_of_memory(r->report);
    for (size_t i = 0; i < a->outputs && status == GRAZE_OK; i++) {
        char *name = numbers + i * NAME_SIZE;
        if (a->colour && a->outputs == 3)
            name[0] = a->names[i];
        else
            snprintf(name, NAME_SIZE, "value%zu", i + 1);
        names[i] = (fit_word){name, strlen(name), 0};
    }
    if (status == GRAZE_OK)
        status = fit_reader_channels(r, names, a->outputs, a->chosen);
    free(names);
    free(numbers);
    return status;
}

static graze_status read_point(alta *a) {
    fit_reader *r = a->reader;
    double x[INPUTS_MAX];
    for (size_t i = 0; i < a->inputs; i++) {
        graze_status status = a->kinds[i] == 'x'
                                  ? fit_reader_number(r, "input", &x[i])
                                  : fit_reader_angle(r, "input", a->kinds[i] == 't' ? FIT_POLAR : FIT_AZIMUTH, &x[i]);
        if (status != GRAZE_OK)
            return status;
    }
    graze_status status = fit_reader_values(r, a->chosen, a->outputs, a->values);
    if (status != GRAZE_OK)
        return status;
    vec3 light, view;
    a->convert(a, x, &light, &view);
    return fit_reader_add(r, light, view, 1, a->values);
}

graze_status fit_read_alta(fit_reader *r) {
    alta a = {.reader = r};
    graze_status status = GRAZE_OK;
    while (status == GRAZE_OK && fit_reader_line(r)) {
        if (fit_reader_count_words(r) == 0)
            continue;
        if (r->line.text[0] == '#') {
            status = a.chosen ? GRAZE_OK : read_comment(&a);
            continue;
        }
        if (!a.chosen)
            status = begin_points(&a);
        if (status == GRAZE_OK)
            status = read_point(&a);
    }
    free(a.chosen);
    free(a.values);
    return status;
}
