/* A path on its way: what it carries, where it is, and how it got there. */
#ifndef TRACE_PATH_STATE_H
#define TRACE_PATH_STATE_H

#include "scene/light.h"
#include "trace/gathering.h"
#include "trace/hit.h"
#include "trace/path.h"
#include "trace/sampler.h"

/* The last reflection, as an emitter found next needs it. What has let the path through since then does not count as
 * one. */
typedef struct scattering {
    graze_lobe lobe;            /* NONE: the ray comes from the eye */
    double density;             /* of the direction, per unit solid angle, the choice of the lobe included */
    rgb direct;                 /* throughput for LIGHT_DIRECT, which differs where a gloss was made ambient */
    rgb indirect;               /* throughput for LIGHT_AMBIENT, also where the path ends with this reflection */
    bool ambient;               /* LIGHT_AMBIENT counts */
    const light_choice *lights; /* as seen from there */
    bool first;                 /* the path had only been mirrored before */
    bool refracted;             /* since then, or mirrored so that no light sample finds what is found beyond */
    bool veiled;                /* since then through the front of an illum, where only what is no such counts */
    double travelled;           /* from there to where the path was last let through or mirrored; 0: not since then */
    const vertex *vertex;       /* where that was; its lights are the above, unless it transmitted */
    int mirror;                 /* the flat mirror that has reflected the path since then, or -1 */
} scattering;

/* What is known of lights at the last vertex without sampling them, a bit for each of the first PATH_FEW_LIGHTS. */
typedef struct known_lights {
    unsigned controls; /* of these, what they would give without shadows: it is a control of what samples find */
    unsigned settled;  /* of these, all that they give: they are seen wholly, or not at all */
    unsigned watched;  /* of these, that they may be seen in part: controls tell how much, no more */
    unsigned clear;    /* of these, that nothing is on the way to any of their points */
    bool shared;       /* the controls are one for all */
} known_lights;

/* Light that has been bent, by a dielectric or a prism, on its way to where it was scattered is found by luck alone,
 * and of a small light so seldom that one path has far more of it than most. What is kept for many paths has none of
 * that, nor does what pixels share have any bent light that arrives there itself, which may have edges: paths that use
 * it look for these. */
typedef enum wanted_light {
    WANTED_ALL,
    WANTED_STRAIGHT, /* all but that */
    WANTED_BENT,     /* that; and all that the first scattering finds */
} wanted_light;

/* Where a vertex reflects small lights by a narrow lobe after a diffuse reflection (trace/rare_gloss.h). */
typedef enum rare_gloss {
    RARE_GLOSS_NONE, /* it does not */
    RARE_GLOSS_FLAT,
    RARE_GLOSS_CURVED,
    RARE_GLOSS_MIRROR, /* flat, and met by luck alone */
} rare_gloss;

/* Where a path that has only been mirrored or let through is to go on, too. */
typedef struct path_branch {
    vec3 point, direction;
    int64_t surface; /* that the point is on */
    double length;   /* from the eye to there */
    rgb throughput, medium;
    scattering last;
    int depth, passages;
} path_branch;

/* How often lights in mirrors and panes are sampled at a vertex (trace/virtual_lights.h). */
typedef struct virtual_lights_worth {
    double faint; /* for each part of their light that is reflected */
    double dim;   /* where there is no other light, */
    double rival; /* of which there is so much, in units of their weights */
} virtual_lights_worth;

enum { PATH_BRANCHES = 8 };

typedef struct path_branches {
    path_branch waiting[PATH_BRANCHES];
    int count;
} path_branches;

typedef struct path {
    const path_context *context;
    sampler *sampler;
    uint32_t first_group; /* that the sampler was at when the path, or its branch, began */
    int branches;         /* begun so far, but for the first */
    bool noisy;           /* an earlier branch has drawn from the sampler */
    double length;        /* from the eye to the last vertex */
    rgb throughput, radiance;
    rgb told[IRRADIANCE_PARTS]; /* as in path_sample, where it is `cached` */
    rgb direct; /* of `radiance`: what was there once the path had scattered and the light found then was added */
    rgb albedo; /* of the first point */
    rgb indirect_light; /* before the path scattered: of the ambient value, or known beforehand */
    int ambient_depth;  /* diffuse reflections so far */
    int ambient_limit;  /* how many there may be at this vertex */
    int depth;          /* all reflections so far */
    int passages;       /* how often it has been let through, straight on or refracted */
    int gleam_depth;    /* reflections up to the last that was drawn by gleams (trace/gleams.h) */
    bool in_mist;       /* there is mist (trace/mist.h) */
    bool hindered;      /* something may be on the way of light: mist, panes, clear bodies, or illums */
    rgb medium;         /* transmittance of a unit of length where the path is; set where the scene refracts */
    bool scattered;     /* whether any of them was not a mirror's */
    bool searching;     /* whether one may meet lights that no light sample finds */
    wanted_light wanted;
    bool gathering;      /* all that is asked is what the first point gets but straight from lights */
    bool indirect_known; /* that was known beforehand, with this error in what is reflected: */
    rgb indirect_error;
    bool cached;     /* whether any came from the irradiance cache */
    bool integrated; /* whether some of the radiance is known without sampling */
    scattering last;
    known_lights known;
    path_control controls[PATH_CONTROLS]; /* so many are set: */
    int control_count;
    rare_gloss gloss;     /* at the last vertex */
    path_unmet_at *unmet; /* what the path, or its branch, has begun to look for; null: nothing */
    rgb before;           /* the radiance then */
    path_rare rare;
    double gleam_weight;        /* so many times of what the path carried was left by that */
    virtual_lights_worth worth; /* at the last vertex at which lights were looked for in mirrors */
} path;

/* Whether the path is where all paths of its ray come first. */
static inline bool path_is_at_first(const path *p) {
    return p->depth == 0 && p->passages == 0;
}

/* Whether the direction of a lobe has a density, so that lights in it can be sampled, too. */
static inline bool lobe_scatters(graze_lobe lobe) {
    return lobe != GRAZE_LOBE_NONE && lobe != GRAZE_LOBE_MIRROR && lobe != GRAZE_LOBE_TRANSMITTED;
}

/* Whether the path is in a body that absorbs light; and what that leaves of it on a way. */
static inline bool path_is_in_body(const path *p) {
    return p->context->scene->has_refraction && rgb_min(p->medium) < 1;
}

static inline rgb path_medium_transmittance(const path *p, double distance) {
    return rgb_power(p->medium, distance);
}

/* Whether another diffuse reflection may follow. */
static inline bool path_bounces_left(const path *p) {
    return p->ambient_depth < p->ambient_limit;
}

static inline double power_heuristic(double density, double other) {
    double ratio = other / density;
    return 1 / (1 + ratio * ratio);
}

#endif
