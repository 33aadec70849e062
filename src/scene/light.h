/* Lights as a point sees them: their role and radiance, and sampling one by solid angle. */
#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include "scene/scene.h"

/* Whether the light shines through the front of an illum, which stands for what is behind it: glows and other illums.
 */
static inline bool light_is_proper(const graze_scene *scene, int light) {
    return !scene->lights[light].glow && !scene->lights[light].secondary;
}

/* The role of a light for a point at `distance` (GEOMETRY_FAR for sources). */
light_role light_role_at(const scene_light *, double distance);

/* Radiance that leaves the light against `direction` (unit, towards the light) where its front's unit normal is
 * `normal` (ignored for sources): black from behind and outside a spotlight's cone. */
rgb light_radiance(const scene_light *, vec3 direction, vec3 normal);

/* The same as it lights a point at `distance`. A spotlight's light diverges from its focus behind it: what arrives is
 * weaker than the light is bright to the eye, by (distance / (distance + focus))^2. */
rgb light_radiance_at(const scene_light *, vec3 direction, vec3 normal, double distance);

/* The radiance of a light with patterns, see light_patterned. */
rgb light_pattern_radiance(const scene_light *, rgb radiance, vec3 point, vec3 direction, vec3 normal, double distance,
                           double travelled);

/* The radiance with the light's patterns, where it has any, for a ray that ends at `point` on it (of a source, the
 * ray's origin) after `distance`, and has come all the way from the eye by `travelled`. Not negative. */
static inline rgb light_patterned(const scene_light *light, rgb radiance, vec3 point, vec3 direction, vec3 normal,
                                  double distance, double travelled) {
    if (!light->modifiers)
        return radiance;
    return light_pattern_radiance(light, radiance, point, direction, normal, distance, travelled);
}

/* The source that a ray in this direction meets when nothing else is in its way, or -1: the first `light` in the
 * scene's order, else the first `glow`. */
int light_source_towards(const graze_scene *, vec3 direction);

/* Whether points get light of the source from this direction: of every `light` that is there, also where only the first
 * of them is seen; of a `glow` where it is. As in Radiance, for which `light`s are sampled and `glow`s are met. */
bool light_source_shines_from(const graze_scene *, int source, vec3 direction);

typedef struct light_sample {
    int light;       /* -1: the light's front is not seen from the point */
    vec3 direction;  /* unit, towards the light */
    double distance; /* GEOMETRY_FAR for a source */
    double density;  /* per unit solid angle */
    rgb radiance;
} light_sample;

/* Draws a direction from the point, which is `travelled` away from the eye, towards a light, by two numbers in
 * [0,1). */
light_sample light_draw(const graze_scene *, vec3 point, double travelled, int index, const double random[2]);

/* The same towards about its middle: a light as one direction shows it. */
static inline light_sample light_draw_middle(const graze_scene *scene, vec3 point, double travelled, int index) {
    return light_draw(scene, point, travelled, index, (const double[2]){0.5, 0.5});
}

/* The density of light_draw for a direction that meets light `index` at `hit_point` (ignored for sources). */
double light_density(const graze_scene *, vec3 point, int index, vec3 direction, vec3 hit_point, vec3 hit_normal);

#endif
