/* Choosing a light for a surface point: about in proportion to what it would add to the radiance that leaves towards
 * the viewer, if nothing cast shadows. */
#ifndef SCENE_LIGHT_CHOICE_H
#define SCENE_LIGHT_CHOICE_H

#include "scene/light_weights.h"
#include "scene/scene.h"
#include "scene/windows.h"

/* A surface point that asks for light. */
typedef struct light_receiver {
    vec3 point;
    const graze_surface *surface;        /* its frame, lobe and view; to be kept as long as the choice */
    rgb diffuse, glossy;                 /* reflectance for LIGHT_DIRECT lights */
    rgb ambient_diffuse, ambient_glossy; /* for LIGHT_AMBIENT ones; black where they are not wanted */
    int window_draws;                    /* how often a sky is looked for in windows; 0: not */
    int draws;                           /* how many lights are chosen, or: */
} light_receiver;

/* As `draws`: none is chosen, every light is sampled. For LIGHT_GROUP_MOST lights at most. */
enum { LIGHT_EVERY_ONE = 0 };

/* How many of the lights, from the first one on, might light the point: glows in copies only where ambient ones do. */
static inline size_t light_choice_count(const graze_scene *scene, const light_receiver *r) {
    bool ambient = !rgb_is_black(r->ambient_diffuse) || !rgb_is_black(r->ambient_glossy);
    return ambient ? scene->light_count : scene->first_copied;
}

/* The lights as one point sees them. Large: not to be copied. */
typedef struct light_choice {
    const light_tree *tree;
    light_receiver receiver;
    int every; /* where every one is sampled, so many of them: light_choice_count */
    light_weights_input input;
    light_weights root;
    window_choice windows; /* where the sky is looked for, beside sampling it as a light */
} light_choice;

/* For a point that asks; windows are looked for if its reflection of ambient light is wanted. */
void light_choice_prepare(light_choice *, const graze_scene *, const light_receiver *);

/* For a point that nothing shines on. */
void light_choice_none(light_choice *);

/* Whether all of a light is above the plane through a point. False for lights that are never sampled. */
bool light_choice_is_above(const graze_scene *, int light, vec3 point, vec3 normal);

/* Whether any light could reach the point. */
static inline bool light_choice_is_possible(const light_choice *choice) {
    return choice->root.candidates > 0;
}

/* Whether every light is to be sampled, rather than some that light_choose chooses. */
static inline bool light_choice_is_every_one(const light_choice *choice) {
    return choice->receiver.draws == LIGHT_EVERY_ONE;
}

/* How often the light is sampled, on the average: the probability with which light_choose takes it, times the number of
 * draws; or 1, where every light is. It is 0 only where the light cannot reach the point. */
double light_expectation(const light_choice *, int light);

/* Chooses a light by a number in [0,1): lights that are near each other by numbers that are. To be called only if it is
 * possible. Gives its light_expectation. -1: the draw fell on a group none of whose lights can reach the point. */
int light_choose(const light_choice *, double random, double *expectation);

#endif
