/* Reads the materials of scene files, with Radiance's checks of their arguments. */
#include "material/from_primitive.h"

#include <string.h>

#include "base/number.h"
#include "material/amounts.h"
#include "rad/transform.h"

/* Squares of indices, and of their ratios, stay far from overflow. */
#define LARGEST_INDEX 100.0

/* Words that begin a transform; a number, as it may be the argument of a function, does not. */
static bool begins_transform(const char *word) {
    if (word[0] != '-' || !word[1])
        return false;
    if (word[1] == 't' || word[1] == 's' || word[1] == 'i')
        return !word[2];
    return (word[1] == 'r' || word[1] == 'm') && word[2] >= 'x' && word[2] <= 'z' && !word[3];
}

uint32_t material_find_transform(const rad_primitive *p, uint32_t rest, const graze_report *report) {
    uint32_t first = rest;
    while (first < p->string_count && !begins_transform(p->strings[first]))
        first++;
    if (first > rest)
        rad_primitive_warning(report, p, "its string argument %u, '%.64s', has no meaning", (unsigned)rest + 1,
                              p->strings[rest]);
    return first;
}

/* `ux uy uz funcfile`, before the transform. */
#define ORIENTATION_STRINGS 4

static graze_status report_roughness(const rad_primitive *p, double roughness, const graze_report *report) {
    char text[NUMBER_TEXT_SIZE], most[NUMBER_TEXT_SIZE];
    number_print_exact(text, roughness);
    number_print_exact(most, GRAZE_ROUGHNESS_MAX);
    return rad_primitive_error(report, p, "roughness %s is above %s", text, most);
}

static graze_status check_count(const rad_primitive *p, uint32_t count, const graze_report *report) {
    if (p->real_count == count)
        return GRAZE_OK;
    return rad_primitive_error(report, p, "needs %u real arguments, not %u", (unsigned)count, (unsigned)p->real_count);
}

/* Of the types that have `roughnesses` of them, from the fifth argument on. */
static graze_status check_reals(const rad_primitive *p, uint32_t count, uint32_t roughnesses,
                                const graze_report *report) {
    graze_status status = check_count(p, count, report);
    if (status == GRAZE_OK)
        status = material_check_signs(p, p->real_count, report);
    for (uint32_t i = 4; i < 4 + roughnesses && status == GRAZE_OK; i++)
        if (p->reals[i] > GRAZE_ROUGHNESS_MAX)
            status = report_roughness(p, p->reals[i], report);
    return status;
}

static void warn_if_unphysical(const rad_primitive *p, const graze_report *report) {
    if (p->reals[0] > 1 || p->reals[1] > 1 || p->reals[2] > 1)
        rad_primitive_warning(report, p, "unphysical: a colour above 1 reflects more light than it receives");
    if (p->reals[3] > 1)
        rad_primitive_warning(report, p, "unphysical: a specularity above 1 reflects more light than it receives");
}

/* The first five real arguments mean the same in all six types. */
static void take_reals(graze_material *m, const rad_primitive *p, graze_material_kind kind, uint32_t roughnesses) {
    *m = (graze_material){
        .kind = kind,
        .model = GRAZE_BRDF_GMD,
        .color = {p->reals[0], p->reals[1], p->reals[2]},
        .specularity = p->reals[3],
        .roughness_u = p->reals[4],
        .roughness_v = p->reals[3 + roughnesses],
    };
}

/* The last two arguments of trans and trans2. */
static graze_status take_transmission(graze_material *m, const rad_primitive *p, const graze_report *report) {
    const double *last = &p->reals[p->real_count - 2];
    if (last[0] > 1 || last[1] > 1)
        return rad_primitive_error(report, p, "the transmission and the transmitted specularity must be in 0 .. 1");
    m->transmission = last[0];
    m->transmitted_specularity = last[1];
    return GRAZE_OK;
}

