/* Reads the materials of scene files, with Radiance's checks of their arguments. */
#include "material/from_primitive.h"

#include <string.h>

#include "base/number.h"
#include "rad/transform.h"

/* `ux uy uz funcfile`, before the transform. */
#define ORIENTATION_STRINGS 4

static graze_status report_roughness(const rad_primitive *p, double roughness, const graze_report *report) {
    char text[NUMBER_TEXT_SIZE], most[NUMBER_TEXT_SIZE];
    number_print_exact(text, roughness);
    number_print_exact(most, GRAZE_ROUGHNESS_MAX);
    return rad_primitive_error(report, p, "roughness %s is above %s", text, most);
}

static graze_status check_reals(const rad_primitive *p, uint32_t count, const graze_report *report) {
    if (p->real_count != count)
        return rad_primitive_error(report, p, "needs %u real arguments, not %u", (unsigned)count,
                                   (unsigned)p->real_count);
    for (uint32_t i = 0; i < count; i++)
        if (!(p->reals[i] >= 0))
            return rad_primitive_error(report, p, "real argument %u is negative", (unsigned)i + 1);
    for (uint32_t i = 4; i < count; i++)
        if (p->reals[i] > GRAZE_ROUGHNESS_MAX)
            return report_roughness(p, p->reals[i], report);
    return GRAZE_OK;
}

static void warn_if_unphysical(const rad_primitive *p, const graze_report *report) {
    if (p->reals[0] > 1 || p->reals[1] > 1 || p->reals[2] > 1)
        rad_primitive_warning(report, p, "unphysical: a colour above 1 reflects more light than it receives");
    if (p->reals[3] > 1)
        rad_primitive_warning(report, p, "unphysical: a specularity above 1 reflects more light than it receives");
}

/* The first five real arguments mean the same in all four types. */
static void take_reals(graze_material *m, const rad_primitive *p, graze_material_kind kind) {
    *m = (graze_material){
        .kind = kind,
        .model = GRAZE_BRDF_GMD,
        .color = {p->reals[0], p->reals[1], p->reals[2]},
        .specularity = p->reals[3],
        .roughness_u = p->reals[4],
        .roughness_v = p->reals[p->real_count - 1],
    };
}

static graze_status read_isotropic(graze_material *m, const rad_primitive *p, graze_material_kind kind,
                                   const graze_report *report) {
    graze_status status = check_reals(p, 5, report);
    if (status != GRAZE_OK)
        return status;
    if (p->string_count > 0)
        rad_primitive_warning(report, p, "its string arguments have no meaning");
    warn_if_unphysical(p, report);
    take_reals(m, p, kind);
    return GRAZE_OK;
}

static graze_status read_orientation(graze_material *m, const rad_primitive *p, const graze_report *report) {
    double u[3];
    bool plain = strcmp(p->strings[3], ".") == 0;
    for (int i = 0; i < 3; i++)
        plain = plain && text_to_real(p->strings[i], &u[i]);
    m->has_orientation = 1;
    if (!plain)
        return GRAZE_OK;

    rad_transform transform;
    graze_status status = rad_transform_parse(&transform, p->strings + ORIENTATION_STRINGS,
                                              (int)(p->string_count - ORIENTATION_STRINGS), p->where, report);
    if (status != GRAZE_OK)
        return status;
    m->orientation = rad_transform_vector(&transform, vec3_make(u[0], u[1], u[2]));
    return GRAZE_OK;
}

static graze_status read_anisotropic(graze_material *m, const rad_primitive *p, graze_material_kind kind,
                                     const graze_report *report) {
    graze_status status = check_reals(p, 6, report);
    if (status != GRAZE_OK)
        return status;
    if (p->string_count < ORIENTATION_STRINGS)
        return rad_primitive_error(report, p, "needs at least %d string arguments, not %u", ORIENTATION_STRINGS,
                                   (unsigned)p->string_count);
    if (p->reals[4] <= GRAZE_ROUGHNESS_MIN || p->reals[5] <= GRAZE_ROUGHNESS_MIN) {
        char least[NUMBER_TEXT_SIZE];
        number_print_exact(least, GRAZE_ROUGHNESS_MIN);
        return rad_primitive_error(report, p, "roughness too small: both must be above %s", least);
    }
    warn_if_unphysical(p, report);
    take_reals(m, p, kind);
    return read_orientation(m, p, report);
}

bool material_is_reflector(rad_type type) {
    return type == RAD_PLASTIC || type == RAD_METAL || type == RAD_PLASTIC2 || type == RAD_METAL2;
}

graze_status material_from_primitive(graze_material *m, const rad_primitive *p, const graze_report *report) {
    switch (p->type) {
    case RAD_PLASTIC:
        return read_isotropic(m, p, GRAZE_PLASTIC, report);
    case RAD_METAL:
        return read_isotropic(m, p, GRAZE_METAL, report);
    case RAD_PLASTIC2:
        return read_anisotropic(m, p, GRAZE_PLASTIC, report);
    case RAD_METAL2:
        return read_anisotropic(m, p, GRAZE_METAL, report);
    default:
        return rad_primitive_error(report, p, "%s is not supported yet", rad_type_name(p->type));
    }
}
