/* From a material's parameters to a surface as seen from one direction: colours, roughness, shading frame. */
#include <stdbool.h>

#include "base/vector.h"
#include "graze/material.h"
#include "material/fresnel.h"
#include "material/lobes.h"
#include "material/refraction.h"

/* Radiance's `plastic` and `metal` are mirrors where roughness^2 <= 1e-6. */
#define MIRROR_ROUGHNESS 1e-3
/* Radiance's bound on the cosine of the view, for the Fresnel estimate. */
#define SMALLEST_VIEW_COSINE 1e-3
/* Sine of the angle between orientation and normal below which rounding errors would decide on the frame. */
#define PARALLEL_SINE 1e-12
/* Radiance calls an orientation parallel to the normal illegal if the roughnesses differ by more than this. */
#define ISOTROPIC_DIFFERENCE 1e-3

/* x along the part of u0 in the surface, that is v = normalize(n x u0), u = v x n. False where u0 has no such part. */
static bool orient(vec3 n, vec3 u0, frame *f) {
    vec3 v = vec3_cross(n, vec3_safe_normalize(u0));
    if (!(vec3_length(v) > PARALLEL_SINE))
        return false;
    /* Where u0 is nearly parallel to n, v comes from differences of nearly equal numbers: take out what n has left in
     * it. */
    v = vec3_normalize(v);
    v = vec3_normalize(vec3_add_scaled(v, -vec3_dot(v, n), n));
    *f = (frame){vec3_normalize(vec3_cross(v, n)), v, n};
    return true;
}

static double clamp_roughness(double alpha) {
    return double_min(double_max(alpha, GRAZE_ROUGHNESS_MIN), GRAZE_ROUGHNESS_MAX);
}

static double mean_roughness(const graze_material *m) {
    double u = m->roughness_u, v = m->roughness_v;
    return u == v ? u : sqrt((u * u + v * v) / 2);
}

static bool is_mirror(const graze_material *m, double mean) {
    return m->has_orientation ? mean == 0 : mean <= MIRROR_ROUGHNESS;
}

/* Sets the frame and the glossy lobe; true for a mirror. */
static bool prepare_shape(graze_surface *s, const graze_material *m, vec3 n, int *illegal_orientation) {
    double u = m->roughness_u, v = m->roughness_v;
    double mean = mean_roughness(m);
    frame f;
    bool oriented = m->has_orientation && orient(n, m->orientation, &f);
    if (!oriented) {
        f = frame_around(n);
        if (m->has_orientation && fabs(u - v) > ISOTROPIC_DIFFERENCE)
            *illegal_orientation = 1;
        u = v = mean;
    }
    s->x = f.x;
    s->y = f.y;
    s->n = f.z;
    s->lobe = (graze_brdf){m->model, clamp_roughness(u), clamp_roughness(v)};
    return is_mirror(m, mean);
}

static double view_fresnel(double cosine) {
    return material_fresnel(double_max(cosine, SMALLEST_VIEW_COSINE));
}

/* Divides what would be reflected diffusely among what stays on this side and what gets to the other. */
static void prepare_transmission(graze_surface *s, const graze_material *m, bool mirror) {
    double diffuse = m->transmission * double_max(1 - m->transmitted_specularity, 0);
    s->transmits = 1;
    s->transmitted_diffuse = rgb_scale(diffuse, s->diffuse);
    s->transmitted_specular = rgb_scale(m->transmission * m->transmitted_specularity, s->diffuse);
    s->diffuse = rgb_scale(double_max(1 - m->transmission, 0), s->diffuse);
    s->transmitted = vec3_negate(s->view);
    s->transmitted_u = s->lobe.alpha_x;
    s->transmitted_v = s->lobe.alpha_y;
    s->transmitted_lobe = rgb_is_black(s->transmitted_specular) ? GRAZE_LOBE_NONE
                          : mirror                              ? GRAZE_LOBE_TRANSMITTED
                                                                : GRAZE_LOBE_TRANSMITTED_GLOSSY;
}

static double at_most(double value, double bound) {
    return double_max(double_min(value, bound), 0);
}

