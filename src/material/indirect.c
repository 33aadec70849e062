/* Indirect light: directions drawn for one lobe of a surface, with the weights of Eq. 16, and their densities. */
#include "material/fresnel.h"
#include "material/lobes.h"

static graze_surface_sample reject(const graze_surface *s) {
    return (graze_surface_sample){s->n, {0, 0, 0}, 0};
}

static graze_surface_sample sample_diffuse(const graze_surface *s, double u, double v) {
    graze_brdf_sample sample = graze_diffuse_sample((vec3){0, 0, 1}, u, v);
    frame f = material_frame(s);
    return (graze_surface_sample){frame_to_world(&f, sample.l), material_diffuse_reflectance(s, sample.l.z),
                                  sample.density};
}

static graze_surface_sample sample_transmitted_diffuse(const graze_surface *s, double u, double v) {
    if (!s->transmits)
        return reject(s);
    graze_brdf_sample sample = graze_diffuse_sample((vec3){0, 0, 1}, u, v);
    frame f = material_frame(s);
    vec3 l = {sample.l.x, sample.l.y, -sample.l.z};
    double through = s->fresnel ? 1 - material_fresnel(sample.l.z) : 1;
    return (graze_surface_sample){frame_to_world(&f, l), rgb_scale(through, s->transmitted_diffuse), sample.density};
}

/* Seen edge-on, a surface lets nothing specular through. */
static graze_surface_sample sample_transmitted(const graze_surface *s) {
    return s->local_view.z > 0 ? (graze_surface_sample){s->transmitted, s->transmitted_specular, 0} : reject(s);
}

static graze_surface_sample sample_glossy(const graze_surface *s, double u, double v, double w) {
    if (!(s->local_view.z > 0))
        return reject(s);
    if (material_is_ashikhmin(s))
        return material_ashikhmin_sample(s, u, v);
    graze_brdf_sample sample = graze_brdf_sample_pair(&s->lobe, s->local_view, u, v, w);
    frame f = material_frame(s);
    return (graze_surface_sample){frame_to_world(&f, sample.l), rgb_scale(sample.weight, s->specular), sample.density};
}

static graze_surface_sample sample_mirror(const graze_surface *s) {
    double cosine = s->local_view.z;
    if (!(cosine > 0))
        return reject(s);
    return (graze_surface_sample){vec3_add_scaled(vec3_negate(s->view), 2 * cosine, s->n), s->specular, 0};
}

graze_surface_sample graze_surface_sample_lobe(const graze_surface *surface, graze_lobe lobe, double s, double t,
                                               double u) {
    if (lobe == GRAZE_LOBE_DIFFUSE)
        return sample_diffuse(surface, s, t);
    if (lobe == GRAZE_LOBE_TRANSMITTED_DIFFUSE)
        return sample_transmitted_diffuse(surface, s, t);
    if (surface->transmits && lobe != GRAZE_LOBE_NONE && lobe == surface->transmitted_lobe)
        return lobe == GRAZE_LOBE_TRANSMITTED ? sample_transmitted(surface)
                                              : material_transmitted_sample(surface, s, t, u);
    if (lobe == GRAZE_LOBE_NONE || lobe != surface->specular_lobe)
        return reject(surface);
    return lobe == GRAZE_LOBE_GLOSSY ? sample_glossy(surface, s, t, u) : sample_mirror(surface);
}

graze_surface_sample graze_surface_sample_unweighted(const graze_surface *surface, double s, double t) {
    if (surface->specular_lobe != GRAZE_LOBE_GLOSSY || !(surface->local_view.z > 0))
        return reject(surface);
    if (material_is_ashikhmin(surface))
        return material_ashikhmin_sample(surface, s, t);
    graze_brdf_sample sample = graze_brdf_sample_ward(&surface->lobe, surface->local_view, s, t);
    if (!(sample.density > 0))
        return reject(surface);
    frame f = material_frame(surface);
    return (graze_surface_sample){frame_to_world(&f, sample.l), surface->specular, sample.density};
}

static double transmitted_density(const graze_surface *s, graze_lobe lobe, vec3 local) {
    if (lobe == GRAZE_LOBE_TRANSMITTED_DIFFUSE)
        return graze_diffuse_density(vec3_negate(local), (vec3){0, 0, 1});
    if (lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY && s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY)
        return material_transmitted_density(s, local);
    return 0;
}

double graze_surface_density(const graze_surface *s, graze_lobe lobe, graze_vec3 l) {
    frame f = material_frame(s);
    vec3 local = frame_to_local(&f, l);
    if (!(local.z > 0))
        return s->transmits ? transmitted_density(s, lobe, local) : 0;
    if (lobe == GRAZE_LOBE_DIFFUSE)
        return graze_diffuse_density(local, (vec3){0, 0, 1});
    if (lobe == GRAZE_LOBE_GLOSSY && s->specular_lobe == GRAZE_LOBE_GLOSSY)
        return material_is_ashikhmin(s) ? material_ashikhmin_density(s, local)
                                        : graze_brdf_pair_density(&s->lobe, local, s->local_view);
    return 0;
}
