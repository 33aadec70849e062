/* What is known of a light, or of all in a group, where one is chosen. */
#ifndef SCENE_LIGHT_SUMMARY_H
#define SCENE_LIGHT_SUMMARY_H

#include "scene/light_tree.h"
#include "scene/scene.h"

/* A light, or all of a group, as it becomes an entry; lengths in units. */
typedef struct light_summary {
    vec3 middle;
    vec3 axis;     /* null: none */
    double cosine; /* -1: all around */
    double radius, spread, core, area;
    rgb radiance, ambient;
} light_summary;

/* A light of the scene, by its number, and where to sort it. */
typedef struct light_place {
    double key;
    int light;
} light_place;

light_summary light_summarize(const light_tree *, const scene_light *);

/* What is known of `count` of the lights together, at least one; `summaries` has all of the scene's, by their numbers.
 */
light_summary light_summarize_all(const light_summary *summaries, const light_place *, size_t count);

#endif
