/* One light path: from a ray, or from a sensor, to one sample of radiance. */
#ifndef TRACE_PATH_H
#define TRACE_PATH_H

#include "trace/hit.h"
#include "trace/irradiance_cache.h"
#include "trace/sampler.h"

/* Direct light as if nothing cast shadows is known without sampling (trace/unshadowed.h). What the same samples would
 * find of it differs from it by `difference`, whose mean is 0; it may be added in any proportion. The best one is how
 * much of it is not shadowed, and that is about `lit / whole`: the brightness of what the samples find of it with
 * and without shadows. Where lights are chosen from many, nothing is added: the first tells what of them is hidden. */
typedef struct path_control {
    rgb difference;
    double lit, whole;
} path_control;

/* One for each of few lights at the first point, one for all lights at later points, and one that only tells how much
 * of the sky is hidden beside windows. */
enum { PATH_CONTROL_OF_SKY = PATH_FEW_LIGHTS + 1, PATH_CONTROLS };

/* What is known of the irradiance at the first point that does not come straight from lights. */
typedef struct path_indirect {
    rgb irradiance, error;      /* error: the standard error */
    rgb told[IRRADIANCE_PARTS]; /* of it, what the irradiance cache says */
} path_indirect;

/* Brightness that small lights give by narrow gloss, or in mirrors, after a diffuse reflection (trace/rare_gloss.h). */
typedef struct path_rare {
    double expected; /* in the mean over all directions */
    double squares;  /* variance of what is then found */
    double found;
    double times;    /* how often something was expected */
    bool by_mirrors; /* some of it in a mirror */
} path_rare;

typedef struct path_sample {
    rgb radiance;
    rgb indirect; /* the part of it that was reflected more than once, mirrors not counted before the first point that
                     is none, or comes from the ambient value */
    rgb albedo;   /* reflectance of what was hit first: diffuse and specular, as seen from there; 1 with -i */
    path_control controls[PATH_CONTROLS];
    int control_count; /* so many are set */
    path_rare rare;
    const path_unmet *unmet; /* of all samples of the estimate; null: nothing is known */
    bool cached;             /* some of it is what the irradiance cache says, the mean of its parts: */
    rgb told[IRRADIANCE_PARTS];
    rgb known_error; /* the standard error of what of it was known beforehand */
    bool noisy;      /* random numbers were drawn: another sample may differ */
    bool integrated; /* some of it is exact but for what graze/brdf_light.h allows */
    bool searching; /* light may come by ways that only luck finds, such as a lamp's image in a mirror on a diffuse wall
                     */
} path_sample;

/* One sample of the radiance that arrives from `first` along the ray (or of irradiance there, by the settings'
 * quantity). Starts at the hit, so that all samples of a ray share it. Draws from the sampler only where the answer
 * depends on it. */
void path_radiance(const path_context *, const path_hit *first, sampler *, path_sample *);

/* One sample of the irradiance on a sensor at `point`. */
void path_irradiance(const path_context *, vec3 point, vec3 normal, sampler *, path_sample *);

/* One sample of the irradiance at a record's point, on a path that has been reflected diffusely once. */
void path_irradiance_at(const path_context *, const struct irradiance_record *, sampler *, path_sample *);

/* Whether path_radiance would use what is known of the irradiance where a path begins; if so, where that is. */
bool path_asks_indirect(const path_context *, const path_hit *first, struct irradiance_record *);

/* One sample of the irradiance at a record's point, before any reflection: `indirect` alone counts, lights are not
 * looked for. */
void path_indirect_at(const path_context *, const struct irradiance_record *, sampler *, path_sample *);

#endif
