/* Panes of glass between rooms and the sky: the sky is looked for in them, as light samples of all of it would nearly
 * all end at the walls. */
#ifndef SCENE_WINDOWS_H
#define SCENE_WINDOWS_H

#include "scene/scene.h"

/* A point looks at so many windows, those that it sees most of. What it leaves out is found by luck alone: all panes
 * between the bars of some windows should be among them. */
enum { WINDOWS_SEEN_MOST = 64 };

/* Finds the panes that one side of sees much of a sky, and the other not; whether a sun shines through them, and whether
 * some of the sky comes in elsewhere. The scene's geometry must be there. */
graze_status scene_windows_find(graze_scene *, const graze_report *);

/* Windows as a point sees them. */
typedef struct window_choice {
    const struct scene_windows *windows;
    vec3 point;
    int count;
    int index[WINDOWS_SEEN_MOST];          /* of each among the scene's */
    double share[WINDOWS_SEEN_MOST];       /* about in proportion to the light that comes in; their sum is 1 */
    double expectation[WINDOWS_SEEN_MOST]; /* how often each is sampled, on the average */
} window_choice;

/* Of a point in front of a surface, by that one's normal: chooses windows, from which `draws` are taken, at least one;
 * each window once if there are no more of them. The scene must have windows. */
void window_choice_prepare(window_choice *, const graze_scene *, vec3 point, vec3 normal, int draws);

/* Which window of the choice, which has some, a number in [0,1) falls on. */
int window_choose(const window_choice *, double random);

/* Draws a direction of a window of the choice by two numbers in [0,1). False: nothing of it is seen. */
bool window_draw(const window_choice *, int which, const double random[2], vec3 *direction);

/* The densities of all draws together, per unit solid angle, for a unit direction; 0 beside the windows. */
double window_density(const window_choice *, vec3 direction);

#endif
