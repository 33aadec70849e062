/* From a material's parameters to a surface as seen from one direction: colours, roughness, shading frame. */
#include <stdbool.h>

#include "base/vector.h"
#include "graze/material.h"
#include "material/fresnel.h"
#include "material/lobes.h"

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

/* Sets the frame and the glossy lobe; true for a mirror. */
static bool prepare_shape(graze_surface *s, const graze_material *m, vec3 n, int *illegal_orientation) {
    double u = m->roughness_u, v = m->roughness_v;
    double mean = u == v ? u : sqrt((u * u + v * v) / 2);
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
    return m->has_orientation ? mean == 0 : mean <= MIRROR_ROUGHNESS;
}

static void prepare_colours(graze_surface *s, const graze_material *m, bool mirror, double view_cosine) {
    double specularity = m->specularity, fresnel = 0;
    s->fresnel = mirror && specularity >= MATERIAL_FRESNEL_THRESHOLD;
    if (s->fresnel)
        fresnel = material_fresnel(double_max(view_cosine, SMALLEST_VIEW_COSINE));

    double white = specularity + fresnel * (1 - specularity);
    if (m->kind == GRAZE_METAL)
        s->specular = rgb_add_scaled(rgb_gray(fresnel), specularity * (1 - fresnel), m->color);
    else
        s->specular = rgb_gray(white);
    s->diffuse = rgb_scale(double_max(1 - white, 0), m->color);

    s->specular_lobe = rgb_is_black(s->specular) ? GRAZE_LOBE_NONE : mirror ? GRAZE_LOBE_MIRROR : GRAZE_LOBE_GLOSSY;
}

void graze_surface_prepare(graze_surface *s, const graze_material *m, graze_vec3 normal, graze_vec3 view,
                           int *illegal_orientation) {
    int illegal = 0;
    bool mirror = prepare_shape(s, m, normal, &illegal);
    if (illegal_orientation)
        *illegal_orientation = illegal;

    frame f = material_frame(s);
    s->view = view;
    s->local_view = frame_to_local(&f, view);
    prepare_colours(s, m, mirror, s->local_view.z);
}
