/* The reflectance functions of a surface: how much light from l it sends to the viewer. */
#include "material/lobes.h"

#include "base/angle.h"
#include "material/fresnel.h"

rgb material_diffuse_reflectance(const graze_surface *s, double cosine) {
    /* What the polish reflects of the incoming light does not get to the body below, just as on the way out. */
    if (!s->fresnel)
        return s->diffuse;
    return rgb_scale(1 - (s->fresnel == 1 ? material_fresnel(cosine) : material_schlick(cosine)), s->diffuse);
}

/* What comes through from below. */
static void transmitted_value(const graze_surface *s, vec3 l, rgb *diffuse, rgb *glossy) {
    double through = s->fresnel ? 1 - material_fresnel(-l.z) : 1;
    *diffuse = rgb_scale(through * INV_PI, s->transmitted_diffuse);
    if (s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY)
        *glossy = material_saturate(rgb_scale(material_transmitted_value(s, l), s->transmitted_specular));
}

void material_local_value(const graze_surface *s, vec3 l, rgb *diffuse, rgb *glossy) {
    *diffuse = *glossy = (rgb){0, 0, 0};
    if (!(l.z > 0)) {
        if (l.z < 0 && s->transmits)
            transmitted_value(s, l, diffuse, glossy);
        return;
    }
    *diffuse = rgb_scale(INV_PI, material_diffuse_reflectance(s, l.z));
    if (s->specular_lobe != GRAZE_LOBE_GLOSSY)
        return;
    double lobe =
        material_is_ashikhmin(s) ? material_ashikhmin_value(s, l) : graze_brdf_value(&s->lobe, l, s->local_view);
    *glossy = material_saturate(rgb_scale(lobe, s->specular));
}

void graze_surface_value(const graze_surface *s, graze_vec3 l, graze_rgb *diffuse, graze_rgb *glossy) {
    frame f = material_frame(s);
    material_local_value(s, frame_to_local(&f, l), diffuse, glossy);
}
