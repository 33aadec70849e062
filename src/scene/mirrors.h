/* Flat mirrors and panes of glass, in which lights are sampled, and which lights they may show to a point. */
#ifndef SCENE_MIRRORS_H
#define SCENE_MIRRORS_H

#include "scene/scene.h"

struct scene_builder;

/* A mirror's front, or panes of glass in one plane, as far as coordinates tell: windows with bars, facades. */
typedef struct scene_mirror {
    int first, count; /* of scene->mirror_surfaces, which are its surfaces */
    bool pane;        /* of glass: it mirrors on both sides, little of what meets it steeply */
    shape_plane plane;
    vec3 middle; /* of a sphere around it, in its plane */
    double radius;
} scene_mirror;

/* The cone of directions, or the sphere, that a light is in. */
typedef struct scene_mirrored_light {
    bool source, ambient; /* ambient: light_is_ambient */
    vec3 middle;          /* of a source: the direction towards it */
    double radius;        /* of a source: the sine of its half angle, */
    double cosine;        /* and the cosine */
    double brightness;
} scene_mirrored_light;

/* A mirror as a point sees it. */
typedef struct scene_mirror_sight {
    const scene_mirror *mirror;
    double side;         /* 1: the point is before it, -1: behind */
    vec3 image;          /* of the point */
    vec3 towards;        /* the middle, from there: a unit vector */
    double sine, cosine; /* of half the angle that the sphere is seen under; 1 and -1 from within */
    double share;        /* of directions, in proportion to others, that it is seen in */
    double reflects;     /* about so much of what it shows */
} scene_mirror_sight;

/* Notes a surface if lights are to be sampled in it. */
void scene_mirrors_note(struct scene_builder *, int index);

/* From what is noted, after all that may cut it and all lights, to the scene's mirrors. Of very many planes of panes
 * the largest are kept. */
graze_status scene_mirrors_make(graze_scene *, const graze_report *);

/* Whether a point may see something in the mirror, above the horizon of `normal`. */
bool scene_mirror_see(const scene_mirror *, vec3 point, vec3 normal, scene_mirror_sight *);

/* About how much of a light is seen there, in proportion to others; 0: none, for certain. */
double scene_mirror_shows(const scene_mirror_sight *, const scene_mirrored_light *);

/* Whether the mirror may show a part of the light, but not all of it: an edge of its surfaces may be there. */
bool scene_mirror_shows_part(const graze_scene *, const scene_mirror_sight *, const scene_mirrored_light *);

/* The surface that the mirror is at a point in its plane; -1: there is none. */
int scene_mirror_at(const graze_scene *, const scene_mirror *, vec3 point);

/* The mirror that a surface is of which `mirrors`. */
static inline const scene_mirror *scene_mirror_of(const graze_scene *scene, int surface) {
    return &scene->mirrors[scene->mirror_of[surface]];
}

#endif
