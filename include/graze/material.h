/* What a surface does to light: Radiance's plastic, metal, plastic2 and metal2, for any renderer to link.
 *
 * A graze_material is a primitive as it stands in a scene file; at a hit it becomes a graze_surface: colours and
 * roughness as seen from one direction, and the shading frame. Two entry points then answer what a renderer asks:
 * graze_surface_direct sums light samples (Eq. 18 of the paper, see brdf.h), graze_surface_sample_lobe draws a
 * direction in which to look for indirect light (Eq. 16). graze_surface_value and graze_surface_density let a renderer
 * combine both by multiple importance sampling: for each lobe, weight = value x cosine / density.
 *
 * What is reflected, for the colour C, the specularity s, and C' = white (plastic) or C (metal), in 1/sr:
 *
 *   rough    C (1 - s) / pi + C' s f(l, v), where f is the lobe of brdf.h: Eq. 17 for GRAZE_BRDF_GMD
 *   mirror   C (1 - s) (1 - F(v.n)) (1 - F(l.n)) / pi, and in the mirror direction this share of the radiance:
 *            s + F(v.n) (1 - s) for plastic, F(v.n) + C s (1 - F(v.n)) for metal
 *
 * with Radiance's estimate of Fresnel reflection F(c) = max(0, exp(-5.85 c) - 0.00287989916), for the viewer's cosine
 * bounded from below by 0.001, and F = 0 where s < 0.017999. All of it is reciprocal, and with GRAZE_BRDF_GMD reflects
 * at most what arrives if C and s are in 0 .. 1; larger values are computed as they stand (C (1 - s) becomes 0 where s
 * > 1). Light below the surface (l.n <= 0) is not reflected, and nothing is reflected specularly to a viewer at or
 * below it (v.n <= 0).
 *
 * All directions are unit vectors in world space that point away from the surface. No function here can fail,
 * allocates, or keeps state: a prepared surface may be used by any number of threads. For parameters that are not
 * negative, colours and specularity up to 1e100, and cosines to the normal of 0 or from 1e-150 up, all results are
 * finite and not negative; reflectance functions, densities and sums too large for a double are DBL_MAX. */
#ifndef GRAZE_MATERIAL_H
#define GRAZE_MATERIAL_H

#include <stddef.h>

#include "graze/brdf.h"
#include "graze/export.h"
#include "graze/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum graze_material_kind {
    GRAZE_PLASTIC, /* diffuse colour (1 - specularity) x colour, specular colour white */
    GRAZE_METAL,   /* both in the material's colour */
} graze_material_kind;

/* A material's parameters as in a scene file: `plastic`, `metal` (isotropic) and `plastic2`, `metal2` (anisotropic). */
typedef struct graze_material {
    graze_material_kind kind;
    graze_brdf_model model; /* of the specular lobe; GRAZE_BRDF_GMD is what Radiance means */
    graze_rgb color;        /* 0 .. 1 */
    double specularity;     /* 0 .. 1 */
    double roughness_u,
        roughness_v;        /* along the orientation vector and across it, 0 .. GRAZE_ROUGHNESS_MAX; see below */
    int has_orientation;    /* plastic2, metal2: use `orientation`; else isotropic, and any frame will do */
    graze_vec3 orientation; /* the u vector, in world space, of any length and at any angle to the surface */
} graze_material;

typedef enum graze_lobe {
    GRAZE_LOBE_NONE = 0,
    GRAZE_LOBE_DIFFUSE,
    GRAZE_LOBE_GLOSSY, /* the rough specular lobe */
    GRAZE_LOBE_MIRROR, /* roughness 0: one direction, no density */
} graze_lobe;

/* A material at a hit, seen from `view`. */
typedef struct graze_surface {
    graze_rgb diffuse;  /* reflectance of the diffuse part, as seen from `view` */
    graze_rgb specular; /* reflectance colour of the specular part; Fresnel's estimate included for mirrors */
    int fresnel;        /* a mirror with Fresnel's estimate: light at cosine c reaches the diffuse part by 1 - F(c) */
    graze_lobe specular_lobe; /* GLOSSY, MIRROR, or NONE where `specular` is black */
    graze_brdf lobe;          /* for GLOSSY */
    graze_vec3 x, y, n;       /* shading frame: x along u, right-handed, orthonormal */
    graze_vec3 view;          /* towards the viewer */
    graze_vec3 local_view;    /* the same in the frame */
} graze_surface;