/* Without an orientation both powers are their harmonic mean, as in Radiance. */
static void prepare_ashikhmin(graze_surface *s, const graze_material *m, double view_cosine) {
    double fresnel = material_schlick(double_max(view_cosine, SMALLEST_VIEW_COSINE));
    bool oriented = s->lobe.alpha_x != s->lobe.alpha_y || m->power_u == m->power_v;
    double mean = 2 / (1 / (m->power_u + 1e-5) + 1 / (m->power_v + 1e-5));
    s->power_u = oriented ? m->power_u : mean;
    s->power_v = oriented ? m->power_v : mean;
    s->lobe.model = GRAZE_BRDF_MODEL_COUNT;
    s->fresnel = 2;
    bool none = rgb_is_black(m->specular_color);
    s->specular = rgb_gray(0);
    if (!none)
        s->specular = rgb_add_scaled(m->specular_color, fresnel, rgb_add_scaled(rgb_gray(1), -1, m->specular_color));
    s->diffuse = (rgb){at_most(m->color.r, 1 - s->specular.r), at_most(m->color.g, 1 - s->specular.g),
                       at_most(m->color.b, 1 - s->specular.b)};
    s->specular_lobe = none ? GRAZE_LOBE_NONE : GRAZE_LOBE_GLOSSY;
    s->transmits = 0;
}

static void prepare_colours(graze_surface *s, const graze_material *m, bool mirror, double view_cosine) {
    if (m->kind == GRAZE_ASHIKHMIN) {
        prepare_ashikhmin(s, m, view_cosine);
        return;
    }
    double specularity = m->specularity, fresnel = 0;
    /* All that is below, where most of it is 0: there is more of this than of anything else. */
    if (m->kind == GRAZE_PLASTIC && specularity == 0) {
        s->fresnel = s->transmits = 0;
        s->specular = rgb_gray(0);
        s->specular_lobe = GRAZE_LOBE_NONE;
        s->diffuse = m->color;
        return;
    }
    s->fresnel = mirror && specularity >= MATERIAL_FRESNEL_THRESHOLD;
    if (s->fresnel)
        fresnel = view_fresnel(view_cosine);

    double white = specularity + fresnel * (1 - specularity);
    if (m->kind == GRAZE_METAL)
        s->specular = rgb_add_scaled(rgb_gray(fresnel), specularity * (1 - fresnel), m->color);
    else
        s->specular = rgb_gray(white);
    s->diffuse = rgb_scale(double_max(1 - white, 0), m->color);

    s->specular_lobe = rgb_is_black(s->specular) ? GRAZE_LOBE_NONE : mirror ? GRAZE_LOBE_MIRROR : GRAZE_LOBE_GLOSSY;
    s->transmits = 0;
    if (m->kind == GRAZE_TRANS && m->transmission > 0)
        prepare_transmission(s, m, mirror);
}

/* Clear bodies, of whose frame nothing but the normal matters. */
static void prepare_clear(graze_surface *s, const graze_material *m, vec3 normal, vec3 view) {
    bool inside = vec3_dot(normal, view) < 0;
    frame f = frame_around(inside ? vec3_negate(normal) : normal);
    s->x = f.x;
    s->y = f.y;
    s->n = f.z;
    s->lobe = (graze_brdf){GRAZE_BRDF_GMD, GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MIN};
    s->view = view;
    s->local_view = frame_to_local(&f, view);
    if (m->kind == GRAZE_GLASS)
        material_prepare_glass(s, m);
    else if (m->kind == GRAZE_MIRROR)
        material_prepare_mirror(s, m, inside);
    else
        material_prepare_dielectric(s, m, inside);
}

void graze_surface_prepare(graze_surface *s, const graze_material *m, graze_vec3 normal, graze_vec3 view,
                           int *illegal_orientation) {
    int illegal = 0;
    if (m->kind >= GRAZE_GLASS) {
        if (illegal_orientation)
            *illegal_orientation = 0;
        prepare_clear(s, m, normal, view);
        return;
    }
    bool mirror = prepare_shape(s, m, normal, &illegal);
    if (illegal_orientation)
        *illegal_orientation = illegal;

    frame f = material_frame(s);
    s->view = view;
    s->local_view = frame_to_local(&f, view);
    prepare_colours(s, m, mirror, s->local_view.z);
}

graze_rgb graze_material_straight_through(const graze_material *m, double cosine) {
    if (m->kind == GRAZE_GLASS)
        return material_glass_transmittance(m, cosine);
    if (m->kind != GRAZE_TRANS || !is_mirror(m, mean_roughness(m)) || !(cosine > 0))
        return (rgb){0, 0, 0};
    double white = m->specularity;
    if (white >= MATERIAL_FRESNEL_THRESHOLD)
        white += view_fresnel(cosine) * (1 - white);
    return rgb_scale(double_max(1 - white, 0) * m->transmission * m->transmitted_specularity, m->color);
}
