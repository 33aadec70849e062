/* Compiling and evaluating reflectance functions. */
#include "material/reflection.h"

#include <string.h>

#include "base/number.h"
#include "material/amounts.h"

/* What they are called with: a value from data, where there are some, the direction to the light, and the light's solid
 * angle, which is 0 for us: lights are seen point by point. */
enum { DATA = MATERIAL_OWN_CHANNEL, LIGHT = DATA + 1, ARGUMENTS = 4 };

static const uint64_t CHANNELS = CAL_CHANNEL_BITS(CAL_NXP, CAL_CBP) | CAL_CHANNEL_BITS(DATA, LIGHT + ARGUMENTS - 1);

static const rgb WHITE = {1, 1, 1}, BLACK = {0, 0, 0};

static bool transmits(rad_type type) {
    return type == RAD_TRANSFUNC || type == RAD_TRANSDATA;
}

static bool has_data(rad_type type) {
    return type == RAD_PLASDATA || type == RAD_METDATA || type == RAD_TRANSDATA;
}

bool material_reflects_by_function(rad_type type) {
    return type == RAD_PLASFUNC || type == RAD_METFUNC || type == RAD_BRTDFUNC || transmits(type) || has_data(type);
}

/* `red green blue specularity`, and of those that transmit `transmission transmitted-specularity`. */
static graze_status take_shares(material_reflection *r, const rad_primitive *p, const graze_report *report) {
    const double *a = p->reals;
    graze_status status = material_check_signs(p, transmits(p->type) ? 6 : 4, report);
    if (!status)
        status = material_check_largest(p, 3, report);
    if (status)
        return status;
    if (a[3] > 1)
        return rad_primitive_error(report, p, "the specularity must be in 0 .. 1");
    if (transmits(p->type) && (a[4] > 1 || a[5] > 1))
        return rad_primitive_error(report, p, "the transmission and the transmitted specularity must be in 0 .. 1");
    if (a[0] > 1 || a[1] > 1 || a[2] > 1)
        rad_primitive_warning(report, p, "unphysical: a colour above 1 reflects more light than it receives");
    const rgb color = {a[0], a[1], a[2]};
    const double through = transmits(p->type) ? a[4] * (1 - a[3]) : 0,
                 through_function = through > 0 ? through * a[5] : 0;
    const bool metal = p->type == RAD_METFUNC || p->type == RAD_METDATA;
    r->by_function = true;
    r->color = color;
    r->front = (material_reflection_side){.diffuse = rgb_scale(1 - through - a[3], color),
                                          .ambient = rgb_scale(1 - through, color),
                                          .function = rgb_scale(a[3], metal ? color : WHITE)};
    r->back = r->front;
    r->beyond = (material_reflection_side){.diffuse = rgb_scale(through - through_function, color),
                                           .ambient = rgb_scale(through, color),
                                           .function = rgb_scale(through_function, color)};
    r->pattern_on_function = metal;
    r->pattern_on_beyond = true;
    return GRAZE_OK;
}

/* `func datafile funcfile x1 ... transform` */
static graze_status compile_data(material_reflection *r, material_library *library, const rad_primitive *p) {
    enum { FUNCTION, DATA_FILE, FILE_NAME, PLACES };
    cal_expression places[RAD_DATA_DIMENSIONS], value = {p->strings[FUNCTION], ARGUMENTS + 1, DATA};
    graze_status status = material_library_data(library, p->strings[DATA_FILE], p, &r->data);
    if (status)
        return status;
    int count = r->data->dimensions;
    status = material_owner_begin(&r->owner, library, p, FILE_NAME, (uint32_t)(PLACES + count));
    for (int i = 0; i < count && !status; i++)
        places[i] = (cal_expression){p->strings[PLACES + i], ARGUMENTS, LIGHT};
    if (!status)
        status = material_function_compile(&r->places, library, &r->owner, FILE_NAME, places, (size_t)count, CHANNELS);
    return status ? status : material_function_compile(&r->value, library, &r->owner, FILE_NAME, &value, 1, CHANNELS);
}

/* `func funcfile transform` */
static graze_status compile_function(material_reflection *r, material_library *library, const rad_primitive *p) {
    enum { FUNCTION, FILE_NAME, REST };
    const cal_expression value = {p->strings[FUNCTION], ARGUMENTS, LIGHT};
    graze_status status = material_owner_begin(&r->owner, library, p, FILE_NAME, REST);
    return status ? status : material_function_compile(&r->value, library, &r->owner, FILE_NAME, &value, 1, CHANNELS);
}

/* Nine reals are diffuse colours of the front, of the back, and of what comes through. */
static graze_status take_colors(material_reflection *r, const rad_primitive *p, const graze_report *report) {
    const double *a = p->reals;
    graze_status status = material_check_amounts(p, 9, report);
    if (status)
        return status;
    const rgb front = {a[0], a[1], a[2]}, back = {a[3], a[4], a[5]}, through = {a[6], a[7], a[8]};
    if (rgb_max(rgb_add(front, through)) > 1 || rgb_max(rgb_add(back, through)) > 1)
        rad_primitive_warning(report, p, "unphysical: what is diffuse of it adds up to more light than it receives");
    r->color = WHITE;
    r->front = (material_reflection_side){front, front, WHITE};
    r->back = (material_reflection_side){back, back, WHITE};
    r->beyond = (material_reflection_side){through, through, WHITE};
    r->keeps_normal = true;
    return GRAZE_OK;
}

