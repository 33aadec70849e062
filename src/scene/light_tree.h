/* The scene's lights in the order and the form in which one is chosen: as arrays, for vector instructions; many of them
 * in groups, which are chosen as lights are, by what is known of all in them. */
#ifndef SCENE_LIGHT_TREE_H
#define SCENE_LIGHT_TREE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/report.h"
#include "base/vector.h"
#include "graze/scene.h"

struct scene_light;

/* The entries of a group stand in blocks of so many. Each lane, of entries with the same place in their blocks, has
 * lights that are near each other, next to those of the lanes beside it. */
enum { LIGHT_LANES = 16 };

/* A group has at most so many entries: of more lights, groups are made. */
enum { LIGHT_GROUP_MOST = 256 };

/* Lengths are in units of the lights' extent; from a middle of theirs. Points are no farther from it than LIGHT_MOST,
 * sources at the distance LIGHT_FAR; distances are at least LIGHT_LEAST: so all products of floats are finite. */
#define LIGHT_MOST  1e11
#define LIGHT_FAR   1e9
#define LIGHT_LEAST 1e-10f

/* Entries are lights, or groups of lights. An entry that only fills its block is black. */
typedef struct light_entries {
    double *x, *y, *z;         /* its middle */
    float *ax, *ay, *az;       /* the middle of the normals of its surfaces, unit */
    float *all_around;         /* 1 where there is no such direction, else 0 */
    float *cosine, *sine;      /* of a group: of the largest angle between it and a normal */
    float *radius;             /* of a sphere around the middle that has all of it in it */
    float *quarter_per_radius; /* 1/(4 radius) */
    float *spread;             /* the mean square of the distance of its surfaces from the middle */
    float *core;               /* added to the square of a distance: what is very near is not infinitely bright */
    float *area;               /* projected, from where most is seen of it */
    float *red, *green, *blue; /* radiance as LIGHT_DIRECT, of the brightest colour's */
    float *ambient_red, *ambient_green, *ambient_blue;          /* as LIGHT_AMBIENT */
    float *spot_x, *spot_y, *spot_z, *spot_cosine, *spot_focus; /* as of the light; of what is none, -2 and 0 */
    int *child; /* of a group of lights: the light; else the group; -1: none */
} light_entries;

typedef struct light_group {
    size_t first;           /* of its entries */
    int blocks, far_blocks; /* the last are of sources */
    bool of_lights;
    int parent;          /* group; -1: this is the root */
    size_t parent_entry; /* this group in its parent */
} light_group;

struct light_weights_input;
struct light_weights;
struct light_tree;

/* Computes the weights of a group's entries: see scene/light_weights.h. */
typedef void light_weigh_function(const struct light_tree *, const light_group *, const struct light_weights_input *,
                                  struct light_weights *);

typedef struct light_tree {
    light_weigh_function *weigh;
    light_entries entries;
    size_t entry_count;
    light_group *groups; /* the root first */
    size_t group_count;
    int *group_of;    /* by light; -1 if it is never sampled */
    size_t *entry_of; /* by light */
    vec3 middle;
    double per_unit;
    bool has_glows, has_spots;
} light_tree;

/* A point of the scene in the tree's coordinates. */
vec3 light_tree_point(const light_tree *, vec3 point);

/* Makes the tree of the scene's lights, in the arena. */
graze_status light_tree_build(light_tree *, const struct scene_light *lights, size_t count, arena *,
                              const graze_report *);

#endif
