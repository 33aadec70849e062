/* Balls that mirror lights, sharply or by a narrow lobe, and the lights that they mirror. */
#ifndef SCENE_BALLS_H
#define SCENE_BALLS_H

#include "scene/light_summary.h"
#include "scene/scene.h"

/* Where there are more of either, none are noted: each then is a small part of what a point sees. */
enum { SCENE_BALLS_MOST = 8, SCENE_BALL_LIGHTS_MOST = 4 };

typedef struct scene_ball {
    vec3 center;
    double radius;
    int surface;
    double thrown;                        /* how much of what shines on it without shadows it throws back as gleams */
    double roughness_u, roughness_v;      /* of its lobe, 0 of a mirror; along u, and across it: */
    bool has_orientation;                 /* if they differ */
    vec3 orientation;                     /* the u vector */
    double light[SCENE_BALL_LIGHTS_MOST]; /* the share of each light in that; the sum is 1 */
} scene_ball;

typedef struct scene_ball_light {
    light_summary summary; /* lengths as in the scene; of a source, very far away */
    bool source;
    int64_t surface; /* -1: a source */
} scene_ball_light;

typedef struct scene_balls {
    int count, light_count;
    scene_ball of[SCENE_BALLS_MOST];
    scene_ball_light lights[SCENE_BALL_LIGHTS_MOST];
} scene_balls;

/* Sets the scene's, if it has balls and lights for them. Its light tree must be there. */
graze_status scene_balls_find(graze_scene *, const graze_report *);

#endif
