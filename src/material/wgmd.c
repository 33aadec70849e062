/* Compiling WGMDfunc, and preparing it at a hit. */
#include "material/wgmd.h"

#include <string.h>

#include "base/number.h"
#include "material/fresnel.h"

/* String arguments. */
enum { SPECULAR_MODIFIER, SPECULAR, TRANSMITTED = 5, VECTOR = 9, FUNCTION_FILE = 12 };

/* Roughnesses and reflectances below this are 0, as in Radiance. */
#define NOTHING 1e-6

static bool is_zero(const char *word) {
    double value;
    return text_to_real(word, &value) && value <= NOTHING;
}

static bool is_above_zero(const char *word) {
    double value;
    return text_to_real(word, &value) && value > NOTHING;
}

static graze_status read_colors(material_wgmd *w, const rad_primitive *p, const graze_report *report) {
    for (uint32_t i = 0; i < 9; i++)
        if (!(p->reals[i] >= 0))
            return rad_primitive_error(report, p, "real argument %u is negative", (unsigned)i + 1);
    if (!is_zero(p->strings[TRANSMITTED]) || p->reals[6] > 0 || p->reals[7] > 0 || p->reals[8] > 0)
        return rad_primitive_error(report, p, "what it transmits is not supported yet");
    w->may_mirror = !is_above_zero(p->strings[SPECULAR + 1]) || !is_above_zero(p->strings[SPECULAR + 2]);
    w->front = (rgb){p->reals[0], p->reals[1], p->reals[2]};
    w->back = (rgb){p->reals[3], p->reals[4], p->reals[5]};
    return GRAZE_OK;
}

static graze_status read_modifier(material_wgmd *w, material_modifiers *modifiers, const rad_primitive *p) {
    const char *name = p->strings[SPECULAR_MODIFIER];
    w->specular_inherits = strcmp(name, "inherit") == 0;
    if (w->specular_inherits)
        return GRAZE_OK;
    return material_modifiers_find(&w->specular_modifiers, modifiers, p, name);
}

graze_status material_wgmd_compile(const material_wgmd **result, material_modifiers *modifiers,
                                   const rad_primitive *p) {
    material_library *library = material_modifiers_library(modifiers);
    cal_expression vector[3], specular[3];
    material_wgmd *made = arena_allocate(material_library_memory(library), sizeof *made);
    *result = made;
    if (!made)
        return report_out_of_memory(material_library_report(library));
    *made = (material_wgmd){.specular_modifiers = NULL};
    for (int i = 0; i < 3; i++) {
        vector[i] = (cal_expression){.text = p->strings[VECTOR + i]};
        specular[i] = (cal_expression){.text = p->strings[SPECULAR + i]};
    }
    const uint64_t channels = CAL_CHANNEL_BITS(CAL_NXP, CAL_RDOTP);
    graze_status status = read_colors(made, p, material_library_report(library));
    if (!status)
        status = read_modifier(made, modifiers, p);
    if (!status)
        status = material_owner_begin(&made->owner, library, p, FUNCTION_FILE, FUNCTION_FILE + 1);
    if (!status)
        status =
            material_function_compile(&made->orientation, library, &made->owner, FUNCTION_FILE, vector, 3, channels);
    if (!status)
        status =
            material_function_compile(&made->specular, library, &made->owner, FUNCTION_FILE, specular, 3, channels);
    return status;
}

static bool values_at(const material_wgmd *w, const material_function *f, const material_ray *ray, vec3 normal,
                      double values[3]) {
    double channels[CAL_CHANNELS_MOST];
    material_channels(channels, &w->owner, f, NULL, ray);
    material_own_direction(channels, CAL_NXP, &w->owner, normal);
    channels[CAL_RDOTP - 1] = -vec3_dot(ray->direction, normal);
    return material_function_values(f, &w->owner, channels, values);
}

void material_wgmd_prepare(const material_wgmd *w, const material_wgmd_point *at, graze_surface *diffuse,
                           graze_surface *specular) {
    const vec3 view = vec3_negate(at->ray.direction);
    double u[3], values[3];
    bool behind = vec3_dot(at->ray.normal, view) < 0;
    graze_material m = {.kind = GRAZE_METAL, .model = at->model, .specularity = 1, .has_orientation = 1};
    if (values_at(w, &w->orientation, &at->ray, at->diffuse_normal, u))
        m.orientation = material_to_world(&w->owner, vec3_make(u[0], u[1], u[2]));
    if (values_at(w, &w->specular, &at->ray, at->specular_normal, values) && values[0] > NOTHING) {
        m.color = rgb_scale(values[0], at->specular_color);
        bool rough = values[1] > NOTHING && values[2] > NOTHING;
        m.roughness_u = rough ? values[1] : 0;
        m.roughness_v = rough ? values[2] : 0;
        /* Too weak for Fresnel's estimate. */
        if (rgb_brightness(m.color) < MATERIAL_FRESNEL_THRESHOLD) {
            m.specularity = MATERIAL_FRESNEL_THRESHOLD / 2;
            m.color = rgb_scale(1 / m.specularity, m.color);
        }
    } else {
        m.specularity = 0;
        m.color = rgb_gray(0);
    }
    graze_surface_prepare(specular, &m, at->specular_normal, view, NULL);
    graze_surface_prepare(diffuse, &m, at->diffuse_normal, view, NULL);
    diffuse->diffuse = rgb_multiply(behind ? w->back : w->front, at->diffuse_color);
    if (diffuse->fresnel)
        diffuse->diffuse = rgb_scale(1 - material_fresnel(double_max(specular->local_view.z, 1e-3)), diffuse->diffuse);
    diffuse->specular = specular->diffuse = rgb_gray(0);
    diffuse->specular_lobe = GRAZE_LOBE_NONE;
}