static graze_status read_isotropic(graze_material *m, const rad_primitive *p, graze_material_kind kind,
                                   const graze_report *report) {
    bool transmits = kind == GRAZE_TRANS;
    graze_status status = check_reals(p, transmits ? 7 : 5, 1, report);
    if (status != GRAZE_OK)
        return status;
    warn_if_unphysical(p, report);
    take_reals(m, p, kind, 1);
    return transmits ? take_transmission(m, p, report) : GRAZE_OK;
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
    rad_primitive_name name = {""};
    const place where = rad_primitive_place(p, &name);
    const uint32_t first = material_find_transform(p, ORIENTATION_STRINGS, report);
    graze_status status =
        rad_transform_parse(&transform, p->strings + first, (int)(p->string_count - first), &where, report);
    if (status != GRAZE_OK)
        return status;
    m->orientation = rad_transform_vector(&transform, vec3_make(u[0], u[1], u[2]));
    return GRAZE_OK;
}

static graze_status read_anisotropic(graze_material *m, const rad_primitive *p, graze_material_kind kind,
                                     const graze_report *report) {
    bool transmits = kind == GRAZE_TRANS;
    graze_status status = check_reals(p, transmits ? 8 : 6, 2, report);
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
    take_reals(m, p, kind, 2);
    if (transmits)
        status = take_transmission(m, p, report);
    return status == GRAZE_OK ? read_orientation(m, p, report) : status;
}

/* What would amplify light is taken for perfectly clear; as Radiance's users write transmissivities above 1 for panes
 * that transmit more than glass without any loss inside. */
static rgb take_transmissivity(const rad_primitive *p, uint32_t first, const graze_report *report) {
    const double *t = &p->reals[first];
    if (t[0] > 1 || t[1] > 1 || t[2] > 1)
        rad_primitive_warning(report, p, "unphysical: a transmissivity above 1 counts as 1");
    return (rgb){double_min(t[0], 1), double_min(t[1], 1), double_min(t[2], 1)};
}

/* Radiance's index of window glass. */
#define GLASS_INDEX 1.52

static graze_status read_glass(graze_material *m, const rad_primitive *p, const graze_report *report) {
    graze_status status = p->real_count == 4 ? GRAZE_OK : check_count(p, 3, report);
    if (status == GRAZE_OK)
        status = material_check_signs(p, p->real_count, report);
    if (status != GRAZE_OK)
        return status;
    double index = p->real_count == 4 ? p->reals[3] : GLASS_INDEX;
    if (!(index >= 1 && index <= LARGEST_INDEX))
        return rad_primitive_error(report, p, "the index of refraction must be in 1 .. 100");
    *m = (graze_material){.kind = GRAZE_GLASS, .color = take_transmissivity(p, 0, report), .refraction = index};
    return GRAZE_OK;
}

static graze_status check_index(const rad_primitive *p, double index, const graze_report *report) {
    if (index >= 1 / LARGEST_INDEX && index <= LARGEST_INDEX)
        return GRAZE_OK;
    return rad_primitive_error(report, p, "the index of refraction must be in 0.01 .. 100");
}

/* The wavelength in nm for which Radiance takes Hartmann's constant into account. */
#define MEAN_WAVELENGTH 500

static graze_status read_dielectric(graze_material *m, const rad_primitive *p, const graze_report *report) {
    graze_status status = check_count(p, 5, report);
    if (status == GRAZE_OK)
        status = material_check_signs(p, 3, report);
    if (status != GRAZE_OK)
        return status;
    double index = p->reals[3] + p->reals[4] / MEAN_WAVELENGTH;
    status = check_index(p, index, report);
    if (status != GRAZE_OK)
        return status;
    *m = (graze_material){.kind = GRAZE_DIELECTRIC,
                          .refraction = index,
                          .inside = take_transmissivity(p, 0, report),
                          .outside = {1, 1, 1}};
    return GRAZE_OK;
}

