/* From a ray to radiance with its standard error. */
#ifndef GRAZE_TRACE_H
#define GRAZE_TRACE_H

#include <stdint.h>

#include "graze/error.h"
#include "graze/export.h"
#include "graze/scene.h"
#include "graze/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How light from lights is found. The first three converge to the same answer. */
typedef enum graze_strategy {
    GRAZE_STRATEGY_MIS = 0,    /* light samples and reflected directions, combined by multiple importance sampling */
    GRAZE_STRATEGY_LIGHT,      /* Eq. 18 alone wherever a light can be sampled */
    GRAZE_STRATEGY_BRDF,       /* Eq. 16 alone */
    GRAZE_STRATEGY_UNWEIGHTED, /* Eq. 16 without its weights, for comparison: wrong, see graze_surface_sample_unweighted
                                */
} graze_strategy;

/* What is to be computed of a ray. */
typedef enum graze_quantity {
    GRAZE_RADIANCE = 0,   /* radiance arriving along the ray, W/sr/m^2 */
    GRAZE_IRRADIANCE_HIT, /* rtrace's -i: irradiance in W/m^2 on what the ray hits first; a light's radiance stays */
    GRAZE_IRRADIANCE, /* rtrace's -I: irradiance on a sensor 0.0001 above the ray's origin, the direction its normal */
} graze_quantity;

/* How much of it: by what it reaches the ray's origin. The two parts add up to the whole. */
typedef enum graze_part {
    GRAZE_WHOLE = 0,
    GRAZE_MIRRORED,   /* by mirror reflection on the first surface, which rough lobes are not: rtrace's -or */
    GRAZE_UNMIRRORED, /* the rest: rtrace's -ox */
} graze_part;

/* Start from graze_trace_defaults() and change what you want. */
typedef struct graze_trace_settings {
    graze_quantity quantity;
    graze_part part;
    graze_strategy strategy;
    int ambient_bounces;       /* -ab: diffuse interreflections followed, >= 0 */
    graze_rgb ambient_value;   /* -av: radiance that stands for all diffuse light beyond; 0 .. 1e100 */
    graze_rgb mist_extinction; /* -me: of mist everywhere, per unit of length; 0 .. 1e100 */
    graze_rgb mist_albedo;     /* -ma: of mist that says none: the part of the extinction that is scattered, 0 .. 1 */
    double mist_eccentricity;  /* -mg: the same of Henyey and Greenstein's phase function, -1 .. 1, exclusively; 0 or
                                  below: all directions alike */
    int back_faces_visible;    /* -bv: 0: opaque surfaces seen from behind are not there (but cast shadows) */
    int lights_visible;        /* -dv: 0: lights nearer than a glow's radius are black to the eye and in mirrors */
    int reflection_limit;      /* -lr: > 0: no more reflections than this before a light; 0: roulette; < 0: both */
    double minimum_weight;     /* -lw: below this weight paths are dropped (reflection_limit > 0) or play roulette */
    double specular_threshold; /* -st: rough lobes up to this specularity, 0 .. 1, are diffuse for indirect light */
    double error;              /* stop when the standard error is about error x value or less; > 0 */
    double floor;              /* ... or below error x floor, in the unit of the value; >= 0 */
    uint32_t samples;          /* not 0: exactly this many paths (but 1 where all paths are equal); powers of 2 serve
                                  best; 1 leaves the standard error unknown */
    uint32_t sample_limit;     /* with `error`: never more paths than this, at least 2 */
    uint64_t seed;             /* other seeds give other, equally good answers */
} graze_trace_settings;

GRAZE_API graze_trace_settings graze_trace_defaults(void);

/* Checks the settings; reports the first that is out of its range. */
GRAZE_API graze_status graze_trace_check(const graze_trace_settings *settings, const graze_report *report);

typedef struct graze_ray {
    graze_vec3 origin;
    graze_vec3 direction; /* of any length but 0: it is normalised */
    double limit;         /* surfaces beyond this distance are not seen; 0 or less: no limit */
} graze_ray;

/* Distance of what a ray never meets. */
#define GRAZE_FAR 1e10

/* What a ray met first. Names live as long as the scene and are null where there is none. */
typedef struct graze_hit {
    const char *surface;       /* null: nothing was hit */
    const char *modifier;      /* of the surface */
    const char *material;      /* at the end of the modifiers */
    double distance;           /* GRAZE_FAR: nothing, or a source infinitely far away */
    graze_vec3 point;          /* on the surface; the origin where nothing was hit */
    graze_vec3 normal;         /* unit, on the surface's own front; null vector where nothing was hit */
    graze_vec3 shading_normal; /* the same, perturbed by textures (not for
                                  GRAZE_IRRADIANCE_HIT), or a mesh's; on the ray's side unless the surface
                                  shines, or is of a clear body */
    double uv[2];              /* texture coordinates of a mesh; else 0 */
} graze_hit;

