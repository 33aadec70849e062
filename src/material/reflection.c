/* Compiling and evaluating reflectance functions. */
#include "material/reflection.h"

/* What they are called with: a value from data, where there are some, the direction to the light, and the light's solid
 * angle, which is 0 for us: lights are seen point by point. */
enum { DATA = MATERIAL_OWN_CHANNEL, LIGHT = DATA + 1, ARGUMENTS = 4 };

bool material_reflects_by_function(rad_type type) {
    return type == RAD_PLASFUNC || type == RAD_METFUNC || type == RAD_PLASDATA || type == RAD_METDATA;
}

static graze_status take_reals(material_reflection *r, const rad_primitive *p, const graze_report *report) {
    for (uint32_t i = 0; i < 4; i++)
        if (!(p->reals[i] >= 0))
            return rad_primitive_error(report, p, "real argument %u is negative", (unsigned)i + 1);
    if (p->reals[3] > 1)
        return rad_primitive_error(report, p, "the specularity must be in 0 .. 1");
    if (p->reals[0] > 1 || p->reals[1] > 1 || p->reals[2] > 1)
        rad_primitive_warning(report, p, "unphysical: a colour above 1 reflects more light than it receives");
    r->color = (rgb){p->reals[0], p->reals[1], p->reals[2]};
    r->specularity = p->reals[3];
    r->metal = p->type == RAD_METFUNC || p->type == RAD_METDATA;
    return GRAZE_OK;
}

/* `func datafile funcfile x1 ... transform` */
static graze_status compile_data(material_reflection *r, material_library *library, const rad_primitive *p,
                                 uint64_t channels) {
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
        status = material_function_compile(&r->places, library, &r->owner, FILE_NAME, places, (size_t)count, channels);
    return status ? status : material_function_compile(&r->value, library, &r->owner, FILE_NAME, &value, 1, channels);
}

/* `func funcfile transform` */
static graze_status compile_function(material_reflection *r, material_library *library, const rad_primitive *p,
                                     uint64_t channels) {
    enum { FUNCTION, FILE_NAME, REST };
    const cal_expression value = {p->strings[FUNCTION], ARGUMENTS, LIGHT};
    graze_status status = material_owner_begin(&r->owner, library, p, FILE_NAME, REST);
    return status ? status : material_function_compile(&r->value, library, &r->owner, FILE_NAME, &value, 1, channels);
}

graze_status material_reflection_compile(const material_reflection **result, material_library *library,
                                         const rad_primitive *p) {
    const uint64_t channels = CAL_CHANNEL_BITS(CAL_NXP, CAL_CBP) | CAL_CHANNEL_BITS(DATA, LIGHT + ARGUMENTS - 1);
    material_reflection *made = arena_allocate(material_library_memory(library), sizeof *made);
    *result = made;
    if (!made)
        return report_out_of_memory(material_library_report(library));
    *made = (material_reflection){.data = NULL};
    graze_status status = take_reals(made, p, material_library_report(library));
    if (status)
        return status;
    bool has_data = p->type == RAD_PLASDATA || p->type == RAD_METDATA;
    return has_data ? compile_data(made, library, p, channels) : compile_function(made, library, p, channels);
}

double material_reflection_value(const material_reflection *r, const material_reflection_point *at, vec3 light) {
    double channels[CAL_CHANNELS_MOST], where[RAD_DATA_DIMENSIONS], value;
    const material_owner *o = &r->owner;
    material_channels(channels, o, &r->value, r->data ? &r->places : NULL, &at->ray);
    material_own_direction(channels, CAL_NXP, o, at->normal);
    channels[CAL_RDOTP - 1] = -vec3_dot(at->ray.direction, at->normal);
    channels[CAL_CRP - 1] = at->color.r;
    channels[CAL_CGP - 1] = at->color.g;
    channels[CAL_CBP - 1] = at->color.b;
    material_own_direction(channels, LIGHT, o, light);
    channels[LIGHT + ARGUMENTS - 2] = 0;
    if (r->data) {
        if (!material_function_values(&r->places, o, channels, where))
            return 0;
        rad_data_values(r->data, &r->data->values, 1, where, &channels[DATA - 1]);
    }
    if (!material_function_values(&r->value, o, channels, &value))
        return 0;
    return fmax(value, 0);
}
