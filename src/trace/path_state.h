/* A path on its way: what it carries, where it is, and how it got there. */
#ifndef TRACE_PATH_STATE_H
#define TRACE_PATH_STATE_H

#include "graze/material.h"
#include "scene/light.h"
#include "scene/light_choice.h"
#include "trace/hit.h"
#include "trace/path.h"
#include "trace/sampler.h"

/* A point that light is gathered at, and how the path got there. */
typedef struct vertex {
    vec3 point;
    int surface; /* -1: a sensor */
    graze_surface shading;
    rgb ambient; /* reflectance of the ambient term: diffuse, and lobes below the specular threshold */
    bool gloss_is_ambient;
    bool no_ambient; /* diffuse light from surfaces is not followed here (-ae, -ai) */
} vertex;

/* The last reflection, as an emitter found next needs it. */
typedef struct scattering {
    graze_lobe lobe;            /* NONE: the ray comes from the eye */
    double density;             /* of the direction, per unit solid angle, the choice of the lobe included */
    rgb direct;                 /* throughput for LIGHT_DIRECT, which differs where a gloss was made ambient */
    rgb indirect;               /* throughput for LIGHT_AMBIENT, also where the path ends with this reflection */
    bool ambient;               /* LIGHT_AMBIENT counts */
    const light_choice *lights; /* as seen from there */
} scattering;

/* The lights at the last vertex whose unshadowed light is known, a bit each, and where to keep the control of the first
 * of them. */
typedef struct known_lights {
    unsigned lights;
    unsigned settled; /* of others all that they give is known: they are seen wholly, or not at all */
    bool shared;      /* one control for all */
} known_lights;

typedef struct path {
    const path_context *context;
    sampler *sampler;
    rgb throughput, radiance;
    rgb told[IRRADIANCE_PARTS]; /* as in path_sample, where it is `cached` */
    rgb direct; /* of `radiance`: what was there once the path had scattered and the light found then was added */
    rgb albedo; /* of the first point */
    rgb ambient_light; /* of the ambient value, before the path scattered */
    int ambient_depth; /* diffuse reflections so far */
    int ambient_limit; /* how many there may be at this vertex */
    int depth;         /* all reflections so far */
    bool scattered;    /* whether any of them was not a mirror's */
    bool searching;    /* whether one may meet lights that no light sample finds */
    bool cached;       /* whether any came from the irradiance cache */
    bool integrated;   /* whether some of the radiance is known without sampling */
    scattering last;
    known_lights known;
    path_control controls[PATH_CONTROLS]; /* so many are set: */
    int control_count;
} path;

/* Probabilities of going on with each lobe; they sum to at most 1. Where a lobe `ends`, the ray only looks for lights
 * that shine on the vertex: what sampling the lights would find. */
typedef struct lobe_choice {
    double diffuse, specular;
    bool diffuse_ends, specular_ends;
} lobe_choice;

/* Whether another diffuse reflection may follow. */
static inline bool path_bounces_left(const path *p) {
    return p->ambient_depth < p->ambient_limit;
}

static inline double power_heuristic(double density, double other) {
    double ratio = other / density;
    return 1 / (1 + ratio * ratio);
}

#endif
