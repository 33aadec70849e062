/* Compiling and evaluating `ux uy uz funcfile transform`. */
#include "material/orientation.h"

#include <string.h>

#include "base/number.h"

enum { FUNCTION_FILE = 3 };

bool material_orients_by_function(const rad_primitive *p) {
    bool has_one = p->type == RAD_PLASTIC2 || p->type == RAD_METAL2 || p->type == RAD_TRANS2 || p->type == RAD_ASHIK2;
    if (!has_one || p->string_count <= FUNCTION_FILE)
        return false;
    bool plain = strcmp(p->strings[FUNCTION_FILE], ".") == 0;
    double number;
    for (int i = 0; i < 3; i++)
        plain = plain && text_to_real(p->strings[i], &number);
    return !plain;
}

graze_status material_orientation_compile(const material_orientation **result, material_library *library,
                                          const rad_primitive *p) {
    cal_expression expressions[3];
    material_orientation *made = arena_allocate(material_library_memory(library), sizeof *made);
    *result = made;
    if (!made)
        return report_out_of_memory(material_library_report(library));
    for (int i = 0; i < 3; i++)
        expressions[i] = (cal_expression){.text = p->strings[i]};
    graze_status status = material_owner_begin(&made->owner, library, p, FUNCTION_FILE, FUNCTION_FILE + 1);
    if (!status)
        status = material_function_compile(&made->vector, library, &made->owner, FUNCTION_FILE, expressions, 3, 0);
    return status;
}

vec3 material_orientation_at(const material_orientation *o, const material_ray *ray) {
    double channels[CAL_CHANNELS_MOST], u[3];
    material_channels(channels, &o->owner, &o->vector, NULL, ray);
    if (!material_function_values(&o->vector, &o->owner, channels, u))
        return vec3_make(0, 0, 0);
    return material_to_world(&o->owner, vec3_make(u[0], u[1], u[2]));
}
