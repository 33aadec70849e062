/* The arguments of light, illum, glow and spotlight. */
#include "scene/emitter.h"

#include <math.h>

#include "base/angle.h"

bool emitter_is(rad_type type) {
    return type == RAD_LIGHT || type == RAD_ILLUM || type == RAD_GLOW || type == RAD_SPOTLIGHT;
}

double emitter_full_angle(double degrees, const rad_primitive *p, const graze_report *report) {
    if (!(degrees > 360))
        return degrees;
    double rest = fmod(degrees, 720), angle = rest > 360 ? 720 - rest : rest;
    rad_primitive_warning(report, p, "an angle of %.10g degrees, above 360, is one of %.10g degrees, as in Radiance",
                          degrees, angle);
    return angle;
}

static graze_status read_spot(scene_light *light, const rad_primitive *material, const graze_report *report) {
    const double *a = material->reals;
    vec3 aim = vec3_make(a[4], a[5], a[6]);
    if (!(a[3] > 0))
        return rad_primitive_error(report, material, "the cone's full angle must be above 0");
    if (vec3_max_abs(aim) == 0)
        return rad_primitive_error(report, material, "the aim vector is null");
    light->spot = true;
    light->spot_axis = vec3_safe_normalize(aim);
    light->spot_focus = vec3_safe_length(aim);
    light->spot_cosine = cos(angle_radians(emitter_full_angle(a[3], material, report) / 2));
    return GRAZE_OK;
}

graze_status emitter_to_light(scene_light *light, const rad_primitive *material, const graze_report *report) {
    static const struct {
        rad_type type;
        uint32_t reals;
    } shapes[] = {{RAD_LIGHT, 3}, {RAD_ILLUM, 3}, {RAD_GLOW, 4}, {RAD_SPOTLIGHT, 7}};
    uint32_t expected = 0;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        if (shapes[i].type == material->type)
            expected = shapes[i].reals;
    light->secondary = material->type == RAD_ILLUM;
    if (material->real_count != expected)
        return rad_primitive_error(report, material, "expected %u reals, found %u", expected, material->real_count);
    const double *a = material->reals;
    if (!(a[0] >= 0 && a[1] >= 0 && a[2] >= 0))
        return rad_primitive_error(report, material, "radiance must not be negative");
    if (rgb_max((rgb){a[0], a[1], a[2]}) > SCENE_LARGEST_RADIANCE)
        return rad_primitive_error(report, material, "radiance above 1e100 is beyond what can be computed with");
    light->radiance = (rgb){a[0], a[1], a[2]};
    if (material->type == RAD_GLOW) {
        light->glow = true;
        light->glow_radius = a[3];
    }
    return material->type == RAD_SPOTLIGHT ? read_spot(light, material, report) : GRAZE_OK;
}
