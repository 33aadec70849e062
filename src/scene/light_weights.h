/* About how much of each entry's light a surface reflects to its viewer, for a whole group at once. */
#ifndef SCENE_LIGHT_WEIGHTS_H
#define SCENE_LIGHT_WEIGHTS_H

#include "scene/light_tree.h"

/* The surface, in the numbers that the loop needs. */
typedef struct light_weights_input {
    double px, py, pz; /* the point, as light_tree_point has it */
    float xx, xy, xz;  /* the shading frame */
    float yx, yy, yz;
    float nx, ny, nz;
    float vx, vy, vz;            /* the view in it */
    float alpha_x2, alpha_y2;    /* roughness, squared */
    float diffuse[3], glossy[3]; /* reflectances times the brightness of each primary */
    float ambient_diffuse[3], ambient_glossy[3];
    bool has_lobe;
} light_weights_input;

typedef struct light_weights {
    double total;
    double lanes[LIGHT_LANES]; /* their sums */
    int candidates;
    float of[LIGHT_GROUP_MOST]; /* 0 only where no light can come from */
} light_weights;

/* The version for this processor. All give the same bits. */
light_weigh_function *light_weights_best(void);

light_weigh_function light_weights_baseline;
#if defined(__x86_64__) && defined(__GNUC__)
#define LIGHT_WEIGHTS_X86_64
light_weigh_function light_weights_avx2, light_weights_avx512;
#endif

#endif