static graze_status read_interface(graze_material *m, const rad_primitive *p, const graze_report *report) {
    graze_status status = check_count(p, 8, report);
    if (status == GRAZE_OK)
        status = material_check_signs(p, p->real_count, report);
    if (status == GRAZE_OK)
        status = check_index(p, p->reals[3], report);
    if (status == GRAZE_OK)
        status = check_index(p, p->reals[7], report);
    if (status != GRAZE_OK)
        return status;
    *m = (graze_material){.kind = GRAZE_DIELECTRIC,
                          .refraction = p->reals[3] / p->reals[7],
                          .inside = take_transmissivity(p, 0, report),
                          .outside = take_transmissivity(p, 4, report)};
    return GRAZE_OK;
}

/* The largest exponent; beyond it single precision could not place a highlight. */
#define LARGEST_POWER 1e6

/* Exponents as roughnesses of about the same lobes. */
static double roughness_of(double power) {
    return sqrt(2 / (power + 2));
}

static graze_status read_ashik2(graze_material *m, const rad_primitive *p, const graze_report *report) {
    graze_status status = check_count(p, 8, report);
    if (status == GRAZE_OK)
        status = material_check_signs(p, p->real_count, report);
    if (status != GRAZE_OK)
        return status;
    const double *a = p->reals;
    if (p->string_count < ORIENTATION_STRINGS)
        return rad_primitive_error(report, p, "needs at least %d string arguments, not %u", ORIENTATION_STRINGS,
                                   (unsigned)p->string_count);
    if (a[6] > LARGEST_POWER || a[7] > LARGEST_POWER)
        return rad_primitive_error(report, p, "the powers must be in 0 .. 1000000");
    if (a[0] + a[3] > 1 || a[1] + a[4] > 1 || a[2] + a[5] > 1)
        rad_primitive_warning(report, p, "unphysical: its colours add up to more than 1");
    *m = (graze_material){.kind = GRAZE_ASHIKHMIN,
                          .model = GRAZE_BRDF_GMD,
                          .color = {a[0], a[1], a[2]},
                          .specular_color = {a[3], a[4], a[5]},
                          .power_u = a[6],
                          .power_v = a[7],
                          .roughness_u = roughness_of(a[6]),
                          .roughness_v = roughness_of(a[7])};
    m->specularity = rgb_brightness(m->specular_color);
    return read_orientation(m, p, report);
}

static graze_status read_mirror(graze_material *m, const rad_primitive *p, const graze_report *report) {
    graze_status status = check_count(p, 3, report);
    if (status == GRAZE_OK)
        status = material_check_signs(p, p->real_count, report);
    if (status != GRAZE_OK)
        return status;
    if (p->string_count > 1)
        return rad_primitive_error(report, p, "needs 1 string argument at most, not %u", (unsigned)p->string_count);
    if (rgb_max((rgb){p->reals[0], p->reals[1], p->reals[2]}) > 1)
        rad_primitive_warning(report, p, "unphysical: a colour above 1 reflects more light than it receives");
    *m = (graze_material){.kind = GRAZE_MIRROR, .color = {p->reals[0], p->reals[1], p->reals[2]}};
    return GRAZE_OK;
}

bool material_is_reflector(rad_type type) {
    return type == RAD_PLASTIC || type == RAD_METAL || type == RAD_TRANS || type == RAD_PLASTIC2 ||
           type == RAD_METAL2 || type == RAD_TRANS2;
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
    case RAD_TRANS:
        return read_isotropic(m, p, GRAZE_TRANS, report);
    case RAD_TRANS2:
        return read_anisotropic(m, p, GRAZE_TRANS, report);
    case RAD_ASHIK2:
        return read_ashik2(m, p, report);
    case RAD_MIRROR:
        return read_mirror(m, p, report);
    case RAD_GLASS:
        return read_glass(m, p, report);
    case RAD_DIELECTRIC:
        return read_dielectric(m, p, report);
    case RAD_INTERFACE:
        return read_interface(m, p, report);
    default:
        return rad_primitive_error(report, p, "%s is not supported yet", rad_type_name(p->type));
    }
}
