/* What a surface does to light: Radiance's plastic, metal and trans, their anisotropic kin, glass, and dielectric, for
 * any renderer to link.
 *
 * A graze_material is a primitive as it stands in a scene file; at a hit it becomes a graze_surface: colours and
 * roughness as seen from one direction, and the shading frame. Two entry points then answer what a renderer asks:
 * graze_surface_direct sums light samples (Eq. 18 of the paper, see brdf.h), graze_surface_sample_lobe draws a
 * direction in which to look for indirect light (Eq. 16). graze_surface_value and graze_surface_density let a renderer
 * combine both by multiple importance sampling: for each lobe, weight = value x cosine / density.
 *
 * What is reflected, for the colour C, the specularity s, and C' = white (plastic, trans) or C (metal), in 1/sr:
 *
 *   rough    C (1 - s) / pi + C' s f(l, v), where f is the lobe of brdf.h: Eq. 17 for GRAZE_BRDF_GMD
 *   mirror   C (1 - s) (1 - F(v.n)) (1 - F(l.n)) / pi, and in the mirror direction this share of the radiance:
 *            s + F(v.n) (1 - s) for plastic and trans, F(v.n) + C s (1 - F(v.n)) for metal
 *
 * with Radiance's estimate of Fresnel reflection F(c) = max(0, exp(-5.85 c) - 0.00287989916), for the viewer's cosine
 * bounded from below by 0.001, and F = 0 where s < 0.017999. All of it is reciprocal, and with GRAZE_BRDF_GMD reflects
 * at most what arrives if C and s are in 0 .. 1; larger values are computed as they stand (C (1 - s) becomes 0 where s
 * > 1). Light below the surface (l.n <= 0) is reflected by none, and nothing is reflected specularly to a viewer at or
 * below it (v.n <= 0).
 *
 * A trans with the transmission t and the transmitted specularity p lets t of what is not reflected specularly through
 * to its other side (l.n < 0), and so reflects only 1 - t of it diffusely: C (1 - s) t (1 - p) / pi diffusely (where it
 * is a mirror, with the same two factors 1 - F, of |l.n|), and C (1 - s) t p specularly (with 1 - F(v.n)): straight on
 * where it is a mirror, else about that direction d = -v, by
 *
 *   g(l, v) = exp(-|l - d|^2 / a^2) / (pi a_u a_v) x min(1 / sqrt(|l.n| v.n), 2 / max(|l.n|, v.n))
 *
 * where a is the roughness in the direction of l as seen along d: 1/a^2 = cos^2/a_u^2 + sin^2/a_v^2 of the angle from
 * the vector u, which is carried from the surface's plane to that across d by the smallest rotation. The Gaussian and
 * the square root are Radiance's; without the second term of the minimum, which counts where one cosine is more than
 * four times the other, more than everything would get through towards the horizon. The integral of g |l.n| over all l
 * is at most 1. It is reciprocal for a_u = a_v, and nearly so otherwise.
 *
 * An ashik2 with the colours C and S reflects C (1 - F(l.n)) / pi diffusely, F(c) = (1 - c)^5, and
 * S + (1 - S) F(v.n) by the lobe of Ashikhmin and Shirley, for the half vector h at the angle delta to n and phi to u,
 *
 *   sqrt((p_u + 1) (p_v + 1)) cos(delta)^(p_u cos^2(phi) + p_v sin^2(phi)) / (8 pi (l.h) max(l.n, v.n))
 *
 * Of C no more counts than what the specular part leaves of 1. (Radiance has no such bound, and at the horizon sends
 * out more than arrives.) A mirror reflects C.
 *
 * A glass is a thin pane: of a light's two polarisations, each reflected by the share R at a face (Fresnel's formulas
 * for the index n), it transmits straight on the mean of (1 - R)^2 T / (1 - R^2 T^2), and reflects the mean of R + (1 -
 * R)^2 R T^2 / (1 - R^2 T^2), where T = C^(1/c) is what its body, of the transmissivity C, lets pass at the cosine c
 * inside.
 *
 * A dielectric is the boundary of a solid: of the viewer's radiance the share R, the mean over both polarisations,
 * comes from the mirror direction, and (1 - R) (n/n')^2 from the refracted one by Snell's law, where n is the index on
 * the viewer's side and n' that on the other. (Radiance grows as the square of the index; the energy is 1 - R.) Beyond
 * the critical angle all is reflected. On its way through either side light is attenuated by
 * graze_material_attenuation.
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
    GRAZE_PLASTIC,    /* diffuse colour (1 - specularity) x colour, specular colour white */
    GRAZE_METAL,      /* both in the material's colour */
    GRAZE_ASHIKHMIN,  /* the model of Ashikhmin and Shirley, with a colour for each part */
    GRAZE_TRANS,      /* a plastic that lets some of the light through */
    GRAZE_GLASS,      /* a thin pane */
    GRAZE_DIELECTRIC, /* the boundary of a solid, or between two */
    GRAZE_MIRROR,     /* reflects in one direction from its front, and is black behind */
} graze_material_kind;

