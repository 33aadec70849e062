/* Where balls show lights to a point: directions that bring much light, and are few.
 *
 * A diffuse reflection that is drawn by its cosine alone leads to one of these once in a while, and finds it bright: of
 * the noise that a glossy ball makes on the wall beside it, that is nearly all. So some of the directions are drawn
 * about each gleam instead, and weighed by the density of both ways together. Where a gleam is, and how wide, need not
 * be exact for that: what hides it, or what the ball really is like, only makes the choice less good. */
#ifndef TRACE_GLEAMS_H
#define TRACE_GLEAMS_H

#include <stdbool.h>

#include "graze/material.h"
#include "scene/balls.h"

/* The directions middle + a x + b y, before they are made unit vectors, with a = xx p, b = xy p + yy q: (p, q) is drawn
 * from a distribution around (0, 0). */
typedef struct gleam {
    bool seen;         /* else the following is not set: */
    vec3 middle, x, y; /* orthonormal */
    double xx, xy, yy;
} gleam;

/* What a ball shows. */
typedef struct gleams_of_ball {
    const scene_ball *ball;
    vec3 to_middle;                        /* from the point */
    double tangent_square;                 /* of the distance to where the ball begins to be seen */
    double share;                          /* of all directions, that are drawn for its gleams */
    bool found;                            /* what follows is known: */
    double lights[SCENE_BALL_LIGHTS_MOST]; /* which part of the share each light's gleam has */
    gleam of[SCENE_BALL_LIGHTS_MOST];
} gleams_of_ball;

typedef struct gleams {
    const graze_scene *scene;
    vec3 point;
    int count;
    double share; /* the sum of theirs, below 1 */
    gleams_of_ball of[SCENE_BALLS_MOST];
} gleams;

/* As a point sees them in a scene that has balls: how large their shares are. The rest is found where it is needed. */
void gleams_expect(gleams *, const graze_scene *, vec3 point, vec3 normal);

/* The same for a point from which many directions are drawn: finds all, and where something stands before a gleam, or
 * before the light that it shows, makes its share smaller. */
void gleams_look(gleams *, const graze_scene *, vec3 point, vec3 normal, int64_t surface);

/* Turns the numbers by which the surface's diffuse directions are drawn: those of as many directions as their share is
 * become ones of gleams. False: the direction leads below the horizon, or past the ball. */
bool gleams_turn(gleams *, const graze_surface *, double random[2]);

/* How much less often such a direction would be drawn by its cosine alone. */
double gleams_weight(gleams *, vec3 direction, vec3 normal);

#endif