/* The standard error of one sample that random numbers went into: not known. */
#define GRAZE_UNKNOWN_ERROR (-1.0)

typedef struct graze_answer {
    graze_rgb value;
    graze_rgb standard_error; /* of `value`: `value` +- 1.96 of these holds the truth 19 times of 20; 0 where all
                                 samples were equal, 1e-8 x value or more where light was integrated without sampling,
                                 GRAZE_UNKNOWN_ERROR with settings.samples 1 */
    uint32_t samples;         /* paths taken */
    int converged;            /* 0: sample_limit was reached before the error asked for */
} graze_answer;

/* Where a ray goes, without any light. The ray must be finite, its direction not null: else `hit` is of nothing, and so
 * it is for GRAZE_IRRADIANCE. */
GRAZE_API void graze_cast(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray,
                          graze_hit *hit);

/* Traces one ray. `stream` tells rays apart: the same scene, settings, ray and stream give the same bits, on any
 * thread, in any order; use the ray's number. The settings must have passed graze_trace_check. `hit` may be null; for
 * GRAZE_IRRADIANCE it is of nothing. A ray that is not finite or has no direction answers 0.
 *
 * Samples come in two halves. Each goes on until the other has found that the answer will have the error asked for:
 * a half that judged itself would stop where it happens to agree with itself, and be wrong more often than it says.
 * What both together state is then mostly below the error asked for, seldom half as much again, and several times it
 * where few samples find most of the light.
 *
 * What unshadowed lights throw directly on the first point that is no mirror is integrated rather than sampled
 * (graze/brdf_light.h). A light that is found to be seen wholly from there, or not at all, is not sampled; where all
 * are, and nothing else could be reflected, one path answers. Of other lights, what the samples find corrects the
 * integral, which counts as far as the other half finds no shadows. At later points, and of a single sample, only the
 * diffuse term is integrated, where all of a part of a large polygon sees the whole light.
 *
 * Where up to 8 spheres of the scene's own are mirrors or have narrow lobes, and there are up to 4 lights, the first
 * two diffuse reflections of a path go to where these show lights more often than by chance, and count the less for it:
 * answers beside such spheres are better, not other.
 *
 * The standard error is estimated from what the samples found: how the means of neighbouring blocks of 1, 2, 4 ...
 * samples differ tells how fast the error falls with their number, and that is taken to go on, at a rate between
 * 1/sqrt(samples), that of independent samples, and 1/samples. It is stated so much larger that 1.96 of it to each side
 * hold the truth in 95% of all answers. Of what is smooth errors fall faster, and are stated too large. Light that none
 * of the samples found, such as that which a small lamp throws on a diffuse wall by way of two mirrors, is in neither
 * the value nor its error; of that by way of one, the error has what is to be expected in the mean over all directions.
 */
GRAZE_API void graze_trace(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray,
                           uint64_t stream, graze_answer *answer, graze_hit *hit);

/* The length of a ray by way of the first surface, if that is a mirror, to what is seen in it; GRAZE_FAR if it is none,
 * or nothing is seen. */
GRAZE_API double graze_mirrored_distance(const graze_scene *scene, const graze_trace_settings *settings,
                                         const graze_ray *ray);

/* One ray of the paths that answer a ray. What is called its radiance is what this one path finds along it. */
typedef struct graze_tree_ray {
    int depth;                /* reflections before it; 0: the ray asked for */
    int shadow;               /* 1: it was sent to a point of a light, and arrived */
    graze_vec3 origin;        /* of a sensor (GRAZE_IRRADIANCE): where it stands */
    graze_vec3 direction;     /* unit */
    graze_hit hit;            /* of a sensor: nothing */
    graze_rgb radiance;       /* along the ray */
    graze_rgb coefficient;    /* which part of it the answer gets: reflectances, weights and probabilities multiplied */
    graze_rgb contribution;   /* to the answer: their product, the sum of those of all rays that it leads to */
    graze_rgb mirrored;       /* the part of `radiance` that a mirror at its end reflects */
    double mirrored_distance; /* to what is seen in that; GRAZE_FAR where there is none */
} graze_tree_ray;

/* Takes `paths` paths (at least 1), and tells of every ray they consist of: each after all that follow from it, last
 * the ray asked for, whose radiance is the answer: the mean over the paths. Shadow rays that meet something else first
 * contribute nothing and are not told of. Contributions sum from ray to ray, up to what the ambient value adds on
 * surfaces. Settings, stream and bits as in graze_trace, but for error, samples and part, which do not count; and light
 * from lights is all sampled. An error means that there is no memory; a ray that graze_trace would answer with 0 is
 * told of as one that meets nothing. */
GRAZE_API graze_status graze_trace_tree(const graze_scene *scene, const graze_trace_settings *settings,
                                        const graze_ray *ray, uint64_t stream, uint32_t paths,
                                        void (*visit)(void *user, const graze_tree_ray *), void *user,
                                        const graze_report *report);

#ifdef __cplusplus
}
#endif

#endif
