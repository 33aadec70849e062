/* Virtual lights: those that a vertex sees in flat mirrors and panes, and how often each is sampled. */
#ifndef TRACE_VIRTUAL_LIGHTS_H
#define TRACE_VIRTUAL_LIGHTS_H

#include "scene/mirrors.h"
#include "trace/path_state.h"

/* A light in a mirror. */
typedef struct virtual_light {
    int light;     /* -1: any of many */
    double weight; /* about in proportion to what it gives */
    scene_mirror_sight sight;
} virtual_light;

/* Goes through those that a vertex may see. */
typedef struct virtual_lights {
    const path_context *context;
    const vertex *vertex;
    int bounced;  /* how often the path had been reflected diffusely where the vertex is */
    bool ambient; /* light that counts as ambient is looked for */
    bool panes;   /* and what panes show */
    size_t next;  /* mirror */
    int light;    /* the next one in the mirror before that */
    virtual_light now;
} virtual_lights;

/* Begins before the first one. What panes show lights diffuse surfaces only where a path that is reflected diffusely
 * would find it, as in Radiance: hence `bounced`. */
void virtual_lights_begin(virtual_lights *, const path_context *, const vertex *, int bounced);

/* The next one that may be seen, until the one after it is asked for; null: there are no more. */
const virtual_light *virtual_lights_next(virtual_lights *);

/* So many are kept. */
enum { VIRTUAL_LIGHTS_KEPT = 8 };

/* All that a vertex may see. */
typedef struct virtual_lights_survey {
    int count;
    double sum;   /* of their weights */
    double often; /* how often any of them is worth to be sampled */
    virtual_lights_worth worth;
    virtual_light kept[VIRTUAL_LIGHTS_KEPT]; /* the first ones */
} virtual_lights_survey;

/* Goes through all from the first one on, and is then before that again. */
void virtual_lights_look(virtual_lights_survey *, virtual_lights *, const virtual_lights_worth *);

/* What they are worth at a vertex that the path has come to, where other lights have been sampled. */
virtual_lights_worth virtual_lights_worth_at(const path *, const vertex *);

/* Whether that is less or more than once for each, so that it is decided by lot. */
bool virtual_lights_draw_lots(const virtual_lights_survey *);

/* How often one is sampled on the average. */
double virtual_lights_expectation(const virtual_lights_survey *, const virtual_light *);

/* Of any of many lights, which is drawn by a random number; how often, on the average, is put into *expectation. Of a
 * single one, that and 1. Negative: none. */
int virtual_light_draw(const virtual_lights *, const virtual_light *, double random, double *expectation);

/* How often, on the average, that draws this light. */
double virtual_light_chance(const virtual_lights *, const virtual_light *, int light);

/* Whether all surfaces of a mirror show paths what they show light samples. */
bool virtual_lights_paths_see(const graze_scene *, const scene_mirror *);

/* The direction as the mirror turns it. */
static inline vec3 virtual_lights_mirror(const scene_mirror *m, vec3 direction) {
    return vec3_add_scaled(direction, -2 * vec3_dot(m->plane.normal, direction), m->plane.normal);
}

#endif
