/* The rough lobe on a surface's other side: Radiance's Gaussian about the direction straight on, without more light
 * getting through towards the horizon than arrives (graze/material.h). */
#include "base/angle.h"
#include "material/lobes.h"

/* The lobe about the direction straight on, in the shading frame. */
typedef struct straight {
    vec3 direction; /* d */
    vec3 u, v;      /* across it: the frame's x and y, carried there by the smallest rotation */
    double cosine;  /* of -d with the normal, above 0 */
} straight;

static bool find_straight(const graze_surface *s, straight *out) {
    frame f = material_frame(s);
    vec3 d = frame_to_local(&f, s->transmitted), w = vec3_negate(d);
    if (!(w.z > 0))
        return false;
    double part = 1 / (1 + w.z);
    out->direction = d;
    out->u = vec3_make(1 - w.x * w.x * part, -w.x * w.y * part, -w.x);
    out->v = vec3_make(-w.x * w.y * part, 1 - w.y * w.y * part, -w.y);
    out->cosine = w.z;
    return true;
}

/* What stands beside the Gaussian in g, times |l.n|: it is what a sample drawn from the Gaussian weighs. */
static double cosine_weight(const straight *d, vec3 l) {
    double cosine = -l.z;
    if (!(cosine > 0))
        return 0;
    double bound = 2 * cosine / double_max(cosine, d->cosine);
    return double_min(sqrt(cosine / d->cosine), bound);
}

static double gaussian(const graze_surface *s, const straight *d, vec3 l) {
    vec3 h = vec3_subtract(l, d->direction);
    double u = vec3_dot(h, d->u), v = vec3_dot(h, d->v), across2 = u * u + v * v;
    double exponent = 0;
    if (across2 > 0) {
        double pu = u / s->transmitted_u, pv = v / s->transmitted_v;
        exponent = (pu * pu + pv * pv) * (vec3_dot(h, h) / across2);
    }
    return exp(-exponent) / PI / s->transmitted_u / s->transmitted_v;
}

/* A direction's like on the other side of the middle, which the Gaussian makes as likely. */
static vec3 partner(const straight *d, vec3 l) {
    return vec3_subtract(vec3_scale(2 * vec3_dot(d->direction, l), d->direction), l);
}

double material_transmitted_value(const graze_surface *s, vec3 l) {
    straight d;
    if (!(l.z < 0) || !find_straight(s, &d))
        return 0;
    return gaussian(s, &d, l) * cosine_weight(&d, l) / -l.z;
}

double material_transmitted_density(const graze_surface *s, vec3 l) {
    straight d;
    if (!(l.z < 0) || !find_straight(s, &d))
        return 0;
    double weight = cosine_weight(&d, l), other = cosine_weight(&d, partner(&d, l));
    return weight > 0 ? double_min(gaussian(s, &d, l) * (2 * weight / (weight + other)), DBL_MAX) : 0;
}

/* Of the two directions that the Gaussian's draw gives, one is kept, with a probability in proportion to its weight, as
 * in the paired sampling of brdf.h. The mean of the two weights, which the kept one has, is at most 1: where both are
 * below the surface their cosines' mean is at most d's; else the one is at most 2. */
graze_surface_sample material_transmitted_sample(const graze_surface *s, double random_radius, double random_angle,
                                                 double choice) {
    straight d;
    graze_surface_sample sample = {.direction = s->transmitted};
    if (!find_straight(s, &d))
        return sample;
    double radius = sqrt(-log1p(-random_radius)), angle = 2 * PI * random_angle;
    double u = s->transmitted_u * radius * cos(angle), v = s->transmitted_v * radius * sin(angle);
    double chord2 = u * u + v * v; /* |l - d|^2 = 2 (1 - l.d) */
    if (!(chord2 < 4))
        return sample;
    double scale = sqrt(1 - chord2 / 4);
    vec3 ahead = vec3_scale(1 - chord2 / 2, d.direction);
    vec3 across = vec3_scale(scale, vec3_add_scaled(vec3_scale(u, d.u), v, d.v));
    vec3 l = vec3_add(ahead, across), other = vec3_subtract(ahead, across);
    double weight = cosine_weight(&d, l), other_weight = cosine_weight(&d, other), sum = weight + other_weight;
    if (!(sum > 0))
        return sample;
    if (choice * sum >= weight) {
        l = other;
        weight = other_weight;
    }
    if (!(weight > 0))
        return sample;
    frame f = material_frame(s);
    sample.direction = vec3_normalize(frame_to_world(&f, l));
    sample.weight = rgb_scale(sum / 2, s->transmitted_specular);
    sample.density = double_min(gaussian(s, &d, l) * (2 * weight / sum), DBL_MAX);
    return sample;
}