static bool is_zero(const char *word) {
    double value;
    return text_to_real(word, &value) && value <= 0;
}

static bool are_zero(const char *const *words) {
    return is_zero(words[0]) && is_zero(words[1]) && is_zero(words[2]);
}

/* `rrefl grefl brefl rtrns gtrns btrns rbrtd gbrtd bbrtd funcfile transform`: expressions, then names of functions, of
 * which each may be 0. */
static graze_status compile_general(material_reflection *r, material_library *library, const rad_primitive *p) {
    enum { MIRROR, THROUGH = 3, FUNCTION = 6, FILE_NAME = 9, REST };
    cal_expression mirror[3], through[3], value[3];
    const char *const *words = p->strings;
    for (int i = 0; i < 3; i++) {
        bool none = strcmp(words[FUNCTION + i], "0") == 0;
        mirror[i] = (cal_expression){.text = words[MIRROR + i]};
        through[i] = (cal_expression){.text = words[THROUGH + i]};
        value[i] = (cal_expression){words[FUNCTION + i], none ? 0 : ARGUMENTS, LIGHT};
        r->by_function = r->by_function || !none;
    }
    r->mirrors = !are_zero(words + MIRROR);
    r->passes = !are_zero(words + THROUGH);
    graze_status status = material_owner_begin(&r->owner, library, p, FILE_NAME, REST);
    if (!status)
        status = material_function_compile(&r->mirror, library, &r->owner, FILE_NAME, mirror, 3, CHANNELS);
    if (!status)
        status = material_function_compile(&r->through, library, &r->owner, FILE_NAME, through, 3, CHANNELS);
    if (!status && r->by_function)
        status = material_function_compile(&r->value, library, &r->owner, FILE_NAME, value, 3, CHANNELS);
    return status;
}

graze_status material_reflection_compile(const material_reflection **result, material_library *library,
                                         const rad_primitive *p) {
    const graze_report *report = material_library_report(library);
    const bool general = p->type == RAD_BRTDFUNC;
    material_reflection *made = arena_allocate(material_library_memory(library), sizeof *made);
    *result = made;
    if (!made)
        return report_out_of_memory(report);
    *made = (material_reflection){.data = NULL};
    graze_status status = general ? take_colors(made, p, report) : take_shares(made, p, report);
    if (status)
        return status;
    return general             ? compile_general(made, library, p)
           : has_data(p->type) ? compile_data(made, library, p)
                               : compile_function(made, library, p);
}

static material_reflection_side under_pattern(material_reflection_side side, rgb pattern, bool on_function) {
    side.diffuse = rgb_multiply(side.diffuse, pattern);
    side.ambient = rgb_multiply(side.ambient, pattern);
    if (on_function)
        side.function = rgb_multiply(side.function, pattern);
    return side;
}

void material_reflection_sides(const material_reflection *r, rgb pattern, bool behind, material_reflection_side *above,
                               material_reflection_side *below) {
    *above = under_pattern(behind ? r->back : r->front, pattern, r->pattern_on_function);
    *below = under_pattern(r->beyond, pattern, r->pattern_on_beyond);
    if (!r->by_function)
        above->function = below->function = BLACK;
}

static void set_channels(double channels[CAL_CHANNELS_MOST], const material_reflection *r, const material_function *f,
                         const material_function *other, const material_reflection_point *at) {
    const material_owner *o = &r->owner;
    material_channels(channels, o, f, other, &at->ray);
    material_own_direction(channels, CAL_NXP, o, at->normal);
    channels[CAL_RDOTP - 1] = -vec3_dot(at->ray.direction, at->normal);
    channels[CAL_CRP - 1] = at->color.r;
    channels[CAL_CGP - 1] = at->color.g;
    channels[CAL_CBP - 1] = at->color.b;
}

static rgb values_to_rgb(const double *values) {
    return (rgb){fmax(values[0], 0), fmax(values[1], 0), fmax(values[2], 0)};
}

rgb material_reflection_value(const material_reflection *r, const material_reflection_point *at, vec3 light) {
    double channels[CAL_CHANNELS_MOST], where[RAD_DATA_DIMENSIONS], values[3];
    set_channels(channels, r, &r->value, r->data ? &r->places : NULL, at);
    material_own_direction(channels, LIGHT, &r->owner, light);
    channels[LIGHT + ARGUMENTS - 2] = 0;
    if (r->data) {
        if (!material_function_values(&r->places, &r->owner, channels, where))
            return BLACK;
        rad_data_values(r->data, &r->data->values, 1, where, &channels[DATA - 1]);
    }
    if (!material_function_values(&r->value, &r->owner, channels, values))
        return BLACK;
    return r->value.count == 1 ? rgb_gray(fmax(values[0], 0)) : values_to_rgb(values);
}

static rgb specular(const material_reflection *r, const material_function *f, const material_reflection_point *at) {
    double channels[CAL_CHANNELS_MOST], values[3];
    set_channels(channels, r, f, NULL, at);
    return material_function_values(f, &r->owner, channels, values) ? values_to_rgb(values) : BLACK;
}

rgb material_reflection_mirrored(const material_reflection *r, const material_reflection_point *at) {
    return r->mirrors ? specular(r, &r->mirror, at) : BLACK;
}

rgb material_reflection_through(const material_reflection *r, const material_reflection_point *at) {
    return r->passes ? specular(r, &r->through, at) : BLACK;
}
