/* What is polished: thin panes of glass, the boundaries of dielectrics, and mirrors. */
#include "material/refraction.h"

#include <stdbool.h>

#include "material/lobes.h"

/* What is reflected of the two polarisations. */
typedef struct fresnel_pair {
    double across, along;
} fresnel_pair;

static double square(double a) {
    return a * a;
}

/* For the cosines before and behind a boundary, and the index behind over that before it. At the horizon all is
 * reflected. */
static fresnel_pair fresnel(double before, double behind, double index) {
    if (!(before > 0))
        return (fresnel_pair){1, 1};
    return (fresnel_pair){square((before - index * behind) / (before + index * behind)),
                          square((behind - index * before) / (behind + index * before))};
}

/* A body's own transmittance at the cosine inside. */
static rgb body_transmittance(rgb transmissivity, double inside) {
    return rgb_power(transmissivity, 1 / inside);
}

/* The cosine within glass; 0 where that does not refract and is seen edge-on. */
static double cosine_inside(double cosine, double index) {
    double sine2 = (1 - cosine) * (1 + cosine) / (index * index);
    return sqrt(double_max(1 - sine2, 0));
}

/* What a pane of these faces and this body transmits of one polarisation, and reflects. Of light that meets a pane at
 * its horizon nothing gets in. */
static double pane_transmits(double face, double body) {
    return face < 1 ? square(1 - face) * body / (1 - square(face * body)) : 0;
}

static double pane_reflects(double face, double body) {
    return face < 1 ? face * (1 + (1 - 2 * face) * square(body)) / (1 - square(face * body)) : 1;
}

static double mean_transmitted(fresnel_pair faces, double body) {
    return (pane_transmits(faces.across, body) + pane_transmits(faces.along, body)) / 2;
}

static double mean_reflected(fresnel_pair faces, double body) {
    return (pane_reflects(faces.across, body) + pane_reflects(faces.along, body)) / 2;
}

/* A pane as it is seen at some angle: its faces and its body. */
typedef struct glass_seen {
    fresnel_pair faces;
    rgb body;
} glass_seen;

/* False where it is seen edge-on, or from behind. */
static bool see_glass(const graze_material *m, double cosine, glass_seen *seen) {
    double inside = cosine_inside(cosine, m->refraction);
    if (!(cosine > 0 && inside > 0))
        return false;
    *seen = (glass_seen){fresnel(cosine, inside, m->refraction), body_transmittance(m->color, inside)};
    return true;
}

/* Most glass is gray: then one number says all. */
static rgb transmitted(const glass_seen *seen) {
    rgb body = seen->body;
    double r = mean_transmitted(seen->faces, body.r);
    return (rgb){r, body.g == body.r ? r : mean_transmitted(seen->faces, body.g),
                 body.b == body.r ? r : mean_transmitted(seen->faces, body.b)};
}

static rgb reflected(const glass_seen *seen) {
    rgb body = seen->body;
    double r = mean_reflected(seen->faces, body.r);
    return (rgb){r, body.g == body.r ? r : mean_reflected(seen->faces, body.g),
                 body.b == body.r ? r : mean_reflected(seen->faces, body.b)};
}

rgb material_glass_transmittance(const graze_material *m, double cosine) {
    glass_seen seen;
    if (!see_glass(m, cosine, &seen))
        return (rgb){0, 0, 0};
    return transmitted(&seen);
}

static void set_specular_lobes(graze_surface *s) {
    s->diffuse = s->transmitted_diffuse = (rgb){0, 0, 0};
    s->fresnel = 0;
    s->specular_lobe = rgb_is_black(s->specular) ? GRAZE_LOBE_NONE : GRAZE_LOBE_MIRROR;
    s->transmitted_lobe = rgb_is_black(s->transmitted_specular) ? GRAZE_LOBE_NONE : GRAZE_LOBE_TRANSMITTED;
    s->transmits = s->transmitted_lobe != GRAZE_LOBE_NONE;
}

void material_prepare_glass(graze_surface *s, const graze_material *m) {
    glass_seen seen;
    bool is_seen = see_glass(m, s->local_view.z, &seen);
    s->specular = is_seen ? reflected(&seen) : (rgb){1, 1, 1};
    s->transmitted_specular = is_seen ? transmitted(&seen) : (rgb){0, 0, 0};
    s->transmitted = vec3_negate(s->view);
    set_specular_lobes(s);
}

void material_prepare_dielectric(graze_surface *s, const graze_material *m, int inside) {
    /* The index on the other side over that on the viewer's, and what the viewer's sines are multiplied by. */
    double index = inside ? 1 / m->refraction : m->refraction, ratio = 1 / index;
    double cosine = double_min(s->local_view.z, 1);
    double behind2 = 1 - square(ratio) * (1 - cosine) * (1 + cosine);
    s->specular = (rgb){1, 1, 1};
    s->transmitted_specular = (rgb){0, 0, 0};
    s->transmitted = vec3_negate(s->view);
    if (behind2 > 0) {
        double behind = sqrt(behind2);
        fresnel_pair face = fresnel(cosine, behind, index);
        double reflected = (face.across + face.along) / 2;
        s->specular = rgb_gray(reflected);
        s->transmitted_specular = rgb_gray((1 - reflected) * square(ratio));
        s->transmitted = vec3_normalize(vec3_add_scaled(vec3_scale(-ratio, s->view), ratio * cosine - behind, s->n));
    }
    set_specular_lobes(s);
}

void material_prepare_mirror(graze_surface *s, const graze_material *m, int behind) {
    s->specular = behind ? (rgb){0, 0, 0} : m->color;
    s->transmitted_specular = (rgb){0, 0, 0};
    set_specular_lobes(s);
}

graze_rgb graze_material_attenuation(const graze_material *m, int inside, double distance) {
    if (m->kind != GRAZE_DIELECTRIC)
        return (rgb){1, 1, 1};
    return rgb_power(inside ? m->inside : m->outside, distance);
}
