/* Lights as a point sees them: their role and radiance, choosing one, and sampling it by solid angle. */
#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include "scene/scene.h"

/* The role of a light for a point at `distance` (GEOMETRY_FAR for sources). */
light_role light_role_at(const scene_light *, double distance);

/* Radiance that leaves the light against `direction` (unit, towards the light) where its front's unit normal is
 * `normal` (ignored for sources): black from behind and outside a spotlight's cone. */
rgb light_radiance(const scene_light *, vec3 direction, vec3 normal);

/* The same as it lights a point at `distance`. A spotlight's light diverges from its focus behind it: what arrives is
 * weaker than the light is bright to the eye, by (distance / (distance + focus))^2. */
rgb light_radiance_at(const scene_light *, vec3 direction, vec3 normal, double distance);

/* The source that a ray in this direction meets when nothing else is in its way, or -1: the first `light` in the
 * scene's order, else the first `glow`. */
int light_source_towards(const graze_scene *, vec3 direction);

/* A surface point that asks for light. Fill in all but `importance` and `candidates` and call light_receiver_prepare.
 */
typedef struct light_receiver {
    vec3 point, normal; /* unit normal on the lit side */
    bool ambient;       /* whether LIGHT_AMBIENT lights are wanted, too */
    bool every;         /* every light is sampled: no light is chosen */
    int candidates;     /* lights that could reach the point */
    double importance;  /* of all lights together: about the irradiance they could give */
} light_receiver;

void light_receiver_prepare(const graze_scene *, light_receiver *);

/* The probability with which light_choose takes the light; 1 or 0 where every light is sampled. */
double light_probability(const graze_scene *, const light_receiver *, int light);

/* Chooses a light by a number in [0,1): a part of the choices in proportion to importance, the rest evenly among the
 * candidates, since a glossy surface may make much of a light of little importance. -1 where there is no candidate. */
int light_choose(const graze_scene *, const light_receiver *, double random, double *probability);

typedef struct light_sample {
    int light;       /* -1: the light's front is not seen from the point */
    vec3 direction;  /* unit, towards the light */
    double distance; /* GEOMETRY_FAR for a source */
    double density;  /* per unit solid angle */
    rgb radiance;
} light_sample;

/* Draws a direction towards a light, from two numbers in [0,1). */
light_sample light_draw(const graze_scene *, const light_receiver *, int index, const double random[2]);

/* The density of light_draw for a direction that meets light `index` at `hit_point` (ignored for sources), times
 * light_probability. */
double light_density(const graze_scene *, const light_receiver *, int index, vec3 direction, vec3 hit_point,
                     vec3 hit_normal);

#endif