/* A material's parameters as in a scene file: `plastic`, `metal`, `trans` (isotropic), `plastic2`, `metal2`, `trans2`
 * (anisotropic), `ashik2`, `glass`, `dielectric`, `interface`, `mirror`. Those that a kind does not name are not looked
 * at. */
typedef struct graze_material {
    graze_material_kind kind;
    graze_brdf_model model; /* of the specular lobe; GRAZE_BRDF_GMD is what Radiance means */
    graze_rgb color;        /* 0 .. 1; of a glass the transmissivity */
    double specularity;     /* 0 .. 1 */
    double roughness_u,
        roughness_v;        /* along the orientation vector and across it, 0 .. GRAZE_ROUGHNESS_MAX; see below */
    int has_orientation;    /* plastic2, metal2, trans2: use `orientation`; else isotropic, and any frame will do */
    graze_vec3 orientation; /* the u vector, in world space, of any length and at any angle to the surface */
    double transmission;    /* trans: 0 .. 1 */
    double transmitted_specularity; /* trans: 0 .. 1 */
    graze_rgb specular_color;       /* ashik2: of the specular part; `color` is that of the diffuse one */
    double power_u, power_v;        /* ashik2: exponents, 0 .. 1e6 */
    double refraction; /* glass: index, at least 1; dielectric: that of the inside over that of the outside, above 0 */
    graze_rgb inside, outside; /* dielectric: transmissivity of a unit of length, 0 .. 1, behind and before the surface;
                                  of the outside, 1 but for an interface */
} graze_material;

typedef enum graze_lobe {
    GRAZE_LOBE_NONE = 0,
    GRAZE_LOBE_DIFFUSE,
    GRAZE_LOBE_GLOSSY, /* the rough specular lobe */
    GRAZE_LOBE_MIRROR, /* roughness 0: one direction, no density */
    /* The same to the other side: */
    GRAZE_LOBE_TRANSMITTED_DIFFUSE,
    GRAZE_LOBE_TRANSMITTED_GLOSSY,
    GRAZE_LOBE_TRANSMITTED, /* straight on or refracted: one direction, no density */
} graze_lobe;

