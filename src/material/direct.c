/* Direct light: the sum of Eq. 18 over samples of the lights. */
#include "material/lobes.h"

static rgb reflect_sample(const graze_surface *s, const frame *f, const graze_light_sample *sample) {
    vec3 l = frame_to_local(f, sample->direction);
    rgb diffuse, glossy;
    material_local_value(s, l, &diffuse, &glossy);
    double projected_solid_angle = fabs(l.z) * sample->solid_angle; /* what is below is black unless it comes through */
    return rgb_multiply(rgb_scale(projected_solid_angle, rgb_add(diffuse, glossy)), sample->radiance);
}

graze_rgb graze_surface_direct(const graze_surface *s, const graze_light_sample *samples, size_t count) {
    frame f = material_frame(s);
    rgb sum = {0, 0, 0};
    for (size_t i = 0; i < count; i++)
        sum = material_saturate(rgb_add(sum, reflect_sample(s, &f, &samples[i])));
    return sum;
}
