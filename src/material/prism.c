/* Compiling and evaluating the functions of prisms: for each way `coefficient dx dy dz`, then the function file. */
#include "material/prism.h"

/* Values of a way. */
enum { COEFFICIENT, DIRECTION, VALUES = 4 };

/* Coefficients that add up to 1 may do so but for their last digits. */
#define ROUNDING 1e-9

/* What would let light grow beyond all numbers is none. */
#define LARGEST_COEFFICIENT 1e10

bool material_is_prism(rad_type type) {
    return type == RAD_PRISM1 || type == RAD_PRISM2;
}

graze_status material_prism_compile(const material_prism **result, material_library *library, const rad_primitive *p) {
    cal_expression expressions[2 * VALUES];
    material_prism *made = arena_allocate(material_library_memory(library), sizeof *made);
    *result = made;
    atomic_flag *told = arena_allocate(material_library_memory(library), sizeof *told);
    if (!made || !told)
        return report_out_of_memory(material_library_report(library));
    atomic_flag_clear(told);
    made->amplification_told = told;
    made->ways = p->type == RAD_PRISM2 ? 2 : 1;
    uint32_t count = (uint32_t)(made->ways * VALUES);
    for (uint32_t i = 0; i < count; i++)
        expressions[i] = (cal_expression){.text = p->strings[i]};
    if (p->modifier != RAD_VOID)
        rad_primitive_warning(material_library_report(library), p, "what modifies it has no effect, as in Radiance");
    graze_status status = material_owner_begin(&made->owner, library, p, count, count + 1);
    if (!status)
        status = material_function_compile(&made->function, library, &made->owner, count, expressions, count,
                                           CAL_CHANNEL_BITS(CAL_DXA, CAL_DZA));
    if (!status && (cal_code_channels(made->function.code) & CAL_CHANNEL_BITS(CAL_DXA, CAL_DZA)))
        rad_primitive_warning(material_library_report(library), p,
                              "DxA, DyA and DzA are 0: no ray is aimed at a light through a prism");
    return status;
}

/* Functions are known to amplify only where rays meet them. */
static void tell_amplification(const material_prism *m, const material_way ways[2]) {
    const material_owner *o = &m->owner;
    if (ways[0].coefficient + ways[1].coefficient > 1 + ROUNDING && !atomic_flag_test_and_set(m->amplification_told))
        rad_primitive_warning(o->report, o->primitive,
                              "unphysical: %s above 1, where it lets more light through than it gets",
                              m->ways == 1 ? "its coefficient comes" : "its coefficients add up to something");
}

void material_prism_ways(const material_prism *m, const material_ray *ray, material_way ways[2]) {
    double channels[CAL_CHANNELS_MOST], values[2 * VALUES];
    ways[0].coefficient = ways[1].coefficient = 0;
    material_channels(channels, &m->owner, &m->function, NULL, ray);
    /* No ray is aimed at a light. */
    channels[CAL_DXA - 1] = channels[CAL_DYA - 1] = channels[CAL_DZA - 1] = 0;
    if (!material_function_values(&m->function, &m->owner, channels, values))
        return;
    for (int i = 0; i < m->ways; i++) {
        const double *way = &values[i * VALUES], *d = &way[DIRECTION];
        vec3 direction = material_to_world(&m->owner, vec3_make(d[0], d[1], d[2]));
        if (!(way[COEFFICIENT] > 0) || !(vec3_max_abs(direction) > 0) || !isfinite(vec3_max_abs(direction)))
            continue;
        ways[i].coefficient = double_min(way[COEFFICIENT], LARGEST_COEFFICIENT);
        ways[i].direction = vec3_safe_normalize(direction);
    }
    tell_amplification(m, ways);
}