/* A material at a hit, seen from `view`. */
typedef struct graze_surface {
    graze_rgb diffuse;  /* reflectance of the diffuse part, as seen from `view` */
    graze_rgb specular; /* reflectance colour of the specular part; Fresnel's estimate included for mirrors */
    int fresnel;        /* not 0: light at cosine c reaches the diffuse part by 1 - F(c): 1 for Radiance's estimate,
                           2 for that of ashik2 */
    graze_lobe specular_lobe; /* GLOSSY, MIRROR, or NONE where `specular` is black */
    graze_brdf lobe;          /* for GLOSSY; of ashik2 its model is GRAZE_BRDF_MODEL_COUNT, none, and: */
    double power_u, power_v;
    graze_vec3 x, y, n;          /* shading frame: x along u, right-handed, orthonormal */
    graze_vec3 view;             /* towards the viewer */
    graze_vec3 local_view;       /* the same in the frame */
    int transmits;               /* some light comes from the other side; else the following are not set: */
    graze_lobe transmitted_lobe; /* TRANSMITTED_GLOSSY, TRANSMITTED, or NONE where transmitted_specular is black */
    graze_rgb transmitted_diffuse;
    graze_rgb transmitted_specular;
    graze_vec3 transmitted; /* the direction in which the viewer looks on beyond the surface; the middle of a lobe */
    double transmitted_u, transmitted_v; /* a_u, a_v of TRANSMITTED_GLOSSY */
} graze_surface;

/* Prepares a surface. `normal` is the shading normal on the viewer's side (dot(normal, view) >= 0), but of a dielectric
 * or a mirror it is that of the outside or the front, wherever the viewer is; it and `view` must be unit vectors to a
 * double's precision. The surface's frame always stands on the viewer's side.
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

/* What a material lets straight through, of light that meets it at this cosine (0 .. 1) to its normal: glass, and trans
 * where it is a mirror, of which it is what TRANSMITTED weighs; else black. Shadow rays may pass these. */
GRAZE_API graze_rgb graze_material_straight_through(const graze_material *, double cosine);

/* The share of radiance that is left after a way, 0 or longer, through a dielectric, inside (1) or outside (0) of it;
 * 1 of other kinds. */
GRAZE_API graze_rgb graze_material_attenuation(const graze_material *, int inside, double distance);

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

/* The reflectance functions at l in 1/sr: diffuse part and glossy part apart (the mirror part has no value). For l
 * below the surface, what it transmits: those of TRANSMITTED_DIFFUSE and TRANSMITTED_GLOSSY. */
GRAZE_API void graze_surface_value(const graze_surface *, graze_vec3 l, graze_rgb *diffuse, graze_rgb *glossy);

/* Indirect light, Eq. 16. */
typedef struct graze_surface_sample {
    graze_vec3 direction; /* unit vector, also where rejected */
    graze_rgb weight; /* times the radiance from `direction`: an unbiased estimate for the lobe; black if rejected */
    double density;   /* per unit solid angle, of this lobe's sampler; 0 for MIRROR, TRANSMITTED and rejected samples */
} graze_surface_sample;

/* Draws a direction for one lobe with s, t, u in [0,1): cosine-weighted for DIFFUSE (s, t), paired sampling for GLOSSY
 * (s, t, u), the mirror direction for MIRROR (none), and the same for their likes on the other side. A rejected sample
 * counts as a sample of radiance 0. A specular lobe other than the surface's specular_lobe and transmitted_lobe, NONE,
 * and TRANSMITTED_DIFFUSE of a surface that does not transmit, only give rejected ones; DIFFUSE, and
 * TRANSMITTED_DIFFUSE of others, are drawn whatever their colour. */
GRAZE_API graze_surface_sample graze_surface_sample_lobe(const graze_surface *, graze_lobe, double s, double t,
                                                         double u);

/* The glossy lobe as Radiance sampled it before release 4, and still does by default: Ward's sampling (s, t), the
 * weight left out: every direction that is kept weighs `specular`, whatever the model. Draw again where it is rejected,
 * as Radiance does. For comparison only: at grazing angles this is wrong by tens of per cent and more. Other lobes than
 * GLOSSY, and views from the horizon or below, only give rejected samples. */
GRAZE_API graze_surface_sample graze_surface_sample_unweighted(const graze_surface *, double s, double t);

/* The density per unit solid angle with which graze_surface_sample_lobe draws l for this lobe. 0 for MIRROR and
 * TRANSMITTED and for lobes that the surface does not have. */
GRAZE_API double graze_surface_density(const graze_surface *, graze_lobe, graze_vec3 l);

#ifdef __cplusplus
}
#endif

#endif
