/* The lobe of ashik2: the anisotropic Phong model of Ashikhmin and Shirley, as Radiance has it (graze/material.h). */
#include "base/angle.h"
#include "material/lobes.h"

/* The exponent of cos(delta), for a half vector (x, y, z) of any length. */
static double exponent(const graze_surface *s, vec3 h) {
    double across2 = h.x * h.x + h.y * h.y;
    return across2 > 0 ? (s->power_u * h.x * h.x + s->power_v * h.y * h.y) / across2 : 0;
}

/* The density of the sampled half vector, over 4 (l.h): that of l. */
static double density(const graze_surface *s, vec3 l) {
    vec3 h = vec3_add(l, s->local_view);
    double length2 = vec3_dot(h, h);
    if (!(l.z > 0 && s->local_view.z > 0 && length2 > 0))
        return 0;
    double cosine2 = double_min(h.z * h.z / length2, 1);
    double power = pow(cosine2, exponent(s, h) / 2) * sqrt((s->power_u + 1) * (s->power_v + 1));
    return power / (4 * PI * sqrt(length2)); /* l.h is half of |h|, for h not normalised */
}

double material_ashikhmin_value(const graze_surface *s, vec3 l) {
    return density(s, l) / double_max(l.z, s->local_view.z);
}

double material_ashikhmin_density(const graze_surface *s, vec3 l) {
    return density(s, l);
}

graze_surface_sample material_ashikhmin_sample(const graze_surface *s, double random_turn, double random_tilt) {
    graze_surface_sample sample = {.direction = s->n};
    double angle = 2 * PI * random_turn;
    double x = sqrt(s->power_v + 1) * cos(angle), y = sqrt(s->power_u + 1) * sin(angle), r = sqrt(x * x + y * y);
    x /= r;
    y /= r;
    double cosine = pow(1 - random_tilt, 1 / (s->power_u * x * x + s->power_v * y * y + 1));
    double sine = sqrt(double_max((1 - cosine) * (1 + cosine), 0));
    vec3 h = {sine * x, sine * y, cosine};
    vec3 l = vec3_add_scaled(vec3_negate(s->local_view), 2 * vec3_dot(h, s->local_view), h);
    if (!(l.z > 0 && vec3_dot(h, s->local_view) > 0))
        return sample;
    frame f = material_frame(s);
    sample.direction = vec3_normalize(frame_to_world(&f, l));
    sample.weight = rgb_scale(l.z / double_max(l.z, s->local_view.z), s->specular);
    sample.density = density(s, l);
    return sample.density > 0 ? sample : (graze_surface_sample){.direction = s->n};
}