/* Prepares a surface. `normal` is the shading normal on the viewer's side (dot(normal, view) >= 0); it and `view` must
 * be unit vectors to a double's precision.
 *
 * The frame: y = normalize(normal x orientation), x = y x normal. Where the orientation is null or parallel to the
 * normal (within 1e-12 rad) the lobe becomes isotropic with the roughness sqrt((u^2 + v^2)/2), as in Radiance;
 * *illegal_orientation (may be null) is then set to 1 if the roughnesses differ by more than 0.001, else 0. Without
 * orientation the same mean is used.
 *
 * Mirror or not: without orientation, a roughness up to 0.001 is a mirror, as Radiance's plastic and metal are; with
 * orientation, only roughnesses that are both 0. Other roughnesses are brought into GRAZE_ROUGHNESS_MIN ..
 * GRAZE_ROUGHNESS_MAX. */
GRAZE_API void graze_surface_prepare(graze_surface *, const graze_material *, graze_vec3 normal, graze_vec3 view,
                                     int *illegal_orientation);

/* A sample of a light: radiance arriving from `direction`, and the solid angle in sr that it stands for. */
typedef struct graze_light_sample {
    graze_vec3 direction;
    graze_rgb radiance;
    double solid_angle;
} graze_light_sample;

/* Direct light, Eq. 18: the radiance that leaves towards the viewer, the sum over all samples of
 * radiance x (diffuse value + glossy value) x cos x solid angle. Mirrors give only their diffuse part: look for lights
 * in their direction with graze_surface_sample_lobe. Null is let pass for `samples` when `count` is 0. */
GRAZE_API graze_rgb graze_surface_direct(const graze_surface *, const graze_light_sample *samples, size_t count);

/* The reflectance functions at l in 1/sr: diffuse part and glossy part apart (the mirror part has no value). */
GRAZE_API void graze_surface_value(const graze_surface *, graze_vec3 l, graze_rgb *diffuse, graze_rgb *glossy);

/* Indirect light, Eq. 16. */
typedef struct graze_surface_sample {
    graze_vec3 direction; /* unit vector, also where rejected */
    graze_rgb weight; /* times the radiance from `direction`: an unbiased estimate for the lobe; black if rejected */
    double density;   /* per unit solid angle, of this lobe's sampler; 0 for a mirror and for rejected samples */
} graze_surface_sample;

/* Draws a direction for one lobe with s, t, u in [0,1): cosine-weighted for DIFFUSE (s, t), paired sampling for GLOSSY
 * (s, t, u), the mirror direction for MIRROR (none). A rejected sample counts as a sample of radiance 0. A specular
 * lobe other than the surface's specular_lobe, and NONE, only give rejected ones; DIFFUSE is drawn whatever its colour.
 */
GRAZE_API graze_surface_sample graze_surface_sample_lobe(const graze_surface *, graze_lobe, double s, double t,
                                                         double u);

/* The glossy lobe as Radiance sampled it before release 4, and still does by default: Ward's sampling (s, t), the
 * weight left out: every direction that is kept weighs `specular`, whatever the model. Draw again where it is rejected,
 * as Radiance does. For comparison only: at grazing angles this is wrong by tens of per cent and more. Other lobes than
 * GLOSSY, and views from the horizon or below, only give rejected samples. */
GRAZE_API graze_surface_sample graze_surface_sample_unweighted(const graze_surface *, double s, double t);

/* The density per unit solid angle with which graze_surface_sample_lobe draws l for this lobe. 0 for MIRROR and for
 * specular lobes that the surface does not have. */
GRAZE_API double graze_surface_density(const graze_surface *, graze_lobe, graze_vec3 l);

#ifdef __cplusplus
}
#endif

#endif
